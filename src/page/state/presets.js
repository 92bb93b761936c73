// Motions worth seeing, each a link with what there is to see; and a tour of six steps through them.

export const presets = [
  ["Puck", "", "Spun 9.5 times a second, a puck slides 4 times as far as one that does not spin."],
  ["No spin", "ball=puck&orbits=0,0.5", "Without spin a puck at 0.5 m/s slides 0.127 m, and textbooks are right."],
  ["Gel ball", "ball=gel&orbits=9,0.5", "Spun 48 times a second, this ball slides 0.239 m before it rolls; textbooks say 12.5 mm."],
  ["Pool ball", "ball=pool&orbits=2.8575,1", "With side spin, a pool ball slides 1.9 times as far before it rolls."],
  ["Massé", "ball=pool&orbits=3,4,0.9,0.9&rollingFriction=0.01", "Friction pulls along the slip: the path curves by 60° in 0.747 m, then the ball rolls straight on."],
  ["Bowling hook", "ball=bowling&orbits=1,3,3,7", "The hook: the path curves by 6.2° in 3.28 m, then the ball rolls straight on."],
  ["Floor polisher", "body=disc&law=uniform&orbits=6,0.5", "What spins fast is hardly held: this disc slides 10 times as far."],
  ["Curling stone", "ball=curling-stone", "Sliding alone would last 25.5 s, turning alone 3.24 s; together they end at one instant, after 26.8 s."],
].map(([title, fragment, says]) => ({ title, fragment, says }));

export const tour = [
  ["What couples", "Every point of the patch rubs against its own slip, and spin turns most of that slip sideways. So little is left of the friction to stop what slides: watch the pink arrow under the patch.", ""],
  ["The plane", "Each motion is one curve here: up is sliding, sideways is spinning. Every curve ends in the same point, rest, and the dot goes with the ball.", "ball=gel&orbits=9,0.5;4,0.5;1,0.5;-3,0.4"],
  ["One curve for all", "Leave twice as fast and spin twice as fast: the same curve, twice as large, and twice as long until the stop. Pull a start along its ray, or its size c from 0 to ∞: it runs through its copies, and below all of them are one line.", "body=disc&law=uniform&window=2,2&orbits=1.6,1.4;0.8,0.7;0.4,0.35"],
  ["The symmetry", "Spin to the left or to the right: the ball slides equally far. The plane is its own mirror image.", "mu=0.3&window=1,4&orbits=0.8,3.5;-0.8,3.5"],
  ["Small patches", "On a small patch a little spin hardly matters: this pool ball slides 3.6 % farther than the textbook says. It still spins long after it has begun to roll.", "ball=pool&orbits=0.2286,1&part=whole"],
  ["Why steppers fail", "Near rest the slip falls faster than any power of the spin: below 10⁻³⁰⁰, long before the spin is gone. A step-by-step program loses it; here its logarithm is exact.", "mu=0.05&view=pair&orbits=0.8,3.5;0.3,1"],
].map(([title, text, fragment]) => ({ title, text, fragment }));
