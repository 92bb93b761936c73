// Laws of friction, rolling friction and slopes that a reader gives, against the program.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { assertClose, close, folder, json, open, page, program, programStop, state, stopTimes } from "./browser.mjs";

const linkWith = (words) => page.waitForFunction((words) => decodeURIComponent(location.hash).includes(words) && location.hash, words).then((link) => link.jsonValue());

test("a law's formulas of the reader's own are the program's, in the plane, in the link and in the command line", async () => {
  await open("#mu=0.3&orbits=0.8,3.5");
  const stopBy = (law) => json("stop", "--mu", "0.3", "--u0", "0.8", "--v0", "3.5", "--law", law).tau_stop;
  const take = async (law) => {
    await page.fill("#formulas", law);
    await page.press("#formulas", "Enter");
  };
  const all = [
    "psi = k < 1 ? 0.4 : 0.4/k; phi = sqrt(k^2/(1 + k^2))", "phi = tanh(k); psi = min(1, 1/|k|, 2)*exp(-0)/2", "phi = k/sum(1, k, 0); psi = 0.4/hypot(1, k) + (k > 2 && k <= 1)*(k != 3)",
    "phi = k*(1 + k)^-1; psi = 2^-1^2*exp(-ln(1 + k))*(1 - 2 - -2)", "phi = k/(1 + k); psi = a/(1 + k) ; a = 0.5",
  ];
  for (const law of all) {
    await take(law);
    await page.waitForFunction((law) => globalThis.page.state.law === law, law);
    assertClose((await stopTimes())[0], stopBy(law), 1e-11, law);
  }
  const law = all.at(-1);
  assert.ok((await page.textContent("#command")).includes(`--law '${law}'`));
  assert.equal(await page.$eval("#law", ({ selectedOptions: [option] }) => option.textContent), "your own formulas");
  // What is wrong is said in the program's words, and the law stays.
  for (const [wrong, problem] of [
    ["phi = k/hypot(c, k); psi = 1/hypot(1, k)", /'c' is no variable.*: write its value at the end: ; c = 0\.8/], ["rubbish", /no such law 'rubbish'; laws: exact/],
    ["phi = k/(1 + kk); psi = 1", /'kk' is no variable, parameter or function.* character 14/], ["phi = v; psi = 1", /the ratio k = v\/\(mu \|u\|\) alone/], ["phi = k/(1 + k); psi = (1", /character/],
    ["phi = -k; psi = 1/(1 + k)", /friction resists/], ["phi = k", /psi = is missing/],
  ]) {
    await take(wrong);
    await page.waitForFunction(() => document.getElementById("problem").textContent !== "");
    assert.match(await page.textContent("#problem"), problem);
    assert.equal((await state()).law, law);
    await page.click("#fit");
  }
  const link = await linkWith("a+=+0.5");
  await close();
  await open(link);
  assert.equal((await state()).law, law);
  await close();
});

test("rolling friction is a drive of the plane where a reduced motion has it; where not, the page says why", async () => {
  const motion = ["--ball", "pool", "--slip", "1", "--spin", "20", "--rolling-friction", "0.01"];
  await open("#ball=pool&orbits=0.5715,1&rollingFriction=0.01");
  const wanted = json("stop", ...motion);
  assertClose((await stopTimes())[0] * await page.evaluate(() => globalThis.page.store.timeFactor), wanted.t_stop, 1e-9, "stops after");
  assert.ok(await page.evaluate(() => globalThis.page.store.request.drive) > 0);
  assert.match(await page.textContent("#command"), /--rolling-friction 0\.01/);
  assert.doesNotMatch(await page.textContent("#terminal"), /without/);
  // The command draws that plane.
  const own = await page.evaluate(() => ["u", "v"].map((key) => [...globalThis.page.store.motions[0][key]].slice(1)));
  const words = (await page.textContent("#command")).replace("portrait.svg", join(folder, "driven.json")).split(" ").slice(1);
  execFileSync(program, words);
  const { highlight } = JSON.parse(readFileSync(join(folder, "driven.json"), "utf8"));
  assert.ok(own[0].length > 60);
  own.forEach((column, i) => column.forEach((value, row) => {
    const other = highlight[["u", "v"][i]].slice(-column.length)[row];
    assert.ok(Math.abs(value - other) <= 1e-9 * (1 + Math.abs(other)), `row ${row}: ${value}, not ${other}`);
  }));
  await close();
  for (const [link, why] of [["orbits=3,4,0.9,0.9", /must roll the way it slides/], ["orbits=30,0.01", /keeps this ball from turning at first/]]) {
    await open(`#ball=pool&${link}&rollingFriction=0.01`);
    assert.match(await page.textContent("#terminal"), /The plane is drawn without rolling friction: /);
    assert.match(await page.textContent("#terminal"), why);
    assert.equal(await page.evaluate(() => globalThis.page.store.request.drive), 0);
    assert.doesNotMatch(await page.textContent("#command"), /rolling/);
    assert.match(await page.textContent("#roll-command"), /--rolling-friction 0\.01/);
    await close();
  }
});

test("on a slope a puck slides as far and as long as the program says, and so it rolls", async () => {
  const slides = () => page.evaluate(() => globalThis.page.store.ride.own);
  await open("#ball=puck&orbits=2.286,0.5&slope=-2");
  const wanted = json("stop", "--ball", "puck", "--slip", "0.5", "--spin", "60", "--slope", "-2");
  const radius = (await state()).ball.radius;
  assertClose((await state()).orbits[0].u / radius, 60, 1e-9, "rad/s");
  assertClose((await slides()).end, wanted.t_stop, 1e-9, "stops after");
  assertClose((await stopTimes())[0] * await page.evaluate(() => globalThis.page.store.timeFactor), wanted.t_stop, 1e-9, "in the plane");
  assertClose((await slides()).path, wanted.slip_length, 1e-9, "slides");
  assert.match(await page.textContent("#command"), /--slope -2/);
  await close();
  await open("#ball=pool&orbits=2.8575,1&slope=-1&part=whole");
  const roll = json("roll", "--ball", "pool", "--slip", "1", "--spin", "100", "--slope", "-1", "--law", "exact");
  assertClose((await slides()).path, roll.path, 1e-9, "path");
  assertClose((await slides()).end, roll.rolls_after.t, 1e-9, "rolls after");
  // So steep that nothing stops: the library's words.
  await page.fill("#ball-fields [name=slope]", "-80");
  assert.match(await page.textContent("#slope-error"), /./);
  assert.equal((await state()).ball.slope, -1);
  await close();
});

test("the exponent of a pressure law has a field of its own", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  assert.ok(!(await page.isVisible("#law-exponent")));
  await page.selectOption("#law", "pressure");
  assert.ok(await page.isVisible("#law-exponent input"));
  await page.fill("#law-exponent input", "2.5");
  const times = await stopTimes();
  assertClose(times[0], programStop("--mu", 0.3, "--u0", 0.8, "--v0", 3.5, "--law", "pressure:2.5"), 1e-12, "pressure:2.5");
  for (const [text, complaint] of [["-1", /ring/], ["26", /<= 25/], ["-2", /-1 < P/], ["x", /'x' is not a finite number/], ["", /needed/]]) {
    await page.fill("#law-exponent input", text);
    assert.match(await page.textContent("#exponent-error"), complaint);
    assert.equal(await page.getAttribute("#law-exponent input", "aria-invalid"), "true");
    assert.deepEqual(await stopTimes(), times);
    assert.equal((await state()).law, "pressure:2.5");
  }
  await page.fill("#law-exponent input", "1");
  assert.equal(await page.textContent("#exponent-error"), "");
  assert.equal((await state()).law, "pressure:1");
  await page.selectOption("#law", "pade");
  assert.ok(!(await page.isVisible("#law-exponent")));
  await close();
});
