// The page of `contensou explore` in a real browser: what its readers do, and what they then see.
//   CONTENSOU_PROGRAM=.../contensou node page.test.mjs
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const program = process.env.CONTENSOU_PROGRAM;
const folder = mkdtempSync(join(tmpdir(), "contensou-page-"));
const file = join(folder, "page.html");
const address = pathToFileURL(file).href;

let browser;
let page;
let complaints;

before(async () => {
  execFileSync(program, ["explore", "-o", file]);
  browser = await chromium.launch({ executablePath: process.env.CONTENSOU_CHROMIUM, args: ["--no-sandbox"] });
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

async function open(fragment = "", options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, ...options });
  page = await context.newPage();
  complaints = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks for ${request.url()}`));
  await page.goto(address + fragment);
  await page.waitForSelector("#orbits li");
}

async function close() {
  assert.deepEqual(complaints, []);
  await page.context().close();
}

const stopTimes = () => page.$$eval("#orbits li", (items) => items.map((item) => Number(item.dataset.tau)));
const state = () => page.evaluate(() => globalThis.page.state);

function programStop(...words) {
  return JSON.parse(execFileSync(program, ["stop", ...words.map(String), "--format", "json"], { encoding: "utf8" })).tau_stop;
}

function assertClose(measured, wanted, tolerance, what) {
  const error = Math.abs(measured / wanted - 1);
  assert.ok(error <= tolerance, `${what}: got ${measured}, wanted ${wanted}, relative error ${error}`);
}

/** Clicks the plane where u and v are, in the view that shows them. */
async function clickPlane(u, v) {
  const { x, y } = await page.evaluate(([u, v]) => {
    const { frame, view, context } = globalThis.page.planeScene;
    const s = { u: [u], v: [v], lnU: [Math.log(Math.abs(u))], lnV: [Math.log(v)] };
    const box = document.getElementById("plane").getBoundingClientRect();
    return { x: box.left + frame.px(view.x(s, 0, context)), y: box.top + frame.py(view.y(s, 0, context)) };
  }, [u, v]);
  await page.mouse.click(x, y);
}

async function dragSlider(id, from, to, steps) {
  const box = await page.locator(`#${id}`).boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + from * box.width, y);
  await page.mouse.down();
  for (let i = 1; i <= steps; ++i) {
    await page.mouse.move(box.x + (from + ((to - from) * i) / steps) * box.width, y);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(done)));
  }
  await page.mouse.up();
}

test("opens from disk and asks the network for nothing", async () => {
  await open();
  assert.match(await page.title(), /contensou/);
  assert.equal((await stopTimes()).length, 1);
  await close();
});

test("a clicked orbit stops when the program says", async () => {
  for (const law of ["pade", "exact", "uniform"]) {
    await open(`#law=${law}&mu=0.2&window=1,4&orbits=0.5,1`);
    await clickPlane(-0.6, 3.1);
    await clickPlane(0.31, 0.4);
    const { orbits, mu } = await state();
    assert.equal(orbits.length, 3);
    assertClose(orbits[1].u, -0.6, 0.02, "u of the click");
    assertClose(orbits[1].v, 3.1, 0.02, "v of the click");
    const times = await stopTimes();
    orbits.forEach(({ u, v }, i) => {
      assertClose(times[i], programStop("--mu", mu, "--u0", u, "--v0", v, "--law", law), 1e-12, `${law}, u0 = ${u}, v0 = ${v}`);
    });
    await close();
  }
});

test("mu is dragged, and everything follows", async (t) => {
  for (const law of ["pade", "exact"]) {
    await open(`#law=${law}&mu=0.9&orbits=0.8,3.5;-0.4,2`);
    const before = await stopTimes();
    await page.evaluate(() => (globalThis.page.redraws.length = 0));
    await dragSlider("mu-slider", 0.98, 0.4, 60);
    const { mu, orbits } = await state();
    assert.ok(mu < 0.03 && mu > 0.005, `mu is ${mu}`);
    const times = await stopTimes();
    assert.ok(times[0] > 5 * before[0]);
    orbits.forEach(({ u, v }, i) => {
      assertClose(times[i], programStop("--mu", mu, "--u0", u, "--v0", v, "--law", law), 1e-12, `mu = ${mu}`);
    });
    const redraws = await page.evaluate(() => [...globalThis.page.redraws].sort((a, b) => a - b));
    assert.ok(redraws.length >= 30, `${redraws.length} redraws`);
    t.diagnostic(`law ${law}: median redraw ${redraws[redraws.length >> 1].toFixed(1)} ms, worst ${redraws.at(-1).toFixed(1)} ms, of ${redraws.length}`);
    await close();
  }
});

test("all views are drawn, and a click in each starts the orbit that it points at", async () => {
  await open("#law=exact&mu=0.3&window=1,5&orbits=0.8,3.5");
  const pictures = new Set();
  for (const view of ["uv", "patch", "log", "similarity", "blowup", "disc"]) {
    await page.click(`#views [data-name=${view}]`);
    assert.equal(await page.getAttribute(`#views [data-name=${view}]`, "aria-checked"), "true");
    const picture = await page.evaluate(() => document.getElementById("plane").toDataURL());
    pictures.add(picture);
    await clickPlane(0.52, 0.21);
    const { u, v } = (await state()).orbits.at(-1);
    assertClose(u, 0.52, 0.06, `u in ${view}`);
    assertClose(v, 0.21, 0.06, `v in ${view}`);
  }
  assert.equal(pictures.size, 6);
  assert.equal((await stopTimes()).length, 7);
  await close();
});

test("a drag shows the isochrone through the pointer", async () => {
  await open("#law=pade&mu=0.3&window=1,5&orbits=0.8,3.5");
  const box = await page.locator("#plane").boundingBox();
  const end = [Math.round(box.x + 0.7 * box.width), Math.round(box.y + 0.4 * box.height)];
  await page.mouse.move(end[0] - 100, end[1] + 50);
  await page.mouse.down();
  await page.mouse.move(...end, { steps: 5 });
  const { isochrone, orbits } = await state();
  await page.mouse.up();
  assert.equal(orbits.length, 1);
  const at = await page.evaluate(([x, y]) => {
    const { frame, view, context } = globalThis.page.planeScene;
    const corner = document.getElementById("plane").getBoundingClientRect();
    const numbers = frame.at(x - corner.left, y - corner.top);
    return view.state(numbers.x, numbers.y, context);
  }, end);
  assertClose(isochrone, programStop("--mu", 0.3, "--u0", at.u, "--v0", at.v, "--law", "pade"), 1e-12, "its time");
  // Each of its points has that stop time.
  const points = await page.evaluate(() => {
    const [{ u, v }] = globalThis.page.planeScene.isochrone;
    return [1, 20, 60].map((i) => [u[i], v[i]]);
  });
  for (const [u, v] of points) {
    assertClose(programStop("--mu", 0.3, "--u0", u, "--v0", v, "--law", "pade"), isochrone, 1e-11, `at u = ${u}, v = ${v}`);
  }
  await close();
});

test("a link reproduces the page", async () => {
  await open("#law=exact&mu=0.25&window=2,3&orbits=1,2");
  await clickPlane(0.7, 1.2);
  await page.click("#views [data-name=patch]");
  await page.fill("#mu", "0.125");
  await dragSlider("time", 0.02, 0.3, 5);
  await page.click("#copy-link");
  const [link, before, times] = [page.url(), await state(), await stopTimes()];
  await close();
  await open(link.slice(link.indexOf("#")));
  const after = await state();
  assert.ok(Math.abs(after.share - before.share) < 1e-3);
  assert.deepEqual({ ...after, share: 0 }, { ...before, share: 0 });
  assert.deepEqual(await stopTimes(), times);
  await close();
});

test("a link that nobody can read opens the page all the same", async () => {
  await open("#law=nonsense&mu=-1&view=&window=1&orbits=x;1,-1;0.5,1&chosen=7&ball=golf&at=2");
  const { law, mu, view, orbits, chosen } = await state();
  assert.deepEqual({ law, mu, view, orbits, chosen }, { law: "exact", mu: 0.3, view: "uv", orbits: [{ u: 0.5, v: 1 }], chosen: 0 });
  await close();
});

test("a wrong number is named beside its field, and the last good state stays", async () => {
  await open("#law=exact&mu=0.25&orbits=0.8,3.5");
  const times = await stopTimes();
  for (const [text, complaint] of [["abc", /'abc' is not a finite number/], ["0", /positive/], ["-1", /positive/], ["1.5", /at most 1/], ["", /needed/], ["1e999", /finite/], ["0,3", /0\.3/]]) {
    await page.fill("#mu", text);
    assert.match(await page.textContent("#mu-error"), complaint);
    assert.equal(await page.getAttribute("#mu", "aria-invalid"), "true");
    assert.deepEqual(await stopTimes(), times);
  }
  await page.fill("#mu", "0.5");
  assert.equal(await page.textContent("#mu-error"), "");
  assert.notDeepEqual(await stopTimes(), times);

  await page.fill("#add-orbit [name=u]", "1");
  await page.fill("#add-orbit [name=v]", "-1");
  await page.click("#add-orbit button");
  assert.match(await page.textContent("#add-orbit output"), /≥ 0/);
  assert.equal((await stopTimes()).length, 1);
  await close();
});

test("a real ball: seconds, its fields, its path, and its command line", async () => {
  await open();
  await page.selectOption("#ball", "pool");
  const seconds = async () => Number((await page.textContent("#orbits .stop")).match(/([\d.]+) s/)[1]);
  const program_ = (...words) => JSON.parse(execFileSync(program, ["stop", "--ball", "pool", "--format", "json", ...words], { encoding: "utf8" }));
  const law = (await state()).law;
  assertClose((await stopTimes())[0], program_("--law", law).tau_stop, 1e-12, "pool, tau");
  assertClose(await seconds(), program_("--law", law).t_stop, 1e-5, "pool, seconds");

  await page.fill("#ball-fields [name=friction]", "0.3");
  assertClose((await stopTimes())[0], program_("--law", law, "--friction", "0.3").tau_stop, 1e-12, "more friction");
  await page.fill("#ball-fields [name=radius]", "-1");
  assert.match(await page.textContent("#radius-error"), /positive/);
  await page.fill("#ball-fields [name=patch]", "1e9");
  assert.match(await page.textContent("#patch-error"), /patch/);
  assertClose((await stopTimes())[0], program_("--law", law, "--friction", "0.3").tau_stop, 1e-12, "the last good state");

  const words = (await page.textContent("#command")).split(" ");
  assert.equal(words.shift(), "contensou");
  assert.match(await page.textContent("#path-facts"), /Rolls after/);
  const drawn = join(folder, "portrait.json");
  words[words.indexOf("portrait.svg")] = drawn;
  execFileSync(program, words);
  const portrait = JSON.parse(readFileSync(drawn, "utf8"));
  const shown = await page.evaluate(() => {
    const { context, family } = globalThis.page.planeScene;
    return { mu: context.mu, window: context.window, u: family.orbits.map((orbit) => orbit.u[0]), v: family.orbits.map((orbit) => orbit.v[0]) };
  });
  assertClose(portrait.mu, shown.mu, 1e-14, "mu of the picture");
  assert.deepEqual(portrait.window, shown.window);
  assert.equal(portrait.orbits.length, shown.u.length);
  portrait.orbits.forEach((orbit, i) => {
    assert.ok(Math.abs(orbit.u[0] - shown.u[i]) < 1e-12 && Math.abs(orbit.v[0] - shown.v[i]) < 1e-12, `orbit ${i}`);
  });
  await close();
});

test("figures and numbers are handed out", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5;-0.5,1");
  const saved = async (button) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
    return readFileSync(await download.path());
  };
  const svg = (await saved("#save-svg")).toString();
  assert.ok(svg.startsWith("<svg xmlns=") && svg.endsWith("</svg>\n"));
  assert.ok(!/NaN|Infinity|undefined/.test(svg));
  const complaint = await page.evaluate((text) => new DOMParser().parseFromString(text, "image/svg+xml").querySelector("parsererror")?.textContent, svg);
  assert.equal(complaint, undefined);

  const png = await saved("#save-png");
  assert.equal(png.subarray(1, 4).toString(), "PNG");
  assert.ok(png.readUInt32BE(16) > 1000, "twice as wide as on the screen");

  const [header, ...rows] = (await saved("#save-csv")).toString().trim().split("\n");
  assert.equal(header, "orbit,tau,u,v,ln_v,k");
  assert.deepEqual(rows[0].split(",").slice(0, 4), ["1", "0", "0.8", "3.5"]);
  assert.ok(rows.some((row) => row.startsWith("2,0,-0.5,1,")));
  assert.ok(rows.at(-1).includes(",0,0,-inf,"), rows.at(-1));
  await close();
});

test("orbits are chosen and removed, and time is played", async () => {
  await open("#law=pade&mu=0.3&orbits=0.8,3.5;-0.5,1;0.2,0.1");
  const times = await stopTimes();
  await page.click("#orbits li:nth-child(2) .remove");
  assert.deepEqual(await stopTimes(), [times[0], times[2]]);
  await page.click("#orbits li:nth-child(2) button");
  assert.equal((await state()).chosen, 1);
  await page.click("#play");
  await page.waitForFunction(() => globalThis.page.state.share > 0.02);
  await page.click("#play");
  const { share } = await state();
  const [, tau] = (await page.textContent("#instant")).match(/^τ = ([\d.]+) /);
  assertClose(Number(tau), share * times[2], 1e-4, "the time of the moving point");
  await page.waitForTimeout(100);
  assert.equal((await state()).share, share);
  for (let i = 0; i < 2; ++i) await page.click("#orbits li:nth-child(1) .remove");
  assert.deepEqual(await stopTimes(), []);
  assert.match(await page.textContent("#instant"), /No orbit/);
  await close();
});

test("the checks of the chosen orbit are live", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  await page.waitForFunction(() => document.querySelectorAll("#checks tbody tr").length >= 8);
  const verdicts = await page.$$eval("#checks tbody td:last-child", (cells) => cells.map((cell) => cell.textContent));
  assert.ok(verdicts.every((verdict) => verdict === "ok"), verdicts.join());
  await close();
});

test("the keyboard alone is enough", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  await page.focus("#plane");
  for (const key of ["ArrowLeft", "ArrowUp", "ArrowUp", "Enter"]) await page.keyboard.press(key);
  assert.equal((await stopTimes()).length, 2);
  assert.match(await page.textContent("#pointed"), /it stops at τ\* = /);
  await page.keyboard.press("Delete");
  assert.equal((await stopTimes()).length, 1);
  await page.focus("#views [aria-checked=true]");
  await page.keyboard.press("ArrowRight");
  assert.equal((await state()).view, "patch");
  await close();
});

test("touch, at the width of a phone, in the dark", async () => {
  await open("#law=exact&mu=0.3&window=1,5&orbits=0.8,3.5", { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true, colorScheme: "dark" });
  const box = await page.locator("#plane").boundingBox();
  await page.touchscreen.tap(box.x + 0.3 * box.width, box.y + 0.5 * box.height);
  assert.equal((await stopTimes()).length, 2);
  const { wide, tall } = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth, tall: document.getElementById("plane").clientHeight }));
  assert.ok(wide <= 360, `the page is ${wide} pixels wide`);
  assert.ok(tall >= 280);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await close();
});

test("a new size of the window is a new drawing, sharp", async () => {
  await open();
  for (const width of [1900, 700, 1280]) {
    await page.setViewportSize({ width, height: 900 });
    await page.waitForFunction(() => {
      const canvas = document.getElementById("plane");
      return canvas.width === Math.round(canvas.clientWidth * devicePixelRatio) && globalThis.page.planeScene.frame.width < canvas.clientWidth;
    });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  }
  // Without any width, as browsers have it while they print or restore a window.
  const frame = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.evaluate(() => (document.body.style.width = "0"));
  await frame();
  await page.evaluate(() => (document.body.style.width = ""));
  await frame();
  await close();
});

test("every control has a name", async () => {
  await open("#ball=pool");
  const nameless = await page.$$eval("button, input, select, canvas", (controls) => controls
    .filter((control) => control.checkVisibility())
    .filter((control) => !(control.getAttribute("aria-label") || control.labels?.length || control.textContent.trim()))
    .map((control) => control.outerHTML));
  assert.deepEqual(nameless, []);
  await close();
});

test("bodies that end on a ray, or with k growing, are explored like balls", async () => {
  const cases = [
    ["#law=uniform&body=disc&window=1,1&orbits=0.8,0.7;0.3,0.9;0.9,0.1", ["--body", "disc", "--law", "uniform"], /k\* = 0\.653/],
    ["#law=exact&body=1,6&mu=1&window=1,1&orbits=0.8,0.7;0.3,0.9", ["--body", "1,6", "--mu", 1, "--law", "exact"], /k → ∞/],
  ];
  for (const [fragment, words, limit] of cases) {
    await open(fragment);
    assert.match(await page.textContent("#terminal"), limit);
    for (const view of ["uv", "patch", "log", "similarity", "blowup", "disc"]) {
      await page.click(`#views [data-name=${view}]`);
      assert.ok(await page.evaluate(() => globalThis.page.planeScene.family.orbits.length) > 10, view);
    }
    const times = await stopTimes();
    (await state()).orbits.forEach(({ u, v }, i) => {
      assertClose(times[i], programStop("--u0", u, "--v0", v, ...words), 1e-12, `${words.join(" ")}, u0 = ${u}, v0 = ${v}`);
    });
    await close();
  }
});
