// The cue and the ball that bounces, each in its step of the tour: their numbers are the program's.
import assert from "node:assert/strict";
import { test } from "node:test";
import { length, shown } from "../../src/page/numbers.js";
import { assertClose, close, drawn, json, open, page, pass, saved, slide, state } from "./browser.mjs";

const says = (id) => page.textContent(`#${id}-says`);
/** Where the ball's face is on the canvas of the cue. */
const face = async () => {
  const { x, y, width, height } = await page.locator("#cue").boundingBox();
  return height > 0.9 * width ? [x + width / 2, y + height / 4] : [x + 0.24 * width, y + height / 2];
};
const slideTo = (id, share) => slide(`${id}-slider`, 1000 * share);

/** The motion that the page shows, and that of the program's stroke. */
async function comparesWith(speed, tip, elevation) {
  const { ball, orbits, chosen } = await state();
  const { own } = await page.evaluate(() => globalThis.page.store.ride);
  const { u, v, along, across } = orbits[chosen];
  const wanted = json("roll", "--ball", ball.name, "--strike", speed, "--tip", tip.join(), "--elevation", elevation, "--rolling-friction", 0);
  const [[vx, vy], [wx, wy, wz]] = [wanted.velocity, wanted.angular_velocity];
  const slip = [vx - ball.radius * wy, vy + ball.radius * wx];
  const size = Math.hypot(...slip);
  const parts = { u: ball.radius * wz, v: size, along: (vx * slip[0] + vy * slip[1]) / size, across: (vy * slip[0] - vx * slip[1]) / size };
  for (const [key, value] of Object.entries({ u, v, along, across })) assert.ok(Math.abs(value - parts[key]) <= 1e-5 * size, `${key}: ${value}, not ${parts[key]}`);
  assertClose(own.path, wanted.path, 1e-4, "path");
}

test("the dot is where the tip of a cue hits for this motion; who drags it strikes as the program does", async () => {
  for (const options of [{}, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }]) {
    await open("#lab=0", options);
    await page.locator("#presets a", { hasText: "Massé" }).click();
    assert.ok(await page.isVisible("#cue-card") && !(await page.isVisible("#plane-card")) && !(await page.isVisible("#bounce-card")));
    await comparesWith(2.5, [0.4, -0.3], 60);
    assert.match(await says("cue"), /hits 0\.4 radii right of the centre and 0\.3 radii below the centre/);
    assert.deepEqual(await page.$$eval("#cue-sliders output", (all) => all.map((each) => each.textContent)), ["2.5 m/s", "60°"]);
    await page.locator("#cue").scrollIntoViewIfNeeded();
    const centre = await face();
    await page.mouse.move(...centre);
    await page.mouse.down();
    await page.mouse.move(centre[0] + 8, centre[1]);
    // A tip that is dragged beyond the rim stays on it.
    await page.mouse.move(centre[0] + 300, centre[1]);
    await page.mouse.up();
    await comparesWith(2.5, [0.5, 0], 60);
    await slideTo("cue-elevation", 0);
    await slideTo("cue-speed", 0.5);
    await comparesWith(4, [0.5, 0], 0);
    await page.focus("#cue");
    for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("ArrowUp");
    await comparesWith(4, [0.3, 0.05], 0);
    if (options.hasTouch) {
      // A finger taps a place of the ball.
      await page.locator("#cue").scrollIntoViewIfNeeded();
      await page.touchscreen.tap(...await face());
      await comparesWith(4, [0, 0], 0);
    }
    assert.equal((await state()).orbits.length, 1);
    await close();
  }
});

test("a motion that no cue gives says so, and so does a body that no cue strikes", async () => {
  await open("#ball=pool&orbits=2.8575,1&step=7");
  assert.match(await says("cue"), /No cue gives this motion/);
  // A ball that is hit above 0.4 radii slips backwards, and goes to the right all the same.
  await slideTo("cue-speed", 0.25);
  await page.focus("#cue");
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowUp");
  await comparesWith(2, [0, 0.5], 0);
  assert.ok(await page.evaluate(() => globalThis.page.hero.bodies[1].xs.at(-1)) > 0);
  await page.selectOption("#ball", "puck");
  assert.match(await says("cue"), /A cue strikes a real ball/);
  assert.equal(await page.textContent("#problem"), "");
  await page.focus("#cue");
  await page.keyboard.press("ArrowUp");
  assert.equal((await state()).ball.name, "puck");
  await close();
});

/** How the program's stroke, aimed by degrees to the left, goes by a stone half way to a mark. */
function programPasses(speed, tip, elevation, aim, mark) {
  const { x, y, ball: { radius } } = json("roll", "--ball", "pool", "--strike", speed, "--tip", tip.join(), "--elevation", elevation, "--samples", 4000);
  const [cos, sin] = [Math.cos((aim * Math.PI) / 180), Math.sin((aim * Math.PI) / 180)];
  const from = (far) => Math.min(...x.map((x, i) => Math.hypot(cos * x - sin * y[i] - far, sin * x + cos * y[i])));
  return { touches: from(mark / 2) < 2 * radius, off: from(mark) };
}

test("a ball curls around a stone: by mouse and by keys, one try touches it, one passes it over the mark; tries stay", async () => {
  await open("#ball=puck&orbits=2.286,0.5;13.716,0.5&chosen=1&line=3&at=1&lab=0", { stopped: true, reducedMotion: "no-preference" });
  const headline = () => page.textContent("#headline");
  assert.match(await headline(), /the line, in 1 try$/);
  await page.click("#next-line");
  assert.equal(await headline(), "Strike the ball around the stone and over the mark.");
  assert.ok(await page.isVisible("#cue-card"));
  const strike = async (aim) => {
    const [x, y] = await page.evaluate(() => {
      const { left, top } = document.getElementById("lanes").getBoundingClientRect();
      const [, ball] = globalThis.page.hero.places;
      return [left + ball.x, top + ball.y];
    });
    const angle = (aim * Math.PI) / 180;
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (const far of [60, 120, 240]) await page.mouse.move(x + far * Math.cos(angle), y - far * Math.sin(angle));
    await page.mouse.up();
    await pass(14_000);
  };
  await strike(0);
  assert.ok(programPasses(2.5, [0.4, -0.3], 60, 0, 0.6).touches);
  assert.equal(await headline(), "Try 1 touches the stone");
  // What is seen ends there.
  const gap = await page.evaluate(() => {
    const { hero: { bodies: [, { at }], stone } } = globalThis.page;
    return Math.hypot(at(1).x - stone.x, at(1).y) - 2 * stone.radius;
  });
  assert.ok(gap <= 0 && gap > -0.005, `${gap} m`);
  // The cue is set without a try.
  await slideTo("cue-elevation", 0.25);
  await page.focus("#cue");
  for (let i = 0; i < 6; ++i) await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  assert.equal((await state()).orbits.length, 2);
  await strike(30);
  await comparesWith(2.5, [0.4, 0], 20);
  const missed = programPasses(2.5, [0.4, 0], 20, 30, 0.6);
  assert.ok(!missed.touches && missed.off > 0.1);
  assert.equal(await headline(), `Try 2 misses the mark by ${length(missed.off, "m")}`);
  assert.ok(!(await page.isVisible("#send")));
  for (let i = 0; i < 6; ++i) await page.press("#cue", "ArrowDown");
  await slideTo("cue-elevation", 0.75);
  await strike(26);
  const hit = programPasses(2.5, [0.4, -0.3], 60, 26, 0.6);
  assert.ok(!hit.touches && hit.off < 0.02, `${hit.off} m`);
  assert.equal(await headline(), "Around the stone and over the mark, in 3 tries");
  const { off } = await page.evaluate(() => globalThis.page.hero.tryNow.passage);
  assert.ok(Math.abs(off - hit.off) < 1e-3, `${off} m, not ${hit.off}`);
  assert.deepEqual(await page.evaluate(() => globalThis.page.hero.ghostsNow().map(({ words }) => words)), ["1", "2", "3"]);
  await page.click("#send");
  await page.waitForFunction(() => document.getElementById("told").textContent !== "");
  const link = page.url();
  assert.doesNotMatch(link, /window|lab|part/);
  await close();
  await open(link.slice(link.indexOf("#")));
  assert.equal(await headline(), "Around the stone and over the mark, in 3 tries");
  assert.equal((await saved("#film-line")).subarray(4, 8).toString(), "ftyp");
  await page.focus("#lanes");
  for (let i = 0; i < 26; ++i) await page.keyboard.press("ArrowDown");
  assert.equal(await page.textContent("#told"), "0° to the left");
  await page.keyboard.press("Enter");
  assert.equal(await headline(), "Try 4 touches the stone");
  for (let i = 0; i < 26; ++i) await page.keyboard.press("ArrowUp");
  assert.equal(await page.textContent("#told"), "26° to the left");
  await page.keyboard.press("Enter");
  assert.equal(await headline(), "Around the stone and over the mark, in 5 tries");
  await close();
});

test("a ball that was struck to roll at once is aimed and struck again, and one of any size has no stone", async () => {
  await open("#ball=pool&orbits=0,0;0,0,3,0&chosen=1&line=0.6&step=7");
  await page.focus("#lanes");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  assert.match(await page.textContent("#headline"), /^Try 2 /);
  await close();
  await open("#ball=gel&orbits=9,0.5;9,0.5&chosen=1&line=1&lab=1");
  assert.match(await page.textContent("#headline"), /^Try 1 /);
  await page.selectOption("#ball", "");
  assert.match(await page.textContent("#headline"), /slides/);
  assert.equal((await state()).line, 0);
  await close();
});

test("a ball that bounces leaves as the program says, with spin and without", async () => {
  await open("#lab=0");
  await page.locator("#presets a", { hasText: "Bounce" }).click();
  assert.ok(await page.isVisible("#bounce-card") && !(await page.isVisible("#plane-card")));
  const compare = async (drop, restitution) => {
    const { ball, orbits: [{ u, v }] } = await state();
    const options = ["--ball", ball.name, "--speed", v, "--drop", drop, "--restitution", restitution, ...(ball.friction === 0.5 ? [] : ["--friction", ball.friction])];
    const [own, plain] = [u / ball.radius, 0].map((spin) => json("bounce", ...options, "--spin", spin).after);
    const leaves = ({ angle, vx }) => `${shown(angle, 3)}° from the vertical, at ${shown(vx, 3)} m/s along the floor`;
    assert.equal(await says("bounce"), `The ball leaves ${leaves(own)}. Without spin: ${leaves(plain)}, as textbooks predict for both.`);
    assert.equal(shown(plain.angle, 3), shown(json("bounce", ...options, "--spin", u / ball.radius).textbook.angle, 3));
  };
  await compare(0.1, 0.8);
  assert.doesNotMatch(page.url(), /drop|restitution/);
  await slideTo("drop", 0.5);
  await slideTo("restitution", 0.35);
  await compare(0.5, 0.35);
  await page.waitForFunction(() => /drop=0\.5&restitution=0\.35/.test(location.hash));
  await slideTo("spin", 0.3);
  await compare(0.5, 0.35);
  // Another friction leaves the patch of the catalogue.
  await page.evaluate(() => globalThis.page.store.ask((next) => (next.ball.friction = 0.3)));
  await compare(0.5, 0.35);
  // The picture follows the clock, and rests with it.
  const picture = () => page.$eval("#bounce", (canvas) => canvas.toDataURL());
  const pictures = new Set();
  for (const fraction of [0, 0.1, 0.2, 0.3, 0.9, 1]) {
    await page.evaluate((fraction) => globalThis.page.store.move({ fraction }), fraction);
    await drawn();
    pictures.add(await picture());
  }
  assert.equal(pictures.size, 5, "it has ended after a third of the motion on the table");
  await close();
  // An impact whose patch is wider than the ball is told, and the page goes on.
  await open("#ball=gel&mass=3&orbits=15,1&step=6");
  assert.match(await says("bounce"), /patch/);
  await slideTo("spin", 0.3);
  assert.equal(await page.textContent("#problem"), "");
  await close();
  await open("#ball=puck&orbits=2.286,0.5&step=6");
  assert.match(await says("bounce"), /A real ball that can roll bounces here/);
  await close();
});

/** The period of x' = y; y' = (1 - x^2)*y - x on its limit cycle, by steps of Runge and Kutta. */
function periodOfVanDerPol() {
  const rate = ([x, y]) => [y, (1 - x * x) * y - x];
  const plus = (at, by, step) => at.map((value, i) => value + step * by[i]);
  const crossings = [];
  let at = [2, 0];
  for (let i = 0, step = 1e-3; crossings.length < 8; ++i) {
    const a = rate(at), b = rate(plus(at, a, step / 2)), c = rate(plus(at, b, step / 2)), d = rate(plus(at, c, step));
    const next = at.map((value, j) => value + (step / 6) * (a[j] + 2 * b[j] + 2 * c[j] + d[j]));
    if (at[0] < 0 && next[0] >= 0) crossings.push(step * (i - at[0] / (next[0] - at[0])));
    at = next;
  }
  return crossings[7] - crossings[6];
}

test("typed equations are drawn as the program draws them; a click starts an orbit, and the link keeps all of it", async () => {
  await open("#ball=puck&orbits=2.286,0.5", { viewport: { width: 1280, height: 900 } });
  const type = async (id, text) => {
    await page.fill(`#${id}`, text);
    await page.press(`#${id}`, "Tab");
    await page.waitForFunction(() => document.getElementById("typed-says").textContent !== "Computing…");
  };
  const figure = () => page.evaluate(() => {
    const { panels: [{ x, y, lines, marks }] } = globalThis.page.store.typed;
    const words = ({ legend }) => legend.map((run) => run.words).join("");
    return { x: [x.low, x.high], y: [y.low, y.high], legends: [...lines, ...marks].map(words), marks: marks.map((mark) => [words(mark), [...mark.points]]),
      through: lines.filter((line) => words(line) === "through the points given").map(({ lines }) => [...lines]) };
  });
  assert.ok(!(await page.isVisible("#typed-plane")));
  const system = "x' = y; y' = (1 - x^2)*y - x";
  await type("typed", system);
  const first = await figure();
  const cycle = first.legends.find((words) => words.startsWith("stable limit cycle"));
  assertClose(Number(/T = ([\d.]+)/.exec(cycle)[1]), periodOfVanDerPol(), 1e-4, cycle);
  assert.deepEqual(first.marks, [["unstable focus", [0, 0]]]);
  await page.locator("#typed-plane").scrollIntoViewIfNeeded();
  const { x, y, width, height } = await page.locator("#typed-plane").boundingBox();
  await page.mouse.click(x + 0.42 * width, y + 0.4 * height);
  await page.waitForFunction(() => globalThis.page.state.points.length === 1);
  const { points: [point] } = await state();
  const second = await figure();
  assert.deepEqual([second.x, second.y], [first.x, first.y], "the window stays");
  // The command line draws the same plane.
  const words = /^contensou portrait --system "(.*)" --window (\S+) --through (\S+) -o system\.svg$/.exec(await page.textContent("#typed-command"));
  assert.deepEqual([words[1], words[3]], [system, point.join()]);
  const wanted = json("portrait", "--system", words[1], "--window", words[2], "--through", words[3]);
  assert.deepEqual(wanted.window, [first.x, first.y]);
  const near = (a, b) => Math.abs(a - b) <= 1e-6 * (1 + Math.abs(b));
  const [[drawnLine]] = [second.through];
  assert.ok(wanted.through.every(({ u, v }) => u.some((_, i) => near(drawnLine[0], u[i]) && near(drawnLine[1], v[i]))), `${drawnLine.slice(0, 2)}`);
  assert.ok(/<svg/.test(await page.selectOption("#picture", "typed-plane").then(() => saved("#save-svg"))));
  // Another point, typed; then the link.
  await type("typed-points", `${point.join(", ")}; 1, 0.5`);
  assert.deepEqual((await state()).points, [point, [1, 0.5]]);
  await page.waitForFunction(() => location.hash.includes(";1,0.5"));
  const link = new URL(page.url()).hash;
  await close();
  await open(link);
  assert.deepEqual((await figure()).legends, second.legends);
  assert.deepEqual((await state()).points, [point, [1, 0.5]]);
  // Wrong input: the reason in the words of the page, and the last plane stays.
  for (const [id, text, reason] of [["typed", "x' = y; y' = -a*x", /'a' is no variable, parameter or function: write its value at the end: ; a = 0\.8/],
    ["typed-points", "100, 3", /the point \(100, 3\) lies outside the window/], ["typed-points", "1, 2, 3", /more than two numbers/]]) {
    await type(id, text);
    assert.match(await page.textContent("#typed-problem"), reason);
    assert.equal((await state()).system, system);
  }
  await type("typed", "x'' = -a*x; a = 4");
  assert.equal(await page.inputValue("#typed-points"), "");
  assert.equal(await page.textContent("#typed-problem"), "");
  assert.deepEqual((await figure()).marks, [["center", [0, 0]]]);
  await type("typed", "");
  assert.ok(!(await page.isVisible("#typed-plane")));
  await close();
});
