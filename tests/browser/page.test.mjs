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

async function open(fragment = "", options = {}, orbits = true) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, ...options });
  page = await context.newPage();
  complaints = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks for ${request.url()}`));
  await page.goto(address + fragment);
  await (orbits ? page.waitForSelector("#orbits li") : page.waitForFunction(() => globalThis.page?.planeScene));
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

/** Clicks where u and v are in a panel of the view. */
async function clickPlane(u, v, panel = 0) {
  const { x, y } = await page.evaluate(([u, v, panel]) => {
    const { frames, planeScene: { view, context } } = globalThis.page;
    const [x, y] = view.panels[panel].place({ u, v, lnV: Math.log(v), lnK: Math.log(v / (context.mu * Math.abs(u))) }, context);
    const box = document.getElementById("plane").getBoundingClientRect();
    return { x: box.left + frames[panel].px(x), y: box.top + frames[panel].py(y) };
  }, [u, v, panel]);
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

const help = execFileSync(program, ["help", "views"], { encoding: "utf8" });
const views = Array.from(help.matchAll(/^ {2}([a-z]+) /gm), ([, name]) => name);

/** Texts that are equal but for their numbers, and numbers that are equal but for the last digits of two C libraries. */
function assertSameText(text, wanted, what) {
  const number = /-?\d+(\.\d+)?(e[-+]?\d+)?/g;
  assert.equal(text.replace(number, "0"), wanted.replace(number, "0"), what);
  const [numbers, wantedNumbers] = [text, wanted].map((all) => all.match(number).map(Number));
  const largest = Math.max(...wantedNumbers.filter((value) => Math.abs(value) < 1e3).map(Math.abs));
  numbers.forEach((value, i) => {
    const error = Math.abs(value - wantedNumbers[i]);
    assert.ok(error <= 1e-9 * (largest + Math.abs(value)), `${what}: number ${i} is ${value}, not ${wantedNumbers[i]}`);
  });
}

/** Runs the page's command line, and compares what the program draws with what the page shows. */
async function assertSamePicture(what) {
  const words = (await page.textContent("#command")).split(" ");
  assert.deepEqual(words.splice(0, 2), ["contensou", "portrait"]);
  const written = (ending) => {
    const name = join(folder, `portrait.${ending}`);
    execFileSync(program, ["portrait", ...words.map((word) => (word === "portrait.svg" ? name : word))]);
    return readFileSync(name, "utf8");
  };
  for (const ending of ["json", "tex"]) {
    const text = await page.evaluate((ending) => globalThis.page.library.portraitFile(globalThis.page.request, ending).text, ending);
    assertSameText(text, written(ending), `${what}, ${words.join(" ")}: ${ending}`);
  }
  // Of what the page itself draws: the orbits of its list, and those that fill a plane, begin where the program's do.
  const portrait = JSON.parse(written("json"));
  const { state, own, drawn, mu, exponent, isochrones } = await page.evaluate(() => {
    const { state, planeScene: { own, figure, context } } = globalThis.page;
    return {
      state, mu: context.mu, exponent: context.exponent,
      own: own.map(({ orbit, chosen }) => ({ chosen, u: [...orbit.u], v: [...orbit.v] })),
      drawn: figure.panels[0].lines.flatMap(({ lines }) => lines.map((line) => [line[0], line[1]])),
      isochrones: figure.panels[0].lines.some(({ legend }) => legend.startsWith("time left")),
    };
  });
  assert.equal(portrait.view, state.view);
  const axes = state.orbits.filter(({ u, v }, index) => index !== state.chosen && (u === 0 || v === 0)).length;
  assert.equal(own.length, state.orbits.length - axes, `${what}: orbits of the list`);
  const listed = [...(portrait.through ?? []), ...(portrait.highlight ? [portrait.highlight] : [])];
  assert.equal(listed.length, own.length, `${what}: --through and the start`);
  const near = (a, b) => Math.abs(a - b) <= 1e-9 * (1 + Math.abs(b));
  listed.forEach((orbit, i) => {
    assert.equal(orbit.u.length, own[i].u.length, `${what}: points of orbit ${i}`);
    orbit.u.forEach((u, j) => assert.ok(near(own[i].u[j], u) && near(own[i].v[j], orbit.v[j]), `${what}: point ${j} of orbit ${i}`));
  });
  const speeds = { uv: 1, pair: 1, patch: mu }[state.view];
  if (!speeds) return;
  assert.equal(isochrones, portrait.isochrones.length > 0, `${what}: isochrones`);
  const height = (lnX) => (exponent === 1 ? portrait.window[1] * Math.exp(lnX) : (Math.exp(lnX) + Math.exp(exponent * lnX)) / 2);
  for (const orbit of [...portrait.orbits, ...(portrait.against?.orbits ?? [])]) {
    assert.ok(drawn.some(([x, y]) => near(x, speeds * orbit.u[0]) && near(y, height(orbit.ln_v[0] - Math.log(portrait.window[1])))), `${what}: an orbit from ${orbit.u[0]}, ${orbit.v[0]}`);
  }
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

/**
 * The highlighted line of each panel in a gnuplot script of the program: its points, in the panel's coordinates. The first
 * plot of a script is its legend.
 */
function highlightedLines(script) {
  return script.split(/^plot (?='-')/m).slice(2).map((panel) => {
    const [entries, ...blocks] = panel.split(/(?<!\\)\n/);
    const data = blocks.join("\n").split(/^e$/m);
    const line = entries.split("\n").findIndex((entry) => /with lines lc rgb '#c2185b' lw 2.6/.test(entry));
    return line < 0 ? [] : data[line].trim().split(/\n+/).map((row) => row.trim().split(/\s+/).map(Number));
  });
}

/** How far points are from a chain of others at most, in shares of its extent. */
function farthestFrom(chain, points) {
  const [low, high] = [Math.min, Math.max].map((most) => [0, 1].map((axis) => most(...chain.map((point) => point[axis]))));
  const scaled = (all) => all.map((point) => point.map((value, axis) => (value - low[axis]) / (high[axis] - low[axis] || 1)));
  const ends = scaled(chain);
  return Math.max(...scaled(points).map(([x, y]) => Math.min(...ends.slice(1).map(([bx, by], i) => {
    const [ax, ay] = ends[i];
    const [dx, dy] = [bx - ax, by - ay];
    const share = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
    return Math.hypot(ax + share * dx - x, ay + share * dy - y);
  }))));
}

test("the page places its own orbits where the program draws them", async () => {
  for (const u0 of [0.8, -0.8]) {
    await open(`#law=exact&mu=0.3&window=1,5&orbits=${u0},3.5`);
    for (const view of views) {
      await page.click(`#views [data-name=${view}]`);
      const words = (await page.textContent("#command")).split(" ").slice(1);
      const name = join(folder, "portrait.gp");
      execFileSync(program, words.map((word) => (word === "portrait.svg" ? name : word)));
      const drawn = highlightedLines(readFileSync(name, "utf8"));
      const own = await page.evaluate(() => {
        const { view, context, own } = globalThis.page.planeScene;
        const { orbit } = own.find(({ chosen }) => chosen);
        const row = (i) => ({ u: orbit.u[i], v: orbit.v[i], lnV: orbit.lnV[i], lnK: orbit.lnK[i], left: orbit.left[i], start: null });
        const rows = Array.from(orbit.u, (_, i) => ({ ...row(i), start: row(0) }));
        return view.panels.map((panel) => rows.map((state) => panel.place(state, context)).filter((point) => point.every(Number.isFinite)));
      });
      assert.equal(drawn.length, own.length, `panels of ${view}`);
      drawn.forEach((line, panel) => {
        if (u0 > 0) assert.ok(line.length > 1, `panel ${panel} of ${view}: ${line.length} points`);
        const error = line.length === 0 ? 0 : farthestFrom(own[panel], line);
        assert.ok(error < 1e-3, `panel ${panel} of ${view}, u0 = ${u0}: ${error}`);
      });
    }
    await close();
  }
});

test("all views are drawn, and a click in each starts the orbit that it points at", async () => {
  await open("#law=exact&mu=0.3&window=1,5&orbits=0.8,3.5");
  const pictures = new Set();
  let orbits = 1;
  for (const view of views) {
    await page.click(`#views [data-name=${view}]`);
    assert.equal(await page.getAttribute(`#views [data-name=${view}]`, "aria-checked"), "true");
    const picture = await page.evaluate(() => document.getElementById("plane").toDataURL());
    pictures.add(picture);
    const panels = await page.evaluate(() => globalThis.page.planeScene.view.panels.map((panel) => Boolean(panel.state)));
    assert.equal(panels.length, await page.evaluate(() => globalThis.page.frames.length));
    for (const panel of panels.keys()) {
      if (!panels[panel]) continue;
      await clickPlane(0.52, 0.21, panel);
      orbits += 1;
      const { u, v } = (await state()).orbits.at(-1);
      assertClose(u, 0.52, 0.06, `u in panel ${panel} of ${view}`);
      assertClose(v, 0.21, 0.06, `v in panel ${panel} of ${view}`);
    }
  }
  assert.equal(pictures.size, 8);
  assert.equal((await stopTimes()).length, orbits);
  assert.equal(orbits, 1 + 10);
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
    const { frames: [frame], planeScene: { view, context } } = globalThis.page;
    const corner = document.getElementById("plane").getBoundingClientRect();
    const numbers = frame.at(x - corner.left, y - corner.top);
    return view.panels[0].state(numbers.x, numbers.y, context);
  }, end);
  assertClose(isochrone, programStop("--mu", 0.3, "--u0", at.u, "--v0", at.v, "--law", "pade"), 1e-12, "its time");
  // Each of its points has that stop time.
  const points = await page.evaluate(() => {
    const { u, v } = globalThis.page.planeScene.isochrone;
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

test("a link that the library rejects opens the page all the same, and says why", async () => {
  for (const fragment of ["#law=exact&mu=0.3&window=1e200,1&orbits=0.8,3.5", "#mu=0.3&orbits=1e200,1"]) {
    await open(fragment);
    assert.equal((await state()).mu, 0.3);
    assert.match(await page.textContent("#mu-error"), /window must be between/);
    assert.equal((await stopTimes()).length, 1);
    await page.fill("#mu", "0.5");
    assert.equal((await state()).mu, 0.5);
    // The same for a link that is opened in the page.
    await page.waitForFunction(() => /mu=0.5/.test(location.hash));
    await page.evaluate((fragment) => (location.hash = fragment), fragment);
    await page.waitForFunction(() => document.getElementById("mu-error").textContent !== "");
    assert.equal((await state()).mu, 0.5);
    await close();
  }
});

test("where sliding has underflowed inside the window, its orbits are drawn all the same", async () => {
  await open("#law=exact&mu=0.01&window=0.1,1&orbits=0.8,3.5;0.05,0.5&chosen=1");
  assert.equal((await state()).mu, 0.01);
  assert.equal(await page.textContent("#mu-error"), "");
  await assertSamePicture("a small window");
  await close();
});

test("beside the plane a click starts nothing", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  const { left, right, top, bottom } = await page.evaluate(() => {
    const [frame] = globalThis.page.frames;
    const box = document.getElementById("plane").getBoundingClientRect();
    return { left: box.left + 5, right: box.left + frame.left + frame.width / 2, top: box.top + 5, bottom: box.bottom - 5 };
  });
  for (const [x, y] of [[right, top], [right, bottom], [left, (top + bottom) / 2]]) {
    await page.mouse.click(x, y);
    assert.equal((await state()).orbits.length, 1);
  }
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

  assert.match(await page.textContent("#path-facts"), /Rolls after/);
  await assertSamePicture("the pool ball");
  await close();
});

test("the command line draws the same picture", async () => {
  const three = "orbits=0.8,3.5;-0.5,1;0.2,0.05&chosen=1";
  for (const view of views) {
    await open(`#law=exact&mu=0.3&view=${view}&${three}`);
    await assertSamePicture(view);
    await close();
  }
  const states = [
    "#ball=pool&law=exact",
    "#ball=pool&law=pade&view=pair&radius=0.03&patch=0.001&orbits=0.5,1;-0.2,0.3;0.4,0.01",
    "#ball=pool&law=exact&view=time&orbits=",
    `#law=pade&mu=0.05&window=1,5&${three}`,
    `#law=exact&mu=0.02&view=pair&against=pade&${three}`,
    "#law=uniform&body=disc&view=disc&orbits=0.8,0.7;0.3,0.9&against=ring",
    "#law=pressure:2.5&against=pressure:-0.25&mu=0.4&field=motion&orbits=0.8,2;0,1;0.3,0",
    `#law=potential8&mu=0.3&field=regularised&isochrones=0&theme=dark&${three}`,
    "#law=exact&body=1,6&mu=2&view=blowup&orbits=0.8,0.7;0.3,0.9",
    "#law=exact&mu=0.3&window=0.25,0.5&orbits=0.8,3.5;-0.5,1;0.2,0.05&chosen=2",  // some start outside
    "#law=pade&mu=0.3&orbits=0,2;0.5,1",  // the chosen one is an axis
    "#law=pade&mu=0.3&orbits=",
  ];
  for (const fragment of states) {
    const query = new URLSearchParams(fragment.slice(1));
    await open(fragment, {}, query.get("orbits") !== "");
    assert.equal((await state()).law, query.get("law"));
    await assertSamePicture(fragment);
    await close();
  }
});

test("another law is drawn against the first, and leaves again", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  const legend = () => page.evaluate(() => globalThis.page.planeScene.figure.panels[0].lines.map((layer) => layer.legend).filter(Boolean));
  assert.ok(!(await legend()).includes("law pade"));
  await page.selectOption("#against", "pade");
  assert.ok((await legend()).includes("law pade") && (await legend()).includes("law exact"));
  assert.match(await page.getAttribute("#plane", "aria-label"), /exact against pade/);
  assert.match(await page.textContent("#command"), / --against pade /);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-svg")]);
  assert.match(readFileSync(await download.path(), "utf8"), />law pade</);
  await page.click("#copy-link");
  assert.match(page.url(), /against=pade/);
  assert.ok(await page.evaluate(() => document.querySelector("#against option[value=exact]").disabled));
  await page.selectOption("#law", "pade");
  assert.doesNotMatch(await page.textContent("#command"), /against/);
  await page.selectOption("#law", "exact");
  assert.match(await page.textContent("#command"), / --against pade /);
  await page.selectOption("#against", "");
  assert.ok(!(await legend()).includes("law pade"));
  assert.doesNotMatch(await page.textContent("#command"), /against/);
  await close();
});

test("fields and isochrones are switched where a view draws them", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  const legend = () => page.evaluate(() => globalThis.page.planeScene.figure.panels[0].lines.map((layer) => layer.legend).join(";"));
  assert.match(await legend(), /time left/);
  await page.uncheck("#isochrones");
  assert.doesNotMatch(await legend(), /time left/);
  assert.match(await page.textContent("#command"), / --isochrones 0 /);
  await page.selectOption("#field", "regularised");
  assert.match(await legend(), /direction of the regularised motion \(2\.7\)/);
  await page.click("#copy-link");
  assert.match(page.url(), /field=regularised&isochrones=0/);
  await page.click("#views [data-name=disc]");
  assert.ok((await page.isDisabled("#field")) && (await page.isDisabled("#isochrones")));
  await page.click("#views [data-name=pair]");
  assert.match(await legend(), /direction of the regularised motion \(2\.7\)/);
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
  for (const [text, complaint] of [["-1", /ring/], ["26", /≤ 25/], ["-2", /−1 < P/], ["x", /'x' is not a finite number/], ["", /needed/]]) {
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

test("a click in the view of time is a moment", async () => {
  await open("#law=exact&mu=0.3&view=time&orbits=0.8,3.5");
  const [x, y] = await page.evaluate(() => {
    const frame = globalThis.page.frames[1];
    const box = document.getElementById("plane").getBoundingClientRect();
    return [box.left + frame.px(0.25), box.top + frame.py(0.5)];
  });
  await page.mouse.click(x, y);
  assert.ok(Math.abs((await state()).share - 0.25) < 0.01);
  assert.equal((await stopTimes()).length, 1);
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

test("a new size of the window is a new drawing, sharp", async () => {
  await open();
  for (const width of [1900, 700, 1280]) {
    await page.setViewportSize({ width, height: 900 });
    await page.waitForFunction(() => {
      const canvas = document.getElementById("plane");
      return canvas.width === Math.round(canvas.clientWidth * devicePixelRatio) && globalThis.page.frames[0].width < canvas.clientWidth;
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
    for (const view of views) {
      await page.click(`#views [data-name=${view}]`);
      assert.ok(await page.evaluate(() => globalThis.page.planeScene.figure.panels.every((panel) =>
        panel.lines.reduce((sum, { lines }) => sum + lines.length, 0) >= 5)), view);
    }
    const times = await stopTimes();
    (await state()).orbits.forEach(({ u, v }, i) => {
      assertClose(times[i], programStop("--u0", u, "--v0", v, ...words), 1e-12, `${words.join(" ")}, u0 = ${u}, v0 = ${v}`);
    });
    await close();
  }
});
