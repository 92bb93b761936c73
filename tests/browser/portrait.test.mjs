// Portraits of the page: in each view they and their answers are those of the program.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { assertClose, clickPlane, close, dragSlider, drawn, folder, json, open, page, program, programStop, saved, slides, state, stopTimes, views } from "./browser.mjs";

/** Texts that are equal but for their numbers, and numbers that are equal but for the last digits of two C libraries; rounded, as TeX has them, the last may be rounded the other way. */
function assertSameText(text, wanted, what, rounded = false) {
  const number = /-?\d+(\.\d+)?(e[-+]?\d+)?/g;
  assert.equal(text.replace(number, "0"), wanted.replace(number, "0"), what);
  const words = text.match(number);
  const lastPlace = words.map((word) => (rounded && /^-?\d+\.\d{1,6}$/.test(word) ? 10 ** -word.split(".")[1].length : 0));
  const [numbers, wantedNumbers] = [words, wanted.match(number)].map((all) => all.map(Number));
  const largest = Math.max(...wantedNumbers.filter((value) => Math.abs(value) < 1e3).map(Math.abs));
  numbers.forEach((value, i) => {
    const error = Math.abs(value - wantedNumbers[i]);
    assert.ok(error <= 1e-9 * (largest + Math.abs(value)) + lastPlace[i], `${what}: number ${i} is ${value}, not ${wantedNumbers[i]}`);
  });
}

/** Runs the page's command line, and compares what the program draws with what the page shows. */
async function assertSamePicture(what) {
  const words = (await page.textContent("#command")).split(" ");
  assert.deepEqual(words.splice(0, 2), ["contensou", "portrait"]);
  const written = (ending) => {
    const name = join(folder, `portrait.${ending}`);
    // Data have neither a field of directions nor a style.
    const asked = ending === "json" ? words.filter((word, i) => ![word, words[i - 1]].some((option) => ["--field", "--style"].includes(option))) : words;
    execFileSync(program, ["portrait", ...asked.map((word) => (word === "portrait.svg" ? name : word))]);
    return readFileSync(name, "utf8");
  };
  const text = await page.evaluate(() => globalThis.page.library.plane.portraitFile(globalThis.page.store.request));
  assertSameText(text, written("tex"), `${what}, ${words.join(" ")}: tex`, true);
  // Of what the page itself draws: the orbits of its list, and those that fill a plane, begin where the program's do.
  const portrait = JSON.parse(written("json"));
  const { state, own, drawn, placed, isochrones } = await page.evaluate((V) => {
    const { state, library: { plane }, plane: { planeScene: { own, figure } } } = globalThis.page;
    return {
      state, placed: [...plane.place(1, 1e-300 * V)],
      own: own.map(({ index, stop, u, v, panels }) => ({ ...state.orbits[index], chosen: index === state.chosen, stop, us: [...u], vs: [...v], line: [...panels[0].line] })),
      drawn: figure.panels[0].lines.flatMap(({ lines }) => Array.from({ length: lines.length / 2 }, (_, i) => i)
        .filter((i) => i === 0 || Number.isNaN(lines[2 * i - 1])).map((i) => [lines[2 * i], lines[2 * i + 1]])),
      isochrones: figure.panels[0].lines.some(({ legend: [first] }) => first?.words.startsWith("time left")),
    };
  }, portrait.window[1]);
  assert.equal(portrait.view, state.view);
  const orbits = own.filter(({ u, v, chosen }) => chosen || (u !== 0 && v !== 0));
  const listed = [...(portrait.through ?? []), ...(portrait.highlight ? [portrait.highlight] : [])];
  assert.equal(listed.length, orbits.length, `${what}: --through and the start`);
  const near = (a, b) => Math.abs(a - b) <= 1e-9 * (1 + Math.abs(b));
  const [U, V] = portrait.window;
  listed.forEach((orbit, i) => {
    const { u, v, stop, us, vs } = orbits[i];
    if (Math.abs(u) > U || v > V) return;
    const rows = orbit.tau_left.flatMap((left, row) => (left < stop * (1 - 1e-12) ? [row] : []));
    assert.equal(us.length, rows.length + 1, `${what}: points of orbit ${i}`);
    rows.forEach((row, j) => assert.ok(near(us[j + 1], orbit.u[row]) && near(vs[j + 1], orbit.v[row]), `${what}: point ${j} of orbit ${i}`));
  });
  if (state.view !== "uv") return;
  assert.equal(isochrones, portrait.isochrones.length > 0, `${what}: isochrones`);
  // The axis of v is linear, or bent: h = (x + x^s)/2 with x = v/V.
  const linear = placed[1] < 1e-200 * V;
  const exponent = Math.log(2 * placed[1]) / Math.log(1e-300);
  const height = (lnX) => (linear ? V * Math.exp(lnX) : (Math.exp(lnX) + Math.exp(exponent * lnX)) / 2);
  const placeOf = (orbit, row) => [orbit.u[row], height(orbit.tau_left[row] === 0 ? -Infinity : orbit.ln_v[row] - Math.log(V))];
  const isNear = ([x, y]) => ([px, py]) => near(px, x) && near(py, y);
  for (const orbit of [...portrait.orbits, ...(portrait.against?.orbits ?? [])]) {
    assert.ok(drawn.some(isNear(placeOf(orbit, 0))), `${what}: an orbit from ${orbit.u[0]}, ${orbit.v[0]}`);
  }
  listed.forEach((orbit, i) => {
    const { u, v, line } = orbits[i];
    const rows = [[u, height(Math.log(v / V))], ...orbit.u.map((_, row) => placeOf(orbit, row))];
    const onBorder = (x, y) => near(Math.abs(x), U) || near(y, height(0));
    for (let at = 0; at < line.length; at += 2) {
      const [x, y] = line.slice(at, at + 2);
      assert.ok(Number.isNaN(x) || onBorder(x, y) || rows.some(isNear([x, y])), `${what}: ${x}, ${y} of the line of orbit ${i}`);
    }
  });
}

test("another view has a window of its own", async () => {
  await open("#law=exact&mu=0.3&view=log&orbits=0.8,3.5");
  await page.click("#zoom-in");
  assert.ok((await state()).window);
  await page.click("#views [value=uv]");
  assert.equal((await state()).window, null);
  await close();
});

test("pucks and stones lie flat: in seconds, as the program has them, and none rolls", async () => {
  for (const ball of ["puck", "curling-stone"]) {
    await open(`#ball=${ball}`);
    const wanted = json("stop", "--ball", ball);
    assertClose((await stopTimes())[0], wanted.tau_stop, 1e-12, ball);
    assertClose((await slides())[0].path, wanted.slip_length, 1e-10, `${ball}: how far`);
    assert.match(await page.textContent("#story"), /and stops/);
    assertClose(json(...(await page.textContent("#roll-command")).split(" ").slice(1)).path, wanted.slip_length, 1e-9, `${ball}: the path of its command line`);
    await assertSamePicture(ball);
    await close();
  }
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

test("mu is dragged, and everything follows", async () => {
  for (const law of ["pade", "exact"]) {
    await open(`#law=${law}&mu=0.9&orbits=0.8,3.5;-0.4,2`);
    const before = await stopTimes();
    await page.evaluate(() => {
      const { store } = globalThis.page;
      const change = store.change.bind(store);
      globalThis.redraws = 0;
      store.change = (edit) => {
        change(edit);
        globalThis.redraws += 1;
      };
    });
    await dragSlider("mu-slider", 0.98, 0.4, 60);
    const { mu, orbits } = await state();
    assert.ok(mu < 0.03 && mu > 0.005, `mu is ${mu}`);
    const times = await stopTimes();
    assert.ok(times[0] > 5 * before[0]);
    orbits.forEach(({ u, v }, i) => {
      assertClose(times[i], programStop("--mu", mu, "--u0", u, "--v0", v, "--law", law), 1e-12, `mu = ${mu}`);
    });
    const redraws = await page.evaluate(() => globalThis.redraws);
    assert.ok(redraws >= 30, `${redraws} redraws`);
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
    const line = entries.split("\n").findIndex((entry) => /with lines lc rgb '#c2185b' lw (2\.6|3\.4)/.test(entry));
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
      await page.click(`#views [value=${view}]`);
      const words = (await page.textContent("#command")).split(" ").slice(1);
      const name = join(folder, "portrait.gp");
      execFileSync(program, words.map((word) => (word === "portrait.svg" ? name : word)));
      const drawn = highlightedLines(readFileSync(name, "utf8"));
      const own = await page.evaluate(() => {
        const { panels } = globalThis.page.plane.planeScene.own.find(({ chosen }) => chosen);
        return panels.map(({ line }) => [...line].map((x, i) => [x, line[i + 1]]).filter(([x], i) => i % 2 === 0 && !Number.isNaN(x)));
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
  let clicks = 0;
  for (const view of views) {
    await page.click(`#views [value=${view}]`);
    assert.ok(await page.isChecked(`#views [value=${view}]`));
    await drawn();
    const picture = await page.evaluate(() => document.getElementById("plane").toDataURL());
    pictures.add(picture);
    const panels = await page.evaluate(() => globalThis.page.plane.frames.length);
    for (let panel = 0; panel < panels; ++panel) {
      // Where no orbit is near, which a click would choose.
      const free = await page.evaluate((panel) => {
        const { plane, plane: { frames: { [panel]: frame } } } = globalThis.page;
        const shares = [0.3, 0.7, 0.2, 0.4, 0.6, 0.5, 0.8, 0.1, 0.9];
        const points = shares.flatMap((y) => shares.map((x) => [frame.left + x * frame.width, frame.top + y * frame.height]));
        const point = points.find(([x, y]) => plane.pointed(x, y) && plane.orbitAt(x, y, "touch") === null);
        const { u, v } = plane.pointed(...point);
        return [u, v];
      }, panel);
      await clickPlane(...free, panel);
      const { orbits: all } = await state();
      assert.equal(all.length, 2, `a click in panel ${panel} of ${view}`);
      // Not every view shows the side.
      assertClose(Math.abs(all[1].u), Math.abs(free[0]), 0.06, `u in panel ${panel} of ${view}`);
      assertClose(all[1].v, free[1], 0.06, `v in panel ${panel} of ${view}`);
      // Else the next click would choose it.
      await page.focus("#plane");
      await page.keyboard.press("Delete");
      clicks += 1;
    }
  }
  assert.equal(pictures.size, 4);
  assert.equal(clicks, 5);
  await close();
});

test("a link reproduces the page", async () => {
  await open("#law=exact&mu=0.25&window=2,3&orbits=1,2");
  await clickPlane(0.7, 1.2);
  await page.click("#views [value=log]");
  await page.fill("[name=mu]", "0.125");
  await dragSlider("time", 0.02, 0.3, 5);
  await page.click("#copy-link");
  const [link, before, times] = [page.url(), await state(), await stopTimes()];
  await close();
  await open(link.slice(link.indexOf("#")));
  const after = await state();
  assert.ok(Math.abs(after.fraction - before.fraction) < 1e-3);
  assert.deepEqual({ ...after, fraction: 0 }, { ...before, fraction: 0 });
  assert.deepEqual(await stopTimes(), times);
  await close();
});

test("where sliding has underflowed inside the window, its orbits are drawn all the same", async () => {
  await open("#law=exact&mu=0.01&window=0.1,1&orbits=0.8,3.5;0.05,0.5&chosen=1");
  assert.equal((await state()).mu, 0.01);
  assert.equal(await page.textContent("#problem"), "");
  await assertSamePicture("a small window");
  await close();
});

test("a real ball: seconds, its fields, its path, and its command line", async () => {
  await open("#mu=0.3");
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
    "#ball=pool&law=pade&view=log&radius=0.03&patch=0.001&orbits=0.5,1;-0.2,0.3;0.4,0.01",
    "#ball=pool&law=exact&view=log&orbits=",
    `#law=pade&mu=0.05&window=1,5&${three}`,
    `#law=exact&mu=0.02&view=blowup&against=pade&${three}`,
    "#law=uniform&body=disc&view=disc&orbits=0.8,0.7;0.3,0.9&against=ring",
    "#law=pressure:2.5&against=pressure:-0.25&mu=0.4&field=motion&orbits=0.8,2;0,1;0.3,0",
    `#law=elliptic&mu=0.3&field=motion&isochrones=0&theme=dark&${three}`,
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

/** The legend of the plane, which is drawn where it is in sight. */
async function planeLegend() {
  await page.locator("#plane").scrollIntoViewIfNeeded();
  await drawn();
  await drawn();
  return page.evaluate(() => globalThis.page.plane.planeScene.figure.panels[0].lines.map(({ legend }) => legend.map(({ words }) => words).join("")));
}

test("another law is drawn against the first, and leaves again", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  assert.ok(!(await planeLegend()).includes("law pade"));
  await page.selectOption("#against", "pade");
  assert.ok((await planeLegend()).includes("law pade") && (await planeLegend()).includes("law exact"));
  assert.match(await page.getAttribute("#plane", "aria-label"), /exact against pade/);
  assert.match(await page.textContent("#command"), / --against pade /);
  assert.match((await saved("#save-svg")).toString(), />law pade</);
  await page.click("#copy-link");
  assert.match(page.url(), /against=pade/);
  assert.ok(await page.evaluate(() => document.querySelector("#against option[value=exact]").disabled));
  await page.selectOption("#law", "pade");
  assert.doesNotMatch(await page.textContent("#command"), /against/);
  assert.equal(await page.inputValue("#against"), "", "a law is not compared with itself");
  await page.selectOption("#law", "exact");
  assert.match(await page.textContent("#command"), / --against pade /);
  await page.selectOption("#against", "");
  assert.ok(!(await planeLegend()).includes("law pade"));
  assert.doesNotMatch(await page.textContent("#command"), /against/);
  await close();
});

test("fields and isochrones are switched where a view draws them", async () => {
  await open("#law=exact&mu=0.3&orbits=0.8,3.5");
  const legend = async () => (await planeLegend()).join(";");
  assert.match(await legend(), /time left/);
  await page.uncheck("#isochrones");
  assert.doesNotMatch(await legend(), /time left/);
  assert.match(await page.textContent("#command"), / --isochrones 0 /);
  await page.selectOption("#field", "motion");
  assert.match(await legend(), /direction of the motion/);
  await page.click("#copy-link");
  assert.match(page.url(), /field=motion&isochrones=0/);
  await page.click("#views [value=disc]");
  assert.ok((await page.isDisabled("#field")) && (await page.isDisabled("#isochrones")));
  await page.click("#views [value=uv]");
  assert.match(await legend(), /direction of the motion/);
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
  await page.focus("#views :checked");
  await page.keyboard.press("ArrowRight");
  assert.equal((await state()).view, "log");
  await close();
});

test("bodies that end on a ray, or with k growing, are explored like balls", async () => {
  const cases = [
    ["#law=uniform&body=disc&window=1,1&orbits=0.8,0.7;0.3,0.9;0.9,0.1", ["--body", "disc", "--law", "uniform"], /k → 0\.653/],
  ];
  for (const [fragment, words, limit] of cases) {
    await open(fragment);
    assert.match(await page.textContent("#terminal"), limit);
    for (const view of views) {
      await page.click(`#views [value=${view}]`);
      assert.ok(await page.evaluate(() => globalThis.page.plane.planeScene.figure.panels.every((panel) =>
        panel.lines.reduce((sum, { lines }) => sum + (lines.length > 0) + [...lines].filter(Number.isNaN).length / 2, 0) >= 5)), view);
    }
    const times = await stopTimes();
    (await state()).orbits.forEach(({ u, v }, i) => {
      assertClose(times[i], programStop("--u0", u, "--v0", v, ...words), 1e-12, `${words.join(" ")}, u0 = ${u}, v0 = ${v}`);
    });
    await close();
  }
});

test("no words of a picture are cut", async () => {
  await open("#body=shell&law=pressure:0.4&against=pade&mu=0.4&orbits=0.8,3.5", { viewport: { width: 1440, height: 900 } });
  const beyond = await page.evaluate((svg) => {
    const holder = document.createElement("div");
    holder.innerHTML = svg;
    document.body.append(holder);
    const { left, right } = holder.firstElementChild.getBoundingClientRect();
    const boxes = Array.from(holder.querySelectorAll("text"), (text) => [text.textContent, text.getBoundingClientRect()]);
    return boxes.filter(([, box]) => box.left < left - 1 || box.right > right + 1).map(([words]) => words);
  }, String(await saved("#save-svg")));
  assert.deepEqual(beyond, []);
  await close();
});
