// What the page draws: bodies, orbits, colours, letters and the room that they have.
import assert from "node:assert/strict";
import { test } from "node:test";
import { clickPlane, close, drawn, open, page, pass, pixelOf, saved, slide, state } from "./browser.mjs";

/** The texts of an SVG file and where they are, in its pixels: {text, left, right, top, bottom}. */
const textsOf = (svg) => page.evaluate((svg) => {
  const holder = document.body.appendChild(document.createElement("div"));
  holder.innerHTML = svg;
  const origin = holder.firstElementChild.getBoundingClientRect();
  const texts = [...holder.querySelectorAll("text")].map((text) => {
    const box = text.getBoundingClientRect();
    return { text: text.textContent, left: box.left - origin.left, right: box.right - origin.left, top: box.top - origin.top, bottom: box.bottom - origin.top };
  });
  holder.remove();
  return texts;
}, String(svg));
const said = async () => `${await page.textContent("#headline")} ${await page.textContent("#story")}`;

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
  // The plane fills its card, which is as high as 64 letters.
  assert.ok(lanes < 0.7 && plane < 1.6, `${lanes}, ${plane}`);
  assert.ok(await page.$eval("#first", ({ clientHeight }) => clientHeight) <= 1024);
  await close();
});

test("the card beside the table is full: plane, cue and ball that bounces", async () => {
  for (const [width, height] of [[1440, 900], [1920, 1080], [2560, 1440]]) {
    for (const [step, id] of [[0, "plane"], [6, "bounce"], [7, "cue"]]) {
      await open(`#ball=gel&orbits=9,1&step=${step}&lab=0`, { viewport: { width, height } });
      const [empty, share] = await page.$eval(`#${id}-card`, (card) => {
        const bottoms = [...card.children].filter((child) => child.checkVisibility()).map((child) => child.getBoundingClientRect().bottom);
        const { bottom, height } = card.getBoundingClientRect();
        return [bottom - Math.max(...bottoms), card.querySelector("canvas").clientHeight / height];
      });
      assert.ok(empty < 40 && share > 0.6, `${id}, ${width}: ${empty} pixels are empty, the picture has ${share} of the card`);
      await close();
    }
  }
});

test("the ball is seen until the motion ends, also long after it has ceased to slide", async () => {
  await open("#ball=pool&part=whole");
  for (const share of [0.02, 0.3, 0.9, 1]) {
    await page.evaluate((share) => globalThis.page.store.move({ fraction: share }), share);
    const pixels = await page.evaluate(() => {
      const lanes = document.getElementById("lanes");
      const canvas = new OffscreenCanvas(lanes.width, lanes.height);
      const context = canvas.getContext("2d");
      context.drawImage(lanes, 0, 0);
      const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += data[i] === 0xc2 && data[i + 1] === 0x2f && data[i + 2] === 0x5a;
      return count;
    });
    assert.ok(pixels > 100, `${pixels} pixels of the spinning ball at ${share}`);
  }
  await close();
});

test("an orbit begins at its start, chosen or not", async () => {
  await open("#law=exact&mu=0.3&window=1,4&orbits=0.8,3.5;-0.5,1&chosen=0");
  for (const chosen of [0, 1]) {
    await page.click(`#orbits li:nth-child(${chosen + 1}) button`);
    const svg = await saved("#save-svg");
    const { left, top } = await page.evaluate(() => document.getElementById("plane").getBoundingClientRect());
    for (const [colour, start] of [["#c22f5a", [0.8, 3.5]], ["#0072b2", [-0.5, 1]]]) {
      const [, x, y] = new RegExp(`<path d="M([\\d.]+) ([\\d.]+)[^"]+" fill="none" stroke="${colour}"`).exec(svg).map(Number);
      const wanted = await pixelOf(...start);
      // Within the disc of the start.
      assert.ok(Math.hypot(x + left - wanted[0], y + top - wanted[1]) < 4, `${colour} at ${x}, ${y} while ${chosen} is chosen`);
    }
  }
  await close();
});

test("with forced colours the view that is chosen is told from the others", async () => {
  await open("#law=exact&mu=0.3&view=log&orbits=0.8,3.5", { forcedColors: "active" });
  const grounds = await page.$$eval("#views button", (buttons) => buttons.map((button) => getComputedStyle(button).backgroundColor));
  const [chosen] = grounds.splice(1, 1);
  assert.ok(grounds.every((ground) => ground !== chosen), `${chosen} beside ${grounds}`);
  await close();
});

test("a PNG is as fine as the screen", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5", { viewport: { width: 390, height: 844 }, deviceScaleFactor: 3, isMobile: true, hasTouch: true });
  const png = await saved("#save-png");
  assert.ok(png.readUInt32BE(16) >= await page.evaluate(() => document.getElementById("plane").width));
  await close();
});

test("numbers of any size have room: ticks, the colour bar", async () => {
  await open("#law=exact&mu=0.3&orbits=1e10,1e10");
  const { width, height } = await page.evaluate(() => ({ width: document.getElementById("plane").clientWidth, height: document.getElementById("plane").clientHeight }));
  const texts = await textsOf(await saved("#save-svg"));
  assert.ok(texts.some(({ text }) => /·10/.test(text)) && texts.length > 15, `${texts.length} texts`);
  texts.forEach((text, i) => {
    assert.ok(text.left > -1 && text.right < width + 1 && text.top > -1 && text.bottom < height + 1, JSON.stringify({ ...text, width, height }));
    for (const other of texts.slice(i + 1)) {
      const apart = text.right <= other.left || other.right <= text.left || text.bottom - 3 <= other.top || other.bottom - 3 <= text.top;
      assert.ok(apart, `'${text.text}' is over '${other.text}'`);
    }
  });
  await close();
});

test("every orbit has a contrast of 3:1 to its ground, in light and dark", async () => {
  const luminance = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16) / 255)
    .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4))
    .reduce((sum, part, i) => sum + part * [0.2126, 0.7152, 0.0722][i], 0);
  for (const colorScheme of ["light", "dark"]) {
    await open("#law=exact&mu=0.3&window=1,4&orbits=0.8,3.5;0.5,3;0.3,2;-0.3,2;-0.5,3;-0.8,3", { colorScheme });
    const { card, ground, own, times } = await page.evaluate(() => {
      const { figure } = globalThis.page.plane.planeScene;
      return {
        card: getComputedStyle(document.documentElement).getPropertyValue("--card").trim(), ground: figure.ground, times: figure.colour_bar.colours,
        own: [...document.querySelectorAll("#orbits li")].map((item) => item.style.getPropertyValue("--swatch")),
      };
    });
    assert.ok(times.length > 10 && new Set(own).size === 6);
    for (const [colours, on] of [[[...own, ...times], ground], [own, card]]) {
      for (const colour of colours) {
        const ratio = (luminance(colour) + 0.05) / (luminance(on) + 0.05);
        assert.ok(Math.max(ratio, 1 / ratio) >= 3, `${colour} on ${on} is ${Math.max(ratio, 1 / ratio)}`);
      }
    }
    await close();
  }
});

test("spins to the left alone fill their pane", async () => {
  await open("#law=exact&mu=0.3&orbits=-0.05,0.5");
  await page.selectOption("#picture", "panes");
  const svg = String(await saved("#save-svg"));
  const frames = [...svg.matchAll(/<clipPath id="[^"]+"><rect x="[^"]+" y="([\d.]+)" width="[^"]+" height="([\d.]+)"/g)].map(([, top, height]) => [Number(top) + 3, Number(height) - 6]);  // lines on the border reach 3 pixels beyond it
  const [, curve] = [...svg.matchAll(/<path d="([^"]+)" fill="none" stroke="#c22f5a"/g)].map(([, path]) => path.match(/[ML][\d.]+ ([\d.]+)/g).map((point) => Number(point.split(" ")[1])));
  const [, [top, height]] = frames;
  assert.ok(Math.max(...curve) - Math.min(...curve) > 0.9 * height, `from ${Math.min(...curve)} to ${Math.max(...curve)} in ${height} pixels from ${top}`);
  await close();
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
  // A cue strikes the chosen one alone.
  await page.evaluate(() => globalThis.page.store.ask((next) => (next.step = 7)));
  await page.focus("#cue");
  await page.keyboard.press("ArrowRight");
  assert.ok((await state()).orbits[1].u > 0);
  await page.click("#orbits li:nth-child(1) button");
  assert.deepEqual((await state()).orbits[0], before);
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

test("what is not seen is not drawn, and after its round it rests", async () => {
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
  // A round, in a clock that goes quicker.
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
  assert.equal(await page.evaluate(() => globalThis.starts), 0);
  await close();
});

test("no card changes its height with the view, the step of the tour or the motion", async () => {
  for (const viewport of [{ width: 1440, height: 900 }, { width: 1280, height: 800 }]) {
    await open("", { viewport });
    const heights = () => page.evaluate(() => ["#hero", ".beside-hero", "#tour"].map((each) => [...document.querySelectorAll(each)].find((card) => card.checkVisibility())).map((card) => Math.round(card.getBoundingClientRect().height)).join());
    const seen = new Map([[await heights(), "the opening"]]);
    const note = async (what) => seen.set(await heights(), what);
    for (const view of ["log", "blowup", "disc", "uv"]) {
      await page.click(`#views [value=${view}]`);
      await note(view);
    }
    for (const link of await page.$$("#presets a")) {
      await link.click();
      await note(await link.textContent());
    }
    await page.click("#presets a");
    for (let step = 1; step < 8; ++step) {
      await page.click("#step-on");
      await page.waitForFunction((step) => globalThis.page.state.step === step, step);
      await note(`step ${step}`);
    }
    assert.equal(seen.size, 1, JSON.stringify([...seen]));
    await close();
  }
});

test("nothing moves under the hand: story, table and sliders stay while a slider is dragged, and the story fits", async () => {
  const moved = [];
  await open("#lab=0");
  for (const [width, height] of [[360, 740], [390, 844], [768, 1024], [1024, 768], [1280, 800], [1440, 900], [1920, 1080], [2560, 1440]]) {
    await page.setViewportSize({ width, height });
    const rectangles = () => page.evaluate(() => ["words", "lanes", "player", "patch", "slip-control", "spin-control", "slip-slider", "spin-slider", "presets"].map((id) => {
      const { left, top, width, height } = document.getElementById(id).getBoundingClientRect();
      return { id, sides: [left + scrollX, top + scrollY, width, height] };
    }));
    for (const link of await page.$$("#presets a")) {
      await link.evaluate((each) => each.click());
      const what = `${width}, ${await link.textContent()}`;
      const before = await rectangles();
      for (const id of ["spin-slider", "slip-slider"]) for (let share = 0; share <= 1000; share += 125) {
        await slide(id, share);
        const wrong = (await rectangles()).filter(({ sides }, i) => sides.some((side, j) => Math.abs(side - before[i].sides[j]) > 0.5));
        if (wrong.length) moved.push(`${what}, ${id} at ${share}: ${JSON.stringify([wrong[0], before.find((each) => each.id === wrong[0].id)])}`);
        const over = await page.evaluate(() => ["words", "headline"].map((id) => document.getElementById(id)).find(({ scrollHeight, clientHeight }) => scrollHeight > clientHeight + 1)?.textContent);
        if (over) moved.push(`${what}, ${id} at ${share}: cut: ${over}`);
      }
    }
  }
  assert.deepEqual(moved.slice(0, 5), [], `${moved.length} in all`);
  await close();
});

test("the buttons of the tour stay where they are from step to step", async () => {
  for (const [width, height] of [[390, 844], [1024, 768], [1440, 900]]) {
    await open("#lab=0", { viewport: { width, height } });
    const places = new Set();
    for (let step = 0; step < 8; ++step) {
      if (step) await page.locator("#step-on").evaluate((button) => button.click());
      await page.waitForFunction((step) => globalThis.page.state.step === step, step);
      await drawn();
      places.add(await page.evaluate(() => ["step-on", "lanes"].map((id) => Math.round(document.getElementById(id).getBoundingClientRect().top + scrollY)).join()));
    }
    assert.equal(places.size, 1, `${width}: ${[...places].join("; ")}`);
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

test("an orbit that begins far outside the window has no more points than others", async () => {
  for (const fragment of ["#window=0.00001,0.00005&orbits=0.8,3.5", "#window=1,5&orbits=1e20,1"]) {
    await open(fragment);
    assert.ok(await page.evaluate(() => globalThis.page.plane.planeScene.own.every(({ u, panels }) => u.length < 2000 && panels[0].line.length < 4000)));
    await close();
  }
});

test("a new size of the window is a new drawing, sharp", async () => {
  await open();
  for (const width of [1900, 700, 1280]) {
    await page.setViewportSize({ width, height: 900 });
    await page.waitForFunction(() => {
      const canvas = document.getElementById("plane");
      return canvas.width === Math.round(canvas.clientWidth * devicePixelRatio) && globalThis.page.plane.frames[0].width < canvas.clientWidth;
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
