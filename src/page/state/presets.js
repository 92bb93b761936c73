// Motions worth seeing, each a link and a sentence; and a tour of eight steps.

const bounce = "ball=gel&orbits=15,1";
// Struck at 2.5 m/s, 0.4 radii to the right of the centre and 0.3 below it, by a cue that is raised by 60 degrees.
const stroke = "ball=pool&orbits=1.28866,3.91931,1.05927,-0.733885";
const masse = `${stroke}&rollingFriction=0.01`;

/** `shows`: the copies of a motion, or a card in the place of the plane. */
export const tour = [
  ["Why spin matters", "Friction acts on every point of the contact patch, against the slip of that point. Spin turns most of this slip sideways. Only a small part of the friction then slows the sliding. Turn the spin above the patch, and watch the arrows.", ""],
  ["The plane", "Each motion is one curve in this plane. Height is sliding speed, distance to the side is spin. Every curve ends at the same point, rest. The dot moves with the ball.", "ball=gel&orbits=9,0.5;4,0.5;1,0.5;-3,0.4"],
  ["One curve for all", "Slide twice as fast and spin twice as fast: the curve has the same shape, is twice as large, and takes twice as long until the stop. Drag a start along the line to rest. In the small panels all these curves are one line.", "ball=puck&window=8,2.4&orbits=6.096,2;3.048,1;1.524,0.5", "copies"],
  ["Left and right", "With spin to the left or to the right the ball slides equally far. So the two halves of the plane are mirror images.", "ball=gel&window=11,0.6&orbits=9,0.5;-9,0.5"],
  ["Small patches", "With a small patch a little spin hardly matters: this pool ball slides 3.6 % farther than textbooks predict. It still spins long after it has begun to roll.", "ball=pool&orbits=0.2286,1&part=whole"],
  ["Why time steps fail", "Near rest the slip is a high power of the spin: it falls below 10⁻³⁰⁰ m/s while 9 % of the spin is left. A program that goes in time steps loses the slip. This page computes its logarithm exactly.", "ball=pool&view=log&orbits=2.8575,1;1.5,0.5"],
  ["It bounces differently", "A ball that hits the floor slides on it for an instant. Spin about the vertical weakens the friction of this instant, too: the ball that spins keeps more of its speed, and leaves at another angle.", bounce, "bounce"],
  ["With a cue", "The dot is the place that the tip of the cue hits: to the side for spin about the vertical, low for backspin. If the butt is raised, too, the path curves. Drag the dot, and watch the table.", masse, "cue"],
].map(([title, text, fragment, shows = ""]) => ({ title, text, fragment, shows }));

const stepThatShows = (card) => tour.findIndex(({ shows }) => shows === card);

/** Rounds of the game: lines that a throw must reach by spin alone, then a mark behind a stone. */
export const rounds = [...[1, 2, 3].map((line) => `line=${line}`), `${stroke}&line=0.6&step=${stepThatShows("cue")}`];

export const presets = [
  ["Puck", "", "With 9.5 turns a second, a puck slides 4 times as far as one that does not spin."],
  ["Gel ball", "ball=gel&orbits=9,0.5", "With 48 turns a second, this ball slides 0.239 m before it rolls; textbooks predict 12.5 mm."],
  ["Pool ball", "ball=pool&orbits=2.8575,1", "With side spin, a pool ball slides 1.9 times as far before it rolls."],
  ["Massé", `${masse}&step=${stepThatShows("cue")}`, "Struck steeply and off its centre, this ball follows a path that friction curves by 60° in 0.575 m."],
  ["Bounce", `${bounce}&step=${stepThatShows("bounce")}`, "Dropped on the floor, the ball that spins leaves at 37.8° from the vertical, the other at 32.5°."],
].map(([title, fragment, says]) => ({ title, fragment, says }));
