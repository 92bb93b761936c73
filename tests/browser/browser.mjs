// Shared by the tests of the page: a browser, the page in it, and readings of both.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const program = process.env.CONTENSOU_PROGRAM;
export const folder = mkdtempSync(join(tmpdir(), "contensou-page-"));
export const file = join(folder, "page.html");
const address = pathToFileURL(file).href;

const help = execFileSync(program, ["help", "views"], { encoding: "utf8" });
// The other views are the program's alone.
export const views = Array.from(help.matchAll(/^ {2}([a-z]+) /gm), ([, name]) => name).filter((name) => ["uv", "log", "blowup", "disc"].includes(name));

/** ms; what a test waits for comes, on a slow machine later: only a failure takes so long. */
export const patience = 300_000;

let browser;
export let page;
let complaints;

before(async () => {
  execFileSync(program, ["explore", "-o", file]);
  browser = await chromium.launch({ executablePath: process.env.CONTENSOU_CHROMIUM, args: ["--no-sandbox"], timeout: patience });
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

/**
 * @param options  of the browser's context; with `stopped` the page's clock stands, and `pass` lets time pass
 * @param ready    what the page is ready with: true, an orbit; false, a state; null, nothing
 * @param before   runs in the page before its own scripts
 */
export async function open(fragment = "", { stopped = false, ...options } = {}, ready = true, before = null) {
  // Without motion, unless a test asks for it.
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, reducedMotion: "reduce", ...options });
  context.setDefaultTimeout(patience);
  // The browser's own pictures, for `drawn`, also where the page's clock stands.
  await context.addInitScript(() => (globalThis.nextPicture = requestAnimationFrame.bind(globalThis)));
  if (stopped) {
    await context.clock.install({ time: 0 });
    await context.clock.pauseAt(1000);
  }
  page = await context.newPage();
  complaints = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks for ${request.url()}`));
  if (before) await page.addInitScript(before);
  // With all that there is, unless a test asks for the first floor.
  await page.goto(`${address}${fragment}${/lab=/.test(fragment) ? "" : fragment ? "&lab=1" : "#lab=1"}`);
  if (ready) await page.waitForSelector("#orbits li", { state: "attached" });
  else if (ready === false) await page.waitForFunction(() => globalThis.page?.store.settled);
}

/** @param expected  what the console may say */
export async function close(expected = []) {
  assert.deepEqual(complaints.filter((complaint) => !expected.some((pattern) => pattern.test(complaint))), []);
  await page.context().close();
}

export const stopTimes = () => page.$$eval("#orbits li", (items) => items.map((item) => Number(item.dataset.tau)));
export const state = () => page.evaluate(() => globalThis.page.state);

/** An answer of the program. */
export const json = (...words) => JSON.parse(execFileSync(program, [...words.map(String), "--format", "json"], { encoding: "utf8" }));
export const programStop = (...words) => json("stop", ...words).tau_stop;

/** How the body of the chosen orbit slides, and one that does not spin. */
export const slides = () => page.evaluate(() => [globalThis.page.store.ride.own, globalThis.page.store.ride.plain]);

export function assertClose(measured, wanted, tolerance, what) {
  const error = Math.abs(measured / wanted - 1);
  assert.ok(error <= tolerance, `${what}: got ${measured}, wanted ${wanted}, relative error ${error}`);
}

/** Until the page is laid out and drawn as it is now, and has heard of what came into sight. */
export const drawn = () => page.evaluate(() => new Promise((done) => globalThis.nextPicture(() => globalThis.nextPicture(done))));

/** Moves a slider to a value. */
export const slide = (id, value) => page.locator(`#${id}`).evaluate((input, value) => {
  input.value = value;
  input.dispatchEvent(new Event("input"));
}, value);

/** Lets so many milliseconds pass on a clock that stands. */
export const pass = (time) => page.clock.runFor(time);

/** The pixel of a state in a panel of the plane. */
export const pixelOf = (u, v, panel = 0) => page.evaluate(([u, v, panel]) => {
  const { plane: { frames: { [panel]: frame } }, library } = globalThis.page;
  const [x, y] = library.plane.place(u, v).slice(2 * panel);
  const box = document.getElementById("plane").getBoundingClientRect();
  return [box.left + frame.px(x), box.top + frame.py(y)];
}, [u, v, panel]);

export const clickPlane = async (u, v, panel) => page.mouse.click(...await pixelOf(u, v, panel));

export async function dragSlider(id, from, to, steps) {
  const box = await page.locator(`#${id}`).boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + from * box.width, y);
  await page.mouse.down();
  for (let i = 1; i <= steps; ++i) {
    await page.mouse.move(box.x + (from + ((to - from) * i) / steps) * box.width, y);
    await drawn();
  }
  await page.mouse.up();
}

/** What a button hands out. */
export async function saved(button) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  return readFileSync(await download.path());
}
