// A film of a ball, given to the page, and the files that the page writes.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { assertClose, close, folder, open, page, program, saved, state } from "./browser.mjs";

/** A film of a ball as CSV, with normal errors that are always the same. */
function filmOf(ball, rows, until, slip, spin) {
  const times = join(folder, "film-times.csv");
  writeFileSync(times, `t\n${Array.from({ length: rows }, (_, i) => (i * until) / (rows - 1)).join("\n")}\n`);
  const words = ["roll", "--ball", ball, "--slip", slip, "--spin", spin, "--law", "exact", "--at", times, "--format", "csv"];
  const motion = execFileSync(program, words, { encoding: "utf8", maxBuffer: 1e9 }).split("\n").filter((line) => /^[-\d]/.test(line));
  let seed = 1;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  const normal = () => Math.sqrt(-2 * Math.log(random())) * Math.cos(2 * Math.PI * random());
  return `t,slip,spin,slip_sd,spin_sd\n${motion.map((line) => {
    const [t, , , , , , , wz, speed] = line.split(",").map(Number);
    return `${t},${speed + 0.01 * normal()},${wz + normal()},0.01,1`;
  }).join("\n")}\n`;
}
const file = (name, text) => ({ name, mimeType: "text/csv", buffer: Buffer.from(text) });
const report = () => page.textContent("#film-report");
const fitted = () => page.waitForFunction(() => /is fitted\./.test(document.getElementById("film-status").textContent));

test("a film is fitted as the program fits it, and the ball takes what was found", async () => {
  const text = filmOf("gel", 60, 0.5, "0.6", "200");
  const path = join(folder, "film.csv");
  writeFileSync(path, text);
  const words = ["fit", path, "--ball", "gel", "--law", "exact,pade"];
  const wanted = JSON.parse(execFileSync(program, [...words, "--format", "json"], { encoding: "utf8" }));
  const wantedText = execFileSync(program, words, { encoding: "utf8" });
  // The second law holds a comma.
  await open("#ball=gel&against=phi = k/hypot(1, k); psi = 1/hypot(1, k)");
  assert.ok(await page.$eval("#picture option[value=film-fit]", ({ hidden }) => hidden));
  await page.setInputFiles("#film", file("film.csv", text));
  await fitted();
  assert.match(await page.textContent("#film-report"), /hypot\(1, k\)/);
  await close();
  await open("#ball=gel&against=pade");
  await page.setInputFiles("#film", file("film.csv", text));
  await fitted();
  assert.ok(!(await page.$eval("#picture option[value=film-fit]", ({ hidden }) => hidden)));
  const { ball, law, orbits: [{ u, v }] } = await state();
  assert.equal(await page.inputValue("#ball-fields [name=friction]"), String(Number(ball.friction.toPrecision(6))));
  assert.deepEqual([law, ball.patchBy], [wanted.law, "patch_radius"]);
  for (const [value, name] of [[ball.friction, "friction"], [ball.patch, "patch_radius"], [v, "slip"], [u / ball.radius, "spin"]]) assertClose(value, wanted[name].value, 1e-6, name);
  // The report is the program's, word for word; its numbers have six digits.
  const number = /-?\d+(\.\d+)?(e[-+]?\d+)?/g;
  const said = await report();
  assert.equal(said.replace(number, "0").replace(/ +/g, " "), wantedText.replace(number, "0").replace(/ +/g, " "));
  const [numbers, wantedNumbers] = [said, wantedText].map((all) => all.match(number).map(Number));
  numbers.forEach((value, i) => assert.ok(Math.abs(value - wantedNumbers[i]) <= 2e-5 * Math.abs(wantedNumbers[i]) + 1e-3, `number ${i}: ${value}, not ${wantedNumbers[i]}`));
  for (const part of [/friction +0\.50/, /95 % confidence/, /pade/, /exact fits better than all others/]) assert.match(said, part);
  assert.match(await page.textContent("#story"), /leave at 0\.[56]/);
  // Its panels go below each other where the page is made narrow.
  const height = () => page.$eval("#film-fit", (canvas) => canvas.clientHeight);
  const before = await height();
  await page.setViewportSize({ width: 390, height: 844 });
  await page.waitForFunction((before) => document.getElementById("film-fit").clientHeight > before, before);
  await page.setViewportSize({ width: 1280, height: 900 });
  await page.waitForFunction((before) => document.getElementById("film-fit").clientHeight === before, before);
  // What was measured is drawn over the curves, until the ball is another.
  const points = async () => {
    await page.selectOption("#picture", "panes");
    return Array.from(String(await saved("#save-svg")).matchAll(/<path d="([^"]*a1\.8 [^"]*)"/g), ([, path]) => Array.from(path.matchAll(/M([\d.]+) ([\d.]+)a1\.8/g), ([, x, y]) => [Number(x) - 1.8, Number(y)]));
  };
  await page.locator("#span label", { hasText: "rest" }).click();
  const drawnPoints = await points();
  assert.deepEqual(drawnPoints.map((discs) => discs.length), [60, 60]);
  assert.ok(drawnPoints[0].every(([x], i) => i === 0 || x > drawnPoints[0][i - 1][0]), "in time");
  const [top, bottom] = [0, 59].map((i) => drawnPoints[0][i][1]);
  assert.ok(bottom > top + 20, "the slip falls");
  await page.selectOption("#ball", "pool");
  assert.deepEqual(await points(), []);
  await close();
});

test("a film of the spin alone determines a product, and says so; one of the centre gives its velocity", async () => {
  await open("#ball=pool");
  await page.selectOption("#picture", "film-fit");
  await page.click("#save-svg");
  assert.match(await page.textContent("#copied"), /could not be done: no film has been fitted/);
  const text = filmOf("pool", 40, 2, "0.2", "100");
  await page.evaluate((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], "spin.csv"));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  }, text.split("\n").map((line) => line.split(",").filter((_, i) => i === 0 || i === 2).join(",")).join("\n"));
  await fitted();
  assert.match(await report(), /these data determine .*friction.* patch_radius.* only/);
  const times = Array.from({ length: 60 }, (_, i) => i / 120);
  const words = ["roll", "--ball", "pool", "--velocity", "0.9,0.9", "--angular-velocity", "-31,-108,105", "--law", "exact", "--at", times.join(","), "--format", "csv"];
  const rows = execFileSync(program, words, { encoding: "utf8" }).split("\n").filter((line) => /^[-\d]/.test(line)).map((line) => line.split(","));
  await page.setInputFiles("#film", file("centre.csv", `t,x,y,spin\n${rows.map((row) => [row[0], row[1], row[2], row[7]].join(",")).join("\n")}\n`));
  await page.waitForFunction(() => /centre\.csv is fitted\./.test(document.getElementById("film-status").textContent));
  const { ball, orbits: [{ along, across }] } = await state();
  assertClose(Math.hypot(along, across), 0.9 * Math.SQRT2, 1e-4, "speed of the centre");
  assertClose(ball.friction, 0.2, 1e-3, "friction");
  // Each column that was measured is drawn over its curve, with what is left below.
  const svg = String(await saved("#save-svg"));
  for (const name of ["x", "y", "spin"]) assert.match(svg, new RegExp(`>${name}: residual / sd<`));
  const dots = Array.from(svg.matchAll(/<path d="([^"]*a1\.368 [^"]*)"/g), ([, path]) => path.split("M").length - 1);
  assert.deepEqual(dots.filter((count) => count === 60).length, 6);
  assert.ok((await page.locator("#film-fit").boundingBox()).height > 300);
  await page.setInputFiles("#film", file("empty.csv", ""));
  await page.waitForFunction(() => document.getElementById("film-problem").textContent !== "");
  assert.ok(await page.locator("#film-fit").isHidden(), "of another film nothing is left");
  await close();
});

test("what is wrong with a film is said where it is read, with its line", async () => {
  await open("#ball=gel");
  const before = (await state()).ball;
  for (const [text, complaint] of [
    ["t,slip,spin\n0,1,2\n0.1,x,2\n", /^track\.csv:3: .*'x' is not a number/],
    ["t,slip\n0,1\n0,2\n", /^track\.csv:3: t must increase/],
    ["t,slid,spn\n0,1,2\n", /^track\.csv:1: .*did you mean 'spin'/],
    ["t,slip\n0,1,2\n", /^track\.csv:2: 3 fields where the header has 2/],
    ["", /^track\.csv:1: empty input/],
    ["t,slip\n0,1\n0.1,0.8\n", /fit: /],
    ["t,slip\n", /^track\.csv: the file has no rows$/],
  ]) {
    await page.setInputFiles("#film", file("track.csv", text));
    await page.waitForFunction(() => document.getElementById("film-problem").textContent !== "");
    assert.match(await page.textContent("#film-problem"), complaint);
    const { top, bottom } = await page.evaluate(() => document.getElementById("film-problem").getBoundingClientRect());
    assert.ok(top >= 0 && bottom <= 900, `said at ${top}`);
    assert.ok(!(await page.isVisible("#film-report")));
    assert.deepEqual((await state()).ball, before);
    await page.evaluate(() => (document.getElementById("film-problem").textContent = ""));
  }
  await page.selectOption("#ball", "");
  await page.setInputFiles("#film", file("track.csv", "t,slip,spin\n0,1,2\n"));
  await page.waitForFunction(() => document.getElementById("film-problem").textContent !== "");
  assert.match(await page.textContent("#film-problem"), /Choose a real ball above/);
  await close();
});

test("a film of 100 000 pictures is fitted, all of it", async () => {
  await open("#ball=gel");
  const text = filmOf("gel", 100000, 0.5, "0.6", "200");
  await page.setInputFiles("#film", file("long.csv", text));
  await fitted();
  assert.match(await report(), /200000 measured values/);
  await close();
});

test("pictures are of any width, and of the plane, the balls, the patch and the motion in time", async () => {
  await open("#ball=pool&orbits=3,4,0.9,0.9&part=whole&rollingFriction=0.01");
  await page.evaluate(() => globalThis.page.store.move({ fraction: 0.3 }));
  const words = { plane: /time left/, lanes: /spinning, 16\.7 turns\/s/, patch: /friction slows the slide/, panes: /t \(s\)/ };
  for (const [picture, text] of Object.entries(words)) {
    await page.selectOption("#picture", picture);
    const svg = String(await saved("#save-svg"));
    const parsed = await page.evaluate((svg) => {
      const { documentElement: root } = new DOMParser().parseFromString(svg, "image/svg+xml");
      const shapes = [...root.querySelectorAll("path")].flatMap((path) => path.getAttribute("d").match(/M/g)).length;
      return { name: root.nodeName, text: root.textContent, shapes, width: Number(root.getAttribute("width")), height: Number(root.getAttribute("height")) };
    }, svg);
    assert.equal(parsed.name, "svg");
    assert.match(parsed.text, text);
    assert.ok(parsed.shapes > 20 && !/NaN|Infinity|undefined/.test(svg), `${picture}: ${parsed.shapes} shapes`);
    for (const width of [640, 5000]) {
      await page.fill("[name=png-width]", String(width));
      const png = await saved("#save-png");
      assert.deepEqual([png.subarray(1, 4).toString(), png.readUInt32BE(16), png.readUInt32BE(20)], ["PNG", width, Math.round((width * parsed.height) / parsed.width)], picture);
      assert.ok(png.length > 5000, `${png.length} bytes`);
    }
  }
  for (const [width, complaint] of [["99", /100 to 12000/], ["20000", /100 to 12000/], ["wide", /not a finite number/]]) {
    await page.fill("[name=png-width]", width);
    assert.match(await page.textContent("#png-width-error"), complaint);
    assert.equal(await page.getAttribute("[name=png-width]", "aria-invalid"), "true");
  }
  assert.equal((await saved("#save-png")).readUInt32BE(16), 5000, "the last good width");
  await close();
});

test("with rolling friction the ball comes to rest, when and where the program says", async () => {
  await open("#ball=pool&orbits=3,4,0.9,0.9&part=whole");
  assert.doesNotMatch(await page.textContent("#story"), /rests/);
  await page.fill("#ball-fields [name=rollingFriction]", "0.01");
  const words = (await page.textContent("#roll-command")).split(" ");
  assert.deepEqual(words.slice(-4), ["--rolling-friction", "0.01", "--law", "exact"]);
  const { rest } = JSON.parse(execFileSync(program, [...words.slice(1), "--format", "json"], { encoding: "utf8" }));
  const { end, factor, own } = await page.evaluate(() => ({ end: globalThis.page.store.end, factor: globalThis.page.store.timeFactor, own: globalThis.page.store.ride.rest }));
  for (const key of ["t", "x", "y"]) assertClose(own[key], rest[key], 1e-10, key);
  assert.ok(end * factor >= rest.t);
  assert.ok((await page.textContent("#story")).includes(`It rests after ${Number(rest.t.toPrecision(3))} s, ${Number(Math.hypot(rest.x, rest.y).toPrecision(3))} m from its start.`));
  const at = (share) => page.evaluate((share) => globalThis.page.hero.bodies[1].at(share), share);
  const [last, before, rolling] = await Promise.all([at(1), at(rest.t / (end * factor)), at(0.5)]);
  // It rests once it turns no more and slides below 0.1 mm/s: while it still spins it creeps on by some micrometres.
  assertClose(Math.hypot(last.x, last.y), Math.hypot(rest.x, rest.y), 1e-6, "where it rests");
  assertClose(Math.hypot(before.x, before.y), Math.hypot(rest.x, rest.y), 1e-4, "when it rests");
  assert.ok(Math.hypot(rolling.x, rolling.y) < 0.9 * Math.hypot(rest.x, rest.y));
  await page.fill("#ball-fields [name=rollingFriction]", "-1");
  assert.match(await page.textContent("#rollingFriction-error"), /from 0 to 1000/);
  await page.click("#copy-link");
  await page.waitForFunction(() => location.hash.includes("rollingFriction=0.01"));
  await page.selectOption("#ball", "puck");
  assert.ok(!(await page.isVisible("#ball-fields [name=rollingFriction]")));
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

/** The boxes of an MP4 that say how long it is, and how large. */
function readFilm(film) {
  const at = (name) => film.indexOf(name) + 4;
  const [size, times, head] = [at("stsz"), at("stts"), at("mdhd")];
  const track = at("tkhd");
  return {
    kind: film.subarray(4, 8).toString(), pictures: film.readUInt32BE(size + 8), runs: film.readUInt32BE(times + 4),
    rate: film.readUInt32BE(head + 12) / film.readUInt32BE(times + 12), seconds: film.readUInt32BE(head + 16) / film.readUInt32BE(head + 12),
    sides: [76, 80].map((offset) => film.readUInt32BE(track + offset) / 65536),
  };
}

test("a film has 60 pictures of 1280 x 720 a second on a machine of any speed, and plays", async () => {
  await open("#ball=puck&orbits=2.286,0.5;4.53,0.5&chosen=1&line=1");
  const client = await page.context().newCDPSession(page);
  const seconds = await page.evaluate(() => globalThis.page.player.seconds) + 2;
  const films = [];
  for (const rate of [1, 6]) {
    await client.send("Emulation.setCPUThrottlingRate", { rate });
    const film = await saved("#save-film");
    assert.deepEqual(readFilm(film), { kind: "ftyp", pictures: 60 * seconds, runs: 1, rate: 60, seconds, sides: [1280, 720] });
    films.push(film);
  }
  assert.match(await page.textContent("#copied"), /The film is saved/);
  await client.send("Emulation.setCPUThrottlingRate", { rate: 1 });
  assert.equal((await state()).fraction, 1, "the page stays where it was");
  // Its head says what is to be seen, and where it comes from; the puck moves below.
  const seen = await page.evaluate(async (text) => {
    const video = document.createElement("video");
    video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], { type: "video/mp4" }));
    const once = (name) => new Promise((done, failed) => {
      video.addEventListener(name, done, { once: true });
      video.addEventListener("error", () => failed(new Error(video.error.message)), { once: true });
    });
    await Promise.all([once("canplay"), (video.muted = true)]);
    const canvas = Object.assign(document.createElement("canvas"), { width: video.videoWidth, height: video.videoHeight });
    const context = canvas.getContext("2d", { willReadFrequently: true });
    const pictures = [];
    for (const time of [0.01, video.duration / 3, video.duration - 0.1]) {
      video.currentTime = time;
      await once("seeked");
      context.drawImage(video, 0, 0);
      const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
      const inked = (from, to) => Array.from({ length: canvas.width * (to - from) }, (_, i) => 4 * (canvas.width * from + i)).filter((i) => Math.abs(data[i] - data[0]) > 60);
      const bodies = inked(130, canvas.height - 60).map((i) => (i / 4) % canvas.width);
      pictures.push({ head: inked(10, 70).length, foot: inked(76, 110).length, furthest: Math.max(...bodies), url: canvas.toDataURL() });
    }
    return { duration: video.duration, sides: [video.videoWidth, video.videoHeight], pictures };
  }, films[0].toString("base64"));
  assert.deepEqual([seen.duration, seen.sides], [seconds, [1280, 720]]);
  if (process.env.CONTENSOU_PICTURES) seen.pictures.forEach(({ url }, i) => writeFileSync(join(process.env.CONTENSOU_PICTURES, `film-${i}.png`), Buffer.from(url.split(",")[1], "base64")));
  const [first, , last] = seen.pictures;
  for (const { head, foot } of seen.pictures) assert.ok(head > 800 && foot > 800, `${head} and ${foot} pixels of words`);
  assert.notEqual(first.head, last.head, "the headline turns at the end");
  await close();
});

test("a film for phones is square, lasts 6 s, and ends on the question before a puck stops", async () => {
  await open("#lab=0", { reducedMotion: "no-preference" });
  await page.click("#answers button");
  await page.evaluate(() => globalThis.page.store.move({ fraction: 1 }));
  const drawings = await page.evaluate(() => {
    const { hero, hero: { drawBalls } } = globalThis.page;
    globalThis.seen = [];
    hero.drawBalls = (...all) => {
      globalThis.seen.push([hero.store.state.fraction, hero.said.headline, hero.lanesNow().map(({ title }) => title).join()]);
      drawBalls.call(hero, ...all);
    };
    return hero.bodies[0].share;
  });
  const film = readFilm(await saved("#film-line"));
  assert.deepEqual([film.sides, film.seconds, film.pictures, film.rate], [[1080, 1080], 6, 360, 60]);
  const seen = (await page.evaluate(() => globalThis.seen)).slice(-360);
  assert.ok(seen.every(([fraction, headline, titles]) => fraction < 0.41 * drawings && /\?$/.test(headline) && !/stopped|\d m/.test(titles)), JSON.stringify(seen.at(-1)));
  assert.ok(seen[200][0] > seen[100][0] && seen.at(-1)[0] === seen[250][0]);
  assert.match(await page.textContent("#headline"), /^You are right/, "the page stays where it was");
  await close();
});

/** Replaces the browser's encoder by one that hands each picture out after its next, as H.264 of Firefox, or loses some. */
const strangeEncoder = (loses) => `{
  const Real = VideoEncoder;
  let held, count = 0;
  globalThis.VideoEncoder = class extends Real {
    constructor({ output, error }) {
      super({ error, output: (...picture) => {
        if (${loses}) return void (++count % 7 && output(...picture));
        if (!held && picture[0].type === "delta") return void (held = picture);
        output(...picture);
        if (held) output(...held);
        held = undefined;
      } });
      this.rest = () => held && output(...held);
    }
    async flush() {
      await super.flush();
      this.rest();
    }
  };
}`;

test("a film has all pictures if the encoder hands them out in another order, and is refused if it loses some", async () => {
  await open("#ball=puck&orbits=2.286,0.5&at=1", {}, true, strangeEncoder(false));
  const seconds = await page.evaluate(() => globalThis.page.player.seconds) + 2;
  const film = await saved("#save-film");
  const { kind, pictures, runs, rate } = readFilm(film);
  assert.deepEqual({ kind, pictures, runs, rate }, { kind: "ftyp", pictures: 60 * seconds, runs: 1, rate: 60 });
  // The offset of each picture from the time of its decoding: each time from `late` on is seen once.
  const table = film.indexOf("ctts") + 8;
  const offsets = Array.from({ length: film.readUInt32BE(table) }, (_, i) => [4, 8].map((at) => film.readUInt32BE(table + 8 * i + at)))
    .flatMap(([count, offset]) => Array(count).fill(offset));
  assert.deepEqual(offsets.map((offset, i) => i + offset).sort((a, b) => a - b), offsets.map((_, i) => i + 1));
  await close();
  await open("#ball=puck&orbits=2.286,0.5&at=1", {}, true, strangeEncoder(true));
  await page.click("#save-film");
  await page.waitForFunction(() => /could not be done: the browser's encoder lost pictures: \d+ of \d+ came/.test(document.getElementById("copied").textContent));
  await close();
});

test("a film of a motion that is changed meanwhile is given up, and so is one of no motion", async () => {
  await open("#ball=puck&orbits=2.286,0.5");
  await page.click("#save-film");
  await page.fill("#ball-fields [name=friction]", "0.2");
  await page.waitForFunction(() => /could not be done: the motion was changed/.test(document.getElementById("copied").textContent));
  await page.click("#orbits .remove");
  await page.click("#save-film");
  await page.waitForFunction(() => /could not be done: there is no motion/.test(document.getElementById("copied").textContent));
  await close();
});
