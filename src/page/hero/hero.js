// The top of the page: what the ball does, beside one that does not spin.
import { $, make, write } from "../dom.js";
import { drawLanes, drawPatch } from "./hero_figure.js";
import { duration, length, shown } from "../numbers.js";
import { makeHandles } from "./handles.js";
import { Ruler } from "./ruler.js";
import { dare, factsOf, nothing, outcome, question, say } from "./story.js";
import { ScreenSurface } from "../drawing/screen_surface.js";
import { borderOf, CanvasSurface, widthOf } from "../drawing/surface.js";
import { rideOn } from "./turning.js";

const titleLines = 3.8;  // of a film, in sizes of the text
const fastest = 9;  // rad/s on the screen; a faster spin is drawn in a part of its size, so that its marks turn one way to the eye
const late = 0.99;  // of the time until the stop, at which the last speeds are told

export class Hero {
  /** What is said. */
  facts = /** @type {Facts} */ ({});
  /** What moves, the body without spin first. */
  bodies = /** @type {ReturnType<Hero["bodiesOf"]>} */ ([]);
  /** @type {{x: number, y: number, radius: number}[]} where the bodies are, in pixels */
  places = [];
  /** @type {{from: number[], to: number[], words: string} | null} of a throw */
  aim = null;
  /** @type {OwnOrbit | null} the motion of which the reader is asked, before he is told */
  asked = null;
  guess = "";
  said = "";  // of what the reader does on the table
  /** @type {number[][] | null} of the ruler, or of the bar of the scale: pixels */
  rulerEnds = null;
  /** The place at a pixel. */
  toTable = (/** @type {number} */ x, /** @type {number} */ y) => ({ x, y });
  /** @type {CanvasSurface | null} of the film that is being taken */
  film = null;

  /** @param player  whose `seconds` are what the motion lasts on the screen */
  constructor(store, player) {
    this.store = store;
    this.player = player;
    this.lanes = new ScreenSurface($("lanes"), (surface) => Object.assign(this, this.drawBalls(surface)));
    this.patch = new ScreenSurface($("patch"), (surface) => this.drawPatch(surface));
    this.ruler = new Ruler(this);
    this.handles = makeHandles($("story"));
    store.shows.push(() => this.show());
    $("answers").append(...question.answers.map((textContent) => make("button", { type: "button", textContent, onclick: () => this.answer(textContent) })));
  }

  /** Asks which body goes farther. */
  ask() {
    this.asked = this.store.motion;
    this.show();
    this.draw();
  }

  answer(guess) {
    this.guess = `You said: ${guess}. `;
    this.player.toggle(true);
  }

  /** Everything but the moment. */
  show() {
    const { store, store: { ride } } = this;
    if (this.asked !== store.motion) this.asked = null;
    for (const id of ["lanes", "patch"]) $(id).hidden = !ride;
    $("answers").hidden = !this.asked;
    $("dare").hidden = !ride || Boolean(this.asked);
    $("says").classList.toggle("later", Boolean(this.asked));
    if (ride) {
      this.facts = factsOf(store);
      this.bodies = this.bodiesOf(ride);
    }
    const { headline, story, pieces = [["", story]] } = !ride ? nothing : this.asked ? question : say(this.facts);
    write($("headline"), headline);
    this.tell(pieces);
    write($("dare-line"), dare[ride?.rolls ? "rolls" : "stops"]);
    $("lanes").setAttribute("aria-label", `Two equal bodies from above. ${story}`);
  }

  /** Both bodies: how they move, and when and where each ceases to slide. */
  bodiesOf({ courses, plain, own, radius, end }) {
    const { player, facts: { spin }, store: { state: { ball }, orbit, timeFactor } } = this;
    const lasts = end * timeFactor;
    const spinShown = Math.min(1, (fastest * player.seconds * radius) / (Math.abs(orbit.u) * lasts) || 1);
    // A path that curves is seen from where it leads to the right, or where it was thrown to.
    const [x, y] = ["x", "y"].map((key) => courses[1][key].at(-1));
    const heading = (Math.abs(y) > 1e-12 * Math.abs(x) ? Math.atan2(y, x) : 0) - (orbit.heading * Math.PI) / 180;
    const titles = ["without spin", spin === 0 ? "this one" : `spinning${ball ? ` ${shown(spin, 3)} rad/s` : ""}`];
    return [plain, own].map(({ end, path }, i) => {
      const ride = rideOn(courses[i], heading, spinShown);
      return { ...ride, title: titles[i], end, far: path, stop: ride.at(Math.min(1, end / lasts)), slides: ride.until(end / lasts) };
    });
  }

  /** The story: words in the colours of what they name, and numbers that are handles. */
  tell(pieces) {
    const { handles, store: { state: { chosen }, theme } } = this;
    const kinds = pieces.map(([kind]) => kind);
    const nodeOf = (kind, i) => (!kind ? new Text() : handles[kind] && kinds.indexOf(kind) === i ? handles[kind] : make("b"));
    const shape = kinds.join();
    // What stays keeps the focus.
    if (shape !== this.shape) {
      const focused = Object.entries(handles).find(([, handle]) => handle === document.activeElement);
      $("story").replaceChildren(...kinds.map(nodeOf));
      if (focused) (focused[1].isConnected ? focused[1] : $(`${focused[0]}-slider`)).focus();
      this.shape = shape;
    }
    const colours = { plain: theme.soft, own: theme.swatch(chosen), spin: theme.swatch(chosen) };
    $("story").childNodes.forEach((node, i) => {
      write(node, pieces[i][1]);
      if (node instanceof HTMLElement) node.style.color = colours[kinds[i]] ?? "";
    });
    for (const [key, handle] of Object.entries(handles)) {
      const slider = $(`${key}-slider`);
      if (!slider) continue;
      handle.setAttribute("aria-valuenow", slider.value);
      handle.setAttribute("aria-valuetext", handle.textContent);
    }
  }

  /** Says what the reader does on the table. */
  say(text) {
    this.said = text;
    this.draw();
  }

  drawPatch(surface) {
    const { now, theme } = this.store;
    if (now) drawPatch(surface, { still: now.u === 0 && now.v === 0, k: now.k, spin: Math.sign(now.u), force: now.force }, theme);
  }

  drawBalls(surface) {
    const { store: { ride, theme, contact }, aim, asked } = this;
    const placed = this.ruler.placed && { ...this.ruler.placed, words: this.ruler.words };
    return ride ? drawLanes(surface, { lanes: this.lanesNow(), radius: ride.radius, rolls: ride.rolls, unit: contact ? "m" : "", secret: asked !== null, aim, placed }, theme) : { places: [], rulerEnds: null };
  }

  /** The canvas of a film, on which the balls are drawn from now on under what is said of them, with the clock. */
  beginFilm() {
    const { lanes: { width, height }, store: { theme: { textSize } } } = this;
    const ratio = globalThis.devicePixelRatio || 1;
    const size = { width, height: height + titleLines * textSize };
    const even = (side) => 2 * Math.round((ratio * side) / 2);  // as films need it
    this.film = new CanvasSurface(make("canvas", { width: even(size.width), height: even(size.height) }), size);
    return this.film.canvas;
  }

  drawFilm(film) {
    const { lanes, player, store: { now, theme, theme: { textSize } } } = this;
    lanes.draw();
    film.shape([borderOf(film)], { fill: theme.card });
    const headline = $("headline").textContent;
    const fitting = Math.min(1.6, (film.width - 8) / widthOf(headline, { size: textSize, bold: true }));
    film.text(4, 1.7 * textSize, headline, { colour: theme.ink, size: fitting * textSize, bold: true });
    const clock = [player.timeText(now.tau), $("pace").textContent].filter(Boolean).join(", ");
    film.text(film.width - 4, 3.2 * textSize, clock, { colour: theme.soft, size: textSize, align: "right" });
    film.context.drawImage(lanes.canvas, 0, titleLines * textSize, lanes.width, lanes.height);
  }

  lanesNow() {
    const { store: { state, timeFactor, ride, end, theme, contact }, bodies } = this;
    const time = state.fraction * end * timeFactor;
    const places = bodies.map(({ at }) => at(state.fraction));
    const has = bodies.map((body) => time >= (1 - 1e-12) * body.end);
    const word = ({ rest }) => (!ride.rolls ? "stopped" : time < (rest?.t ?? Infinity) ? "rolls" : "rests");
    // A ruler lies between them where both go straight.
    const [plain, own] = bodies;
    const straight = bodies.every(({ stop: { x, y, path } }) => Math.abs(Math.hypot(x, y) - path) < 1e-3 * path);
    const [to, path] = has[1] ? [own.stop, own.far] : [places[1], places[1].path];
    const ruler = straight && path > 1.02 * plain.far ? { from: plain.stop, to, more: path - plain.far } : null;
    const slid = (body) => `${word(body)}, after ${length(body.far, contact ? "m" : "")} in ${duration(body.end, contact ? "s" : "")}`;
    return bodies.map((body, i) => ({
      title: `${body.title}: ${has[i] ? slid(body) : "slides"}`,
      xs: body.xs, ys: body.ys, at: places[i], slides: body.slides,
      colour: i === 1 ? theme.swatch(state.chosen) : theme.soft, ruler: i === 1 ? ruler : null,
    }));
  }

  draw() {
    const { store: { ride, now, state, orbit, motion, library: { plane } }, facts } = this;
    if (!ride) return;
    if (this.asked && state.fraction > 0) {
      this.asked = null;
      this.show();
    }
    if (this.film) this.drawFilm(this.film);
    else this.lanes.drawInSight();
    this.patch.drawInSight();
    $("patch").setAttribute("aria-label", `The contact patch from below: ${shown(100 * now.force, 2)} % of the friction f N acts against the sliding` +
      (now.k < 1 && now.u !== 0 ? "; one point of it does not slip" : ""));
    if (this.aim) return;
    const last = state.fraction < 1 ? null : plane.instant(orbit.u, orbit.v, late * motion.stop);
    write($("told"), this.said ? this.said : last ? this.guess + outcome(facts, { slip: last.v, spin: (last.u / orbit.u) * facts.spin }, late) : "");
  }
}
