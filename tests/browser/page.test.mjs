// The page of `contensou explore` from its opening to its printout: bodies, sliders, clicks, keys, touch, history and files.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { gunzipSync } from "node:zlib";
import { unpacked } from "../../src/page/packing.js";
import { assertClose, close, drawn, file, folder, json, open, page, pass, pixelOf, program, programStop, saved, slide, slides, state, stopTimes } from "./browser.mjs";

const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const inLab = ["#columns", "#views", "#mu-control", "#friction-control", "#copies", "#plane-help", ".keys"];
const story = () => page.textContent("#story");

test("opens from disk and asks the network for nothing; at most 850 kB", async () => {
  assert.ok(statSync(file).size <= 850_000, `${statSync(file).size} bytes`);
  await open("#lab=0");
  assert.match(await page.title(), /contensou/);
  assert.equal((await stopTimes()).length, 1);
  await close();
});

test("the page opens with two pucks, and what it says of them is what the program computes", async () => {
  await open();
  const stop = (spin) => json("stop", "--ball", "puck", "--slip", "0.5", "--spin", spin);
  const wanted = [stop("60"), stop("0")];
  (await slides()).forEach(({ end, path }, i) => {
    assertClose(end, wanted[i].t_stop, 1e-11, "stops after");
    assertClose(path, wanted[i].slip_length, 1e-11, "slides");
  });
  const [far, farPlain] = wanted.map(({ slip_length }) => `${slip_length.toPrecision(3)} m`);
  assert.equal(await page.textContent("#headline"), "Spin a puck, and it slides 4 times as far");
  for (const part of ["leave at 0.5 m/s", `it slides ${farPlain}, and stops. Textbooks: ${farPlain} for both.`, `it slides ${far}, 4 times as far, and takes 3.6 times as long`]) assert.ok((await story()).includes(part), await story());
  await close();
});

test("of a ball the path until it rolls is told, as the program has it, with the slip at which it rolls", async () => {
  for (const [start, words] of [
    ["9,0.5", ["--slip", "0.5", "--spin", "300"]], ["9,0.5,0.2,0.4", ["--velocity", "0.2,0.4", "--angular-velocity", `${-0.4 / 0.03},${-0.3 / 0.03},300`]]]) {
    await open(`#ball=gel&orbits=${start}`);
    const [own, plain] = await slides();
    const wanted = json("roll", "--ball", "gel", ...words, "--law", "exact");
    assertClose(own.path, wanted.path, 1e-9, "path");
    assertClose(own.end, wanted.rolls_after.t, 1e-11, "rolls after");
    if (start === "9,0.5") {
      assertClose(plain.path, wanted.textbook.path, 1e-9, "textbook's path");
      for (const part of ["slides 12.5 mm, then rolls", "it slides 0.239 m, 19 times as far, and takes 22 times as long"]) assert.ok((await story()).includes(part), await story());
      assert.match(await page.textContent("#ball-facts"), /counts as rolling once its slip is below 1 mm\/s/);
    }
    // At the end both balls are where the program has them.
    const [at, end] = await page.evaluate(() => [globalThis.page.hero.bodies[1].at(1), globalThis.page.store.end * globalThis.page.store.timeFactor]);
    const there = execFileSync(program, ["roll", "--ball", "gel", ...words, "--law", "exact", "--at", String(end), "--format", "csv"], { encoding: "utf8" }).trim().split("\n").at(-1).split(",").map(Number);
    assertClose(Math.hypot(at.x, at.y), Math.hypot(there[1], there[2]), 1e-9, "place at the end");
    await close();
  }
});

test("what is told is what a ruler shows: the band's end, by the bar of the scale", async () => {
  for (const fragment of ["", "#ball=gel&orbits=9,0.5", "#ball=pool&orbits=2.8575,1"]) {
    await open(fragment);
    await page.selectOption("#picture", "lanes");
    const svg = String(await saved("#save-svg"));
    const paths = Array.from(svg.matchAll(/<path d="([^"]+)" fill="none" stroke="([^"]+)"/g), ([, d, stroke]) => ({ stroke, xs: Array.from(d.matchAll(/[ML]([\d.]+) /g), ([, x]) => Number(x)) }));
    const bar = paths.at(-1).xs.length === 4 ? paths.at(-1) : paths.filter(({ xs }) => xs.length === 4).at(-1);
    const [, size, unit] = />([\d.]+) (mm|m)[;<]/.exec(svg);
    const metres = (Number(size) * (unit === "mm" ? 1e-3 : 1)) / (bar.xs[2] - bar.xs[0]);
    const bands = paths.filter(({ stroke }) => stroke.length === 9).map(({ xs }) => (xs.at(-1) - xs[0]) * metres);
    const told = Array.from((await story()).matchAll(/slides ([\d.]+) (mm|m)/g), ([, length, unit]) => Number(length) * (unit === "mm" ? 1e-3 : 1));
    assert.equal(bands.length, 2);
    // The ruler between them: two pieces, and an end at either side.
    const ruler = paths.filter(({ xs }) => xs.length === 8).at(-1).xs;
    const more = Number(/>([\d.]+) m more</.exec(svg)[1]);
    assert.ok(Math.abs(more - (told[1] - told[0])) < 0.005 * told[1], `${fragment}: the ruler says ${more} m, the story ${told[1] - told[0]} m`);
    assert.ok(Math.abs((ruler[3] - ruler[0]) * metres - more) < 1.5 * metres + 0.005 * more, `${fragment}: a ruler of ${(ruler[3] - ruler[0]) * metres} m, told ${more} m`);
    bands.forEach((band, i) => assert.ok(Math.abs(band - told[i]) < 1.5 * metres + 0.005 * told[i], `${fragment}: ${band} m is drawn, ${told[i]} m is told`));
    await close();
  }
});

/** Pixels of the band behind the body that spins, or of the other one: from where to where. */
const band = (index) => page.evaluate((index) => {
  const { canvas } = globalThis.page.hero.lanes;
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  copy.drawImage(canvas, 0, 0);
  const { y } = globalThis.page.hero.places[index];
  const { data } = copy.getImageData(0, Math.round((y + 2) * devicePixelRatio), canvas.width, 1);
  const wanted = [[190, 193, 197], [231, 172, 189]][index];
  const xs = Array.from({ length: canvas.width }, (_, x) => x).filter((x) => wanted.every((value, i) => Math.abs(data[4 * x + i] - value) < 3));
  return xs.length ? xs.at(-1) - xs[0] : 0;
}, index);

const giveaways = ["#patch", "#why-card", "#sliders", "#plane", "#copies", "#presets", "#says", "#tour", "#game button"];
const seenOf = (ids) => page.evaluate((ids) => ids.filter((id) => document.querySelector(id).checkVisibility({ visibilityProperty: true })), ids);

test("the motion is shown before it is told: the headline asks until the end, then judges the answer, and stays", async () => {
  await open("#lab=0", { stopped: true, reducedMotion: "no-preference" });
  const marks = new Set();
  for (let i = 0; i < 5; ++i) {
    await pass(100);
    marks.add(await page.evaluate(() => document.getElementById("lanes").toDataURL()));
  }
  assert.ok(marks.size >= 4, "the body that spins turns in place");
  assert.equal((await state()).fraction, 0);
  const asks = async () => {
    assert.equal(await page.textContent("#headline"), "One puck spins. Which slides farther?");
    assert.deepEqual(await seenOf(giveaways), []);
  };
  await asks();
  assert.doesNotMatch(`${await page.locator("#app").innerText()} ${await page.title()}`, /0\.515|0\.127|times|farther than/);
  assert.deepEqual([await band(0), await band(1), ...await seenOf(["#play"])], [0, 0]);
  await page.click("#answers button:nth-child(3)");
  const bands = [];
  for (let i = 0; i < 3; ++i) {
    await pass(2000);
    await asks();
    assert.match(await page.textContent("#story"), /^You said: equally far\.$/);
    bands.push(await band(1));
  }
  assert.ok(bands[0] > 20 && bands[1] > bands[0] && bands[2] > bands[1], `${bands}`);
  await pass(1500);
  const verdict = "You said equally far, as textbooks do: 0.127 m. The one that spins went 0.515 m";
  for (const time of [0, 20_000]) {
    await pass(time);
    assert.equal(await page.textContent("#headline"), verdict);
    assert.equal((await state()).fraction, 1, "no round begins by itself");
    assert.equal(await page.textContent("#heard"), verdict);
  }
  assert.deepEqual(await seenOf(["#patch", "#sliders", "#plane", "#presets", "#tour"]), ["#patch", "#sliders", "#plane", "#presets", "#tour"]);
  // Another motion ends the verdict; the question comes back when it is asked for.
  await page.locator("#spin-slider").press("ArrowRight");
  assert.match(await page.textContent("#headline"), /^Spin a puck/);
  await page.click("#again");
  await pass(300);
  await asks();
  assert.deepEqual((await state()).orbits.map(({ u, v }) => [u, v]), [[2.286, 0.5]]);
  await page.click("#answers button:nth-child(1)");
  await pass(8000);
  assert.equal(await page.textContent("#headline"), "You are right: the one that spins went 0.515 m, the other 0.127 m");
  await close();
  // Who asks for less motion finds the end, and is asked if he wants it.
  await open("#lab=0", { stopped: true });
  await pass(300);
  assert.equal((await state()).fraction, 1);
  assert.match(await page.textContent("#headline"), /4 times as far/);
  await page.click("#again");
  await asks();
  await page.click("#answers button:nth-child(2)");
  assert.equal(await page.textContent("#headline"), "You said the one without spin: it went 0.127 m. The one that spins went 0.515 m");
  await close();
});

test("the address of the opening asks again, until the reader changes something", async () => {
  await open("#lab=0", { stopped: true, reducedMotion: "no-preference" });
  const address = async (time) => {
    await pass(time);
    return page.url().split("#")[1] ?? "";
  };
  assert.equal(await address(500), "");
  await page.click("#answers button:nth-child(1)");
  await pass(2000);
  await page.click("#play");
  assert.equal(await address(500), "", "a reader who stops the motion has no link to its middle");
  await page.click("#play");
  assert.equal(await address(8000), "");
  assert.match(await page.textContent("#headline"), /^You are right/);
  await page.reload();
  await page.waitForFunction(() => globalThis.page?.store.settled);
  assert.equal(await page.textContent("#headline"), "One puck spins. Which slides farther?");
  await page.click("#answers button:nth-child(1)");
  await pass(8000);
  await page.locator("#spin-slider").press("ArrowRight");
  assert.match(await address(500), /^ball=puck&.*orbits=2\.305/);
  await close();
  // The page shows the end at once if motion is reduced; its address asks a friend all the same.
  await open("#lab=0", { stopped: true });
  assert.equal(await address(500), "");
  await close();
});

test("a link is not asked of and plays once; the dot of the plane moves with the balls", async () => {
  const pictures = () => page.evaluate(() => ["lanes", "patch", "plane", "panes"].map((id) => document.getElementById(id).toDataURL()));
  await open("#ball=puck&orbits=2.286,0.5", { stopped: true, reducedMotion: "no-preference" });
  await pass(600);
  assert.ok(!(await page.isVisible("#answers")));
  const before = await pictures();
  await pass(500);
  await page.click("#play");
  // What is out of sight is drawn when it comes into sight.
  await page.locator("#panes").scrollIntoViewIfNeeded();
  await drawn();
  await pass(100);
  (await pictures()).forEach((picture, i) => assert.notEqual(picture, before[i]));
  // A puck turns as its clock says.
  assert.equal(await page.textContent("#pace"), "slowed 3.8 times");
  const turned = await page.evaluate(() => {
    const { store, library: { plane }, player } = globalThis.page;
    const { t, wz } = store.ride.courses[1];
    return [player.spinShown, plane && t.reduce((sum, time, i) => sum + (i ? (time - t[i - 1]) * (wz[i] + wz[i - 1]) / 2 : 0), 0) / 2 / Math.PI];
  });
  assert.deepEqual([turned[0], Number(turned[1].toPrecision(3))], [1, 8.75]);
  assert.match(await page.textContent("#clock"), /0\.\d{3} s/);
  await page.click("#play");
  await pass(20_000);
  assert.deepEqual([(await state()).fraction, await page.getAttribute("#play", "aria-label")], [1, "Play"]);
  // A ball that would seem to stand still or to turn back is drawn slower, and the clock says so.
  await page.locator("#presets a", { hasText: "Gel" }).click();
  const [, slowed, spin] = /^slowed ([\d.]+) times, its spin ([\d.]+) times$/.exec(await page.textContent("#pace")).map(Number);
  assertClose(slowed / spin, await page.evaluate(() => globalThis.page.player.spinShown), 0.05, "the share of the spin that is drawn");
  await close();
});

test("at the size of a notebook all of it is on the first screen, and on a phone the plane follows the balls", async () => {
  const places = () => page.evaluate(() => Object.fromEntries(["headline", "lanes", "play", "patch", "plane", "presets", "tour"].map((id) => {
    const { top, bottom, left, right } = document.getElementById(id).getBoundingClientRect();
    return [id, { top, bottom, left, right }];
  })));
  await open("#lab=0", { viewport: { width: 1440, height: 900 } });
  for (const [id, { top, bottom }] of Object.entries(await places())) assert.ok(top >= 0 && bottom <= 900, `${id}: ${top} to ${bottom}`);
  await close();
  await open("#lab=0", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const { lanes, play, patch, plane, tour } = await places();
  assert.ok(lanes.bottom < 500 && play.bottom < 560 && patch.top > play.bottom, JSON.stringify({ lanes, play, patch }));
  assert.ok(tour.top > patch.bottom && tour.bottom < plane.top, JSON.stringify({ plane, tour }));
  await close();
});

test("sliders say what they are, in SI, and the start follows", async () => {
  await open("#ball=gel&orbits=9,0.5");
  const slideTo = async (id, share) => {
    await slide(`${id}-slider`, 1000 * share);
    return page.locator(`#${id}-slider`).getAttribute("aria-valuetext");
  };
  assert.equal(await slideTo("spin", 0), "0 turns/s (0 rad/s)");
  assert.match(await page.textContent("#headline"), /^Without spin/);
  assert.equal(await slideTo("spin", 0.4), "31.8 turns/s (200 rad/s)");
  assert.equal(await slideTo("slip", 0.5), "1 m/s");
  const { orbits: [{ u, v, along }], ball } = await state();
  assert.deepEqual([u / ball.radius, v, along], [200, 1, 1]);
  const before = (await state()).mu;
  assert.equal(await slideTo("friction", 0.5), "0.6");
  assert.equal((await state()).mu, before, "the patch does not follow the friction");
  assert.match(await slideTo("mu", 0.8), /^7\.5\d? mm, mu 0\.25/);
  await close();
});

test("presets and the tour show what they speak of", async () => {
  await open();
  for (const link of await page.$$("#presets a")) {
    const before = await state();
    await link.click();
    assert.equal(await page.textContent("#problem"), "");
    const after = await state();
    assert.ok(after.orbits.length > 0);
    if ((await link.textContent()) !== "Puck") assert.notDeepEqual(after.orbits, before.orbits);
  }
  await page.click("#presets a");
  const steps = await page.$$eval("#steps li", (items) => items.map((item) => item.textContent));
  assert.equal(steps.length, 8);
  const seen = new Set();
  for (let i = 1; i < steps.length; ++i) {
    const before = JSON.stringify((await state()).orbits);
    await page.click("#step-on");
    await page.waitForFunction((before) => JSON.stringify(globalThis.page.state.orbits) !== before, before);
    assert.equal(await page.textContent("#problem"), "");
    seen.add(await page.evaluate(() => [...document.querySelectorAll("#plane, #bounce, #cue")].find((canvas) => canvas.checkVisibility()).toDataURL()));
  }
  assert.equal(seen.size, 7);
  assert.ok(await page.isDisabled("#step-on"));
  await close();
});

test("Back takes a change back", async () => {
  await open("#law=exact&mu=0.3&window=1,4&orbits=0.8,3.5;-0.5,1", { stopped: true });
  await pass(400);
  await page.click("#orbits li:nth-child(2) .remove");
  await pass(400);
  assert.doesNotMatch(page.url(), /-0.5,1/);
  await page.goBack();
  await page.waitForFunction(() => globalThis.page.state.orbits.length === 2);
  await page.goForward();
  await page.waitForFunction(() => globalThis.page.state.orbits.length === 1);
  await close();
});

test("a start is dragged, a click chooses the nearest orbit, Escape clears the isochrone, and all are cleared", async () => {
  await open("#law=exact&mu=0.3&window=1,4&orbits=0.8,3.5;-0.5,1&chosen=0");
  await page.mouse.move(...await pixelOf(-0.5, 1));
  await page.mouse.down();
  await page.mouse.move(...await pixelOf(-0.7, 2), { steps: 4 });
  await page.mouse.up();
  let { orbits, chosen, isochrone } = await state();
  assert.deepEqual([orbits.length, chosen, isochrone], [2, 1, 0]);
  assertClose(orbits[1].u, -0.7, 0.02, "u of the start");
  assertClose(orbits[1].v, 2, 0.02, "v of the start");
  // A point of the first orbit, some way on.
  const { u, v } = await page.evaluate(() => globalThis.page.library.plane.instant(0.8, 3.5, 1));
  await page.mouse.click(...await pixelOf(u, v));
  ({ orbits, chosen } = await state());
  assert.deepEqual([orbits.length, chosen], [2, 0]);
  for (const clear of [() => page.keyboard.press("Escape"), () => page.click("#clear-isochrone")]) {
    await page.mouse.move(...await pixelOf(0.1, 2));
    await page.mouse.down();
    await page.mouse.move(...await pixelOf(0.2, 2.5), { steps: 4 });
    await page.mouse.up();
    assert.ok((await state()).isochrone > 0);
    await clear();
    assert.equal((await state()).isochrone, 0);
    assert.ok(!(await page.isVisible("#clear-isochrone")));
  }
  await page.click("#clear-orbits");
  assert.equal((await state()).orbits.length, 0);
  await close();
});

test("keys reach the isochrone and every panel", async () => {
  await open("#law=exact&mu=0.3&view=blowup&orbits=0.8,3.5");
  await page.focus("#plane");
  await page.keyboard.press("p");
  await page.keyboard.press("p");
  assert.equal(await page.evaluate(() => globalThis.page.plane.cross.panel), 1);
  await page.keyboard.press("i");
  assert.ok((await state()).isochrone > 0);
  assert.match(await page.textContent("#pointed"), /dotted line/);
  await page.keyboard.press("Escape");
  assert.equal((await state()).isochrone, 0);
  await page.keyboard.press("Backspace");
  assert.equal((await state()).orbits.length, 0);
  await close();
});

test("a phone scrolls past the plane, and two fingers zoom it", async () => {
  await open("#law=exact&mu=0.3&window=1,5&orbits=0.8,3.5", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  await page.locator("#plane").scrollIntoViewIfNeeded();
  const box = await page.locator("#plane").boundingBox();
  const devtools = await page.context().newCDPSession(page);
  const [x, y] = [box.x + 0.3 * box.width, box.y + 0.5 * box.height];
  const before = await page.evaluate(() => scrollY);
  const touch = (type, ...points) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  await touch("touchStart", [x, y]);
  for (let i = 1; i <= 8; ++i) {
    await touch("touchMove", [x, y - 15 * i]);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(done)));
  }
  await touch("touchEnd");
  assert.ok((await page.evaluate(() => scrollY)) > before + 60);
  assert.equal((await state()).isochrone, 0);
  const { y: top } = await page.locator("#plane").boundingBox();
  const fingers = (apart) => [[x + 40 - apart, top + 100], [x + 40 + apart, top + 100]];
  await touch("touchStart", ...fingers(20));
  for (let i = 1; i <= 8; ++i) await touch("touchMove", ...fingers(20 + 5 * i));
  await touch("touchEnd");
  const { window: [U], isochrone, orbits } = await state();
  assert.ok(U < 0.5 && U > 0.2, `U = ${U}`);
  assert.deepEqual([isochrone, orbits.length], [0, 1]);
  await close();
});

test("one change changes one thing", async () => {
  await open("#ball=pool");
  await page.fill("#ball-fields [name=radius]", "0.05");
  const { orbits, ball } = await state();
  assertClose(orbits[0].u / 0.05, 100, 1e-12, "the spin stays");
  assert.equal(ball.patchBy, "spin_deceleration");
  await page.fill("[name=mu]", "0.05");
  assert.equal((await state()).ball.patchBy, "spin_deceleration");
  assertClose((await state()).mu, 0.05, 1e-11, "mu");
  await page.selectOption("#law", "pade");
  await page.selectOption("#ball-fields select", "patch_radius");
  const { mu } = await state();
  await page.selectOption("#ball-fields select", "spin_deceleration");
  assertClose((await state()).mu, mu, 1e-11, "the same patch, known in another way");
  await close();
});

test("a real ball is handed out in seconds, and its motion as the program's roll", async () => {
  await open("#ball=pool&orbits=3,4,0.9,0.9");
  const [header, ...rows] = (await saved("#save-csv")).toString().trim().split("\n");
  assert.equal(header, "t,x,y,vx,vy,wx,wy,wz,slip,energy");
  const words = (await page.textContent("#roll-command")).split(" ");
  assert.deepEqual(words.slice(0, 2), ["contensou", "roll"]);
  const times = join(folder, "times.csv");
  writeFileSync(times, `t\n${rows.map((row) => row.split(",")[0]).join("\n")}\n`);
  const wanted = execFileSync(program, [...words.slice(1), "--at", times, "--format", "csv"], { encoding: "utf8" }).split("\n").filter((line) => /^[-\d]/.test(line));
  assert.equal(rows.length, wanted.length);
  rows.forEach((row, i) => row.split(",").forEach((value, column) => {
    const other = Number(wanted[i].split(",")[column]);
    assert.ok(Math.abs(value - other) <= 1e-10 * (1 + Math.abs(other)), `row ${i}, column ${column}: ${value}, not ${other}`);
  }));
  assertClose((await slides())[0].path, json(...words.slice(1)).path, 1e-9, "path");
  await close();
});

test("a ball that does not spin is seen to roll, and nothing of its patch slips", async () => {
  await open("#ball=gel&orbits=0,0.5");
  await page.evaluate(() => globalThis.page.store.move({ fraction: 0.7 }));
  assert.match(await page.textContent("#instant"), /no slip/);
  const [{ x }, radius] = await page.evaluate(() => [globalThis.page.hero.bodies[1].at(1), globalThis.page.state.ball.radius]);
  assert.ok(x > 5.9 * radius && x < 6.5 * radius, `${x} m`);
  await close();
});

test("the page travels: a strict policy, a page inside a page, no path of the machine that built it", async () => {
  const html = readFileSync(file, "utf8");
  const inside = Array.from(html.matchAll(/"(\d+ [^"]{10000,}?)"/g), ([, text]) => gunzipSync(unpacked(text)).toString("latin1"));
  assert.equal(inside.length, 2, "the modules and the library");
  assert.doesNotMatch(inside.join("") + html, /\/(home|work|root|tmp|usr|build)\/[\w.+/-]+\.[ch](pp)?\b/);
  assert.ok(html.length < 850e3, `${html.length} bytes`);

  const policy = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; img-src data:";
  const strict = join(folder, "strict.html");
  writeFileSync(strict, html.replace("<head>", `<head><meta http-equiv="Content-Security-Policy" content="${policy}">`));
  await open();
  await page.goto(pathToFileURL(strict).href);
  await page.waitForSelector("#orbits li", { state: "attached" });

  const outer = join(folder, "outer.html");
  writeFileSync(outer, `<iframe style="width:1200px;height:900px" srcdoc="${html.replaceAll("&", "&amp;").replaceAll('"', "&quot;")}"></iframe>`);
  await page.goto(pathToFileURL(outer).href);
  const inner = page.frameLocator("iframe");
  await inner.locator("#orbits li").waitFor({ state: "attached" });
  await inner.locator("#presets a", { hasText: "Pool" }).click();
  await inner.locator("#lab").click();
  await inner.locator("#copy-link").click();
  assert.match(await inner.locator("#copied").textContent(), /#|copied/);
  await close();
});

test("a dark page is printed light, in one piece", async () => {
  await open("", { colorScheme: "dark" });
  const ground = () => page.evaluate(() => globalThis.page.plane.planeScene.figure.ground);
  const dark = await ground();
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.notEqual(await ground(), dark);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "light");
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal(await ground(), dark);
  const pages = (await page.pdf()).toString("latin1").match(/\/Type \/Page\b/g).length;
  assert.ok(pages <= 2, `${pages} pages`);
  await close();
});

test("for a page around it only the balls are shown", async () => {
  await open("#embed", { stopped: true }, false);
  assert.ok(await page.isVisible("#lanes"));
  for (const id of ["plane", "columns", "tour", "presets"]) assert.ok(!(await page.isVisible(`#${id}`)), id);
  await page.click("#play");
  await pass(500);
  assert.ok((await state()).fraction > 0.05);
  // Its name, below the balls, leads to all of it.
  await page.click("h1 a");
  await page.locator("#plane").waitFor();
  await close();
  await open("#ball=pool");
  await page.click("#copy-embed");
  await page.waitForFunction(() => document.getElementById("copied").textContent !== "");
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
    const corner = document.getElementById("plane").getBoundingClientRect();
    return globalThis.page.plane.pointed(x - corner.left, y - corner.top);
  }, end);
  assertClose(isochrone, programStop("--mu", 0.3, "--u0", at.u, "--v0", at.v, "--law", "pade"), 1e-12, "its time");
  // Each of its points has that stop time.
  const points = await page.evaluate(() => {
    const { plane: { planeScene: { isochrone: [line] } }, library: { plane } } = globalThis.page;
    return [1, 10, 20].map((i) => plane.at(0, line[2 * i], line[2 * i + 1]));
  });
  for (const { u, v } of points) {
    assertClose(programStop("--mu", 0.3, "--u0", u, "--v0", v, "--law", "pade"), isochrone, 1e-11, `at u = ${u}, v = ${v}`);
  }
  await close();
});

test("beside the plane a click starts nothing", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  const { left, right, top, bottom } = await page.evaluate(() => {
    const [frame] = globalThis.page.plane.frames;
    const box = document.getElementById("plane").getBoundingClientRect();
    return { left: box.left + 5, right: box.left + frame.left + frame.width / 2, top: box.top + 5, bottom: box.bottom - 5 };
  });
  for (const [x, y] of [[right, top], [right, bottom], [left, (top + bottom) / 2]]) {
    await page.mouse.click(x, y);
    assert.equal((await state()).orbits.length, 1);
  }
  await close();
});

test("figures and numbers are handed out", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5;-0.5,1");
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
  // Not only as many instants as the picture needs.
  for (const orbit of [1, 2]) assert.equal(rows.filter((row) => row.startsWith(`${orbit},`)).length, 240);
  await close();
});

test("orbits are chosen and removed, and time is played", async () => {
  await open("#law=pade&mu=0.3&orbits=0.8,3.5;-0.5,1;0.2,0.1", { stopped: true });
  const times = await stopTimes();
  await page.click("#orbits li:nth-child(2) .remove");
  assert.deepEqual(await stopTimes(), [times[0], times[2]]);
  await page.click("#orbits li:nth-child(2) button");
  assert.equal((await state()).chosen, 1);
  await page.click("#play");
  await pass(300);
  await page.click("#play");
  const { fraction } = await state();
  const [, tau] = (await page.textContent("#instant")).match(/^τ = ([\d.]+) /);
  assertClose(Number(tau), fraction * times[2], 1e-4, "the time of the moving point");
  await pass(100);
  assert.equal((await state()).fraction, fraction);
  for (let i = 0; i < 2; ++i) await page.click("#orbits li:nth-child(1) .remove");
  assert.deepEqual(await stopTimes(), []);
  assert.match(await page.textContent("#instant"), /No motion yet/);
  await close();
});

test("touch, at the width of a phone, in the dark", async () => {
  await open("#law=exact&mu=0.3&window=1,5&orbits=0.8,3.5", { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true, colorScheme: "dark" });
  await page.locator("#plane").scrollIntoViewIfNeeded();
  const box = await page.locator("#plane").boundingBox();
  await page.touchscreen.tap(box.x + 0.3 * box.width, box.y + 0.5 * box.height);
  assert.equal((await stopTimes()).length, 2);
  const { wide, tall } = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth, tall: document.getElementById("plane").clientHeight }));
  assert.ok(wide <= 360, `the page is ${wide} pixels wide`);
  assert.ok(tall >= 280);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
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

test("the first floor has the bodies, two sliders, the plane and the story; one word opens the rest, and is in the link", async () => {
  for (const options of [{}, phone]) {
    await open("#lab=0", options);
    for (const id of ["#headline", "#story", "#lanes", "#slip-slider", "#spin-slider", "#plane", "#presets", "#tour"]) assert.ok(await page.isVisible(id), id);
    for (const id of inLab) assert.ok(!(await page.locator(id).first().isVisible()), id);
    assert.equal(await page.locator("input:visible, select:visible").count(), 4, "time, slip, spin, spin of the patch");
    // The plane is curves alone, on axes in plain words.
    const { title, colour_bar: colourBar, panels: [{ x, y, lines }] } = await page.evaluate(() => globalThis.page.plane.planeScene.figure);
    assert.deepEqual([title, colourBar, x.name, y.name, lines.filter(({ legend, dashed }) => legend || dashed).length], ["", undefined, "rim speed of the spin, m/s", "sliding speed, m/s", 0]);
    assert.equal((await page.textContent("#plane-card")).match(/[^.]+\./)[0].trim(), "Each curve is one motion; all end at rest.");
    assert.equal(await page.getAttribute("#lab", "aria-expanded"), "false");
    await page.focus("#lab");
    await page.keyboard.press("Enter");
    for (const id of inLab.slice(0, options.isMobile ? -1 : undefined)) assert.ok(await page.locator(id).first().isVisible(), id);
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

test("a server is asked for the page, and for nothing else", async () => {
  const asked = [];
  const server = createServer(({ url }, answer) => {
    asked.push(url);
    answer.writeHead(200, { "Content-Type": "text/html" }).end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  server.unref(); // so that a failure ends
  await open();
  page.removeAllListeners("request");
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.waitForSelector("#orbits li", { state: "attached" });
  // What the page had asked for would have come before this.
  await page.evaluate(() => fetch("/last"));
  await close();
  server.close();
  assert.deepEqual(asked, ["/", "/last"]);
});

test("what is copied while a motion plays is what would be drawn", async () => {
  const link = "#ball=gel&view=log&orbits=9,0.5;-4,0.5";
  const pictures = async () => {
    const all = [];
    for (const id of ["lanes", "patch", "plane", "panes"]) {
      // Out of sight it is not drawn.
      await page.locator(`#${id}`).scrollIntoViewIfNeeded();
      await drawn();
      await drawn();
      all.push(await page.evaluate((id) => document.getElementById(id).toDataURL(), id));
    }
    return all;
  };
  const to = (fraction) => page.evaluate((fraction) => globalThis.page.store.move({ fraction }), fraction);
  await open(link);
  const first = await pictures();
  for (const fraction of [0.1, 0.2, 0.3, 0.4]) await to(fraction);
  const copied = await pictures();
  copied.forEach((picture, i) => assert.ok(picture !== first[i], `picture ${i} has moved`));
  await close();
  await open(`${link}&at=0.4`);
  (await pictures()).forEach((picture, i) => assert.ok(picture === copied[i], `picture ${i}`));
  await close();
});

test("inside another page nothing is added to the history; a slow drag adds one change", async () => {
  await open("", { stopped: true });
  const outer = join(folder, "article.html");
  writeFileSync(outer, `<iframe style="width:1200px;height:900px" src="${pathToFileURL(file).href}#embed"></iframe>`);
  await page.goto(pathToFileURL(outer).href);
  const inner = page.frameLocator("iframe");
  await inner.locator("#spin-slider").waitFor();
  const before = await page.evaluate(() => history.length);
  for (const key of ["ArrowRight", "ArrowRight"]) {
    await inner.locator("#spin-slider").press(key);
    await pass(350);
  }
  assert.equal(await page.evaluate(() => history.length), before);
  await close();
  await open("", { stopped: true });
  await pass(350);
  const length = await page.evaluate(() => history.length);
  const box = await page.locator("#spin-slider").boundingBox();
  const at = (share) => page.mouse.move(box.x + share * box.width, box.y + box.height / 2);
  await at(0.2);
  await page.mouse.down();
  for (const share of [0.3, 0.4, 0.5]) {
    await at(share);
    await pass(350);
  }
  await page.mouse.up();
  await pass(350);
  assert.equal(await page.evaluate(() => history.length), length + 1);
  await close();
});

test("a finger that scrolls past a slider does not move it", async () => {
  await open("", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  await page.locator("#spin-slider").scrollIntoViewIfNeeded();
  const box = await page.locator("#spin-slider").boundingBox();
  const before = await state();
  const devtools = await page.context().newCDPSession(page);
  const [x, y] = [box.x + 0.7 * box.width, box.y + box.height / 2];
  const touch = (type, ...points) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const top = await page.evaluate(() => scrollY);
  await touch("touchStart", [x, y]);
  for (let i = 1; i <= 10; ++i) {
    await touch("touchMove", [x - i, y - 15 * i]);
    await drawn();
  }
  await touch("touchEnd");
  assert.ok((await page.evaluate(() => scrollY)) > top + 60);
  assert.deepEqual((await state()).orbits, before.orbits);
  await close();
});
