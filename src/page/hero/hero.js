// The top of the page: the motion of a body beside one that does not spin, the question, and the game of the line.
import { $, make, write } from "../dom.js";
import { drawLanes, drawPatch } from "./hero_figure.js";
import { duration, length, shown } from "../numbers.js";
import { answers, factsOf, goal, judged, nothing, question, say } from "./story.js";
import { ScreenSurface } from "../drawing/screen_surface.js";
import { borderOf, widthOf } from "../drawing/surface.js";
import { ghostsOf, reach, rightOf } from "./tries.js";
import { product, rideOn, rotation } from "./turning.js";

const film = { text: 12.5, title: 20, top: 62, rim: 12 };  // pixels in a picture 640 pixels wide: sizes of words, height of the head, rim
const turning = 20;      // s that the body turns in place while the reader is asked

export class Hero {
  /** Facts about the motion. */
  facts = /** @type {Facts} */ ({});
  /** The two bodies, the one without spin first. */
  bodies = /** @type {ReturnType<Hero["bodiesOf"]>} */ ([]);
  /** @type {{x: number, y: number, radius: number}[]} where the bodies are, in pixels */
  places = [];
  /** @type {{from: number[], to: number[], words: string} | null} arrow of a throw */
  aim = null;
  /** @type {{share: number, words: string} | null} ring around the body that spins */
  ring = null;
  /** @type {{key: string, guess: string, ended: boolean, turn: number} | null} the question, while its motion is shown */
  asked = null;

  /** @param player  its `seconds` are the duration of the motion on the screen */
  constructor(store, player) {
    this.store = store;
    this.player = player;
    this.lanes = new ScreenSurface($("lanes"), (surface) => Object.assign(this, this.drawBalls(surface)));
    this.patch = new ScreenSurface($("patch"), (surface) => this.drawPatch(surface));
    store.shows.push(() => this.show());
    $("answers").append(...Object.values(answers).map((textContent) => make("button", { type: "button", textContent, onclick: () => this.answer(textContent) })));
  }

  /** Key of the shown motion. */
  get key() {
    const { ball, orbits, chosen, line } = this.store.state;
    return JSON.stringify([ball, orbits, chosen, line]);
  }

  /** The mode: asking the question, watching its motion, judged after the answer, game, or "" for none of these. */
  get mode() {
    const { asked, store: { state, ride } } = this;
    return !ride ? "" : asked ? (asked.ended ? "judged" : asked.guess ? "watching" : "asking") : state.line ? "game" : "";
  }

  get stone() {
    return this.store.ride?.stone ?? null;
  }

  /** Asks which body goes farther. The body that spins turns in place. */
  ask() {
    const { store, player, lanes } = this;
    player.toggle(false);
    store.move({ fraction: 0 });
    const asked = this.asked = { key: this.key, guess: "", ended: false, turn: 0 };
    this.show();
    this.draw();
    const rate = (player.spinShown * this.facts.spin * store.end * store.timeFactor) / player.seconds;
    let began = 0;
    const step = (time) => {
      began ||= time;
      if (this.asked !== asked || asked.guess || time - began > 1000 * turning) return;
      asked.turn = (rate * (time - began)) / 1000;
      lanes.drawInSight();
      requestAnimationFrame(step);
    };
    if (store.moves) requestAnimationFrame(step);
  }

  answer(guess) {
    const { asked, store, player } = this;
    if (!asked) return;
    asked.guess = guess;
    this.show();
    if (store.moves) player.toggle(true);
    else store.move({ fraction: 1 });
  }

  /** Shows all parts that do not depend on the moment. */
  show() {
    const { store, store: { ride } } = this;
    if (this.asked && this.asked.key !== this.key) this.asked = null;
    const { mode } = this;
    document.documentElement.dataset.mode = mode;
    for (const id of ["lanes", "patch"]) $(id).hidden = !ride;
    $("answers").hidden = mode !== "asking";
    $("to-line").hidden = mode === "game";
    if (ride) {
      this.facts = factsOf(store);
      this.bodies = this.bodiesOf(ride);
    }
    this.speak();
  }

  /** Headline and story. */
  get said() {
    const { store, facts, mode, asked } = this;
    if (!store.ride) return nothing;
    if (mode === "asking" || mode === "watching") return question(asked?.guess);
    if (mode === "game") return goal(this.tryNow);
    const said = say(facts);
    return mode === "judged" ? { ...said, headline: judged(asked?.guess ?? "", facts) } : said;
  }

  speak() {
    const { mode, said: { headline, pieces } } = this;
    write($("headline"), headline);
    this.tell(pieces);
    // A screen reader reads the result.
    write($("heard"), mode === "judged" || (mode === "game" && this.tryNow.ended) ? headline : "");
    const hit = mode === "game" && this.tryNow.ended && this.tryNow.hit;
    $("send").hidden = $("film-line").hidden = $("next-line").hidden = !hit;
    $("lanes").setAttribute("aria-label", `${this.stone ? "A ball and a stone" : "Two equal bodies"} from above. ${$("story").textContent}`);
  }

  /** The last try for the line. */
  get tryNow() {
    const { facts, store: { state: { line, orbits, chosen, fraction }, ride } } = this;
    const far = ride?.own.path ?? 0;
    const passage = ride?.passage;
    const hit = chosen > 0 && orbits.length > 1 && (passage ? passage.hit : Math.abs(far - line) <= reach);
    return { line, passage, far, slip: facts.slip, spin: facts.spin, tries: chosen, ended: fraction >= 1 && chosen > 0, hit };
  }

  /** Returns both bodies: their motions, and time and place at which each ceases to slide. */
  bodiesOf({ courses, plain, own, end }) {
    const { player, facts: { spin }, store: { state: { ball }, orbit, timeFactor } } = this;
    const lasts = end * timeFactor;
    const right = rightOf(orbit, courses[1], this.stone);
    const titles = ["without spin", spin === 0 ? "this one" : ball ? `spinning, ${shown(spin, 3)} rad/s` : "spinning"];
    return [plain, own].map(({ end, path }, i) => {
      const ride = rideOn(courses[i], right, player.spinShown);
      const share = Math.min(1, end / lasts);
      return { ...ride, title: titles[i], end, far: path, share, stop: ride.at(share) };
    });
  }

  /** Writes the story in the colours of the bodies. */
  tell(pieces) {
    const { store: { state: { chosen }, theme } } = this;
    const colours = { plain: theme.soft, own: theme.swatch(chosen) };
    const key = JSON.stringify([pieces, colours]);
    if (key === this.told) return;
    this.told = key;
    $("story").replaceChildren(...pieces.map(([kind, textContent]) => {
      const node = make(kind === "times" ? "b" : "span", { textContent, className: kind });
      node.style.color = colours[kind] ?? "";
      return node;
    }));
  }

  /** Writes a message about an action of the reader. */
  say(text) {
    write($("told"), text);
  }

  drawPatch(surface) {
    const { now, theme, state: { chosen }, request } = this.store;
    if (!now) return;
    const scene = { still: now.u === 0 && now.v === 0, k: now.k, spin: Math.sign(now.u), force: now.force, colour: theme.swatch(chosen), hollow: request.law === "ring" };
    drawPatch(surface, scene, theme);
  }

  drawBalls(surface, { theme } = this.store, { aim, ring } = /** @type {{aim: Hero["aim"], ring: Hero["ring"]}} */ (this)) {
    const { ride, contact, state: { line } } = this.store;
    if (!ride) return { places: [] };
    const { stone } = this;
    const unit = contact ? "m" : "";
    return drawLanes(surface, {
      lanes: this.lanesNow().slice(stone ? 1 : 0), radius: ride.radius, rolls: ride.rolls, unit, aim, ring, ghosts: this.ghostsNow(),
      line: line ? { at: line, reach, words: length(line, unit), stone } : null,
    }, theme);
  }

  ghostsNow() {
    return ghostsOf(this.store, this.mode);
  }

  /** Draws a moment of a film on a surface of 640 x 360: headline, address and clock, and the bodies below them. */
  drawFilm(surface, fraction) {
    const { player, store, store: { state } } = this;
    const shown = state.fraction;
    state.fraction = fraction;
    const theme = { ...store.theme, textSize: film.text };
    const { width, height, context } = surface;
    surface.shape([borderOf(surface)], { fill: theme.card });
    const { headline } = this.said;
    const title = { colour: theme.ink, bold: true, size: film.title };
    surface.text(film.rim, 28, headline, { ...title, size: film.title * Math.min(1, (width - 2 * film.rim) / widthOf(headline, title)) });
    const small = { colour: theme.soft, size: film.text };
    // The address shows the source of a film that is sent on.
    surface.text(film.rim, 50, /^http/.test(location.protocol) ? `${location.host}${location.pathname}` : "contensou", small);
    surface.text(width - film.rim, 50, [player.timeText(store.now.tau), $("pace").textContent].filter(Boolean).join(", "), { ...small, align: "right" });
    context.save();
    // The words of the table begin 4 pixels from its left side.
    context.translate(film.rim - 4, film.top);
    Object.assign(surface, { width: width - 2 * film.rim + 8, height: height - film.top });
    this.drawBalls(surface, { theme }, { aim: null, ring: null });
    Object.assign(surface, { width, height });
    context.restore();
    state.fraction = shown;
  }

  lanesNow() {
    const { store: { state, timeFactor, ride, end, theme, contact }, bodies, mode, asked } = this;
    const time = state.fraction * end * timeFactor;
    const places = bodies.map(({ at }) => at(state.fraction));
    if (mode === "asking" && asked) places[1] = { ...places[1], turn: product(rotation([0, 0, asked.turn]), places[1].turn) };
    const has = bodies.map((body) => time >= (1 - 1e-12) * body.end);
    const word = ({ rest }) => (!ride.rolls ? "stopped" : time < (rest?.t ?? Infinity) ? "rolls" : "rests");
    // If both move straight, a ruler shows the distance between them.
    const [plain, own] = bodies;
    const straight = bodies.every(({ stop: { x, y, path } }) => Math.abs(Math.hypot(x, y) - path) < 1e-3 * path);
    const [to, path] = has[1] ? [own.stop, own.far] : [places[1], places[1].path];
    const ruler = mode !== "game" && straight && has[0] && path > 1.02 * plain.far ? { from: plain.stop, to, more: path - plain.far } : null;
    const slid = (body) => `${word(body)}, after ${length(body.far, contact ? "m" : "")} in ${duration(body.end, contact ? "s" : "")}`;
    return bodies.map((body, i) => {
      const slidUntil = Math.min(state.fraction, body.share);
      const track = body.until(slidUntil);
      return {
        title: mode === "asking" || mode === "game" ? body.title : `${body.title}: ${has[i] ? slid(body) : "slides"}`,
        xs: body.xs, ys: body.ys, at: places[i], slid: track, rolled: ride.rolls && state.fraction > body.share ? body.until(state.fraction).slice(track.length - 2) : [],
        colour: i === 1 ? theme.swatch(state.chosen) : theme.soft, ruler: i === 1 ? ruler : null,
      };
    });
  }

  draw() {
    const { store: { ride, now, state }, mode, asked } = this;
    if (!ride) return;
    const ended = state.fraction >= 1;
    if (asked && mode === "watching" && ended) {
      asked.ended = true;
      this.show();
    } else if (mode === "game" && ended !== this.ended) this.speak();
    this.ended = ended;
    this.lanes.drawInSight();
    this.patch.drawInSight();
    $("patch").setAttribute("aria-label", `The contact patch from below: ${shown(100 * now.force, 2)} % of the friction f N acts against the sliding` +
      (now.k < 1 && now.u !== 0 ? "; one point of it does not slip" : ""));
  }
}
