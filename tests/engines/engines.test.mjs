// What `contensou engine` says that an engine does, against the engine: a pool ball at 1 m/s and 100 rad/s, with the
// number typed in that it prints. Every setting that it lists of these engines is run.
//   CONTENSOU_PROGRAM=.../contensou node engines.test.mjs
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { test } from "node:test";

// One after the other: PhysX hides node while it is loaded.
const { mujocoTimes } = await import("./mujoco.mjs");
const { physxTimes } = await import("./physx.mjs");

const gravity = 9.81;

function asked(name) {
  const words = ["engine", name, "--ball", "pool", "--gravity", String(gravity), "--format", "json"];
  const told = JSON.parse(execFileSync(process.env.CONTENSOU_PROGRAM, words, { encoding: "utf8" }));
  const [engine] = told.engines;
  return {
    ball: { radius: 0.028575, mass: 0.1701, friction: told.friction, slip: told.slip, spin: told.spin, gravity },
    patch: told.patch_radius,
    typed: (parameter) => engine.parameters[parameter].value,
    settings: new Map(engine.settings.map((setting) => [setting.setting, setting])),
  };
}

function assertClose(measured, told, what) {
  const error = Math.abs(measured / told - 1);
  assert.ok(error <= 0.01, `${what}: ${measured} s in the engine, ${told} s in the model, relative error ${error}`);
}

/** Runs each setting in the engine. A spin that never ends is watched for 2 s, in which the ball's own loses a fifth. */
function compare({ ball, settings }, runs) {
  assert.deepEqual(Object.keys(runs), [...settings.keys()]);
  for (const [name, { t_slip, t_spin }] of settings) {
    const times = runs[name](t_spin === "inf" ? 2 : 12);
    assertClose(times.slip, t_slip, `slip, ${name}`);
    if (t_spin === "inf") {
      assert.ok(times.left > 0.95 * ball.spin, `spin left after 2 s, ${name}: ${times.left}`);
    } else {
      assertClose(times.spin, t_spin, `spin, ${name}`);
    }
  }
}

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
