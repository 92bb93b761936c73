// Each setting of MuJoCo and PhysX that `contensou engine` lists, run in the engine.
//   CONTENSOU_PROGRAM=.../contensou node engines.test.mjs
import assert from "node:assert/strict";
import { test } from "node:test";
import { asked, assertClose, compare } from "./comparison.mjs";

// One after the other: PhysX hides node while it is loaded.
const { mujocoTimes } = await import("./mujoco.mjs");
const { physxTimes } = await import("./physx.mjs");

// Attributes of a contact so soft that the ball does not hop (see the last test): it sinks in by 10 um.
const soft = 'solref="-1e6 -2e3" solimp="0.01 0.01 0.001 0.5 2" solreffriction="0 -20"';

test("MuJoCo", () => {
  const told = asked("mujoco");
  const { ball, patch, typed } = told;
  const f = typed("friction[0]");
  const elliptic = (torsion, condim = 4) => (end) =>
    mujocoTimes(ball, {
      dt: 1e-4,
      option: 'cone="elliptic" impratio="1e8"',
      contact: `condim="${condim}" friction="${f} ${f} ${torsion} 0 0" ${soft}`,
    }, end);
  // By the two geoms: of each number the larger counts.
  const pyramidal = (end) =>
    mujocoTimes(ball, {
      dt: 1e-3,
      option: "",
      plane: `condim="1" friction="${f} ${typed("friction[1]") / 2} 0" solref="0.002 1" solimp="0.9999 0.9999 0.001"`,
      geom: `condim="4" friction="${f / 2} ${typed("friction[1]")} 0" solref="0.002 1" solimp="0.9999 0.9999 0.001"`,
    }, end);
  compare(told, {
    "cone elliptic": elliptic(typed("friction[1]")),
    "cone pyramidal (default)": pyramidal,
    "cone elliptic, friction[1] 0.005 (default)": elliptic(0.005),
    "cone elliptic, friction[1] the diameter": elliptic(2 * patch),
    "condim 3 (default)": elliptic(typed("friction[1]"), 3),
  });
});

test("PhysX", () => {
  const told = asked("physx");
  const { ball, patch, typed } = told;
  const min = typed("minTorsionalPatchRadius");
  compare(told, {
    eTGS: (end) => physxTimes(ball, "eTGS", { min }, end),
    "eTGS, minTorsionalPatchRadius = a": (end) => physxTimes(ball, "eTGS", { min: patch }, end),
    "eTGS, torsionalPatchRadius alone": (end) => physxTimes(ball, "eTGS", { patch }, end),
    "ePGS (default)": (end) => physxTimes(ball, "ePGS", { min }, end),
  });
});

test("on a stiff contact MuJoCo's ball hops, and its slip ends 9 % later", () => {
  const { ball, typed, settings } = asked("mujoco");
  const stiff = 'solref="0.002 1" solimp="0.9999 0.9999 0.001"';
  const { slip, spin } = mujocoTimes(ball, {
    dt: 1e-3,
    option: 'cone="elliptic"',
    contact: `condim="4" friction="0.2 0.2 ${typed("friction[1]")} 0 0" ${stiff}`,
  }, 12);
  const { t_slip, t_spin } = settings.get("cone elliptic");
  assert.ok(slip > 1.08 * t_slip && slip < 1.1 * t_slip, `slip: ${slip} s, ${t_slip} s in the model`);
  assertClose(spin, t_spin, "spin");
});
