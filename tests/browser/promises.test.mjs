// What the page keeps to whatever a reader does, each with the steps that once led elsewhere.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { clickPlane, close, drawn, file, folder, open, page, pass, pixelOf, saved, state } from "./browser.mjs";

const said = async () => `${await page.textContent("#headline")} ${await page.textContent("#story")}`;

test("a click anywhere in the plane is answered in words: no NaN, no power of ten, and what rolls is told so", async () => {
  for (const fragment of ["#ball=gel&orbits=9,0.5", "#ball=pool&orbits=2.8575,1", "#ball=steel&orbits=0,0.5", "", "#ball=curling-stone", "#mu=0.3&orbits=0.8,3.5"]) {
    await open(fragment);
    const { answers, count } = await page.evaluate(() => {
      const { plane, plane: { frames: [frame] }, store, library } = globalThis.page;
      const [answers, all] = [[], 13];
      store.held = true;  // what lies behind the orbits, which nobody is asked about, stays
      const opened = store.state;
      let count = 0;
      for (let i = 0; i < all; ++i) for (let j = 0; j < all; ++j) {
        const at = [frame.left + ((i + 0.5) / all) * frame.width, frame.top + ((j + 0.5) / all) * frame.height];
        if (!plane.pointed(...at)) continue;
        count += 1;
        plane.choose(...at, "key");
        const start = store.orbit;
        const words = `${document.getElementById("headline").textContent} ${document.getElementById("story").textContent} ` +
          `${document.getElementById("told").textContent} ${globalThis.page.hero.lanesNow().map(({ title }) => title).join(" ")}`;
        if (/NaN|∞|undefined|·10/.test(words)) answers.push([start, words]);
        if (store.state.ball && library.rollingSlip > start.v && !(start.u === 0 ? /already rolls|at rest/ : /already rolls|in place/).test(words)) answers.push([start, words]);
        store.state = opened;
      }
      return { answers, count };
    });
    assert.ok(count > 150, `${count} clicks`);
    assert.deepEqual(answers, [], fragment);
    await close();
  }
});

test("the log view has one scale, and all starts in it", async () => {
  await open("#mu=0.3&view=log&orbits=0.8,3.5;0.4,1.75;0.2,0.875");
  const { places, box } = await page.evaluate(() => {
    const { plane: { frames: [frame] }, library, state } = globalThis.page;
    return {
      places: state.orbits.map(({ u, v }) => frame.pixel(library.plane.place(u, v))),
      box: [frame.left, frame.top, frame.left + frame.width, frame.top + frame.height],
    };
  });
  for (const [x, y] of places) assert.ok(x > box[0] && x < box[2] && y > box[1] && y < box[3], `${x}, ${y} in ${box}`);
  for (const i of [1, 2]) {
    const [dx, dy] = [0, 1].map((axis) => places[i][axis] - places[i - 1][axis]);
    assert.ok(dx < -3 && Math.abs(dx + dy) < 0.01 * Math.abs(dx), `${dx}, ${dy}`);
  }
  await close();
});

test("the velocity of the centre is its orbit's: what is done to one orbit leaves the others", async () => {
  await open("#ball=gel&orbits=9,0.5");
  const before = (await state()).orbits[0];
  await clickPlane(3, 0.3);
  let { orbits } = await state();
  assert.deepEqual([orbits[1].along, orbits[1].across], [orbits[1].v, 0], "a click starts without rolling");
  await page.mouse.move(...await pixelOf(orbits[1].u, orbits[1].v));
  await page.mouse.down();
  await page.mouse.move(...await pixelOf(3, 0.15), { steps: 4 });
  await page.mouse.up();
  ({ orbits } = await state());
  assert.ok(orbits[1].v < 0.2);
  assert.deepEqual(orbits[0], before);
  await page.fill("#ball-fields [name=across]", "0.25");
  await page.click("#orbits li:nth-child(1) button");
  assert.deepEqual((await state()).orbits[0], before);
  assert.equal(await page.inputValue("#ball-fields [name=across]"), "0");
  assert.match(await said(), /leave at 0\.5 m\/s/);
  await close();
  await open("#ball=pool&orbits=5.7,2");
  assert.match(await said(), /leave at 2 m\/s/, "a link with u and v alone is of a ball that does not turn forward");
  await close();
});

test("the ball without spin is grey, whichever orbit is chosen", async () => {
  await open();
  await clickPlane(-1, 0.3);
  const colours = () => page.evaluate(() => globalThis.page.hero.lanesNow().map(({ colour }) => colour));
  const grey = await page.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue("--soft").trim());
  for (const i of [1, 2]) {
    await page.click(`#orbits li:nth-child(${i}) button`);
    const [plain, own] = await colours();
    assert.equal(plain, grey);
    assert.notEqual(own, grey);
  }
  await close();
});

test("the text of the tour is that of what is shown, and in the link", async () => {
  await open("", { stopped: true });
  const shown = () => page.evaluate(() => Math.round(document.getElementById("steps").scrollLeft / document.getElementById("steps").clientWidth));
  for (let step = 1; step <= 2; ++step) {
    await page.click("#step-on");
    await drawn();
    await pass(500);
    assert.match(page.url(), new RegExp(`step=${step}`));
  }
  const link = page.url();
  await page.goBack();
  await page.waitForFunction(() => globalThis.page.state.step === 1);
  assert.equal(await shown(), 1);
  await page.locator("#presets a", { hasText: "Gel" }).click();
  assert.equal((await state()).step, 0);
  assert.equal(await shown(), 0);
  await drawn();
  await pass(500);
  assert.equal((await state()).ball.name, "gel", "the text that comes back changes nothing");
  await close();
  await open(link.slice(link.indexOf("#")));
  assert.equal(await shown(), 2);
  assert.ok(!(await page.isDisabled("#step-back")));
  await close();
});

test("at each step of the tour the text says what the headline and the numbers say", async () => {
  const seen = () => page.evaluate(() => {
    const { store: { ride: { own, plain }, motions, state: { step, orbits } }, library: { plane } } = globalThis.page;
    const { textContent: text } = document.querySelectorAll("#steps li p")[step];
    const motion = plane.motion(orbits[0].u, orbits[0].v);
    const lost = motion.lnV.findIndex((lnV) => lnV < -300 * Math.LN10);
    return { text, headline: document.getElementById("headline").textContent, story: document.getElementById("story").textContent, times: own.path / plain.path,
      stop: own.stop, end: own.end, orbits, stops: motions.map(({ stop }) => stop), spinWhereLost: motion.u[lost] / orbits[0].u };
  });
  const wanted = [
    [/little is left of the friction to stop what slides/, /^Spin a puck, and it slides 4 times as far$/, ({ times }) => times > 3],
    [/Each motion is one curve/, /^Spin a ball, and it slides 19 times as far$/, ({ orbits }) => orbits.length === 4],
    [/twice as long until the stop/, /^Spin makes this puck slide 36 % farther$/, ({ stops }) => Math.abs(stops[0] / stops[1] - 2) < 1e-12],
    [/to the left or to the right: the ball slides equally far/, /^Spin makes this ball slide 11 % farther$/, ({ stops }) => stops[0] === stops[1]],
    [/a little spin hardly matters: this pool ball slides (.*) farther than the textbook says\. It still spins long after it has begun to roll/, /^This ball soon rolls, and spins on$/,
      ({ times, stop, end, story, text }) => times < 1.05 && stop > 5 * end && story.includes(`${/slides (.*) farther/.exec(text)[1]} farther`)],
    [/below 10⁻³⁰⁰, long before the spin is gone/, /^This ball soon rolls, and spins on$/, ({ spinWhereLost }) => spinWhereLost > 0.3],
  ];
  await open();
  for (const [step, [text, headline, holds]] of wanted.entries()) {
    if (step > 0) await page.click("#step-on");
    await page.waitForFunction((step) => globalThis.page.state.step === step, step);
    const there = await seen();
    assert.match(there.text, text);
    assert.match(there.headline, headline);
    assert.ok(holds(there), JSON.stringify(there));
  }
  await close();
});

test("a link to rest says so, and what it rejects of the plane leaves the motion", async () => {
  for (const [fragment, thing] of [["#ball=puck&orbits=0,0", "puck"], ["#ball=pool&orbits=0,0&part=whole", "ball"], ["#mu=0.3&orbits=0,0", "ball"], ["#ball=gel&view=time&orbits=0,0;9,0.5&at=1", "ball"],
    ["#body=disc&law=uniform&orbits=0,0", "puck"], ["#ball=pool&orbits=0,0&slope=1", null], ["#ball=pool&orbits=0,0&rollingFriction=0.01", null]]) {
    await open(fragment);
    if (thing) assert.equal(await page.textContent("#headline"), `A ${thing} at rest`, fragment);
    assert.notEqual(await page.textContent("#headline"), "", fragment);
    assert.doesNotMatch(await page.locator("#app").innerText(), /NaN|undefined|Infinity/, fragment);
    await page.click("#play");
    await page.click("#step-on");
    await close();
  }
  await open("#ball=puck&orbits=2.286,0.5&window=1e200,1&view=pair");
  assert.match(await page.textContent("#problem"), /window must be between/);
  const { ball, orbits: [{ u, v }], window } = await state();
  assert.deepEqual([ball.name, u, v, window], ["puck", 2.286, 0.5, null]);
  await close();
});

test("what no code of ours throws is said to be our fault, with the link that was asked for", async () => {
  await open("#ball=gel");
  const fault = await page.evaluate(() => {
    try {
      globalThis.page.library.plane.at(99, 0, 0);  // no such panel
      return null;
    } catch ({ name, message }) {
      return { name, message };
    }
  });
  assert.deepEqual(fault, { name: "Fault", message: "a fault of contensou, not of the input; please report it with what was asked: " });
  await page.evaluate(({ name, message }) => {
    const { plane } = globalThis.page.library;
    plane.portrait = () => {
      delete plane.portrait;
      throw Object.assign(new Error(message), { name });
    };
  }, fault);
  const before = await page.textContent("#headline");
  await page.fill("#ball-fields [name=friction]", "0.123");
  const words = await page.locator("body").innerText();
  assert.match(words, /a fault of contensou, not of the input; please report it with what was asked: #.*friction=0\.123/);
  assert.equal(await page.textContent("#headline"), before);
  await close();
});

test("every preset says what is to be seen", async () => {
  await open();
  const wanted = { "Puck": /4 times/, "No spin": /Without spin/, "Gel ball": /19 times/, "Pool ball": /1\.9 times/, "Massé": /curves by 60°/, "Bowling hook": /curves by 6/,
    "Floor polisher": /10 times/, "Curling stone": /end at one instant/ };
  for (const link of await page.$$("#presets a")) {
    await link.click();
    assert.match(await page.textContent("#headline"), wanted[await link.textContent()]);
  }
  await close();
});

test("what fails is said beside the buttons, and no promise is left unhandled", async () => {
  const failing = () => {
    HTMLCanvasElement.prototype.toBlob = (done) => done(null);
    globalThis.MediaRecorder = class {
      static isTypeSupported = () => globalThis.takesFilms;
      constructor() {
        throw new DOMException("no such film", "NotSupportedError");
      }
    };
    Object.defineProperty(navigator, "clipboard", { value: { writeText: () => Promise.reject(new Error("denied")) } });
    globalThis.unhandled = [];
    addEventListener("unhandledrejection", ({ reason }) => globalThis.unhandled.push(String(reason)));
  };
  await open("", {}, true, failing);
  for (const [takes, button, words] of [[false, "#save-film", /takes no films/], [true, "#save-film", /no such film/], [true, "#save-png", /no canvas of \d+ × \d+ pixels/]]) {
    await page.evaluate((takes) => (globalThis.takesFilms = takes), takes);
    await page.click(button);
    await page.waitForFunction((words) => new RegExp(words).test(document.getElementById("copied").textContent), words.source);
  }
  await page.click("#copy-embed");
  await page.waitForFunction(() => /<iframe src="file:.*names the file on this computer/.test(document.getElementById("copied").textContent));
  await page.click("#copy-link");
  await page.waitForFunction(() => !/iframe/.test(document.getElementById("copied").textContent));
  await drawn();
  assert.deepEqual(await page.evaluate(() => globalThis.unhandled), []);
  await close();
});

test("where a host forbids pictures from data, a PNG is made all the same; where it forbids scripts from text, the page says so", async () => {
  const html = readFileSync(file, "utf8");
  const guarded = async (name, policy) => {
    const path = join(folder, name);
    writeFileSync(path, html.replace("<head>", `<head><meta http-equiv="Content-Security-Policy" content="${policy}">`));
    await page.goto(pathToFileURL(path).href + "#lab=1");
  };
  await open();
  await guarded("pictures.html", "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'");
  await page.waitForSelector("#orbits li");
  const png = await saved("#save-png");
  assert.deepEqual([png.subarray(1, 4).toString(), png.length > 5000], ["PNG", true]);
  await guarded("trusted.html", "require-trusted-types-for 'script'");
  await page.locator("#failure").filter({ visible: true }).waitFor();
  assert.match(await page.textContent("#failure"), /could not be started: .*Trusted/i);
  await close([/TrustedScript/i, /Trusted Type/i, /data:,/]);
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

test("numbers of any size are answered in the page's words", async () => {
  await open("#ball=gel&orbits=9,0.5");
  const wrong = [];
  const look = async (what) => {
    const words = await page.evaluate(() => [...document.querySelectorAll(".error, #headline, #story, #ball-facts, #instant")].map((each) => each.textContent).join(" | "));
    if (/::|nan\b|NaN|undefined/.test(words.replace("is not a finite number", ""))) wrong.push(`${what}: ${words}`);
  };
  const values = ["1e-308", "1e308", "1e-9", "1e9", "0", "-1"];
  const fields = ["radius", "mass", "friction", "gravity", "patch", "along", "across", "rollingFriction"];
  for (const field of fields) {
    const usual = await page.inputValue(`#ball-fields [name=${field}]`);
    for (const value of values) {
      await page.fill(`#ball-fields [name=${field}]`, value);
      await look(`${field} ${value}`);
    }
    await page.fill(`#ball-fields [name=${field}]`, usual);
  }
  for (const value of [...values, "10", "1e-6"]) {
    await page.fill("#mu", value);
    await look(`mu ${value}`);
  }
  await close();
  for (const fragment of ["#body=1e308,1e-308&mu=0.3", "#mu=1e-308", "#ball=gel&gravity=1e308", "#mu=1e-6&orbits=0.8,3.5", "#body=1000,0.001&mu=10&orbits=1,1", "#body=0.001,1000&mu=1&orbits=1,1"]) {
    await open(fragment, {}, false);
    await look(fragment);
    await close();
  }
  assert.deepEqual(wrong, []);
});

test("what is not seen is not drawn, and after three rounds it rests", async () => {
  await open("#ball=puck&orbits=2.286,0.5", { stopped: true, reducedMotion: "no-preference" });
  await page.evaluate(() => {
    globalThis.drawings = 0;
    for (const surface of [globalThis.page.hero.lanes, globalThis.page.plane.surface]) {
      const picture = surface.picture;
      surface.picture = (...all) => {
        globalThis.drawings += 1;
        picture(...all);
      };
    }
    scrollTo(0, 1e6);
  });
  await drawn();
  await pass(100);
  const now = () => page.evaluate(() => ({ drawings: globalThis.drawings, fraction: globalThis.page.state.fraction }));
  const before = await now();
  await pass(500);
  const unseen = await now();
  assert.ok(unseen.fraction > before.fraction + 0.03);
  assert.equal(unseen.drawings, before.drawings);
  await page.evaluate(() => scrollTo(0, 0));
  await drawn();
  await pass(100);
  assert.ok((await now()).drawings > before.drawings + 2);
  // Rounds, in a clock that goes quicker.
  await page.evaluate(() => {
    Object.defineProperty(globalThis.page.player, "seconds", { get: () => 0.05 });
    globalThis.starts = 0;
    let last = 0;
    const { store, store: { changed } } = globalThis.page;
    store.changed = (moment) => {
      changed(moment);
      const { fraction } = store.state;
      if (fraction < last) globalThis.starts += 1;
      last = fraction;
    };
    globalThis.page.player.toggle(true);
  });
  await pass(5000);
  assert.equal(await page.evaluate(() => globalThis.page.player.playing), false);
  assert.equal(await page.evaluate(() => globalThis.starts), 2);
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

test("no card changes its height with the view, the step of the tour or the motion", async () => {
  for (const viewport of [{ width: 1440, height: 900 }, { width: 1280, height: 800 }]) {
    await open("", { viewport });
    const heights = () => page.evaluate(() => ["hero", "plane-card", "tour"].map((id) => Math.round(document.getElementById(id).getBoundingClientRect().height)).join());
    const seen = new Map([[await heights(), "the opening"]]);
    const note = async (what) => seen.set(await heights(), what);
    for (const view of ["patch", "log", "similarity", "blowup", "disc", "time", "pair", "uv"]) {
      await page.click(`#views [value=${view}]`);
      await note(view);
    }
    for (const link of await page.$$("#presets a")) {
      await link.click();
      await note(await link.textContent());
    }
    for (let step = 1; step < 6; ++step) {
      await page.click("#step-on");
      await page.waitForFunction((step) => globalThis.page.state.step === step, step);
      await note(`step ${step}`);
    }
    assert.equal(seen.size, 1, JSON.stringify([...seen]));
    await close();
  }
});

test("letters follow the size that the reader has set in the browser", async () => {
  await open("", { viewport: { width: 1280, height: 800 } });
  const size = () => page.evaluate(() => parseFloat(getComputedStyle(document.getElementById("story")).fontSize));
  const before = await size();
  const devtools = await page.context().newCDPSession(page);
  await devtools.send("Page.setFontSizes", { fontSizes: { standard: 32 } });
  await drawn();
  assert.equal(await size(), 2 * before);
  await close();
});

