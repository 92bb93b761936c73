// The words of the page: headline, story, tour and presets say in plain words and numbers what is shown.
import assert from "node:assert/strict";
import { test } from "node:test";
import { close, drawn, open, page, pass, pixelOf, state } from "./browser.mjs";

test("what was said of an orbit goes when the orbit does", async () => {
  await open("#law=exact&mu=0.3&window=1,4&orbits=0.8,3.5");
  const said = async () => (await page.textContent("#pointed")).trim();
  for (const change of [() => page.selectOption("#ball", "pool"), () => page.fill("[name=mu]", "0.05")]) {
    await page.mouse.click(...await pixelOf(...await page.evaluate(() => globalThis.page.store.portrait.window.map((side) => -0.4 * side).map(Math.abs))));
    assert.match(await said(), /it stops at/);
    await change();
    assert.equal(await said(), "");
  }
  await close();
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
  await page.focus("[name=mu]");
  await page.keyboard.press("Control+a");
  for (const key of ["Backspace", ..."0.05"]) await page.keyboard.press(key);
  await drawn();
  const announced = await page.evaluate(() => globalThis.announced);
  assert.deepEqual(announced.filter((text) => /must|needed|number/.test(text)), []);
  assert.equal((await state()).mu, 0.05);
  assert.equal(await page.getAttribute("[name=mu]", "aria-describedby"), "mu-error");
  await page.fill("[name=mu]", "abc");
  await page.keyboard.press("Tab");
  assert.equal(await page.inputValue("[name=mu]"), "0.05");
  assert.equal(await page.getAttribute("[name=mu]", "aria-invalid"), "false");
  await close();
});

test("the story is whole again after there was no motion", async () => {
  await open("#ball=puck&orbits=2.286,0.5");
  const story = await page.textContent("#story");
  await page.click("#orbits li .remove");
  assert.equal(await page.textContent("#story"), "Up: faster sliding. To the side: faster spin.");
  await page.click("#presets a");
  assert.equal(await page.textContent("#story"), story);
  await close();
});

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
    const [before, after] = [motion.lnV[lost - 1], motion.lnV[lost]];
    const share = (-300 * Math.LN10 - before) / (after - before);
    return { text, headline: document.getElementById("headline").textContent, story: document.getElementById("story").textContent, times: own.path / plain.path,
      stop: own.stop, end: own.end, orbits, bounce: Array.from(document.getElementById("bounce-says").textContent.matchAll(/([\d.]+)°/g), ([, angle]) => Number(angle)), cue: document.getElementById("cue-says").textContent,
      stops: motions.map(({ stop }) => stop), spinWhereLost: (motion.u[lost - 1] + share * (motion.u[lost] - motion.u[lost - 1])) / orbits[0].u };
  });
  const wanted = [
    [/Only a small part of the friction then slows the sliding/, /^Spin a puck, and it slides 4 times as far$/, ({ times }) => times > 3],
    [/Each motion is one curve/, /^Spin a ball, and it slides 19 times as far$/, ({ orbits }) => orbits.length === 4],
    [/twice as long until the stop/, /^Spin a puck, and it slides 2\.8 times as far$/, ({ stops }) => [0, 1].every((i) => Math.abs(stops[i] / stops[i + 1] - 2) < 1e-12)],
    [/to the left or to the right the ball slides equally far/, /^Spin a ball, and it slides 19 times as far$/, ({ stops }) => stops[0] === stops[1]],
    [/a little spin hardly matters: this pool ball slides (.*) farther than textbooks predict\. It still spins long after it has begun to roll/, /^This ball soon rolls, and keeps spinning$/,
      ({ times, stop, end, story, text }) => times < 1.05 && stop > 5 * end && story.includes(`${/slides (.*) farther/.exec(text)[1]} farther`)],
    [/below 10⁻³⁰⁰ m\/s while 9 % of the spin is left/, /^Spin a ball, and it slides 1\.9 times as far$/, ({ spinWhereLost }) => Math.round(100 * spinWhereLost) === 9],
    [/the ball that spins keeps more of its speed, and leaves at another angle/, /times as far$/, ({ bounce: [own, plain] }) => own > plain + 5],
    [/If the butt is raised, too, the path curves/, /^The path of this ball curves by 60°$/, ({ cue }) => /0\.4 radii right .* 0\.3 radii below/.test(cue)],
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

test("every preset says what is to be seen", async () => {
  await open();
  const wanted = { "Puck": /4 times/, "Gel ball": /19 times/, "Pool ball": /1\.9 times/, "Massé": /curves by 60°/, "Bounce": /slides 18 times as far/ };
  for (const link of await page.$$("#presets a")) {
    await link.click();
    assert.match(await page.textContent("#headline"), wanted[await link.textContent()]);
  }
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
  const fields = ["radius", "mass", "friction", "gravity", "patch", "rollingFriction"];
  for (const field of fields) {
    const usual = await page.inputValue(`#ball-fields [name=${field}]`);
    for (const value of values) {
      await page.fill(`#ball-fields [name=${field}]`, value);
      await look(`${field} ${value}`);
    }
    await page.fill(`#ball-fields [name=${field}]`, usual);
  }
  for (const value of [...values, "10", "1e-6"]) {
    await page.fill("[name=mu]", value);
    await look(`mu ${value}`);
  }
  await close();
  for (const fragment of ["#mu=1e-308", "#ball=gel&gravity=1e308", "#mu=1e-6&orbits=0.8,3.5"]) {
    await open(fragment, {}, false);
    await look(fragment);
    await close();
  }
  assert.deepEqual(wrong, []);
});
