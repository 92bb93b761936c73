// One curve: a start that is pulled runs through its copies, or changes curve.
import assert from "node:assert/strict";
import { test } from "node:test";
import { assertClose, close, drawn, open, page, pixelOf, programStop, state } from "./browser.mjs";

const said = async () => (await page.textContent("#pointed")).trim();

/** Pulls the chosen start through places that are as many times its own speeds. */
async function pull(...steps) {
  const { u, v } = await page.evaluate(() => globalThis.page.store.orbit);
  await page.mouse.move(...await pixelOf(u, v));
  await page.mouse.down();
  for (const [x, y] of steps) await page.mouse.move(...await pixelOf(x * u, y * v));
  await page.mouse.up();
}

/** Of the chosen motion and of what the pull has left behind: the start, the stop, and v over its start in parts of the time. */
const curves = () => page.evaluate(() => {
  const { plane: { copies }, store: { orbit, motion }, library: { plane } } = globalThis.page;
  return [{ ...orbit, stop: motion.stop }, ...copies.ghosts.map(({ start, stop }) => ({ ...start, stop }))].map(({ u, v, stop }) =>
    ({ u, v, stop, shares: [0.2, 0.5, 0.9].map((part) => plane.instant(u, v, part * stop).v / v) }));
});
const picture = () => page.evaluate(() => document.getElementById("copies").toDataURL());

test("along its ray a start runs through copies: one curve, c times as large, c times as long", async () => {
  for (const fragment of ["", "#mu=0.9&orbits=0.8,1.5&window=2,3", "#body=disc&law=uniform&orbits=-0.8,0.7&window=1,1"]) {
    await open(fragment);
    const before = await page.evaluate(() => ({ ...globalThis.page.store.orbit, stop: globalThis.page.store.motion.stop }));
    await pull([0.9, 0.92], [0.72, 0.7], [0.5, 0.52]);
    const { orbits: [{ u, v }] } = await state();
    assert.ok(u / before.u > 0.48 && u / before.u < 0.54);
    assertClose(v / before.v, u / before.u, 1e-12, "both speeds by one factor");
    const all = await curves();
    assert.ok(all.length >= 6, `${all.length} curves`);
    for (const { u: itsU, stop, shares } of all) {
      assertClose(stop / before.stop, itsU / before.u, 1e-12, "c times as long");
      shares.forEach((share, i) => assertClose(share, all[0].shares[i], 1e-9, "one line"));
    }
    const c = String(Number((u / before.u).toPrecision(3)));
    assert.match(await said(), new RegExp(`^Speeds × ${c}: same curve, ${c} × the time: `));
    await close();
  }
});

test("across its ray it changes curve, and what it leaves behind fans out until something else is chosen", async () => {
  await open("#body=disc&law=uniform&orbits=0.8,0.7;0.2,0.9&window=2,2");
  const before = await picture();
  await pull([0.9, 1.3], [0.6, 1.6], [0.4, 1.8]);
  assert.match(await said(), /^Another curve: it stops after τ = [\d.]+ \(before: τ = [\d.]+\)\.$/);
  const { orbits: [{ u, v }] } = await state();
  const all = await curves();
  assertClose(all[0].stop, programStop("--body", "disc", "--law", "uniform", "--u0", u, "--v0", v), 1e-12, "stop");
  assert.ok(new Set(all.map(({ shares }) => shares[1].toFixed(3))).size >= 4, JSON.stringify(all));
  assert.notEqual(await picture(), before);
  assert.ok(await page.evaluate(() => globalThis.page.plane.planeScene.ghosts.length > 4));
  await page.click("#orbits li:nth-child(2) button");
  assert.equal(await page.evaluate(() => globalThis.page.plane.scene().ghosts.length), 0);
  await close();
});

test("while a start is held, all that stop at one time with it are a line through it", async () => {
  await open("#body=disc&law=uniform&orbits=0.8,0.7&window=1,1");
  const height = () => page.evaluate(() => document.getElementById("plane").clientHeight);
  const before = await height();
  await page.mouse.move(...await pixelOf(0.8, 0.7));
  await page.mouse.down();
  await page.mouse.move(...await pixelOf(0.5, 0.8), { steps: 3 });
  const { orbits: [{ u, v }], isochrone } = await state();
  assertClose(isochrone, programStop("--body", "disc", "--law", "uniform", "--u0", u, "--v0", v), 1e-12, "its time");
  const least = await page.evaluate(([u, v]) => {
    const { plane: { planeScene: { isochrone: [line] }, frames: [frame] }, library: { plane } } = globalThis.page;
    const start = frame.pixel(plane.place(u, v));
    return Math.min(...frame.lines(line).flatMap((part) => Array.from({ length: part.length / 2 }, (_, i) => Math.hypot(part[2 * i] - start[0], part[2 * i + 1] - start[1]))));
  }, [u, v]);
  assert.ok(least < 6, `${least} pixels beside it`);
  assert.equal(await height(), before, "the plane stays as it is under the hand");
  await page.mouse.up();
  assert.equal((await state()).isochrone, 0);
  await close();
});

test("while a start is held, what lies behind it stays; then it is what a link to it draws", async () => {
  const plane = async () => {
    await page.evaluate(() => globalThis.page.store.move({ fraction: 0.5 }));
    await drawn();
    return page.evaluate(() => document.getElementById("plane").toDataURL());
  };
  const behind = () => page.evaluate(() => (globalThis.seen ??= []).push(globalThis.page.plane.planeScene.figure) && new Set(globalThis.seen).size);
  const link = "#ball=gel&window=11,0.6&orbits=9,0.5;-4,0.5&chosen=1";
  await open(link);
  await behind();
  await page.mouse.move(...await pixelOf(-4, 0.5));
  await page.mouse.down();
  for (const v of [0.45, 0.4, 0.35]) {
    await page.mouse.move(...await pixelOf(-3, v), { steps: 4 });
    assert.equal(await behind(), 2);
  }
  await page.mouse.up();
  assert.equal(await behind(), 3);
  const { orbits: [, { u, v }] } = await state();
  await page.evaluate(() => globalThis.page.plane.copies.pull = null);
  await page.evaluate(() => globalThis.page.plane.copies.ghosts = []);
  const picture = await plane();
  await close();
  await open(link.replace("-4,0.5", `${u},${v}`));
  assert.ok(picture === await plane(), "the picture of the link");
  await close();
});

test("the tour's copies are copies", async () => {
  await open();
  for (let step = 1; step <= 2; ++step) {
    await page.click("#step-on");
    await page.waitForFunction((step) => globalThis.page.state.step === step, step);
  }
  const { orbits } = await state();
  assert.equal(orbits.length, 3);
  orbits.forEach(({ u, v }, i) => {
    assertClose(u, orbits[0].u / 2 ** i, 1e-12, "u");
    assertClose(v, orbits[0].v / 2 ** i, 1e-12, "v");
  });
  await close();
});
