// Two floors, the ruler, numbers that are handles, and what the Lab has for a law of the reader's own and for slopes.
//   CONTENSOU_PROGRAM=.../contensou node lab.test.mjs
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { assertClose, close, drawn, folder, json, open, page, pass, program, saved, state, stopTimes } from "./browser.mjs";

const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const linkWith = (words) => page.waitForFunction((words) => decodeURIComponent(location.hash).includes(words) && location.hash, words).then((link) => link.jsonValue());
const inLab = ["#columns", "#views", "#mu-control", "#friction-control"];

test("the first floor has the bodies, two sliders, the plane and the story; one word opens the rest, and is in the link", async () => {
  for (const options of [{}, phone]) {
    await open("#lab=0", options);
    for (const id of ["#headline", "#story", "#lanes", "#slip-slider", "#spin-slider", "#plane", "#presets", "#tour"]) assert.ok(await page.isVisible(id), id);
    for (const id of inLab) assert.ok(!(await page.isVisible(id)), id);
    assert.equal(await page.locator("input:visible, select:visible").count(), 3, "time, slip, spin");
    assert.equal(await page.getAttribute("#lab", "aria-expanded"), "false");
    await page.focus("#lab");
    await page.keyboard.press("Enter");
    for (const id of inLab) assert.ok(await page.isVisible(id), id);
    assert.equal(await page.getAttribute("#lab", "aria-expanded"), "true");
    // Without motion it is there at once.
    assert.ok((await page.locator("#columns").boundingBox()).y < 20);
    await page.waitForFunction(() => location.hash.includes("lab=1"));
    await page.click("#presets a:nth-child(3)");
    assert.ok(await page.isVisible("#columns"), "a preset leaves the floor");
    await page.click("#lab");
    assert.ok(!(await page.isVisible("#columns")));
    await close();
  }
});

test("Back leaves the Lab, and a link of what it alone shows opens it", async () => {
  await open("#lab=0", { stopped: true });
  await pass(400);
  await page.click("#lab");
  await pass(400);
  assert.match(page.url(), /lab=1/);
  await page.goBack();
  await page.waitForFunction(() => !globalThis.page.state.lab);
  assert.ok(!(await page.isVisible("#columns")));
  await close();
});

test("numbers in the story are handles: a drag or keys do what the slider does, and the focus stays", async () => {
  await open("#lab=0");
  const handle = (key) => page.locator(`#story .handle[data-key=${key}]`);
  assert.equal(await handle("slip").textContent(), "0.5 m/s");
  assert.equal(await handle("spin").textContent(), "9.5 times a second");
  assert.equal(await handle("spin").getAttribute("role"), "slider");
  const box = await handle("spin").boundingBox();
  await page.mouse.move(box.x + 5, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + 45, box.y + box.height / 2, { steps: 4 });
  await page.mouse.up();
  const { orbits: [{ u }], ball } = await state();
  assertClose(u / ball.radius, 60 + 500 * 40 / 400, 0.02, "rad/s");
  await handle("slip").focus();
  await page.keyboard.press("ArrowRight");
  assertClose((await state()).orbits[0].v, 0.6, 1e-9, "m/s");
  assert.equal(await page.evaluate(() => document.activeElement.dataset.key), "slip");
  assert.equal(await handle("slip").getAttribute("aria-valuetext"), "0.6 m/s");
  // Without spin the sentence is another, and the handle is in it.
  await handle("spin").focus();
  await page.keyboard.press("Home");
  assert.match(await page.textContent("#headline"), /^Without spin/);
  assert.equal(await handle("spin").textContent(), "does not spin");
  assert.equal(await page.evaluate(() => document.activeElement.dataset.key), "spin");
  await page.keyboard.press("PageUp");
  assertClose((await state()).orbits[0].u / ball.radius, 50, 1e-9, "rad/s");
  await close();
});

test("words of the story have the colours of what they name", async () => {
  await open("#lab=0");
  const colours = await page.$$eval("#story b, #story .handle", (words) => Object.fromEntries(words.map((word) => [word.textContent, getComputedStyle(word).color])));
  assert.equal(colours["0.515 m"], colours["The other spins"]);
  assert.equal(colours["0.127 m"], colours["One does not spin"]);
  assert.notEqual(colours["0.515 m"], colours["0.127 m"]);
  await close();
});

test("the ruler is dragged by an end, moved as a whole, by touch and by keys; Escape puts it back", async () => {
  for (const options of [{}, phone]) {
    await open("#lab=0", options);
    const ends = () => page.evaluate(() => {
      const { left, top } = document.getElementById("lanes").getBoundingClientRect();
      return globalThis.page.hero.rulerEnds.map(([x, y]) => [left + x, top + y]);
    });
    const words = () => page.evaluate(() => globalThis.page.hero.ruler.words);
    const [from, to] = await ends();
    const metres = 0.388 / (to[0] - from[0]);
    const target = [(from[0] + to[0]) / 2, to[1]];
    if (options.hasTouch) {
      const devtools = await page.context().newCDPSession(page);
      const touch = (type, ...points) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
      await touch("touchStart", to);
      for (let i = 1; i <= 8; ++i) await touch("touchMove", to.map((side, axis) => side + (i / 8) * (target[axis] - side)));
      await touch("touchEnd");
    } else {
      await page.mouse.move(...to);
      await page.mouse.down();
      await page.mouse.move(...target, { steps: 5 });
      await page.mouse.up();
    }
    await drawn();
    assertClose(parseFloat(await words()), 0.194, 3 * metres / 0.194 + 0.01, "half of it");
    assert.equal((await state()).orbits.length, 1, "nothing was thrown");
    const [start, end] = await ends();
    assert.ok(Math.hypot(end[0] - target[0], end[1] - target[1]) < 8, `${end}, not ${target}`);
    assert.ok(Math.hypot(start[0] - from[0], start[1] - from[1]) < 1);
    // As a whole.
    if (!options.hasTouch) {
      const length = await words();
      await page.mouse.move((start[0] + end[0]) / 2, start[1]);
      await page.mouse.down();
      await page.mouse.move((start[0] + end[0]) / 2 - 60, start[1] - 20, { steps: 5 });
      await page.mouse.up();
      await drawn();
      assert.equal(await words(), length);
      assert.ok(Math.abs((await ends())[0][0] - start[0] + 60) < 2);
    }
    await page.focus("#lanes");
    await page.keyboard.press("r");
    const before = (await ends())[1][0];
    await page.keyboard.press("ArrowRight");
    assertClose((await ends())[1][0], before + 4, 0.002, "pixels");
    assert.match(await page.textContent("#told"), /^The ruler: 0\.\d+ m\. Arrows move its far end, r the next, Escape puts it back\.$/);
    await page.keyboard.press("Escape");
    await drawn();
    assert.deepEqual((await ends()).flat().map(Math.round), [...from, ...to].map(Math.round));
    await close();
  }
});

test("a pressure of the reader's own is the program's, in the plane, in the link and against another law", async () => {
  const table = "rho,pressure\n0,1\n0.4,1\n0.4,0.5\n1,0\n";
  const file = join(folder, "pressure.csv");
  writeFileSync(file, table);
  const take = (text) => page.setInputFiles("#pressure", { name: "mine.csv", mimeType: "text/csv", buffer: Buffer.from(text) });
  await open("#mu=0.3&orbits=0.8,3.5&law=pade&against=uniform");
  const [other] = [json("stop", "--mu", "0.3", "--u0", "0.8", "--v0", "3.5", "--law", "uniform").tau_stop];
  assert.match(await page.textContent("#orbits .stop"), new RegExp(`by uniform τ\\* = ${other.toPrecision(7)}`.replace(/0+$/, "")));
  await take(table);
  await page.waitForFunction(() => globalThis.page.state.law.startsWith("table:"));
  assertClose((await stopTimes())[0], json("stop", "--mu", "0.3", "--u0", "0.8", "--v0", "3.5", "--law", file).tau_stop, 1e-11, "stops");
  assert.match(await page.textContent("#command"), /--law pressure\.csv --against uniform/);
  assert.match(await page.inputValue("#law"), /^table:/);
  const { law } = await state();
  const link = await linkWith("law=table");
  await close();
  await open(link);
  assert.equal((await state()).law, law);
  assert.equal(String(await saved("#save-pressure")), table);
  // What is wrong is said, and the law stays.
  for (const [text, problem] of [["a,b\n0,1\n", /columns rho and pressure/], ["rho,pressure\n0.1,1\n1,0\n", /pressure\.csv:2: .*rho must begin at 0/], ["rho,pressure\n0,x\n1,0\n", /pressure\.csv:2/]]) {
    await take(text);
    await page.waitForFunction(() => document.getElementById("problem").textContent !== "");
    assert.match(await page.textContent("#problem"), problem);
    assert.equal((await state()).law, law);
    await page.click("#fit");
  }
  await close();
});

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
  const [{ orbits: [orbit] }] = [JSON.parse(String(await saved("#save-json")))];
  const words = (await page.textContent("#command")).replace("portrait.svg", join(folder, "driven.json")).split(" ").slice(1);
  execFileSync(program, words);
  const [programs] = JSON.parse(readFileSync(join(folder, "driven.json"), "utf8")).orbits;
  for (const key of ["u", "ln_v", "tau_left"]) for (const i of [0, 20, 60]) assertClose(orbit[key][i], programs[key][i], 1e-9, `${key} ${i}`);
  await close();
  for (const [link, why] of [["orbits=3,4,0.9,0.9", /must roll the way it slides/], ["orbits=30,0.01", /keeps this ball from turning at first/]]) {
    await open(`#ball=pool&${link}&rollingFriction=0.01`);
    assert.match(await page.textContent("#terminal"), /The plane is without rolling friction: /);
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

test("points and residuals of a film are handed out, with what was fitted", async () => {
  await open("#ball=gel");
  const rows = Array.from({ length: 30 }, (_, i) => `${i / 20},${300 - 2 * i + Math.sin(99 * i)}`);
  await page.setInputFiles("#film", { name: "film.csv", mimeType: "text/csv", buffer: Buffer.from(`t,spin\n${rows.join("\n")}\n`) });
  await page.locator("#film-report").filter({ visible: true }).waitFor();
  const [header, ...lines] = String(await saved("#save-residuals")).trim().split("\n");
  assert.equal(header, "t,spin,spin_fitted,spin_residual");
  assert.equal(lines.length, 30);
  for (const line of lines) {
    const [, measured, fitted, residual] = line.split(",").map(Number);
    assert.ok(Math.abs(measured - fitted - residual) < 1e-9 && Math.abs(residual) < 5, line);
  }
  await close();
});

test("a start that a slider takes out of the window takes the window along", async () => {
  await open("#ball=puck&orbits=2.286,0.5");
  const seen = () => page.evaluate(() => [globalThis.page.store.portrait.window[1], globalThis.page.store.orbit.v]);
  const [before] = await seen();
  await page.locator("#slip-slider").press("ArrowRight");
  assert.equal((await seen())[0], before, "within it, it stays");
  await page.locator("#slip-slider").press("End");
  const [top, v] = await seen();
  assert.ok(v > before && top >= v, `${v} is beyond ${top}`);
  await close();
});

test("in a tall window bodies and plane keep together", async () => {
  await open("#lab=0", { viewport: { width: 1440, height: 2400 } });
  const [lanes, plane] = await page.$$eval("#lanes, #plane", (all) => all.map(({ clientHeight, clientWidth }) => clientHeight / clientWidth));
  assert.ok(lanes < 0.7 && plane < 1, `${lanes}, ${plane}`);
  await close();
});
