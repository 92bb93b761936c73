// Compares an engine with the motion that `contensou engine` prints for it: a pool ball at 1 m/s and 100 rad/s. The
// engine gets the numbers that the program prints.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";

const gravity = 9.81;

export function asked(name) {
  const words = ["engine", name, "--ball", "pool", "--gravity", String(gravity), "--format", "json"];
  const told = JSON.parse(execFileSync(process.env.CONTENSOU_PROGRAM, words, { encoding: "utf8" }));
  const [engine] = told.engines;
  return {
    ball: { radius: 0.028575, mass: 0.1701, friction: told.friction, slip: told.slip, spin: told.spin, gravity },
    patch: told.patch_radius,
    law: { slip: told.t_slip, spin: told.t_spin },
    typed: (parameter) => engine.parameters[parameter].value,
    settings: new Map(engine.settings.map((setting) => [setting.setting, setting])),
  };
}

export function assertClose(measured, told, what) {
  const error = Math.abs(measured / told - 1);
  assert.ok(error <= 0.01, `${what}: ${measured} s in the engine, ${told} s in the model, relative error ${error}`);
}

/** Runs each setting in the engine. A spin that never ends is watched for 2 s, in which the ball's own loses a fifth. */
export function compare({ ball, settings }, runs) {
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
