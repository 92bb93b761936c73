// Thrown bodies, the question, the dare and the presets, which a reader meets first.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { duration, length, shown, turnsOf } from "../../src/page/numbers.js";
import { question } from "../../src/page/hero/story.js";
import { assertClose, close, drawn, file, json, open, page, pass, pixelOf, saved, slide, state } from "./browser.mjs";

/** Where a body is on the screen: the one that spins, or the other. */
const body = (index = 1) => page.evaluate((index) => {
  const { left, top } = document.getElementById("lanes").getBoundingClientRect();
  const { x, y } = globalThis.page.hero.places[index];
  return [left + x, top + y];
}, index);
const told = () => page.textContent("#told");

/** Presses a body, drags, and turns the wheel; lets go unless it is to be held. */
async function fling(dx, dy, wheel = 0, { index = 1, held = false } = {}) {
  const [x, y] = await body(index);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 4 });
  if (wheel) {
    const before = await told();
    await page.mouse.wheel(0, wheel);
    await page.waitForFunction((before) => document.getElementById("told").textContent !== before, before);
  }
  if (!held) await page.mouse.up();
}

test("a body is thrown: how far is how fast, the wheel is the spin, and the throw is a dot of the plane and in the link", async () => {
  await open("#ball=puck&orbits=2.286,0.5", { stopped: true, reducedMotion: "no-preference" });
  await pass(100);
  const width = await page.evaluate(() => globalThis.page.hero.lanes.width);
  await fling(0.275 * width, 0, 800);
  const { orbits, chosen, ball, fraction } = await state();
  assert.deepEqual([orbits.length, chosen], [2, 1]);
  const { u, v, along, across, heading } = orbits[1];
  assertClose(v, 1, 0.02, "half of the way is half of the full speed");
  // A radian of the wheel the other way: a part of 500 rad/s in two turns.
  assertClose(u / ball.radius, 60 - 500 / (4 * Math.PI), 0.02, "spin");
  assert.deepEqual([along, across, heading], [v, 0, 0]);
  assert.ok(fraction < 0.5, "and it goes");
  await pass(300);
  assert.ok((await state()).fraction > 0.02);
  // The dot lies on the plane, and the one before it stays.
  const box = await page.locator("#plane").boundingBox();
  for (const orbit of orbits) {
    const [x, y] = await pixelOf(orbit.u, orbit.v);
    assert.ok(x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height, `${x}, ${y}`);
  }
  // Nothing is remembered while it plays.
  await page.click("#play");
  await pass(400);
  assert.ok(page.url().includes(`;${u},${v}`));
  const link = page.url();
  // A throw of the other body is one, too; a tap is none.
  await fling(-60, -60, 0, { index: 0 });
  assert.equal((await state()).orbits[2].heading, 135);
  await page.mouse.click(...await body());
  assert.equal((await state()).orbits.length, 3);
  await close();
  await open(link.slice(link.indexOf("#")));
  assert.deepEqual((await state()).orbits, orbits);
  await close();
});

test("what is held is let go where its release is not heard of, such as outside of the window", async () => {
  await open();
  const held = () => page.evaluate(() => [globalThis.page.hero.aim !== null, globalThis.page.store.held, globalThis.page.state.orbits.length]);
  // A mouse that comes back without its button; a capture that ends.
  for (const event of ["pointermove", "lostpointercapture"]) {
    await fling(80, 0, 0, { held: true });
    assert.deepEqual(await held(), [true, true, 1]);
    await page.evaluate((event) => document.getElementById("lanes").dispatchEvent(new PointerEvent(event, { pointerId: 1, pointerType: "mouse", bubbles: true })), event);
    assert.deepEqual(await held(), [false, event !== "pointermove", 1]);
    await page.mouse.up();
    assert.deepEqual(await held(), [false, false, 1], "nothing is thrown");
  }
  await close();
});

test("what is thrown goes where the hand went, in the picture, and nothing is cut", async () => {
  for (const [dx, dy] of [[100, 0], [100, -80], [-100, -80], [0, 100], [-120, 0]]) {
    await open();
    await fling(dx, dy);
    const { places, ends, width, height } = await page.evaluate(() => {
      const { hero: { places, bodies, lanes: { width, height } } } = globalThis.page;
      return { places, ends: bodies.map(({ xs, ys }) => [xs.at(-1), ys.at(-1)]), width, height };
    });
    const far = Math.hypot(dx, dy);
    for (const [x, y] of ends) assert.ok(Math.hypot(x / Math.hypot(x, y) - dx / far, y / Math.hypot(x, y) + dy / far) < 0.02, `${x}, ${y} for ${dx}, ${dy}`);
    for (const { x, y, radius } of places) assert.ok(x > radius && x < width - radius && y > radius && y < height - radius, JSON.stringify({ x, y, radius }));
    await page.selectOption("#picture", "lanes");
    const svg = String(await saved("#save-svg"));
    const texts = await page.evaluate((svg) => {
      const holder = document.body.appendChild(document.createElement("div"));
      holder.innerHTML = svg;
      const origin = holder.firstElementChild.getBoundingClientRect();
      const found = [...holder.querySelectorAll("text")].map((text) => [text.getBoundingClientRect(), text.textContent])
        .map(([{ left, right, top, bottom }, words]) => ({ words, left: left - origin.left, right: right - origin.left, top: top - origin.top, bottom: bottom - origin.top }));
      holder.remove();
      return found;
    }, svg);
    assert.ok(texts.some(({ words }) => words === "0.515 m"), "the throw before");
    texts.forEach((text, i) => {
      assert.ok(text.left > -1 && text.right < width + 1 && text.top > -3 && text.bottom < height + 3, JSON.stringify({ ...text, dx, dy, width, height }));
      for (const other of texts.slice(i + 1)) {
        assert.ok(text.right <= other.left || other.right <= text.left || text.bottom - 3 <= other.top || other.bottom - 3 <= text.top, `'${text.words}' is over '${other.words}', ${dx}, ${dy}`);
      }
    });
    await close();
  }
});

test("a second finger turns what is thrown, and a finger beside the bodies scrolls", async () => {
  await open("", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const devtools = await page.context().newCDPSession(page);
  const touch = async (type, ...points) => {
    await devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await drawn();
  };
  const [x, y] = await body();
  const at = [x - 120, y + 20];
  const second = (angle) => [at[0] + 90 * Math.cos(angle), at[1] - 90 * Math.sin(angle)];
  await touch("touchStart", [x, y]);
  for (let i = 1; i <= 5; ++i) await touch("touchMove", [x + ((at[0] - x) * i) / 5, y + 4 * i]);
  await touch("touchStart", at, second(0));
  for (let i = 1; i <= 6; ++i) await touch("touchMove", at, second((i * Math.PI) / 6));
  assert.match(await told(), /m\/s, 29\.4 turns\/s/, "half a turn to the left is a quarter of 500 rad/s more");
  await touch("touchMove", at);
  assert.equal((await state()).orbits.length, 1, "the second finger lets nothing go");
  await touch("touchEnd");
  const { orbits, ball } = await state();
  assert.equal(orbits.length, 2);
  assertClose(orbits[1].u / ball.radius, 185, 1e-9, "spin");
  assert.equal(await page.evaluate(() => scrollY), 0);
  // Beside the bodies.
  const box = await page.locator("#lanes").boundingBox();
  const from = [box.x + box.width - 8, box.y + box.height - 30];
  await touch("touchStart", from);
  for (let i = 1; i <= 8; ++i) await touch("touchMove", [from[0], from[1] - 20 * i]);
  await touch("touchEnd");
  assert.ok((await page.evaluate(() => scrollY)) > 60);
  assert.equal((await state()).orbits.length, 2);
  await close();
});

test("keys throw, Escape and a short way throw nothing, and a wheel beside the bodies scrolls", async () => {
  await open();
  await page.focus("#lanes");
  await page.keyboard.press("ArrowRight");
  assert.equal(await told(), "0.55 m/s, 9.55 turns/s");
  for (const key of ["ArrowUp", "ArrowUp", "Shift+ArrowRight"]) await page.keyboard.press(key);
  assert.equal(await told(), "0.563 m/s, 13.5 turns/s");
  await page.keyboard.press("Escape");
  assert.equal(await told(), "");
  await page.keyboard.press("Enter");
  assert.equal((await state()).orbits.length, 1);
  assert.equal(await told(), "0.5 m/s, 9.55 turns/s");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  const { orbits, ball } = await state();
  assert.deepEqual([orbits.length, orbits[1].v], [2, 0.5]);
  assertClose(orbits[1].u / ball.radius, 47.5, 1e-9, "spin");
  await fling(5, 5);
  assert.equal((await state()).orbits.length, 2);
  const before = await page.evaluate(() => scrollY);
  await page.mouse.move(640, 40);
  await page.mouse.wheel(0, 200);
  await page.waitForFunction((before) => scrollY > before, before);
  await close();
});

test("the story has the two bodies in their colours", async () => {
  for (const colorScheme of ["light", "dark"]) {
    await open("#ball=puck&orbits=2.286,0.5;2,0.5&chosen=1", { colorScheme });
    const { words, drawn: bodies } = await page.evaluate(() => {
      const probe = document.body.appendChild(document.createElement("i"));
      const seen = globalThis.page.hero.lanesNow().map(({ colour }) => {
        probe.style.color = colour;
        return getComputedStyle(probe).color;
      });
      return { drawn: seen, words: [...document.querySelectorAll("#story :is(.own, .plain)")].map((word) => [word.textContent, getComputedStyle(word).color]) };
    });
    // Also how far each slides.
    const [plain, own] = [words[1][0], words[3][0]];
    assert.deepEqual(words, [["One does not spin", bodies[0]], [plain, bodies[0]], ["The other spins", bodies[1]], [own, bodies[1]]]);
    assert.ok(plain !== own && [plain, own].every((length) => / m$/.test(length)), `${plain}, ${own}`);
    await close();
  }
});

test("every picture is drawn on a phone", async () => {
  await open("", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  for (const id of ["lanes", "patch", "plane", "copies", "panes"]) {
    await page.locator(`#${id}`).scrollIntoViewIfNeeded();
    await drawn();
    const colours = await page.$eval(`#${id}`, (canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return [data.slice(0, 3).join(), new Set(new Uint32Array(data.buffer)).size];
    });
    assert.ok(colours[0] === "255,255,255" && colours[1] > 10, `${id}: ${colours}`);
  }
  await close();
});

/** Where the ring of the body that spins is, at an angle to the left from the right, in rad. */
const onRing = (angle) => page.evaluate((angle) => {
  const { left, top } = document.getElementById("lanes").getBoundingClientRect();
  const { x, y, radius } = globalThis.page.hero.places.at(-1);
  return [left + x + (radius + 25) * Math.cos(angle), top + y - (radius + 25) * Math.sin(angle)];
}, angle);

/** Pulls the ring from one angle to another, and lets go. */
async function spin(from, to) {
  await page.mouse.move(...await onRing(from));
  await page.mouse.down();
  for (let i = 1; i <= 12; ++i) await page.mouse.move(...await onRing(from + ((to - from) * i) / 12));
  await page.mouse.up();
}

test("a line is reached by spin alone: the ring, the wheel without a button, keys; tries stay, and a hit is in the link", async () => {
  await open("#lab=0", { stopped: true, reducedMotion: "no-preference" });
  await page.click("#answers button");
  await pass(8000);
  await page.click("#to-line");
  const headline = () => page.textContent("#headline");
  assert.equal(await headline(), "Same push, 0.5 m/s. Reach the line, by spin alone.");
  const speeds = async () => (await state()).orbits.map(({ u, v }) => [u / 0.0381, v]);
  const rad = (await state()).ball.radius;
  // An eighth of a turn to the left of two turns for 500 rad/s.
  await spin(0, Math.PI / 4);
  assertClose((await state()).orbits[1].u / rad, 60 + 500 / 16, 0.02, "rad/s");
  assert.equal((await state()).orbits[1].v, 0.5, "the push is the same");
  await pass(200);
  assert.match(await headline(), /^Same push/, "nothing is told before the end");
  await pass(14_000);
  const [, { u }] = (await state()).orbits;
  const far = json("stop", "--ball", "puck", "--slip", 0.5, "--spin", u / rad).slip_length;
  assert.equal(await headline(), `${turnsOf(u / rad, "turns a second")} give ${length(far, "m")}: ${length(1 - far, "m")} short of the line`);
  assert.ok(!(await page.isVisible("#send")));
  // The wheel over the body, without a button; a click lets go.
  await page.mouse.move(...await body());
  const scrolled = await page.evaluate(() => scrollY);
  await page.mouse.wheel(0, -900);
  await page.waitForFunction(() => globalThis.page.hero.ring?.share > 0.2);
  assert.equal(await page.evaluate(() => scrollY), scrolled);
  await page.mouse.click(...await body());
  assert.equal((await state()).orbits.length, 3);
  await pass(14_000);
  assert.match(await headline(), /beyond the line$/);
  // Keys, as fine as the line is wide.
  await page.focus("#lanes");
  do await page.keyboard.press("Shift+ArrowDown"); while (parseFloat((await told()).split(", ")[1]) > 19.25);
  await page.keyboard.press("Enter");
  await pass(14_000);
  assert.match(await headline(), /give (1|1\.0[012]\d?|0\.9[89]\d?) m: the line, in 3 tries$/);
  const found = page.evaluate(() => globalThis.page.hero.ghostsNow().map(({ words }) => words));
  assert.deepEqual(await found, (await speeds()).slice(0, 3).map(([its]) => turnsOf(its * 0.0381 / rad)));
  // The line and the tries are sent on, and no throw.
  await page.evaluate(() => Object.defineProperty(navigator, "clipboard", { value: { writeText: (text) => Promise.resolve(globalThis.copied = text) } }));
  await page.click("#send");
  await page.waitForFunction(() => globalThis.copied && document.getElementById("told").textContent !== "");
  const sent = await page.evaluate(() => globalThis.copied);
  assert.match(sent, /^contensou, line at 1 m, in 3 tries: (◀️|⏪)(▶️|⏩)🎯\nfile:.*#line=1&tries=3$/);
  const link = page.url();
  await page.click("#next-line");
  assert.equal(await told(), "");
  assert.deepEqual([(await state()).line, (await state()).orbits.length], [2, 1]);
  await close();
  // The address has the tries, so that a reload keeps them.
  await open(link.slice(link.indexOf("#")));
  assert.match(await headline(), /: the line, in 3 tries$/);
  await close();
  await open(sent.slice(sent.indexOf("#")), { stopped: true, reducedMotion: "no-preference" });
  await pass(3000);
  assert.equal(await headline(), "A friend reached the line in 3 tries. You?");
  assert.deepEqual([(await state()).fraction, (await state()).orbits.length], [0, 1], "nothing runs that nobody threw");
  assert.ok(await page.isVisible("#try-line") && !(await page.isVisible("#play")));
  await page.click("#try-line");
  for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowUp");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Shift+ArrowUp");
  await page.keyboard.press("Enter");
  await pass(14_000);
  assert.match(await headline(), /: the line, in 1 try; your friend needed 3$/);
  await close();
});

test("the line of a day follows from the day, and everybody who opens it has the same", async () => {
  await open("#lab=0", { stopped: true });
  await page.evaluate(() => (globalThis.Date = class extends Date {
    constructor(...all) {
      super(...(all.length ? all : ["2026-11-28T23:59:00Z"]));
    }
  }));
  await page.click("#today-line");
  const { line, day } = await state();
  assert.deepEqual([line, day], [2.61, "2026-11-28"]);
  await pass(500);
  assert.match(page.url(), /#day=2026-11-28$/);
  assert.match(await page.textContent("#story"), /^Line of 2026-11-28 \(UTC\)\. /);
  assert.ok(!(await page.isVisible("#today-line")));
  await close();
  for (const [fragment, problem] of [["#day=2026-02-30&tries=2", /^day=2026-02-30 of the link is left out/], ["#line=1&tries=1e9", /^tries=1e9/], ["#day=<img src=x onerror=alert(1)>", /is left out/]]) {
    await open(fragment, {}, false);
    assert.match(await page.textContent("#problem"), problem);
    await close();
  }
});

test("one and the same pull of the puck gives one spin wherever it begins, by mouse and by finger; the ring is seen all the time", async () => {
  for (const options of [{}, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }, { viewport: { width: 844, height: 390 }, hasTouch: true, isMobile: true }]) {
    const spins = new Set();
    let out = 0;
    await open("#line=1&lab=0", options);
    for (const [dx, dy] of [[0, 0], [-3, 2], [2, 3], [-1, -3], [3, -1], [9, -9], [-14, 12]]) {
      await page.evaluate(() => globalThis.page.store.ask((state) => Object.assign(state, { orbits: [state.orbits[0]], chosen: 0, fraction: 0 })));
      await drawn();
      const scene = () => page.evaluate(() => globalThis.page.hero.ringAtRest);
      assert.equal((await scene()).words, "9.55 turns/s");
      out = 25 + await page.evaluate(() => globalThis.page.hero.places.at(-1).radius);
      const [x, y] = (await onRing(0)).map((side, i) => side - [out, 0][i]);
      if (options.hasTouch) {
        const devtools = await page.context().newCDPSession(page);
        const touch = (type, ...points) => devtools.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
        await touch("touchStart", [x + dx, y + dy]);
        for (let i = 1; i <= 4; ++i) await touch("touchMove", [x + dx + 5 * i, y + dy + i]);
        await touch("touchEnd");
        assert.doesNotMatch(await page.locator("#hero").innerText(), /wheel|key|click|Enter/i);
      } else {
        await page.mouse.move(x + dx, y + dy);
        await page.mouse.down();
        await page.mouse.move(x + dx + 20, y + dy + 4, { steps: 4 });
        await page.mouse.up();
      }
      const { orbits, ball } = await state();
      assert.equal(orbits.length, 2);
      spins.add(orbits[1].u / ball.radius);
      assert.ok(await scene());
    }
    await close();
    assert.equal(spins.size, 1, JSON.stringify([...spins]));
    // 20 pixels of the ring, two turns of which are 500 rad/s.
    assert.ok(out >= 36, `${out} pixels`);
    assertClose([...spins][0], 60 + 500 * 20 / (2 * 2 * Math.PI * out), 0.01, "rad/s");
  }
});

test("the reader turns the spin of the patch: the arrows turn aside, and the number is the library's force", async () => {
  await open("#lab=0");
  const seen = async () => ({
    label: await page.getAttribute("#patch", "aria-label"), spoken: await page.getAttribute("#why-slider", "aria-valuetext"),
    picture: await page.$eval("#patch", (canvas) => canvas.toDataURL()),
  });
  const pictures = new Set();
  for (const share of [0, 200, 400, 700, 1000]) {
    await slide("why-slider", share);
    await drawn();
    const { label, spoken, picture } = await seen();
    pictures.add(picture);
    const spin = 500 * (share / 1000) ** 2;
    // The program's law of a uniform pressure, at the ratio of the slide to the rim speed.
    const { phi: [force] } = json("law", "--law", "uniform", "--k", share ? 0.5 / (spin * 0.0381) : "inf");
    const percent = shown(100 * force, force < 0.1 ? 1 : 2);
    assert.ok(label.includes(`${percent} % of it slows the slide`) && spoken.includes(`${percent} % of the friction`), `${label}; ${spoken}`);
  }
  assert.equal(pictures.size, 5);
  // The motion on the table stays. The patch follows it while it plays, and begins with its spin.
  assert.equal((await state()).orbits[0].u, 2.286);
  await slide("spin-slider", 300);
  assert.match((await seen()).spoken, /^23\.9 turns\/s/);
  const { label } = await seen();
  await page.evaluate(() => globalThis.page.store.move({ fraction: 0.5 }));
  await drawn();
  assert.notEqual((await seen()).label, label);
  await close();
});

test("headline, table and plane alone fill a projector, with words of 1.5 % of its width", async () => {
  for (const width of [1280, 1920]) {
    await open("#lab=0", { viewport: { width, height: (width * 9) / 16 } });
    await page.keyboard.press("P");
    await drawn();
    await drawn();
    for (const id of ["#headline", "#lanes", "#plane", "#play"]) assert.ok(await page.isVisible(id), id);
    for (const id of ["#why-card", "#tour", "#sliders", "#presets", "footer", "#lab"]) assert.ok(!(await page.isVisible(id)), id);
    const { tall, letter, words } = await page.evaluate(() => ({
      tall: document.documentElement.scrollHeight, letter: globalThis.page.plane.frames[0].letter, words: parseFloat(getComputedStyle(document.getElementById("story")).fontSize),
    }));
    assert.ok(tall <= (width * 9) / 16 + 1 && 0.9 * letter >= 0.0149 * width && words >= 0.015 * width, JSON.stringify({ tall, letter, words, width }));
    await page.waitForFunction(() => location.hash.includes("project=1"));
    await page.keyboard.press("Escape");
    assert.ok(await page.isVisible("#why-card"));
    await close();
  }
});

test("the last throws stay on the table where they ended", async () => {
  await open();
  for (const dx of [60, 90, 120, 150]) await fling(dx, 0);
  const { orbits, ball } = await state();
  const ghosts = await page.evaluate(() => globalThis.page.hero.ghostsNow());
  assert.equal(ghosts.length, 3);
  ghosts.forEach(({ x, words }, i) => {
    const { u, v } = orbits[i + 1];
    const far = json("stop", "--ball", "puck", "--slip", v, "--spin", u / ball.radius).slip_length;
    assertClose(x, far, 1e-9, "path");
    assert.equal(words, length(far, "m"));
  });
  await close();
});

test("each preset says in one sentence what is to be seen, with numbers that are the page's", async () => {
  await open();
  const links = await page.$$("#presets a");
  assert.equal(links.length, 5);
  for (const link of links) {
    await link.click();
    assert.equal(await link.getAttribute("aria-current"), "true");
    const says = await page.textContent("#says");
    const { real, spin, slip, own, plain, stop } = await page.evaluate(() => globalThis.page.hero.facts);
    const turningAlone = await page.evaluate(() => globalThis.page.library.plane.stop(globalThis.page.store.orbit.u, 0) * globalThis.page.store.timeFactor);
    const unit = real ? "m" : "";
    const times = own.path / plain.path;
    const known = [length(own.path, unit), length(plain.path, unit), `${shown(times, 2)} times as far`, `${shown(Math.abs(spin) / 2 / Math.PI, 2)} turns a second`,
      `${shown(slip, 3)} m/s`, `${shown(Math.abs(own.turned), 2)}°`, ...(await page.textContent("#bounce-says")).match(/[\d.]+°/g) ?? [], ...[own.end, plain.end, stop, turningAlone].map((t) => duration(t, "s"))];
    const numbers = says.match(/[\d.]*\d(°| times as far| turns a second| mm?(\/s)?\b| s\b)/g);
    assert.ok(numbers.length > 0, says);
    for (const number of numbers) assert.ok(known.includes(number), `'${number}' of '${says}' is none of ${known.join(", ")}`);
    assert.equal(says.match(/\d(?![\d.])/g).length, numbers.length, `a number of '${says}' has no unit`);
    assert.match(says, /^[^.]*(\.\d[^.]*)*\.$/, "one sentence");
  }
  // What is said of one that is pointed at moves none of them.
  await page.setViewportSize({ width: 1160, height: 900 });
  const places = () => page.$$eval("#presets a", (all) => all.map(({ offsetTop }) => offsetTop));
  const before = await places();
  for (const link of links) {
    await link.hover();
    assert.deepEqual(await places(), before);
  }
  await page.setViewportSize({ width: 1280, height: 900 });
  // It is said of a link that is pointed at, and not of a motion that is none of them.
  await links[0].hover();
  assert.match(await page.textContent("#says"), /^With 9\.5 turns/);
  await page.mouse.move(5, 5);
  await page.fill("[name=mu]", "0.9").catch(() => {});
  await page.fill("#ball-fields [name=friction]", "0.2");
  assert.equal(await page.textContent("#says"), "");
  await close();
});

test("paper has the end, and the screen afterwards what it had", async () => {
  await open("#ball=puck&at=0.25");
  assert.equal((await state()).fraction, 0.25);
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.equal((await state()).fraction, 1);
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.equal((await state()).fraction, 0.25);
  await page.fill("#ball-fields [name=mass]", "1");
  assert.equal((await state()).fraction, 0.25, "who goes to a moment stays there");
  await close();
});

test("a first picture stands in the page before the library does, of what it opens with", async () => {
  const first = () => page.locator("#first-picture");
  await open("", { javaScriptEnabled: false }, null);
  assert.equal(await first().locator("h2").textContent(), question().headline);
  assert.ok((await first().locator("svg").boundingBox()).height > 80);
  await close();
  assert.ok(readFileSync(file, "utf8").indexOf("first-picture") < 40_000, "before the library");
  await open("", { reducedMotion: "no-preference" });
  assert.equal(await first().count(), 0);
  assert.equal(await page.textContent("#headline"), question().headline);
  await close();
  // Of another motion it shows nothing.
  await open("#ball=gel", {}, null, () => (globalThis.WebAssembly = undefined));
  await page.locator("#failure").filter({ visible: true }).waitFor();
  assert.ok(!(await first().isVisible()));
  await close([/no native wasm support/]);
});
