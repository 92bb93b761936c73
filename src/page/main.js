// The page: what the reader does changes the state, and the state is drawn.
import { commandLine } from "./command_line.js";
import { csvOf, pngOf, save, textFile } from "./exports.js";
import { addNumberField, choiceButtons, fillSelect, numberField } from "./fields.js";
import { listen } from "./gestures.js";
import { lawField } from "./law_field.js";
import { loadLibrary } from "./library.js";
import { plain } from "./markup.js";
import { shown } from "./numbers.js";
import { bodies, bodyOf, fields, fromFragment, initialState, takeBall, toFragment } from "./page_state.js";
import { drawPanes } from "./panes_figure.js";
import { drawPath } from "./path_figure.js";
import { drawPortrait } from "./portrait_figure.js";
import { rowsOf } from "./portrait_layout.js";
import { portraitRequest } from "./portrait_request.js";
import { CanvasSurface, SvgSurface } from "./surface.js";
import { isDark, themeOf } from "./theme.js";
import { viewNamed, views } from "./views.js";

const $ = (id) => document.getElementById(id);
const regimes = ["k → 0: towards the stop only spin is left", "k → k*: sliding and spin die out together", "k → ∞: towards the stop only sliding is left"];
const fieldTitles = { none: "none", motion: "of the motion (2.6)", regularised: "regularised (2.7)" };

class Page {
  constructor(library) {
    this.library = library;
    this.known = { laws: library.laws, largestExponent: library.largestExponent, views: views.map((view) => view.name), balls: library.balls };
    this.state = fromFragment(location.hash, this.known);
    this.cross = null;
    this.redraws = [];
    this.makeControls();
    this.listenToThePlane();
    new ResizeObserver(() => this.draw()).observe($("columns"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.ask(() => {}));
    addEventListener("hashchange", () => {
      if (location.hash.slice(1) === toFragment(this.state)) return;
      const asked = fromFragment(location.hash, this.known);
      this.ask((state) => Object.assign(state, asked));
    });
    this.ask(() => {});
  }

  // --- the state, and what follows from it -------------------------------------------------------------------------

  /** Changes the state; if the library rejects the new one, the old one stays and the reason is thrown. */
  change(edit) {
    const before = this.state;
    const next = structuredClone(before);
    edit(next);
    next.chosen = Math.max(0, Math.min(next.chosen, next.orbits.length - 1));
    const started = performance.now();
    try {
      this.compute(next);
    } catch (error) {
      if (this.settled) this.compute(before);
      else if (JSON.stringify(before) !== JSON.stringify(initialState())) {
        this.state = initialState();
        this.change(() => {});
      }
      throw error;
    }
    this.state = next;
    this.settled = true;
    this.theme = themeOf(next.theme);
    this.draw();
    this.showControls();
    this.checkSoon();
    this.measure(performance.now() - started);
    this.rememberSoon();
  }

  /** Everything that depends on law, body, patch and starts, but not on the moment. */
  compute(state) {
    const { plane } = this.library;
    this.contact = null;
    if (state.ball) {
      this.contact = this.library.contact(state.law, { ...state.ball, velocityX: 0, velocityY: 0, omegaX: 0, omegaY: 0, omegaZ: 0 });
      state.mu = this.contact.mu;
    }
    const { chi, gamma } = bodyOf(state);
    this.facts = plane.choose(state.law, state.mu, chi, gamma);
    this.request = portraitRequest(state, plane, isDark(state.theme));
    const asked = JSON.stringify(this.request);
    if (this.portraitKey !== asked) {
      this.portraitKey = null;
      this.portrait = this.library.portrait(this.request);
      this.portraitKey = asked;
    }
    this.context = { mu: state.mu, window: [this.portrait.windowU, this.portrait.windowV], exponent: this.portrait.exponent };
    this.unitIsochrone = state.isochrone ? plane.isochrone() : null;
    this.motions = state.orbits.map(({ u, v }) => plane.motion(u, v));
  }

  get timeFactor() {
    return this.contact ? this.contact.secondsPerTau : 1;
  }

  get motion() {
    return this.motions[this.state.chosen];
  }

  /** The time at the end of the slider, in tau. */
  get end() {
    if (!this.motion) return 1;
    const orbit = this.state.orbits[this.state.chosen];
    if (this.state.part === "whole" || orbit.v === 0) return this.motion.stop;
    return Math.min(this.motion.stop, 1.5 * this.facts.slidingLimit * orbit.v);
  }

  get now() {
    if (!this.motion) return null;
    const { u, v } = this.state.orbits[this.state.chosen];
    return this.library.plane.instant(u, v, this.state.share * this.end);
  }

  stopText(tau) {
    const inTau = `τ* = ${shown(tau, 7)}${this.contact ? " m/s" : ""}`;
    return this.contact ? `${shown(tau * this.timeFactor, 6)} s  (${inTau})` : inTau;
  }

  // --- drawing -----------------------------------------------------------------------------------------------------

  draw() {
    if (!this.settled || $("plane").clientWidth < smallestWidth) return;
    this.drawPlane();
    this.drawMoment();
  }

  scene() {
    const { state, portrait, context } = this;
    const now = this.now;
    // The library answers with the chosen orbit by itself, and with the others that are none of the axes.
    const others = state.orbits.map((start, index) => ({ start, index }))
      .filter(({ start, index }) => index !== state.chosen && start.u !== 0 && start.v !== 0)
      .map((entry, i) => ({ ...entry, orbit: portrait.through[i], chosen: false }));
    const chosen = portrait.highlight ? [{ orbit: portrait.highlight, start: state.orbits[state.chosen], index: state.chosen, chosen: true }] : [];
    return {
      figure: portrait.figure, view: viewNamed(state.view), context,
      own: [...others, ...chosen],
      isochrone: state.isochrone ? { u: this.unitIsochrone.u.map((u) => u * state.isochrone), v: this.unitIsochrone.v.map((v) => v * state.isochrone) } : null,
      marker: now && now.tau < this.motion.stop
        ? { index: state.chosen, state: { ...now, lnK: Math.log(now.k), left: this.motion.stop - now.tau, start: { ...state.orbits[state.chosen], left: this.motion.stop } } }
        : null,
      cross: this.cross,
    };
  }

  drawPlane() {
    const canvas = $("plane");
    const rows = String(rowsOf(this.portrait.figure.panels.length, canvas.clientWidth));
    if (canvas.dataset.rows !== rows) {
      canvas.dataset.rows = rows;
      canvas.style.setProperty("--rows", rows);
    }
    this.planeScene = this.scene();
    this.frames = drawPortrait(new CanvasSurface(canvas), this.planeScene, this.theme);
    const legend = this.portrait.figure.panels.flatMap((panel) => panel.lines).map((layer) => plain(layer.legend)).filter(Boolean);
    canvas.setAttribute("aria-label",
      `Phase portrait, view ${this.planeScene.view.title}: ${plain(this.portrait.figure.title)}; drawn are ` +
      `${[...new Set(legend)].join(", ") || "orbits"}; ${this.state.orbits.length} orbits of yours` +
      (this.motion ? `; the chosen one stops at ${this.stopText(this.motion.stop)}` : ""));
  }

  /** The figures that change with the moment, the plane excepted. */
  drawMoment() {
    const now = this.now;
    const unit = this.contact ? " (m/s)" : "";
    drawPanes(new CanvasSurface($("panes")), {
      motions: this.motions.map((motion, index) => ({ ...motion, chosen: index === this.state.chosen })),
      end: this.end, now, timeFactor: this.timeFactor, chosenIndex: this.state.chosen, speedUnit: unit,
      timeLabel: this.contact ? "t (s)" : "τ",
    }, this.theme);
    $("instant").textContent = now
      ? `${this.contact ? `t = ${shown(now.tau * this.timeFactor, 5)} s` : `τ = ${shown(now.tau, 5)}`} of ` +
        `${shown(this.motion.stop * this.timeFactor, 5)}:  u = ${shown(now.u, 4)}, v = ${shown(now.v, 4)}, k = ${shown(now.k, 4)}`
      : "No orbit yet: click the plane.";
    this.drawPath(now);
  }

  drawPath(now) {
    const visible = Boolean(this.contact && this.motion);
    $("path-card").hidden = !visible;
    if (!visible) return;
    const key = JSON.stringify([this.state.law, this.state.ball, this.state.orbits[this.state.chosen]]);
    try {
      if (this.pathKey !== key) {
        this.path = this.library.roll(this.state.law, this.ballAtStart());
        this.pathKey = key;
      }
      const t = now.tau * this.timeFactor;
      const place = t <= this.path.t.at(-1) ? this.library.place(this.state.law, this.ballAtStart(), t) : null;
      drawPath(new CanvasSurface($("path")), {
        ...this.path, radius: this.state.ball.radius, index: this.state.chosen,
        rollsAt: { x: this.path.rollsAtX, y: this.path.rollsAtY }, now: place,
      }, this.theme);
      $("path-facts").textContent = `Rolls after ${shown(this.path.rollsAfter, 4)} s (dashed, the textbook's ball, which slides as if ` +
        `it did not spin: ${shown(this.path.textbookRollsAfter, 4)} s), at (${shown(this.path.rollsAtX, 4)}, ` +
        `${shown(this.path.rollsAtY, 4)}) m; then straight on at (${shown(this.path.finalX, 4)}, ${shown(this.path.finalY, 4)}) m/s. ` +
        `The contact point slides ${shown(this.path.slipLength, 4)} m. x is along the slip.`;
    } catch (error) {
      $("path-facts").textContent = error.message;
    }
  }

  /** The ball with the velocities of the chosen orbit: slip v along x, spin u/R, and the reader's velocity of the centre. */
  ballAtStart() {
    const { ball } = this.state;
    const { u, v } = this.state.orbits[this.state.chosen];
    return { ...ball, omegaX: -ball.velocityY / ball.radius, omegaY: (ball.velocityX - v) / ball.radius, omegaZ: u / ball.radius };
  }

  measure(milliseconds) {
    this.redraws.push(milliseconds);
    if (this.redraws.length > 200) this.redraws.shift();
    $("redraw").textContent = `Redrawn in ${milliseconds.toFixed(1)} ms.`;
  }

  // --- controls ----------------------------------------------------------------------------------------------------

  makeControls() {
    const { library } = this;
    const attempt = (action) => this.try(action);
    fillSelect($("ball"), [{ name: "", title: "any ball, any unit" }, ...library.balls.map(({ name, title }) => ({ name, title }))]);
    this.lawField = lawField($("law"), $("law-exponent"), {
      library, key: "exponent", attempt, use: (law) => this.change((state) => (state.law = law)),
    });
    this.againstField = lawField($("against"), $("against-exponent"), {
      library, key: "against-exponent", none: "no other law", attempt, use: (law) => this.change((state) => (state.against = law)),
    });
    fillSelect($("field"), fields.map((name) => ({ name, title: fieldTitles[name] })));
    $("field").addEventListener("change", () => this.ask((state) => (state.field = $("field").value)));
    $("isochrones").addEventListener("change", () => this.ask((state) => (state.isochrones = $("isochrones").checked ? initialState().isochrones : 0)));
    fillSelect($("body"), Object.entries(bodies).map(([name, { title }]) => ({ name, title })));
    this.viewButtons = choiceButtons($("views"), views, (name) => {
      this.cross = null;
      this.ask((state) => (state.view = name));
    });
    this.partButtons = choiceButtons($("span"), [{ name: "whole", title: "whole motion" }, { name: "sliding", title: "while it slides" }],
      (name) => this.ask((state) => Object.assign(state, { part: name, share: 0 })));

    $("ball").addEventListener("change", () => this.try(() => this.chooseBall($("ball").value)));
    $("body").addEventListener("change", () => this.ask((state) => {
      state.body = $("body").value;
      state.mu = bodyOf(state).mu ?? Math.min(state.mu, bodyOf(state).largestMu);
    }));
    this.inertiaFields = [["chi", "χ = 1 + mR²/J_h"], ["gamma", "γ = mR²/J_z"]].map(([key, label]) => [key, addNumberField($("inertia"), {
      key, label, use: (value) => {
        if (!(value > 0)) throw new Error("a positive number is needed");
        this.change((state) => (state[key] = value));
      },
    })]);
    this.windowFields = ["U", "V"].map((name, side) => addNumberField($("window"), {
      key: `window-${name}`, label: name, use: (value) => {
        if (!(value > 0)) throw new Error("a positive number is needed");
        this.change((state) => (state.window = this.context.window.map((shown, i) => (i === side ? value : shown))));
      },
    }));
    $("fit").addEventListener("click", () => this.ask((state) => (state.window = null)));
    this.muField = numberField($("mu"), $("mu-error"), (mu) => this.setMu(mu));
    $("mu-slider").addEventListener("input", () => this.try(() => this.setMu(sliderToMu(Number($("mu-slider").value), bodyOf(this.state).largestMu))));

    $("theme").addEventListener("click", () => this.ask((state) => {
      state.theme = state.theme === "auto" ? (isDark("auto") ? "light" : "dark") : "auto";
    }));
    $("play").addEventListener("click", () => this.togglePlay());
    $("time").addEventListener("input", () => this.setShare(Number($("time").value) / 1000));
    $("add-orbit").addEventListener("submit", (event) => this.addTyped(event));
    this.makeBallFields();
    this.makeExports();
  }

  zoom(factor) {
    this.ask((state) => (state.window = this.context.window.map((side) => Number((side * factor).toPrecision(4)))));
  }

  /** Changes the state, or says beside mu why not. */
  ask(edit) {
    this.try(() => this.change(edit));
  }

  /** Runs what may be rejected, and says so beside mu: it is the field that all choices meet in. */
  try(action) {
    try {
      action();
      this.muField.say("");
    } catch (error) {
      this.showControls();
      this.muField.say(error.message);
    }
  }

  setMu(mu) {
    if (!(mu > 0)) throw new Error("mu must be positive");
    const { largestMu } = bodyOf(this.state);
    if (mu > largestMu) throw new Error(`mu is the patch radius over R: at most ${largestMu} here`);
    this.change((state) => {
      state.mu = mu;
      if (state.ball) Object.assign(state.ball, { patchBy: "patch_radius", patch: mu * state.ball.radius });
    });
  }

  chooseBall(name) {
    this.change((state) => {
      if (name) takeBall(state, this.library.balls.find((ball) => ball.name === name));
      else state.ball = null;
    });
  }

  makeBallFields() {
    const fields = [["radius", "radius R (m)"], ["mass", "mass m (kg)"], ["friction", "friction f"], ["gravity", "gravity g (m/s²)"]];
    const use = (key) => (value) => {
      if (!key.startsWith("velocity") && !(value > 0)) throw new Error("a positive number is needed");
      this.change((state) => (state.ball[key] = value));
    };
    this.ballFields = Object.fromEntries(fields.map(([key, label]) => [key, addNumberField($("ball-fields"), { key, label, use: use(key) })]));
    const by = document.createElement("label");
    this.patchBy = document.createElement("select");
    fillSelect(this.patchBy, [{ name: "patch_radius", title: "its radius ε (m)" }, { name: "spin_deceleration", title: "spin deceleration (rad/s²)" }]);
    by.append("patch known by", this.patchBy);
    $("ball-fields").append(by);
    this.patchBy.addEventListener("change", () => this.ask((state) => this.describePatch(state, this.patchBy.value)));
    this.ballFields.patch = addNumberField($("ball-fields"), { key: "patch", label: "patch", use: use("patch") });
    for (const [key, label] of [["velocityX", "centre: along the slip (m/s)"], ["velocityY", "across it (m/s)"]]) {
      this.ballFields[key] = addNumberField($("path-fields"), { key, label, use: use(key) });
    }
  }

  /** The same patch, known in another way. */
  describePatch(state, by) {
    const { radius, friction, gravity } = state.ball;
    const perRadius = (15 * Math.PI * friction * gravity) / (32 * radius * radius);
    const { patchRadius } = this.contact;
    Object.assign(state.ball, { patchBy: by, patch: Number((by === "patch_radius" ? patchRadius : patchRadius * perRadius).toPrecision(12)) });
  }

  makeExports() {
    const copy = async (text, what) => {
      try {
        await navigator.clipboard.writeText(text);
        $("copied").textContent = `${what} copied.`;
      } catch {
        $("copied").textContent = text;
      }
    };
    $("copy-link").addEventListener("click", () => {
      this.remember();
      copy(location.href, "Link");
    });
    $("copy-command").addEventListener("click", () => copy($("command").textContent, "Command"));
    $("save-svg").addEventListener("click", () => save("portrait.svg", textFile(this.svg(), "image/svg+xml")));
    $("save-png").addEventListener("click", async () => save("portrait.png", await pngOf(this.svg())));
    for (const ending of ["tex", "json"]) {
      $(`save-${ending}`).addEventListener("click", () =>
        save(`portrait.${ending}`, textFile(this.library.portraitFile(this.request, ending).text, ending === "json" ? "application/json" : "text/x-tex")));
    }
    $("save-csv").addEventListener("click", () => save("orbits.csv", textFile(csvOf(this.motions), "text/csv")));
  }

  svg() {
    const { width, height } = $("plane").getBoundingClientRect();
    const surface = new SvgSurface(Math.round(width), Math.round(height), plain(this.portrait.figure.title));
    drawPortrait(surface, { ...this.scene(), cross: null }, this.theme);
    return surface.toString();
  }

  showControls() {
    const { state } = this;
    $("ball").value = state.ball?.name ?? "";
    this.lawField.show(state.law);
    this.againstField.show(state.against);
    for (const option of $("against").options) option.disabled = option.value === state.law;
    $("field").value = state.field;
    $("isochrones").checked = state.isochrones > 0;
    $("field").disabled = $("isochrones").disabled = !viewNamed(state.view).layered;
    $("body").value = state.body;
    $("body-label").hidden = Boolean(state.ball);
    $("inertia").hidden = state.body !== "own";
    for (const [key, field] of this.inertiaFields) field.show(state[key]);
    $("mu-slider").value = muToSlider(state.mu, bodyOf(state).largestMu ?? 1);
    $("mu-slider").setAttribute("aria-valuetext", shown(state.mu));
    $("mu-slider").disabled = $("mu").disabled = bodyOf(state).mu !== undefined;
    this.muField.show(state.ball ? Number(state.mu.toPrecision(6)) : state.mu);
    this.windowFields.forEach((field, side) => field.show(Number(this.context.window[side].toPrecision(6))));
    this.viewButtons.show(state.view);
    this.partButtons.show(state.part);
    $("view-hint").textContent = viewNamed(state.view).hint;
    $("terminal").textContent = regimes[this.facts.regime] + (this.facts.regime === 1 ? `, k* = ${shown(this.facts.terminalRatio, 6)}` : "");
    $("theme").setAttribute("aria-label", `Theme: ${state.theme === "auto" ? "as the system" : state.theme}`);
    $("time").value = Math.round(1000 * state.share);
    $("command").textContent = commandLine(state, this.request, this.library.balls.find((ball) => ball.name === state.ball?.name));
    this.showOrbits();
    this.showBall();
  }

  showBall() {
    const { ball } = this.state;
    $("ball-card").hidden = !ball;
    if (!ball) return;
    $("ball-title").textContent = ball.title;
    for (const [key, field] of Object.entries(this.ballFields)) field.show(ball[key]);
    this.patchBy.value = ball.patchBy;
    $("ball-facts").textContent = `Patch radius ${shown(1000 * this.contact.patchRadius, 4)} mm, μ = ${shown(this.state.mu, 5)}. ${ball.sources}`;
  }

  showOrbits() {
    const list = $("orbits");
    while (list.children.length > this.motions.length) list.lastChild.remove();
    while (list.children.length < this.motions.length) list.append(this.orbitItem());
    this.motions.forEach((motion, index) => {
      const item = list.children[index];
      const { u, v } = this.state.orbits[index];
      item.className = index === this.state.chosen ? "chosen" : "";
      item.style.setProperty("--swatch", this.theme.swatch(index));
      item.dataset.tau = motion.stop;
      const [choose, remove] = item.children;
      choose.setAttribute("aria-pressed", String(index === this.state.chosen));
      choose.children[0].textContent = `u₀ = ${shown(u, 4)}, v₀ = ${shown(v, 4)}` +
        (this.contact ? `: spin ${shown(u / this.state.ball.radius, 4)} rad/s, slip ${shown(v, 4)} m/s` : "");
      choose.children[1].textContent = `stops at ${this.stopText(motion.stop)}`;
      remove.setAttribute("aria-label", `Remove orbit ${index + 1}`);
    });
  }

  orbitItem() {
    const item = document.createElement("li");
    const choose = Object.assign(document.createElement("button"), { type: "button" });
    choose.append(Object.assign(document.createElement("span"), { className: "start" }), Object.assign(document.createElement("span"), { className: "stop" }));
    const remove = Object.assign(document.createElement("button"), { type: "button", textContent: "✕", className: "remove" });
    const index = () => [...item.parentElement.children].indexOf(item);
    choose.addEventListener("click", () => this.ask((state) => Object.assign(state, { chosen: index(), share: 0 })));
    remove.addEventListener("click", () => this.removeOrbit(index()));
    item.append(choose, remove);
    return item;
  }

  removeOrbit(index) {
    this.ask((state) => {
      state.orbits.splice(index, 1);
      if (state.chosen >= index) state.chosen -= 1;
      state.share = 0;
    });
  }

  addTyped(event) {
    event.preventDefault();
    const form = event.target;
    const problem = form.querySelector("output");
    const [u, v] = ["u", "v"].map((name) => Number(form.elements[name].value.trim() || NaN));
    if (!Number.isFinite(u) || !Number.isFinite(v)) problem.textContent = "two finite numbers are needed";
    else if (v < 0) problem.textContent = "a sliding speed is ≥ 0";
    else if (u === 0 && v === 0) problem.textContent = "u₀ = v₀ = 0 is rest";
    else {
      problem.textContent = "";
      this.try(() => this.startOrbit({ u, v }));
    }
  }

  startOrbit(start) {
    this.change((state) => {
      // What is pointed at stays where it is.
      if (Math.abs(start.u) <= this.context.window[0] && start.v <= this.context.window[1]) state.window ??= this.context.window;
      state.orbits.push(start);
      Object.assign(state, { chosen: state.orbits.length - 1, share: 0, isochrone: 0 });
    });
    this.announce(`Orbit from u = ${shown(start.u, 4)}, v = ${shown(start.v, 4)}: it stops at ${this.stopText(this.motion.stop)}.`);
  }

  // --- the plane under the pointer ---------------------------------------------------------------------------------

  listenToThePlane() {
    // The panel under a pixel, with the numbers there; none beside and between them.
    const panelAt = (x, y) => {
      const index = this.frames.findIndex((frame) => frame.contains(x, y));
      return index < 0 ? null : { index, panel: this.planeScene.view.panels[index], ...this.frames[index].at(x, y) };
    };
    const pointed = (x, y) => {
      const at = panelAt(x, y);
      const state = at?.panel.state?.(at.x, at.y, this.context);
      return state && Math.hypot(state.u, state.v) > 0 && Number.isFinite(state.u) && Number.isFinite(state.v) ? state : null;
    };
    const choose = (x, y) => {
      const at = panelAt(x, y);
      if (at?.panel.moment && this.motion) return this.setShare(Math.min(1, (at.panel.moment(at.x) * this.motion.stop) / this.end));
      const start = pointed(x, y);
      if (start) this.try(() => this.startOrbit(rounded(start, this.context)));
    };
    listen($("plane"), {
      tap: (x, y) => {
        this.cross = null;
        choose(x, y);
      },
      drag: (x, y) => {
        const at = pointed(x, y);
        if (at) this.ask((state) => (state.isochrone = this.library.plane.stop(at.u, at.v).tau));
      },
      point: (x, y) => this.describe(pointed(x, y)),
      leave: () => {
        if (!this.cross) return;
        this.cross = null;
        this.drawPlane();
      },
      move: (dx, dy) => {
        const panel = Math.min(this.cross?.panel ?? 0, this.frames.length - 1);
        const frame = this.frames[panel];
        const { x, y } = this.cross ?? { x: (frame.x.low + 2 * frame.x.high) / 3, y: (frame.y.low + frame.y.high) / 2 };
        const moved = frame.at(frame.px(x) + dx * frame.width / 40, frame.py(y) - dy * frame.height / 40);
        this.cross = { panel, ...moved };
        this.drawPlane();
        this.describe(pointed(frame.px(moved.x), frame.py(moved.y)));
      },
      enter: () => {
        if (!this.cross) return;
        const frame = this.frames[this.cross.panel];
        choose(frame.px(this.cross.x), frame.py(this.cross.y));
      },
      zoom: (factor) => this.zoom(factor),
      remove: () => this.motion && this.removeOrbit(this.state.chosen),
    });
  }

  describe(at) {
    if (!at) return this.announce("");
    const { tau } = this.library.plane.stop(at.u, at.v);
    this.announce(`u = ${shown(at.u, 4)}, v = ${shown(at.v, 4)}, k = ${shown(at.v / (this.context.mu * Math.abs(at.u)), 4)}: stops at ${this.stopText(tau)}`);
  }

  announce(text) {
    $("pointed").textContent = text || "\u00a0";
  }

  // --- time --------------------------------------------------------------------------------------------------------

  setShare(share) {
    this.state.share = share;
    $("time").value = Math.round(1000 * share);
    this.drawPlane();
    this.drawMoment();
    this.rememberSoon();
  }

  togglePlay() {
    this.playing = !this.playing && Boolean(this.motion);
    $("play").textContent = this.playing ? "❚❚" : "▶";
    $("play").setAttribute("aria-label", this.playing ? "Pause" : "Play");
    if (!this.playing) return;
    if (this.state.share >= 1) this.state.share = 0;
    // A real ball moves in real time, but nobody waits longer than this.
    const seconds = this.contact ? Math.min(12, Math.max(2, this.end * this.timeFactor)) : 6;
    let last = performance.now();
    const step = (time) => {
      if (!this.playing) return;
      this.setShare(Math.min(1, this.state.share + Math.max(0, time - last) / 1000 / seconds));
      last = time;
      if (this.state.share >= 1 || !this.motion) this.togglePlay();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  // --- what can wait -----------------------------------------------------------------------------------------------

  checkSoon() {
    const orbit = this.state.orbits[this.state.chosen];
    const { law, mu, body, chi, gamma } = this.state;
    const key = JSON.stringify([law, mu, body, chi, gamma, orbit]);
    if (key === this.checkKey) return;
    this.checkKey = key;
    clearTimeout(this.checkTimer);
    $("checks").setAttribute("aria-busy", "true");
    this.checkTimer = setTimeout(() => this.check(orbit), 350);
  }

  check(orbit) {
    const body = $("checks").tBodies[0];
    $("checks").removeAttribute("aria-busy");
    try {
      const { rows } = orbit ? this.library.plane.checks(orbit.u, orbit.v) : { rows: [] };
      body.replaceChildren(...rows.map(({ name, measured, allowed, passed }) => {
        const row = document.createElement("tr");
        row.append(...[name, shown(measured, 2), shown(allowed, 2), passed ? "ok" : "FAIL"].map((text) => Object.assign(document.createElement("td"), { textContent: text })));
        row.lastChild.className = passed ? "" : "failed";
        return row;
      }));
    } catch (error) {
      const cell = Object.assign(document.createElement("td"), { textContent: error.message, colSpan: 4 });
      const row = document.createElement("tr");
      row.append(cell);
      body.replaceChildren(row);
    }
  }

  rememberSoon() {
    clearTimeout(this.rememberTimer);
    this.rememberTimer = setTimeout(() => this.remember(), 250);
  }

  remember() {
    history.replaceState(null, "", `#${toFragment(this.state)}`);
  }
}

const smallestWidth = 120;  // pixels; a hidden or minimised page has none
const smallestMu = 1e-3;
const sliderToMu = (value, largest) => Number((largest * (smallestMu / largest) ** (1 - value / 1000)).toPrecision(3));
const muToSlider = (mu, largest) => Math.round(1000 * (1 - Math.log(mu / largest) / Math.log(smallestMu / largest)));

/** A start as people would write it: no more digits than a pixel is worth. */
function rounded({ u, v }, { window: [U, V] }) {
  const to = (value, side) => {
    const digits = Math.max(3, 4 - Math.floor(Math.log10(side / Math.max(Math.abs(value), 1e-300))));
    return Number(value.toPrecision(Math.min(4, digits)));
  };
  return { u: to(u, U), v: to(v, V) };
}

loadLibrary().then((library) => (globalThis.page = new Page(library)), (error) => {
  $("failure").hidden = false;
  $("failure").textContent = `The library could not be started: ${error.message ?? error}. The page needs a browser with WebAssembly exceptions (2022 or later).`;
});
