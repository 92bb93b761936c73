// A ball on a wall in LAMMPS.
import { execFileSync } from "node:child_process";
import { fading, slipOf } from "./fading.mjs";

/**
 * @param normal      normal model, "hertz" or "hooke"
 * @param stiffness   its stiffness, Pa or N/m; the ball starts in equilibrium with this stiffness
 * @param twisting    words of the twisting model
 * @param end         s
 */
export function lammpsTimes(ball, { normal, stiffness, twisting }, end) {
  const { radius, mass, friction, gravity, slip, spin } = ball;
  const dt = 5e-4; // s
  const load = mass * gravity;
  const tangential = { hertz: "mindlin", hooke: "linear_history" }[normal];
  const overlap = normal === "hooke" ? load / stiffness : (load / stiffness) ** (2 / 3) / radius ** (1 / 3);
  const input = `
    units si
    atom_style sphere
    boundary p p f
    comm_modify vel yes cutoff ${4 * radius}
    region box block -1 1 -1 1 ${-radius} ${4 * radius}
    create_box 1 box
    create_atoms 1 single 0 0 ${radius - overlap}
    set atom 1 diameter ${2 * radius} density ${mass / ((4 / 3) * Math.PI * radius ** 3)} omega 0 0 ${spin}
    velocity all set ${slip} 0 0
    pair_style zero ${radius}
    pair_coeff * *
    fix motion all nve/sphere
    fix weight all gravity ${gravity} vector 0 0 -1
    fix wall all wall/gran granular ${normal} ${stiffness} 0 tangential ${tangential} ${stiffness} 0 ${friction} ${twisting} &
      damping velocity zplane 0 NULL
    compute of all property/atom vx vy omegax omegay omegaz
    compute row all reduce sum c_of[*]
    thermo_style custom c_row[*]
    thermo_modify format float %.15g
    thermo 1
    timestep ${dt}
    run ${Math.round(end / dt)}
  `;
  const printed = execFileSync("lmp", ["-log", "none"], { input, encoding: "utf8", maxBuffer: 2 ** 30 });
  const rows = printed.split("\n").map((line) => line.trim().split(/\s+/).map(Number));
  const motion = rows.filter((row) => row.length === 5 && row.every(Number.isFinite)).values();
  motion.next(); // the start
  const step = () => {
    const [vx, vy, ...w] = motion.next().value;
    return { slip: slipOf(radius, [vx, vy], w), spin: w[2] };
  };
  return fading(ball, step, dt, end);
}
