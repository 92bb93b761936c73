// What the page says and keeps when a link, a number, a file, a script or its host fails.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { close, drawn, file, folder, open, page, saved, state, stopTimes } from "./browser.mjs";

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

test("a link to rest says so, and what it rejects of the plane leaves the motion", async () => {
  for (const [fragment, thing] of [["#ball=puck&orbits=0,0", "puck"], ["#ball=pool&orbits=0,0&part=whole", "ball"], ["#mu=0.3&orbits=0,0", "ball"], ["#ball=gel&view=log&orbits=0,0;9,0.5&at=1", "ball"],
    ["#body=disc&law=uniform&orbits=0,0", "puck"], ["#ball=pool&orbits=0,0&slope=1", null], ["#ball=pool&orbits=0,0&rollingFriction=0.01", null]]) {
    await open(fragment);
    if (thing) assert.equal(await page.textContent("#headline"), `A ${thing} at rest`, fragment);
    assert.notEqual(await page.textContent("#headline"), "", fragment);
    assert.doesNotMatch(await page.locator("#app").innerText(), /NaN|undefined|Infinity/, fragment);
    await page.click("#play");
    await page.click("#step-on");
    await close();
  }
  await open("#ball=puck&orbits=2.286,0.5&window=1e200,1&view=log");
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

test("what fails is said beside the buttons, and no promise is left unhandled", async () => {
  const failing = () => {
    HTMLCanvasElement.prototype.toBlob = (done) => done(null);
    globalThis.VideoEncoder = class {
      static isConfigSupported = async () => ({ supported: globalThis.takesFilms });
      state = "unconfigured";
      configure() {
        throw new DOMException("no such film", "NotSupportedError");
      }
      close() {}
    };
    Object.defineProperty(navigator, "clipboard", { value: { writeText: () => Promise.reject(new Error("denied")) } });
    globalThis.unhandled = [];
    addEventListener("unhandledrejection", ({ reason }) => globalThis.unhandled.push(String(reason)));
  };
  await open("", {}, true, failing);
  for (const [takes, button, words] of [[false, "#save-film", /cannot write films/], [true, "#save-film", /no such film/], [true, "#save-png", /cannot draw \d+ × \d+ pixels/]]) {
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

test("what is wrong with a start is said beside it", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5;0.5,1");
  const start = async (u, v) => {
    await page.fill("#add-orbit [name=u]", u);
    await page.fill("#add-orbit [name=v]", v);
    await page.click("#add-orbit button");
    return page.textContent("#add-orbit output");
  };
  assert.match(await start("0,5", "1"), /u₀: write 0\.5 with a point/);
  assert.match(await start("1e200", "1"), /This start cannot be shown/);
  assert.equal(await start("−0.5", "1"), "");
  assert.equal((await state()).orbits.at(-1).u, -0.5);
  // The focus stays in the list when the last of it is removed.
  await page.focus("#orbits li:last-child .remove");
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => document.activeElement.className), "remove");
  // What cannot be used does not stay in its field.
  await page.fill("[name=mu]", "abc");
  await page.focus("#add-orbit [name=u]");
  assert.equal(await page.inputValue("[name=mu]"), "0.3");
  await close();
});

test("a link that nobody can read opens the page all the same", async () => {
  await open("#law=nonsense&mu=-1&view=&window=1&orbits=x;1,-1;0.5,1&chosen=7&at=2");
  const { law, mu, view, orbits, chosen } = await state();
  assert.deepEqual({ law, mu, view, orbits, chosen }, { law: "exact", mu: 0.3, view: "uv", orbits: [{ u: 0.5, v: 1, along: 1, across: 0, heading: 0 }], chosen: 0 });
  await close();
  // A ball that nobody knows: the opening, and a word.
  await open("#ball=golf&orbits=1,2");
  assert.deepEqual([(await state()).ball.name, (await state()).orbits[0].u], ["puck", 2.286]);
  assert.match(await page.textContent("#problem"), /^There is no ball 'golf'\. Balls: .*pool/);
  await close();
});

test("a part of a link that cannot be read is told; a link that the library rejects shows the body with its own start", async () => {
  for (const [fragment, part] of [["#mu=2&orbits=1,1", "mu=2"], ["#law=stribeck&mu=0.3&orbits=1,1", "law=stribeck"], ["#ball=pool&friction=-1", "friction=-1"],
    ["#mu=0.3&law=phi=exp(1e9*k);psi=1", "law=phi=exp(1e9*k);psi=1"]]) {
    await open(fragment);
    assert.ok((await page.textContent("#problem")).startsWith(`${part} of the link is left out: `), fragment);
    await close();
  }
  for (const [fragment, ball] of [["#ball=puck&orbits=1e308,1e308", "puck"], ["#ball=pool&slope=89", "pool"], ["#ball=gel&radius=1e-9", "gel"]]) {
    await open(fragment);
    assert.notEqual(await page.textContent("#problem"), "", fragment);
    const asked = await state();
    await page.evaluate((name) => (location.hash = `ball=${name}&lab=1`), ball);
    await page.waitForFunction(() => document.getElementById("problem").textContent === "");
    const plain = await state();
    assert.deepEqual([asked.ball.name, asked.ball.radius, asked.ball.slope, asked.orbits], [ball, plain.ball.radius, 0, plain.orbits], fragment);
    await close();
  }
});

test("a link that the library rejects opens the page all the same, and says why", async () => {
  for (const fragment of ["#law=exact&mu=0.3&window=1e200,1&orbits=0.8,3.5", "#mu=0.3&orbits=1e200,1"]) {
    await open(fragment);
    assert.equal((await state()).mu, 0.3);
    assert.match(await page.textContent("#problem"), /window must be between/);
    assert.equal((await stopTimes()).length, 1);
    await page.fill("[name=mu]", "0.5");
    assert.equal((await state()).mu, 0.5);
    // The same for a link that is opened in the page.
    await page.waitForFunction(() => /mu=0.5/.test(location.hash));
    await page.evaluate((fragment) => (location.hash = fragment), fragment);
    await page.waitForFunction(() => document.getElementById("problem").textContent !== "");
    assert.equal((await state()).mu, 0.5);
    await close();
  }
});

test("a wrong number is named beside its field, and the last good state stays", async () => {
  await open("#law=exact&mu=0.25&orbits=0.8,3.5");
  const times = await stopTimes();
  for (const [text, complaint] of [["abc", /'abc' is not a finite number/], ["0", /positive/], ["-1", /positive/], ["1.5", /to 1 is allowed/], ["", /needed/], ["1e999", /finite/], ["0,3", /0\.3/]]) {
    await page.fill("[name=mu]", text);
    assert.match(await page.textContent("#mu-error"), complaint);
    assert.equal(await page.getAttribute("[name=mu]", "aria-invalid"), "true");
    assert.deepEqual(await stopTimes(), times);
  }
  await page.fill("[name=mu]", "0.5");
  assert.equal(await page.textContent("#mu-error"), "");
  assert.notDeepEqual(await stopTimes(), times);

  await page.fill("#add-orbit [name=u]", "1");
  await page.fill("#add-orbit [name=v]", "-1");
  await page.click("#add-orbit button");
  assert.match(await page.textContent("#add-orbit output"), /≥ 0/);
  assert.equal((await stopTimes()).length, 1);
  await close();
});
