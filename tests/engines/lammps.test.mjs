// The motion that `contensou engine lammps` describes, in LAMMPS.
//   CONTENSOU_PROGRAM=.../contensou node lammps.test.mjs
import { test } from "node:test";
import { asked, assertClose, compare } from "./comparison.mjs";
import { lammpsTimes } from "./lammps.mjs";

const { ball: itself, patch, typed, settings, law } = asked("lammps");
const ball = { ...itself, friction: typed("mu_s of tangential") };
const load = ball.mass * ball.gravity;
// This stiffness makes the radius of the contact, sqrt(R overlap), the patch radius.
const hertz = (load * ball.radius) / patch ** 3;
const run = (twisting, end, stiffness = hertz) => lammpsTimes(ball, { normal: "hertz", stiffness, twisting }, end);

test("LAMMPS", () => {
  compare({ ball, settings }, {
    "twisting sds": (end) => run(`twisting sds ${(hertz * patch ** 3) / 2} 0 ${typed("mu_twist of twisting sds")}`, end),
    "twisting marshall": (end) => run("twisting marshall", end),
    "twisting none (default)": (end) => run("", end),
  });
});

test("the moment of marshall depends on the radius of the contact, not on the normal model", () => {
  const { t_spin } = settings.get("twisting marshall");
  const stiffness = (load * ball.radius) / patch ** 2;
  const hooke = { normal: "hooke", stiffness, twisting: "twisting marshall" };
  assertClose(lammpsTimes(ball, hooke, 12).spin, t_spin, "spin, hooke");
  assertClose(run("twisting marshall", 12, hertz / 8).spin, t_spin / 2, "spin, stiffness divided by 8");
});

test("marshall ends the slip after 47 %, and the spin after 87 %, of the times of the law", () => {
  const { slip, spin } = run("twisting marshall", 12);
  assertClose(slip, 0.4724 * law.slip, "slip");
  assertClose(spin, 0.8743 * law.spin, "spin");
});
