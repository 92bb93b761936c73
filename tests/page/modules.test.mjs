// The page's modules that need no browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { commandLine } from "../../src/page/plane/command_line.js";
import { csvOfFilm, csvOfOrbits, csvOfRide } from "../../src/page/share/exports.js";
import { strikeOf } from "../../src/page/cards/cue.js";
import { sizeOf } from "../../src/page/plane/copies.js";
import { panelsOf } from "../../src/page/plane/copies_figure.js";
import { drawLanes } from "../../src/page/hero/hero_figure.js";
import { Frame } from "../../src/page/drawing/frame.js";
import { decades, parseNumber, roundDown, shown, superscript } from "../../src/page/numbers.js";
import { allowed, bodyOf, fromFragment, initialState, moved, speaksOfNothing, startOf, takeBall, toFragment } from "../../src/page/state/page_state.js";
import { packed, unpacked } from "../../src/page/packing.js";
import { portraitRequest } from "../../src/page/plane/portrait_request.js";
import { presets, tour } from "../../src/page/state/presets.js";
import { italic, plain, runsOf } from "../../src/page/drawing/runs.js";
import { Store } from "../../src/page/state/store.js";
import { answers, goal, judged, question, regimeOf, say } from "../../src/page/hero/story.js";
import { lineOf, passageOf, rightOf, stoneOf } from "../../src/page/hero/tries.js";
import { rideOn, rotation, turnedBy } from "../../src/page/hero/turning.js";
import { described } from "../../src/page/plane/views.js";

// Letters of one width, where a browser would measure them.
const context = { measureText: (text) => ({ width: 7 * text.length }) };
globalThis.document = /** @type {any} */ ({ createElement: () => ({ getContext: () => context }) });

/** As much of the library as a state needs. */
const gel = {
  name: "gel", title: "gel ball on a rigid plane", body: "ball", law: "exact", sources: "", patchBy: "patch_radius",
  radius: 0.03, mass: 0.1, friction: 0.5, gravity: 9.8, patch: 0.007, slip: 0.5, spin: 300,
};
const known = {
  balls: [gel, { ...gel, name: "puck", body: "disc", law: "uniform", patchBy: "whole_face" }],
  bodies: [{ name: "ball", chi: 3.5, gamma: 2.5 }, { name: "disc", chi: 1, gamma: 2, mu: 1 }],
  views: ["uv", "log", "disc"].map((name) => ({ name, layered: name === "uv" })),
  lawName(called) {
    if (!/^(exact|pade|uniform|pressure:-?[\d.]+)$/.test(called)) throw new Error(`no such law: ${called}`);
    return called;
  },
};

test("numbers are read as people type them, and a reason is given for what is none", () => {
  assert.deepEqual(["1.5", " −2e-3 ", "-0"].map(parseNumber), [1.5, -0.002, -0]);
  for (const [text, reason] of [["0x10", /'0x10' is not/], ["1e", /not/], [".", /not/], ["Infinity", /not/], ["", /needed/], ["0,5", /write 0\.5/], ["abc", /'abc' is not/], ["1e999", /finite/]]) assert.throws(() => parseNumber(text), reason);
});

test("numbers are shown with a few digits, in signs that people write", () => {
  const cases = { 0: "0", 0.1: "0.1", "-2.5": "−2.5", 1234567: "1.2346·10⁶", 0.00001234: "1.234·10⁻⁵", Infinity: "∞", "-Infinity": "−∞", 99999: "99999" };
  for (const [value, text] of Object.entries(cases)) assert.equal(shown(Number(value)), text);
  assert.equal(shown(Math.PI, 3), "3.14");
  assert.equal(superscript(-120), "⁻¹²⁰");
});

test("powers of ten are few, round, and inside", () => {
  for (const [low, high] of [[-6.1, 0.1], [-1.5, 1.5], [-300, 2], [-7, 2]]) {
    const { ticks } = decades(low, high);
    assert.ok(ticks.length >= 2 && ticks.length <= 6, `${low} to ${high}: ${ticks.length}`);
    for (const { at } of ticks) assert.ok(at >= low && at <= high && Number.isInteger(at));
  }
  assert.deepEqual(decades(-1.5, 1.5).ticks.map(({ text }) => text), ["10⁻¹", "1", "10¹"]);
  assert.deepEqual(decades(-1.6, -0.1).ticks.map(({ text }) => text), ["0.05", "0.1", "0.2", "0.5"], "few have more between them");
  assert.deepEqual([99, 20, 0.07].map(roundDown).map((value) => Number(value.toPrecision(12))), [50, 20, 0.05]);
});

test("a text is a string, or strings and runs", () => {
  const index = { words: "0", italic: false, level: -1 };
  assert.deepEqual(runsOf([italic("u"), index, " = 10"]), [
    { words: "u", italic: true, level: 0 }, index, { words: " = 10", italic: false, level: 0 },
  ]);
  assert.deepEqual(runsOf("a_b"), [{ words: "a_b", italic: false, level: 0 }]);
  assert.equal(plain(["law ", italic("k"), "*"]), "law k*");
});

test("bytes come back from the text that they are packed into, which may stand in a script and in an attribute", () => {
  for (const length of [0, 1, 2, 18, 19, 20, 38, 39, 4099]) {
    const bytes = Uint8Array.from({ length }, (_, i) => (i * i * 31 + 7 * i) % 256);
    const text = packed(bytes);
    assert.deepEqual(unpacked(text), bytes, `${length} bytes`);
    assert.match(text, /^\d+ /);
    // Readers of HTML change no other character of ASCII in a text of a script.
    assert.ok([...text].every((letter) => letter <= "\x7f" && !"\0\n\r\x1a\"<\\".includes(letter)));
    assert.ok(text.length <= 5 + 22 * Math.ceil(length / 19));
  }
});

test("every state comes back from its link", () => {
  const states = [
    {}, { law: "pressure:-0.25", against: "pade", mu: 0.125, lab: true }, { body: "disc", mu: 1 },
    { view: "log", window: [2, 3e-7], field: "motion", isochrones: 0, theme: "dark" },
    { orbits: [startOf(-1e-5, 0), startOf(1e20, 3, 3, 0, 170)], chosen: 1, fraction: 0.25, part: "sliding", isochrone: 1.5, step: 5 }, { orbits: [], chosen: 0 },
  ].map((part) => ({ ...initialState(), ...part }));
  const ball = initialState();
  Object.assign(takeBall(ball, gel), { friction: 0.125, patchBy: "spin_deceleration", patch: 12.5 });
  ball.orbits = [startOf(1, 2), startOf(3, 4, -1, 0.25), startOf(3, 4, 4, 0, -45)];
  for (const state of [...states, ball, { ...ball, line: 2, part: "whole", embed: true, lab: true, ball: { ...ball.ball, slope: -2 } }]) assert.deepEqual(fromFragment(`#${toFragment(state)}`, known), state);
});

test("what cannot be read in a link is told, and what can be read is not", () => {
  const told = (link) => {
    const problems = [];
    fromFragment(link, known, problems);
    return problems.join("\n");
  };
  for (const part of ["law=nonsense", "against=nonsense", "body=1", "mu=2", "mu=x", "view=none", "window=1", "window=0,1", "field=up", "isochrones=3", "part=none",
    "orbits=x", "chosen=-1", "line=-1", "day=2026-02-30", "day=tomorrow", "tries=-1", "tries=1e9", "drop=x", "restitution=2", "step=9", "at=2", "isochrone=0", "theme=red", "friction=0.2"]) {
    const [key] = part.split("=");
    assert.match(told(key === "mu" ? part : `mu=0.3&${part}`), new RegExp(`^${part} of the link is left out: .+\\.$`), part);
  }
  for (const [key, value] of [["patchBy", "none"], ["friction", "-1"], ["radius", "0"], ["slope", "90"], ["rollingFriction", "-1"]]) {
    assert.match(told(`ball=${gel.name}&${key}=${value}`), new RegExp(`^${key}=${value} of the link is left out: .+\\.$`));
  }
  assert.match(told("mu=0.3&orbits=x;1,-1;0.5,1"), /^orbits=x of .+\norbits=1,-1 of .+\.$/);
  assert.match(told("ball=golf&orbits=1,2"), /^There is no ball 'golf'\. Balls: .*gel/);
  assert.match(told(`law=${"x".repeat(5000)}`), /^law=x{60}… of the link/);
  for (const link of ["", "#embed", "#utm_source=x", "mu=0.3&orbits=&at=0&theme=auto", ...presets.map(({ fragment }) => fragment).filter((fragment) => /gel|^$/.test(fragment))]) assert.equal(told(link), "", link);
});

test("a link that the library rejects opens the body that was asked for with its own start, else the opening", () => {
  const opened = (link, rejects) => {
    const store = new Store(/** @type {any} */ (known), fromFragment(link, known));
    store.compute = (state) => {
      if (rejects(state)) throw new Error("rejected");
    };
    const told = [];
    store.tell = (words) => told.push(words);
    store.ask(() => {}, undefined, ["besides"]);
    assert.deepEqual(told, ["rejected besides"], link);
    return store.state;
  };
  const { gravity } = gel;
  for (const [link, rejects] of /** @type {[string, (state: State) => boolean][]} */ ([
    ["ball=gel&orbits=1e308,1e308", ({ orbits }) => orbits[0].u > 1e300], ["ball=gel&slope=80&orbits=1,2", ({ ball }) => ball?.slope === 80],
    ["ball=gel&gravity=1e-9&lab=1", ({ ball }) => ball?.gravity !== gravity],
  ])) {
    const state = opened(link, rejects);
    assert.deepEqual([state.ball, state.orbits, state.lab], [fromFragment("ball=gel", known).ball, fromFragment("ball=gel", known).orbits, /lab/.test(link)], link);
  }
  const plain = opened("mu=0.2&law=pade&orbits=1e308,1", ({ orbits }) => orbits[0].u > 1e300);
  assert.deepEqual([plain.ball, plain.mu, plain.law, plain.orbits], [null, 0.2, "pade", initialState().orbits]);
  assert.equal(opened("mu=0.2&view=log", ({ view }) => view === "log").mu, 0.2, "the motion stays where the plane is rejected");
  assert.equal(opened("ball=gel", ({ ball }) => ball?.name === "gel").ball?.name, "puck");
});

test("what cannot be read in a link keeps its first value", () => {
  const first = initialState();
  for (const part of ["law=nonsense", "mu=-1", "mu=x", "view=none", "window=1", "window=0,1", "orbits=x", "mu=0.3&at=2", "body=1", "body=1.5,2.5", "view=pair", "isochrones=3", "part=none", "mu=0.3&theme=red", "mu=0.3&step=9", "mu=0.3&line=1"]) {
    const state = fromFragment(part, known);
    assert.deepEqual({ ...state, orbits: part.startsWith("orbits") ? first.orbits : state.orbits, lab: false }, first, part);
  }
  assert.deepEqual(fromFragment("orbits=x;1;1,-1;0.5,1;1,2,x&chosen=7", known).orbits, [startOf(0.5, 1)]);
  assert.deepEqual(fromFragment("mu=0.3&orbits=1,2,3,4", known).orbits, [startOf(1, 2)], "without units nothing is known of the centre");
  assert.deepEqual(fromFragment("ball=puck&orbits=1,2,3,4", known).orbits, [startOf(1, 2)], "a puck does not turn forward");
  assert.deepEqual(fromFragment("ball=puck&orbits=1,2,3,4,30", known).orbits, [startOf(1, 2, 2, 0, 30)], "but it is thrown somewhere");
  assert.equal(fromFragment("body=disc&mu=0.2", known).mu, 1, "a puck's mu is its own");
  assert.equal(fromFragment("mu=7", known).mu, 0.3, "no patch is larger than the body");
  // Nor is a link that was cut or mangled another world.
  for (const link of ["", "#garbage", "#%", "#utm_source=x", "#ball=golf&orbits=1,2&view=log"]) assert.deepEqual(fromFragment(link, known), fromFragment("ball=puck&orbits=2.286,0.5", known), link);
  assert.deepEqual(["#embed", "#embed=1", "#embed=0"].map((link) => fromFragment(link, known).embed), [true, true, false]);
  // The Lab is open where a link says so, or speaks of what it alone shows.
  assert.deepEqual(["", "#ball=puck&orbits=1,2", "#view=log", "#lab=1", "#view=log&lab=0"].map((link) => fromFragment(link, known).lab), [false, false, true, true, false]);
  assert.deepEqual(["", "#garbage", "#theme=dark", "#embed", "#ball=golf", "#mu=0.3", "#ball=puck"].map((link) => speaksOfNothing(link, known)), [true, true, true, true, true, false, false]);
});

test("chi, gamma and a fixed mu are the library's", () => {
  assert.deepEqual(bodyOf(initialState(), known), { name: "ball", chi: 3.5, gamma: 2.5 });
  assert.equal(bodyOf({ ...initialState(), body: "disc" }, known).mu, 1);
});

test("presets and steps of the tour are links that are understood", () => {
  const balls = ["gel", "pool", "bowling", "puck", "curling-stone"].map((name) => ({ ...gel, name }));
  const views = ["uv", "log", "blowup", "disc"].map((name) => ({ name }));
  for (const { fragment } of [...presets, ...tour]) {
    const state = fromFragment(fragment, { ...known, balls, views });
    const query = new URLSearchParams(fragment);
    const written = new URLSearchParams(toFragment(state));
    for (const [key, value] of query) assert.equal(written.get(key) ?? { part: "sliding", body: "disc", law: state.ball?.law }[key] ?? "none", value, `${fragment}: ${key}`);
  }
});

test("a start that is moved keeps how the ball turns forward; one that does not turn is exact", () => {
  assert.deepEqual(moved(startOf(1, 0.5), 2, 0.3), startOf(2, 0.3));
  assert.deepEqual(moved(startOf(1, 0.5, 0.75, -2, 20), 1, 0.25), startOf(1, 0.25, 0.5, -2, 20));
});

test("a link carries what differs from what it would open", () => {
  const puck = fromFragment("", known);
  puck.orbits.push(startOf(3.044, 0.994, 0.994, 0, -11));
  assert.equal(toFragment({ ...puck, chosen: 1 }), "ball=puck&orbits=2.286,0.5;3.044,0.994,0.994,0,-11&chosen=1");
  puck.ball.friction = 0.2;
  assert.equal(toFragment({ ...puck, orbits: [startOf(1, 2)], lab: true }), "ball=puck&friction=0.2&orbits=1,2&lab=1");
  assert.equal(toFragment({ ...initialState(), view: "log", lab: true }), "mu=0.3&view=log&orbits=0.8,3.5");
  assert.equal(toFragment({ ...initialState(), lab: false }), "mu=0.3&orbits=0.8,3.5&lab=0");
});

test("the address of the opening asks: it holds no motion, at its start, at its end, and while the page asks", () => {
  const opening = fromFragment("", known);
  for (const [change, asks, text] of /** @type {[Partial<State>, boolean, string][]} */ ([[{}, false, ""], [{ fraction: 1 }, false, ""], [{ fraction: 0.3 }, true, ""],
    [{ fraction: 0.3 }, false, "ball=puck&orbits=2.286,0.5&at=0.3"], [{ theme: "dark", lab: true }, false, "theme=dark&lab=1"],
    [{ line: 2 }, false, "line=2"], [{ line: 2, tries: 3 }, false, "line=2&tries=3"], [{ orbits: [startOf(2.3, 0.5)] }, false, "ball=puck&orbits=2.3,0.5"]])) {
    const fragment = toFragment({ ...opening, ...change }, asks);
    assert.equal(fragment, text);
    assert.equal(speaksOfNothing(fragment, known), text === "" || text.startsWith("theme"));
  }
});

test("a dare holds the line and the tries, and the line of a day follows from the day alone", () => {
  const { ball, orbits, line, tries, day } = fromFragment("line=2.5&tries=3", known);
  assert.deepEqual([ball?.name, orbits, line, tries, day], ["puck", [startOf(2.286, 0.5)], 2.5, 3, ""]);
  const daily = fromFragment("day=2026-11-28&tries=2", known);
  assert.deepEqual([daily.line, daily.day, daily.tries], [2.61, "2026-11-28", 2]);
  assert.equal(toFragment(daily), "day=2026-11-28&tries=2");
  assert.equal(fromFragment("mu=0.3&day=2026-11-28", known).line, 0, "without units there is no metre");
  const days = Array.from({ length: 4000 }, (_, i) => lineOf(new Date(86_400_000 * (20_454 + i)).toISOString().slice(0, 10)));
  assert.ok(days.every((line, i) => line >= 0.6 && line <= 3 && Math.abs(line - days[(i + 1) % days.length]) > 0.1 && line === Number(line.toFixed(2))));
  assert.ok(new Set(days).size > 230);
});

test("a law is not compared with itself in a link", () => {
  assert.doesNotMatch(toFragment({ ...initialState(), law: "pade", against: "pade" }), /against/);
});

test("numbers from which nothing can follow are refused in the words of the others", () => {
  for (const [key, value, words] of [["gravity", 1e308, /: from 1·10⁻⁹ to 1·10⁹ is allowed$/], ["mass", 0, /positive/], ["mu", 1e-308, /from/], ["rollingFriction", -1, /from 0 to 1000/]]) {
    assert.throws(() => allowed(key, value), words);
  }
  for (const [key, value] of [["rollingFriction", 0], ["along", -3], ["U", 1e200]]) assert.equal(allowed(key, value), value);
  const { ball, mu } = fromFragment("ball=gel&gravity=1e308&patch=1e-308", known);
  assert.deepEqual([ball.gravity, ball.patch], [gel.gravity, gel.patch]);
  assert.equal(mu, 0.3);
  assert.deepEqual([fromFragment("mu=1e-308", known).mu, fromFragment("body=1e308,1", known).body], [0.3, "ball"]);
});

/** A gel ball that leaves at 0.5 m/s, or what differs from it. */
const facts = (other = {}) => ({
  name: "gel ball", real: true, rolls: true, slip: 0.5, spin: 300, along: other.slip ?? 0.5, across: 0, least: 0.001, stop: 5.17,
  own: { end: 0.627, path: 0.239, turned: 0 }, plain: { end: 0.0291, path: 0.0125, turned: 0 }, ...other,
});
const path = (path, turned = 0) => ({ end: 1, path, turned });
const puck = { name: "ice hockey puck", rolls: false };

test("what there is to see follows from the numbers, and is said in words without powers of ten", () => {
  const table = [
    ["much", {}, /slides 19 times as far$/, /slides 12\.5 mm, then rolls\. Textbooks: 12\.5 mm for both\. .* with 48 turns a second: it slides 0\.239 m, 19 times as far, and takes 22 times as long\.$/],
    ["much", { ...puck, own: path(0.515), plain: path(0.127) }, /Spin a puck, and it slides 4\.1 times/, /and stops\. Textbooks: 0\.127 m/],
    ["more", { own: path(1.1), plain: path(1) }, /ball slide 10 % farther/, /slides 1 m, then rolls\. Textbooks: 1 m for both\./],
    ["soon", { own: path(1.000000001), plain: path(1) }, /soon rolls/, /slides 1 m, equally far, and/],
    ["soon", { own: path(1.01), plain: path(1) }, /soon rolls, and keeps spinning/, /Its spin ends after 5\.17 s/],
    ["together", { ...puck, own: path(1.01), plain: path(1) }, /puck slides hardly farther, and spins to the end/, /1 % farther, and takes/],
    ["curves", { across: 1, own: path(1.01, -60), plain: path(1, 59) }, /curves by 60°/, /Its slip of 0\.5 m\/s.*bend by 59°/],
    ["soon", { across: 1, own: path(1.01, 2), plain: path(1) }, /soon rolls/, /land with a slip of/],
    ["plain", { spin: 0, own: path(0.0125) }, /^Without spin, textbooks are right$/, /leaves at 0\.5 m\/s and does not spin: it slides 12\.5 mm, then rolls/],
    ["rolls", { slip: 1e-34, along: 0.3, own: path(0), plain: path(0) }, /already rolls/, /Its spin ends after 5\.17 s/],
    ["rolls", { slip: 1e-34, along: 0.3, spin: 0, own: path(0), plain: path(0) }, /already rolls/, /too slowly to be seen\.$/],
    ["rolls", { slip: 0.0011, own: path(1e-6), plain: path(1e-9) }, /rolls almost at once/, /slides for only 1 s and /],
    ["spins", { slip: 1e-34, own: path(0), plain: path(0) }, /spins in place/, /stops after 5\.17 s/],
    ["spins", { ...puck, slip: 0, own: path(0), plain: path(0) }, /A puck that spins in place/, /./],
    ["rests", { slip: 0, spin: 0, own: path(0), plain: path(0) }, /at rest/, /./],
    ["more", { real: false, name: "ball", spin: 0.8, slip: 3.5, least: 0.0075, own: path(15.7), plain: path(14.1) }, /11 % farther/, /leave at v = 3\.5.*with u = 0\.8/],
  ];
  const seen = new Set();
  for (const [regime, other, headline, story] of table) {
    const all = facts(/** @type {any} */ (other));
    assert.equal(regimeOf(all), regime, JSON.stringify(other));
    const said = say(all);
    assert.match(said.headline, headline);
    assert.match(said.story, story);
    for (const [kind, words] of said.pieces) assert.ok(["", "own", "plain", "times"].includes(kind) && (words || !kind));
    assert.doesNotMatch(said.story, /[[\]|]/);
    assert.doesNotMatch(`${said.headline} ${said.story}`, /NaN|Infinity|∞|undefined|·10/);
    seen.add(regime);
  }
  assert.equal(seen.size, 9);
  assert.match(say(facts({ rest: { t: 12, x: 3, y: 4 } })).story, /It rests after 12 s, 5 m from its start\.$/);
});

test("a guess is judged by what was seen, and a try for the line by where it ended", () => {
  const seen = facts(/** @type {any} */ ({ ...puck, own: path(0.515), plain: path(0.127) }));
  assert.equal(judged(answers.equal, seen), "You said equally far, as textbooks do: 0.127 m. The one that spins went 0.515 m");
  assert.match(judged(answers.spins, seen), /^You are right: the one that spins went 0\.515 m, the other 0\.127 m$/);
  assert.match(judged(answers.plain, seen), /it went 0\.127 m\. The one that spins went 0\.515 m$/);
  // Until then nothing tells.
  for (const guess of ["", answers.equal]) assert.doesNotMatch(JSON.stringify(question(guess)), /\d/);
  const tried = (other) => goal({ line: 1, day: "", far: 0.999, slip: 0.5, spin: 119, tries: 3, theirs: 0, ended: true, hit: true, ...other }).headline;
  assert.equal(tried({}), "18.9 turns a second give 0.999 m: the line, in 3 tries");
  assert.match(tried({ theirs: 2 }), /in 3 tries; your friend needed 2$/);
  assert.equal(tried({ theirs: 2, tries: 0, ended: false }), "A friend reached the line in 2 tries. You?");
  assert.match(tried({ theirs: 1, tries: 0, ended: false, passage: { until: 1, off: 0 } }), /around the stone in 1 try\. You\?$/);
  assert.match(tried({ tries: 1 }), /in 1 try$/);
  assert.match(tried({ far: 0.72, hit: false }), /: 0\.28 m short of the line$/);
  assert.match(tried({ far: 1.25, hit: false }), /: 0\.25 m beyond the line$/);
  assert.equal(tried({ ended: false }), "Same push, 0.5 m/s. Reach the line, by spin alone.");
});

const requestOf = (state) => portraitRequest(state, bodyOf(state, known), false);

test("a request is what the state asks the library for", () => {
  const state = { ...initialState(), against: "exact", orbits: [{ u: 1, v: 2 }, { u: 3, v: 4 }], chosen: 1 };
  const { against, ball, chi } = requestOf(state);
  assert.deepEqual([against, ball, chi], [null, null, 3.5], "a law is not compared with itself");
  takeBall(state, gel);
  const { velocity, angular_velocity, patch_radius } = requestOf(state).ball;
  assert.deepEqual([velocity, angular_velocity, patch_radius], [[0.5, 0], [0, 0, 300], 0.007]);
  assert.equal(requestOf({ ...state, orbits: [] }).ball, null, "without a motion only the mu of a ball");
});

test("the command line names what differs from what the program would do", () => {
  const line = (state, through = []) => commandLine(state, requestOf(state), through, bodyOf(state, known), gel);
  const state = { ...initialState(), lab: true, orbits: [{ u: 0.8, v: 3.5 }], window: [1, 2], against: "pade", isochrones: 0, field: "motion" };
  assert.deepEqual(line(state, [{ u: -1, v: 0.5 }]), {
    portrait: "contensou portrait --mu 0.3 --u0 0.8 --v0 3.5 --law exact --against pade --view uv --scale linear --window 1,2 --through -1,0.5 --isochrones 0 --field motion -o portrait.svg",
    roll: null,
  });
  const ball = initialState();
  takeBall(ball, gel).friction = 0.25;
  Object.assign(ball, { lab: true }).orbits[0].across = 1.5;
  assert.deepEqual(line(ball), {
    portrait: "contensou portrait --ball gel --friction 0.25 --slip 0.5 --spin 300 --law exact --view uv --scale linear -o portrait.svg",
    roll: "contensou roll --ball gel --friction 0.25 --velocity 0.5,1.5 --angular-velocity -50,0,300 --law exact",
  });
});

test("a cue's stroke follows from the start that it gives", () => {
  const ball = { gamma: 2.5, masses: 0.3, elevation: 20, offset: 0.5 };
  /** The formulas of si::struck: cue along x, R = 1. */
  const struck = (speed, right, above, degrees) => {
    const [cos, sin] = [Math.cos(degrees * Math.PI / 180), Math.sin(degrees * Math.PI / 180)];
    const impulse = (2 * speed) / (1 + ball.masses + ball.gamma * (right ** 2 + above ** 2));
    const [vx, wx, wy, wz] = [impulse * cos, ball.gamma * impulse * right * sin, ball.gamma * impulse * above, ball.gamma * impulse * right * cos];
    const slip = Math.hypot(vx - wy, wx);
    return startOf(wz, slip, (vx * (vx - wy)) / slip, (-vx * wx) / slip);
  };
  for (const stroke of [[2, 0.3, -0.2, 30], [1, -0.4, 0.3, 75], [3, 0.5, 0, 0], [3, 0, -0.5, 20], [3, 0, 0.5, 20]]) {
    const { speed, right, above, elevation } = strikeOf(struck(...stroke), ball) ?? assert.fail(`${stroke}`);
    [speed, right, above, elevation].forEach((value, i) => assert.ok(Math.abs(value - stroke[i]) <= 5.1e-5, `${stroke}: ${[speed, right, above, elevation]}`));
  }
  assert.equal(strikeOf(startOf(3, 4, 0.9, 0.9), ball), null, "a raised cue turns the ball to the side of its spin");
  assert.equal(strikeOf(startOf(0, 4, 0.9, 0.9), ball), null);
  assert.equal(strikeOf(startOf(1, 1, 0, 0), ball), null);
});

test("a film is handed out with what was found and what is left, angles up to whole turns", () => {
  const columns = { t: [0, 1], slip: [1, 0.5], slip_fitted: [0.75, 0.5], angle: [7, 1], angle_fitted: [7 - 2 * Math.PI, 0.5], note: [1, 2] };
  assert.equal(csvOfFilm(columns), `t,slip,slip_fitted,slip_residual,angle,angle_fitted,angle_residual\n0,1,0.75,0.25,7,${7 - 2 * Math.PI},0\n1,0.5,0.5,0,1,0.5,0.5\n`);
});

test("a table of orbits has the program's words for infinity, that of a ride the program's columns", () => {
  const motion = { tau: [0, 1], u: [1, 0], v: [2, 0], lnV: [0.5, -Infinity], k: [2, Infinity] };
  assert.equal(csvOfOrbits([motion]), "orbit,tau,u,v,ln_v,k\n1,0,1,2,0.5,2\n1,1,0,0,-inf,inf\n");
  const names = ["t", "x", "y", "vx", "vy", "wx", "wy", "wz", "slip", "energy"];
  assert.equal(csvOfRide(Object.fromEntries([...names, "rest"].map((name, i) => [name, [i, -i]]))), `${names}\n0,1,2,3,4,5,6,7,8,9\n0,-1,-2,-3,-4,-5,-6,-7,-8,-9\n`);
});

test("a start is a copy of another where both speeds are as many times as large", () => {
  const near = ({ c, along }, wanted, isCopy) => assert.ok(Math.abs(c - wanted) < 1e-9 && along === isCopy, `${c} ${along}`);
  near(sizeOf({ u: 2, v: 1 }, { u: 4, v: 2 }), 0.5, true);
  near(sizeOf({ u: -8, v: 4 }, { u: -4, v: 2 }), 2, true);
  near(sizeOf({ u: 0, v: 4 }, { u: 0, v: 2 }), 2, true);
  near(sizeOf({ u: 3, v: 0 }, { u: 1, v: 0 }), 3, true);
  for (const [u, v] of [[4, 1], [-4, 2], [2, 3], [4, 0]]) assert.ok(!sizeOf({ u, v }, { u: 4, v: 2 }).along, `${u}, ${v}`);
  assert.ok(!sizeOf({ u: 1, v: 2 }, { u: 0, v: 2 }).along);
});

test("in the strip a copy is the curve moved up, and divided by their starts both are one line", () => {
  const tau = [0, 1, 2], [u, v, k] = [[4, 2, 0], [8, 2, 0], [2, 1, 0.5]];
  const times = (c, column) => column.map((value) => c * value);
  const curve = (c) => ({ tau: times(c, tau), u: times(c, u), v: times(c, v), k, stop: 2 * c, start: { u: 4 * c, v: 8 * c }, colour: "", width: 1 });
  const near = (a, b) => a.length === b.length && a.every((value, i) => Math.abs(value - b[i]) < 1e-12);
  const [byV, byU, strip, sizes] = panelsOf([curve(1), curve(5)], { base: { u: 4, v: 8 }, stop: 2 }, { line: "" });
  for (const { lines: [one, other] } of [byV, byU]) assert.ok(near(one.lines, other.lines) && one.lines[0] === 0 && one.lines[1] === 1);
  const [one, other] = strip.lines.map(({ lines }) => lines);
  assert.ok(near(other, one.map((value, i) => (i % 2 ? value + Math.log10(5) : value))));
  assert.ok(strip.y.low < one[1] && strip.y.high > other[1]);
  assert.ok(near(sizes.marks[1].points, [Math.log10(5), Math.log10(5)]));
});

test("a ball is seen at an angle, a flat body from above", () => {
  const theme = { textSize: 12, card: "card", ink: "ink", soft: "soft", line: "line" };
  const spotsOf = (rolls, turn) => {
    const shapes = [];
    const surface = { width: 400, height: 200, still: (_keys, _ground, draw) => draw(), shape: (lines, style) => shapes.push({ lines, style }), text() {} };
    const lane = { title: "", xs: [0, 1], ys: [0, 0], slid: [0, 0], rolled: [], at: { x: 0, y: 0, path: 0, turn }, colour: "#000000", ruler: null };
    const { places: [{ x, y, radius }] } = drawLanes(/** @type {any} */ (surface), { lanes: [lane], radius: 0.1, unit: "m", rolls, ghosts: [], line: null, ring: null, wide: false, aim: null }, theme);
    if (!rolls) return shapes.filter(({ style }) => style.stroke === "card" && !style.fill).flatMap(({ lines }) => lines).map(([, , tx, ty]) => [(tx - x) / radius, (y - ty) / radius]);
    const [{ lines }] = shapes.filter(({ style, lines }) => style.fill === "card" && lines[0].length > 2);
    // The middle of each spot, in radii.
    return lines.map((line) => [0, 1].map((side) => line.filter((_, i) => i % 2 === side).reduce((sum, value) => sum + value, 0) / (line.length / 2))).map(([px, py]) => [(px - x) / radius, (y - py) / radius]);
  };
  const still = rotation([0, 0, 0]);
  const has = (spots, px, py) => spots.some(([sx, sy]) => Math.hypot(sx - px, sy - py) < 0.08);
  // A flat body has one mark, which no turn but a whole one brings back.
  assert.ok(spotsOf(false, still).length === 1 && has(spotsOf(false, still), 0.78, 0) && has(spotsOf(false, rotation([0, 0, 1.2])), 0.78 * Math.cos(1.2), 0.78 * Math.sin(1.2)));
  assert.ok(!has(spotsOf(true, still), 0, 0) && has(spotsOf(true, still), 0, Math.sin(0.7) * Math.cos(0.36)), "the top is seen above the middle");
  // One that rolls to the right takes its top along; one that spins keeps it where it is.
  assert.ok(has(spotsOf(true, rotation([0, 0, 1])), 0, Math.sin(0.7) * Math.cos(0.36)));
  assert.ok(has(spotsOf(true, rotation([0, 0.5, 0])), Math.sin(0.5) * Math.cos(0.36), Math.sin(0.7) * Math.cos(0.5) * Math.cos(0.36)));
});

test("a frame leads from numbers to pixels and back, and a column breaks where it says", () => {
  const frame = new Frame({ left: 10, top: 20, width: 100, height: 50 }, { low: -1, high: 1 }, { low: 0, high: 5 });
  assert.deepEqual([frame.px(0), frame.py(5)], [60, 20]);
  assert.deepEqual(frame.at(60, 20), { x: 0, y: 5 });
  assert.deepEqual(frame.at(-100, 1000), { x: -1, y: 0 });
  assert.deepEqual(frame.lines(Float64Array.of(0, 0, 1, 5, NaN, NaN, -1, 0)), [[60, 70, 110, 20], [10, 70]]);
  assert.deepEqual(frame.lines([0, 0, 1, 5, 1, -Infinity]), [[60, 70, 110, 20], []]);
  assert.deepEqual(frame.pixel([9, 9, 0, 5], 2), [60, 20]);
  assert.ok(frame.contains(10, 20) && !frame.contains(10, 72));
});

test("rotations keep lengths and angles, and turn the right way", () => {
  const near = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-12, `${a} is not ${b}`));
  near(turnedBy(rotation([0, 0, Math.PI / 2]), [1, 0, 0]), [0, 1, 0]);
  near(turnedBy(rotation([Math.PI / 2, 0, 0]), [0, 1, 0]), [0, 0, 1]);
  near(turnedBy(rotation([0, 0, 0]), [1, 2, 3]), [1, 2, 3]);
  near([Math.hypot(...turnedBy(rotation([1, -2, 0.5]), [3, 4, 12]))], [13]);
});

test("a ball that only slides does not turn, one that rolls turns by its path", () => {
  const [v, radius, duration] = [2, 0.5, 3];
  /** At v along x, in times that grow as squares. */
  const ride = (wy, wz = 0) => {
    const t = Float64Array.of(0, duration / 4, duration);
    const always = (value) => t.map(() => value);
    return { t, x: t.map((time) => v * time), y: always(0), wx: always(0), wy: always(wy), wz: always(wz) };
  };
  const slides = rideOn(ride(0), 0, 1);
  assert.deepEqual(slides.at(1).turn, rotation([0, 0, 0]));
  assert.deepEqual([slides.at(0.5).x, slides.at(0.5).path], [3, 3]);
  assert.deepEqual(slides.until(0.5), [0, 0, 1.5, 0, 3, 0]);
  assert.ok(Math.abs(rideOn(ride(0), Math.PI / 2, 1).at(1).y + v * duration) < 1e-12, "what leads up is seen to lead to the right");
  assert.deepEqual(rideOn(ride(0, 8), 0, 0.25).at(1).turn, rideOn(ride(0, 2), 0, 1).at(1).turn);
  const rolls = rideOn(ride(v / radius), 0, 1);
  const turn = rotation([0, (v * duration) / radius, 0]);
  rolls.at(1).turn.flat().forEach((value, i) => assert.ok(Math.abs(value - turn.flat()[i]) < 1e-12));
});

test("a value is computed again only when what it depends on changes", () => {
  const store = new Store(/** @type {any} */ ({}), initialState());
  let computed = 0;
  const keep = (key) => store.keep("name", key, () => (computed += 1));
  assert.deepEqual([keep([1, { a: 2 }]), keep([1, { a: 2 }]), keep([1, { a: 3 }]), keep([1, { a: 2 }])], [1, 1, 2, 3]);
  assert.equal(keep([1, { a: 2 }]), 3);
  assert.throws(() => store.keep("name", "x", () => { throw new Error("rejected"); }), /rejected/);
  assert.deepEqual([keep([1, { a: 2 }]), keep("x")], [4, 5], "after a rejection nothing is kept");
});

test("every view has a title and a hint, and one that is not known its name", () => {
  for (const name of ["uv", "log", "blowup", "disc"]) assert.ok(described({ name }).hint.length > 20, name);
  assert.deepEqual(described({ name: "new" }), { name: "new", title: "new", hint: "" });
});

test("a ball touches a stone or passes it, and a hit is near the mark", () => {
  const stone = stoneOf({ line: 0.6, ball: { radius: 0.03 } }, true);
  assert.equal(stoneOf({ line: 0.6, ball: { radius: 0.03 } }, false), null);
  const along = (y) => ({ at: (share) => ({ x: share, y: y(share) }) });
  const passed = passageOf(along(() => 0.061), stone);
  assert.deepEqual([passed.until, passed.hit], [1, false]);
  assert.ok(Math.abs(passed.off - 0.061) < 1e-6);
  const touched = passageOf(along(() => -0.059), stone);
  assert.deepEqual([touched.until, touched.hit], [0.29, false]);
  // Around the stone, and back to the line.
  const curl = (miss) => passageOf(along((share) => (share < 0.4 ? 0.1 : 0.1 + (miss - 0.1) * Math.min(1, (share - 0.4) / 0.2))), stone);
  assert.deepEqual([curl(0.019).hit, curl(0.021).hit], [true, false]);
  // The cue points along the velocity at the start.
  assert.ok(Math.abs(rightOf({ u: 0, v: 1, along: 1, across: 1, heading: 45 }, { x: [], y: [] }, stone)) < 1e-15);
});
