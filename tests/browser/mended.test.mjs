// What readers of the page once met and was mended, each with the steps that led there.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { test } from "node:test";
import { close, drawn, file, open, page, pixelOf, saved, state } from "./browser.mjs";

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

test("what was said of an orbit goes when the orbit does", async () => {
  await open("#law=exact&mu=0.3&window=1,4&orbits=0.8,3.5");
  const said = async () => (await page.textContent("#pointed")).trim();
  for (const change of [() => page.selectOption("#ball", "pool"), () => page.fill("#mu", "0.05")]) {
    await page.mouse.click(...await pixelOf(...await page.evaluate(() => globalThis.page.store.portrait.window.map((side) => -0.4 * side).map(Math.abs))));
    assert.match(await said(), /it stops at/);
    await change();
    assert.equal(await said(), "");
  }
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

test("without JavaScript, and where the library cannot start, one sentence says so and no control is there", async () => {
  const controls = () => page.locator("main button, main input, main select, canvas").filter({ visible: true }).count();
  await open();
  assert.ok(await controls() > 20);
  await close();
  await open("", { javaScriptEnabled: false }, null);
  assert.match(await page.locator("body").innerText(), /needs JavaScript/);
  assert.equal(await controls(), 0);
  await close();
  await open("", {}, null, () => (globalThis.WebAssembly = undefined));
  await page.locator("#failure").filter({ visible: true }).waitFor();
  assert.match(await page.textContent("#failure"), /could not be started: .*WebAssembly/);
  assert.equal(await controls(), 0);
  await close([/no native wasm support/]);
});

test("a number that is being typed is not announced key by key", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  await page.evaluate(() => {
    globalThis.announced = [];
    const live = (node) => node.closest("[aria-live], [role=alert], [role=status], output");
    new MutationObserver((changes) => changes.forEach(({ target }) => {
      const region = live(target.nodeType === 1 ? target : target.parentElement);
      if (region && region.getAttribute("aria-live") !== "off" && region.textContent.trim()) globalThis.announced.push(region.textContent);
    })).observe(document.body, { subtree: true, childList: true, characterData: true });
  });
  await page.focus("#mu");
  await page.keyboard.press("Control+a");
  for (const key of ["Backspace", ..."0.05"]) await page.keyboard.press(key);
  await drawn();
  const announced = await page.evaluate(() => globalThis.announced);
  assert.deepEqual(announced.filter((text) => /must|needed|number/.test(text)), []);
  assert.equal((await state()).mu, 0.05);
  assert.equal(await page.getAttribute("#mu", "aria-describedby"), "mu-error");
  await page.fill("#mu", "abc");
  await page.keyboard.press("Tab");
  assert.equal(await page.inputValue("#mu"), "0.05");
  assert.equal(await page.getAttribute("#mu", "aria-invalid"), "false");
  await close();
});

test("with forced colours the view that is chosen is told from the others", async () => {
  await open("#law=exact&mu=0.3&view=patch&orbits=0.8,3.5", { forcedColors: "active" });
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

test("numbers of any size have room: ticks, the colour bar, the fields of the window", async () => {
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
  for (const field of await page.$$("#window input")) {
    const [value, needed, room] = await field.evaluate((input) => [Number(input.value), input.scrollWidth, input.clientWidth]);
    assert.ok(value > 1e10 && needed <= room, `${value}: ${needed} of ${room} pixels`);
  }
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
        card: getComputedStyle(document.documentElement).getPropertyValue("--card").trim(), ground: figure.ground, times: figure.colourBar.colours,
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
  const frames = [...svg.matchAll(/<clipPath id="[^"]+"><rect x="[^"]+" y="([\d.]+)" width="[^"]+" height="([\d.]+)"/g)].map(([, top, height]) => [Number(top), Number(height)]);
  const [, curve] = [...svg.matchAll(/<path d="([^"]+)" fill="none" stroke="#c22f5a"/g)].map(([, path]) => path.match(/[ML][\d.]+ ([\d.]+)/g).map((point) => Number(point.split(" ")[1])));
  const [, [top, height]] = frames;
  assert.ok(Math.max(...curve) - Math.min(...curve) > 0.9 * height, `from ${Math.min(...curve)} to ${Math.max(...curve)} in ${height} pixels from ${top}`);
  await close();
});

test("what is copied while a motion plays is what would be drawn", async () => {
  const link = "#ball=gel&view=pair&orbits=9,0.5;-4,0.5";
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

test("the story is whole again after there was no motion", async () => {
  await open("#ball=puck&orbits=2.286,0.5");
  const story = await page.textContent("#story");
  await page.click("#orbits li .remove");
  assert.equal(await page.textContent("#story"), "Up is sliding, sideways is spinning.");
  await page.click("#presets a");
  assert.equal(await page.textContent("#story"), story);
  await close();
});
