// Installs the tarball of src/javascript into an empty folder, without a network, and runs there what its README shows and
// what follows here: its numbers are the program's.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
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
const close = (a, b) => assert.ok(Math.abs(a - b) <= 1e-11 * Math.abs(b), `${a} is not ${b}`);

const numbers = `
import { Ball, Flow, balls, stopTime } from "contensou";
const tried = (call) => { try { return call(); } catch (error) { return error.message; } };
const masse = new Ball("pool").roll({ velocity: [1, 0], angularVelocity: [40, 35, -50] }, { rollingFriction: 0.01 });
console.log(JSON.stringify({
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
  const { stops, disc, k, balls, rest, slides, wrong } = JSON.parse(run(process.execPath, "numbers.js"));
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
  assert.match(wrong[0], /no such law: nope/);
  assert.match(wrong[1], /no such ball: poool; there are pool/);
  assert.match(wrong[2], /mu is missing/);
  assert.match(wrong[3], /mu = 2: 0 < mu <= 1 is required/);
  assert.ok(wrong[4] > 0);

  const compiler = join(here, "../page/node_modules/typescript/bin/tsc");
  if (existsSync(compiler)) {
    write("typed.ts", 'import { Ball, stopTime } from "contensou";\nconst tau: number = stopTime({ mu: 0.1, u: 1, v: 1 });\n'
      + 'const x: Float64Array = new Ball("pool", { slip: tau }).roll().motion(1).x;\nexport { x };\n');
    run(process.execPath, compiler, "--noEmit", "--strict", "--module", "nodenext", "--target", "es2022", "typed.ts");
  }
} finally {
  rmSync(folder, { recursive: true });
}
