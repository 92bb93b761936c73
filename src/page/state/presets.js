// Motions worth seeing, each a link and a sentence; and a tour of eight steps.

const bounce = "ball=gel&orbits=15,1";
// Struck at 2.5 m/s, 0.4 radii to the right of the centre and 0.3 below it, by a cue that is raised by 60 degrees.
const stroke = "ball=pool&orbits=1.28866,3.91931,1.05927,-0.733885";
const masse = `${stroke}&rollingFriction=0.01`;

/** `shows`: the copies of a motion, or a card in the place of the plane. */
export const tour = [
  ["Why spin matters", "Friction acts on every point of the contact patch, against the slip of that point. Spin turns most of this slip sideways. Only a small part of the friction then slows the sliding: watch the arrow under the patch.", ""],
  ["The plane", "Each motion is one curve in this plane. Height is sliding speed, distance to the side is spin. Every curve ends at the same point, rest. The dot moves with the ball.", "ball=gel&orbits=9,0.5;4,0.5;1,0.5;-3,0.4"],
  ["One curve for all", "Slide twice as fast and spin twice as fast: the curve has the same shape, is twice as large, and takes twice as long until the stop. Drag a start along the line to rest, or move the slider of the size. In the small panels all these curves are one line.", "body=disc&law=uniform&window=2,2&orbits=1.6,1.4;0.8,0.7;0.4,0.35", "copies"],
  ["Left and right", "With spin to the left or to the right the ball slides equally far. So the two halves of the plane are mirror images.", "mu=0.3&window=1,4&orbits=0.8,3.5;-0.8,3.5"],
  ["Small patches", "With a small patch a little spin hardly matters: this pool ball slides 3.6 % farther than textbooks predict. It still spins long after it has begun to roll.", "ball=pool&orbits=0.2286,1&part=whole"],
  ["Why time steps fail", "Near rest the slip is a high power of the spin: it falls below 10⁻³⁰⁰ long before the spin is gone. A program that goes in time steps loses the slip. This page computes its logarithm exactly.", "mu=0.05&view=log&orbits=0.8,3.5;0.3,1"],
  ["It bounces differently", "A ball that hits the floor slides on it for an instant. Spin about the vertical weakens the friction of this instant, too: the ball that spins keeps more of its speed, and leaves at another angle.", bounce, "bounce"],
  ["With a cue", "The dot is the place that the tip of the cue hits: to the side for spin about the vertical, low for backspin. If the butt is raised, too, the path curves. Drag the dot, and watch the table.", masse, "cue"],
].map(([title, text, fragment, shows = ""]) => ({ title, text, fragment, shows }));

const stepThatShows = (card) => tour.findIndex(({ shows }) => shows === card);

/** Rounds of the game: lines that a throw must reach by spin alone, then a mark behind a stone. */
export const rounds = [
  ...[1, 2, 3].map((line) => `ball=puck&orbits=2.286,0.5&line=${line}`), `${stroke}&line=0.6&step=${stepThatShows("cue")}`,
];

export const presets = [
  ["Puck", "", "Spun 9.5 times a second, a puck slides 4 times as far as one that does not spin."],
  ["Gel ball", "ball=gel&orbits=9,0.5", "Spun 48 times a second, this ball slides 0.239 m before it rolls; textbooks predict 12.5 mm."],
  ["Pool ball", "ball=pool&orbits=2.8575,1", "With side spin, a pool ball slides 1.9 times as far before it rolls."],
  ["Massé", `${masse}&step=${stepThatShows("cue")}`, "Struck steeply and off its centre, this ball follows a path that friction curves by 60° in 0.575 m."],
  ["Bounce", `${bounce}&step=${stepThatShows("bounce")}`, "Dropped on the floor, the ball that spins leaves at 37.8° from the vertical, the other at 32.5°."],
  ["Bowling hook", "ball=bowling&orbits=1,3,3,7", "The path curves by 6.2° in 3.28 m; then the ball rolls straight on."],
  ["Curling stone", "ball=curling-stone", "Sliding alone would last 25.5 s, spinning alone 3.24 s; together they end at the same instant, after 26.8 s."],
].map(([title, fragment, says]) => ({ title, fragment, says }));
