// Installs the tarball of src/javascript into an empty folder, without a network, and runs there what its README shows and
// what follows here: its numbers are the program's.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const { CONTENSOU_PROGRAM: program, CONTENSOU_NPM_TARBALL: tarball } = process.env;
const folder = mkdtempSync(join(tmpdir(), "contensou-npm-"));
const run = (command, ...words) => execFileSync(command, words, { cwd: folder, encoding: "utf8", env: { ...process.env, npm_config_cache: join(folder, "cache"), npm_config_update_notifier: "false" } });
const ofProgram = (...words) => JSON.parse(run(program, ...words, "--format", "json"));
const write = (name, text) => writeFileSync(join(folder, name), text);
const refusal = (...words) => spawnSync(program, words.map(String), { encoding: "utf8" }).stderr;
const close = (a, b) => assert.ok(Math.abs(a - b) <= 1e-11 * Math.abs(b), `${a} is not ${b}`);

const numbers = `
import { Ball, Flow, balls, step, stopTime, stopTimes } from "contensou";
const tried = (call) => { try { return call(); } catch (error) { return error.message; } };
const masse = new Ball("pool").roll({ velocity: [1, 0], angularVelocity: [40, 35, -50] }, { rollingFriction: 0.01 });
const start = { mu: 0.3, u: 1, v: 1 }, pool = new Ball("pool"), flow = new Flow({ mu: 0.3 });
const contact = { motion: [1, -2, 300], load: 1.7, friction: 0.2, radius: 3e-3, byForce: 20, byMoment: 2e4, dt: 0.01 };
const flat = ({ motion, force, moment }) => [...motion, ...force, moment];
const many = Array.from({ length: 40000 }, (_, i) => 0.05 + (i * 0.618) % 0.9), own = many.slice(0, 400), grows = [];
for (let i = 0; i < 2; ++i) {
  const before = process.memoryUsage().external;
  for (let j = 0; j < 3000; ++j) stopTime({ mu: 0.3, u: 1, v: 1 + j / 1e4, law: "elliptic" });
  grows.push(process.memoryUsage().external - before);
}
const v = [0.5, 1, -1, 2], u = new Float64Array([1, 2, 3, NaN]), mu = [0.1, 0.3, 0.3, 0.1];
console.log(JSON.stringify({
  many: [flow.stopTimes({ u, v }), stopTimes({ ...start, u, v }), stopTimes({ u: 1, v, mu }), stopTimes({ u: 1, v, body: "disc" })].map((each) => [...each]),
  each: [v.map((v, i) => tried(() => flow.stopTime({ u: u[i], v }))), v.map((v, i) => tried(() => stopTime({ u: 1, v, mu: mu[i] }))),
    v.map((v) => tried(() => stopTime({ u: 1, v, body: "disc" })))],
  one: [[...stopTimes(start)], [...stopTimes({ ...start, mu: [NaN, 0.3] })], [...flow.stopTimes({ u: [], v: 1 })], stopTimes(start) instanceof Float64Array],
  grows,
  tables: [[flow.stopTimes({ u: many, v: 1 }), many, (u) => flow.stopTime({ u, v: 1 })], [stopTimes({ mu: own, u: 1, v: own, law: "ring", drive: 0.1 }), own, (mu) => stopTime({ mu, u: 1, v: mu, law: "ring", drive: 0.1 })],
    [stopTimes({ mu: new Float32Array(own), u: -1, v: 2, body: "hollow-ball" }), [...new Float32Array(own)], (mu) => stopTime({ mu, u: -1, v: 2, body: "hollow-ball" })]]
    .map(([taus, each, one]) => Math.max(...each.slice(0, 400).map((value, i) => Math.abs(taus[i] / one(value) - 1)))),
  steps: ["exact", "uniform", "elliptic:0.6", "punch"].map((law) => flat(step({ ...contact, law }))),
  stands: (() => {
    const m = 0.17, dt = 1 / 60;
    let motion = [1, 0, 100], t = 0;
    for (; motion.some((each) => each !== 0); t += dt) ({ motion } = step({ ...contact, motion, load: m * 9.81, byForce: 3.5 / m, byMoment: 2.5 / (m * 0.0285 ** 2), dt }));
    return t.toFixed(2);
  })(),
  refused: Object.fromEntries(Object.entries({
    stopTime: () => stopTime({ ...start, drve: 1 }), stopTimes: () => stopTimes({ ...start, lwa: "pade" }), Flow: () => new Flow({ mu: 1, chii: 1 }),
    start: () => flow.stopTime({ u: 1, v: 1, mu: 0.1 }), at: () => flow.at({ u: 1, w: 1 }, 1), Ball: () => new Ball("pool", { fricton: 0.3 }),
    fields: () => new Ball({ raduis: 1 }), roll: () => pool.roll({ slip: 1, spn: 1 }), options: () => pool.roll({}, { rollingBelwo: 1 }),
    nothing: () => new Flow(), no: () => pool.roll({ quite: "another" }), lengths: () => flow.stopTimes({ u: [1, 2], v: [1, 2, 3] }),
    step: () => step({ ...contact, dt: -1 }), radius: () => step({ ...contact, raduis: 1 }), tables: () => stopTimes({ mu: [0.1, 2], u: 1, v: 1 }),
    inherited: () => new Ball("toString"), kept: () => new Ball({ ...balls.steel, slip: 2 }).law,
  }).map(([name, call]) => [name, tried(call)])),
  types: (() => {
    const gone = new Float64Array(2);
    structuredClone(gone, { transfer: [gone.buffer] });
    const wrong = [true, "1", null, 1n, {}, [true], ["1"], [null], [1n], [undefined], new BigInt64Array(1), gone];
    const one = [...wrong, [1], new Float64Array(1), undefined];
    const calls = [[one, (u) => stopTime({ ...start, u })], [one, (v) => flow.stopTime({ u: 1, v })], [one, (u) => flow.motion({ u, v: 1 })],
      [one, (v) => flow.at({ u: 1, v }, 1)], [one, (tau) => flow.at({ u: 1, v: 1 }, tau)], [one, (u) => flow.check({ u, v: 1 })],
      [one.slice(0, -1), (mu) => stopTime({ ...start, mu })], [one.slice(0, -1), (drive) => new Flow({ mu: 0.3, drive })], [one.slice(0, -1), (chi) => new Flow({ mu: 0.3, chi })],
      [one.slice(0, -1), (mass) => new Ball("pool", { mass })], [one.slice(0, -1), (slip) => pool.roll({ slip })],
      [one.slice(0, -1), (rollingFriction) => pool.roll({}, { rollingFriction })], [one.slice(0, -1), (until) => pool.roll().motion(until)],
      [wrong, (u) => stopTimes({ ...start, u })], [wrong, (v) => flow.stopTimes({ u: 1, v })], [wrong, (mu) => stopTimes({ ...start, mu })],
      [one, (load) => step({ ...contact, load })], [[1, [1], [1, 2, "3"], undefined], (motion) => step({ ...contact, motion })],
      [[5, true, null, ["exact"], {}], (law) => stopTime({ ...start, law })], [[5, null], (body) => new Flow({ mu: 0.3, body })],
      [[1, [1], "1,2", [1, "2"], [1, 2, 3]], (velocity) => pool.roll({ velocity })]];
    const told = (call) => { try { call(); } catch (error) { return error instanceof TypeError ? error.message : \`\${error}\`; } return "nothing"; };
    return calls.flatMap(([values, call]) => values.map((value) => [String(call), told(() => call(value))]));
  })(),
  limits: [() => stopTime({ ...start, mu: 2 }), () => stopTime({ ...start, law: "exat" }), () => stopTime({ ...start, law: "pressure:-2" }),
    () => stopTime({ ...start, body: "disk" }), () => stopTime({ ...start, body: "disc" }), () => new Ball("poool"), () => pool.roll({ slip: -1 }),
    () => pool.roll({}, { rollingFriction: -1 }), () => pool.roll({}, { rollingBelow: -1 }), () => new Ball("puck").roll({}, { rollingBelow: 0.1 }),
    () => new Ball("pool", { mass: -1 }), () => pool.roll({ slip: 1, velocity: [1, 0] }), () => new Ball("pool", { patch_radius: 1 }),
    () => stopTime({ ...start, chi: -3, gamma: 2 }), () => stopTime({ ...start, mu: -1, chi: 3.5, gamma: 2.5 })].map(tried),
  stops: [["exact", 0.1], ["pade", 0.3], ["ring", 0.2]].map(([law, mu]) => [law, mu, stopTime({ law, mu, u: 1, v: 1 })]),
  disc: stopTime({ body: "disc", u: 1, v: 2 }), k: new Flow({ body: "disc" }).terminalRatio,
  balls: Object.keys(balls).map((name) => [name, new Ball(name).roll().stopTime, new Ball(name).patchRadius]),
  rest: masse.motion().rest, slides: masse.slidesUntil,
  wrong: [tried(() => new Flow({ mu: 0.1, law: "nope" })), tried(() => new Ball("poool")), tried(() => new Flow({})),
    tried(() => stopTime({ mu: 2, u: 1, v: 1 })), tried(() => stopTime({ mu: 2, chi: 3.5, gamma: 2.5, u: 1, v: 1 }))],
}));
`;

try {
  write("package.json", '{"type": "module", "private": true}');
  run("npm", "install", "--offline", "--no-audit", "--no-fund", resolve(tarball));
  const installed = join(folder, "node_modules/contensou");
  for (const file of ["LICENSE", "THIRD_PARTY.txt", "README.md", "index.d.ts", "contensou.wasm"]) assert.ok(existsSync(join(installed, file)), file);

  const [, shown, printed] = /```js\n([^]*?)```\n\n```text\n([^]*?)```/.exec(readFileSync(join(installed, "README.md"), "utf8"));
  write("shown.js", shown);
  assert.equal(run(process.execPath, "shown.js"), printed);

  write("numbers.js", numbers);
  const { stops, disc, k, balls, rest, slides, wrong, many, each, one, refused, types, limits, grows, tables, steps, stands } = JSON.parse(run(process.execPath, "numbers.js"));
  for (const [law, mu, tau] of stops) close(tau, ofProgram("stop", "--law", law, "--mu", mu, "--u0", 1, "--v0", 1).tau_stop);
  close(disc, ofProgram("stop", "--body", "disc", "--u0", 1, "--v0", 2).tau_stop);
  close(k, ofProgram("terminal", "--body", "disc").k_star);
  for (const [name, stop, patch] of balls) {
    const answer = ofProgram("stop", "--ball", name);
    close(stop, answer.t_stop);
    close(patch, answer.ball.patch_radius);
  }
  const roll = ofProgram("roll", "--ball", "pool", "--velocity", "1,0", "--angular-velocity", "40,35,-50", "--rolling-friction", 0.01);
  for (const of of ["t", "x", "y"]) close(rest[of], roll.rest[of]);
  close(slides, roll.rolls_after.t);
  assert.match(wrong[0], /^no such law 'nope'; laws: exact, pade, uniform, .*pressure:P/);
  assert.match(wrong[1], /^no such ball 'poool' \(did you mean 'pool'\?\); balls: pool, /);
  assert.match(wrong[2], /mu is missing/);
  assert.match(wrong[3], /mu = 2: 0 < mu <= 1 is required/);
  assert.ok(wrong[4] > 0);

  // Arrays: what one start gives, and null, which is NaN in JSON, where one start is refused.
  const entries = (row) => row.map((tau) => typeof tau === "number" ? tau : null);
  assert.deepEqual(many[0], entries(each[0]));
  assert.deepEqual(many[1], many[0]);
  assert.deepEqual(many[2], entries(each[1]));
  assert.deepEqual(many[3], entries(each[2]));
  assert.deepEqual(entries(each[0]).map((tau) => tau === null), [false, false, true, true]);
  assert.equal(one[0].length, 1);
  assert.deepEqual(one, [one[0], [null, one[0][0]], [], true]);

  assert.ok(Math.max(...tables) <= 1e-14, `${tables}`);
  assert.ok(grows[1] < 2 ** 20, `${grows} bytes`);

  // The values are those of contensou_patch_step in C, and the time at which the ball stands that of the README of src/si.
  [[0.9701230256446876, -1.940246051289375, 299.98285586498486, -0.14938487177656198, 0.29876974355312397, -8.572067507579758e-05],
    [0.9702584129531101, -1.9405168259062202, 299.97852603080787, -0.14870793523444947, 0.29741587046889895, -0.00010736984596055445],
    [0.9704892426048275, -1.940978485209655, 299.9704462150139, -0.14755378697586247, 0.29510757395172493, -0.00014776892493053282],
    [0.9704850878036759, -1.9409701756073519, 299.9712867406571, -0.14757456098162014, 0.2951491219632403, -0.00014356629671444165],
  ].forEach((row, i) => row.forEach((number, j) => close(steps[i][j], number)));
  assert.ok(readFileSync(join(here, "../../src/si/README.md"), "utf8").includes(`at rest after ${stands} s`), stands);

  const told = {
    stopTime: "stopTime: unknown option 'drve' (did you mean 'drive'?); options: u, v, mu, law, body, chi, gamma, drive",
    stopTimes: "stopTimes: unknown option 'lwa' (did you mean 'law'?)", Flow: "Flow: unknown option 'chii' (did you mean 'chi'?)",
    start: "stopTime: unknown option 'mu'", at: "at: unknown option 'w'", Ball: "Ball: unknown option 'fricton' (did you mean 'friction'?)",
    fields: "Ball: unknown option 'raduis' (did you mean 'radius'?)", roll: "roll: unknown option 'spn' (did you mean 'spin'?)",
    options: "roll: unknown option 'rollingBelwo' (did you mean 'rollingBelow'?)", nothing: "Flow: options are needed, {mu, law, body, chi, gamma, drive}; got undefined",
    no: "roll: unknown option 'quite'; options: slip, spin, velocity, angularVelocity", lengths: "arrays of one length are needed; got u of 2, v of 3",
    step: "step: the time step must be >= 0", radius: "step: unknown option 'raduis' (did you mean 'radius'?)", tables: "mu = 2: 0 < mu <= 1 is required",
    inherited: "no such ball 'toString'; balls: pool", kept: "exact",
  };
  for (const [name, words] of Object.entries(told)) assert.ok(refused[name].startsWith(words), `${refused[name]} is not ${words}`);

  for (const [call, words] of types) assert.match(words, /^[a-zA-Z]+: [a-z]+(\[0\])?: (.* is needed; got |its memory was given away)/i, call);

  // Limits: the words after the value are the program's.
  const start = ["--mu", 0.3, "--u0", 1, "--v0", 1];
  const ofTheProgram = [["stop", "--mu", 2, ...start.slice(2)], ["stop", ...start, "--law", "exat"], ["stop", ...start, "--law", "pressure:-2"],
    ["stop", ...start, "--body", "disk"], ["stop", ...start, "--body", "disc"], ["stop", "--ball", "poool"], ["roll", "--ball", "pool", "--slip", -1],
    ["roll", "--ball", "pool", "--rolling-friction", -1], ["roll", "--ball", "pool", "--rolling-below", -1],
    ["roll", "--ball", "puck", "--rolling-below", 0.1], ["roll", "--ball", "pool", "--mass", -1], ["roll", "--ball", "pool", "--slip", 1, "--velocity", "1,0"],
    ["stop", "--ball", "pool", "--patch-radius", 1], ["stop", ...start, "--body", "-3,2"],
    ["stop", "--mu", -1, ...start.slice(2), "--body", "3.5,2.5"]].map((words) => refusal(...words));
  const parts = [/0 < mu <= 1 is required/, /\(did you mean 'exact'\?\); laws: exact, pade, uniform, /, /-1 < P <= 25/, /\(did you mean 'disc'\?\); bodies: ball, hollow-ball, disc, puck, ring/,
    /a puck rests on its whole face, so mu is 1: leave /, /\(did you mean 'pool'\?\); balls: pool, steel, bowling, rubber, gel, basketball, puck, curling-stone/,
    /slip must be finite and >= 0, in m\/s, got -1/, /rolling_friction must be finite and >= 0, got -1/, /0 or more is needed/,
    /a disc lies flat and never rolls: leave it out/, /mass must be finite and > 0, in kg, got -1/, /exclude each other: give slip and spin, or velocity/,
    /the patch radius must be above 0 and at most the ball's radius 0.028575 m/, /chi and gamma must be positive/, /mu > 0 is required/];
  assert.equal(limits.length, parts.length);
  parts.forEach((part, i) => [limits[i], ofTheProgram[i]].forEach((message) => assert.match(String(message), part)));
  assert.ok(limits.every((message) => !message.includes("--")));

  const compiler = join(here, "../page/node_modules/typescript/bin/tsc");
  if (existsSync(compiler)) {
    write("typed.ts", 'import { Ball, Flow, step, stopTime, stopTimes } from "contensou";\nconst tau: number = stopTime({ mu: 0.1, u: 1, v: 1 });\n'
      + 'const taus: Float64Array = stopTimes({ mu: [0.1], u: new Float32Array(1), v: 1 });\nnew Flow({ mu: tau }).stopTimes({ u: taus, v: [1] });\n'
      + 'const vx: number = step({ motion: [1, 0, tau], load: 1, friction: 0.2, radius: 3e-3, byForce: 20, byMoment: 2e4, dt: 0.01 }).motion[0];\nexport { vx };\n'
      + 'const x: Float64Array = new Ball("pool", { slip: tau }).roll().motion(1).x;\nexport { x };\n');
    run(process.execPath, compiler, "--noEmit", "--strict", "--module", "nodenext", "--target", "es2022", "typed.ts");
  }
} finally {
  rmSync(folder, { recursive: true });
}
