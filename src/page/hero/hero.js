// The top of the page: the motion of a body beside one that does not spin, the question, and the game of the line.
import { $, make, write } from "../dom.js";
import { drawLanes } from "./hero_figure.js";
import { duration, length, shown, turnsOf } from "../numbers.js";
import { answers, factsOf, goal, judged, nothing, question, say } from "./story.js";
import { ScreenSurface } from "../drawing/screen_surface.js";
import { fullSpeeds, ghostsOf, reach, rightOf } from "./tries.js";
import { product, rideOn, rotation } from "./turning.js";

/** The buttons below the table, each with the stages at which it is shown. */
const buttons = {
  "try-line": ["dared"], "send": ["hit"], "film-line": ["hit", "judged"], "next-line": ["hit"], "to-line": ["", "judged"], "today-line": ["", "judged", "try"],
  "again": ["", "judged", "try", "today"],
};

const lowest = 220;      // pixels, height of a table with two lanes and the ring of the game
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
  /** @type {{share: number, words: string} | null} ring around the body that spins, while it is pointed at or pulled */
  ring = null;
  /** @type {{key: string, guess: string, ended: boolean, turn: number} | null} the question, while its motion is shown */
  asked = null;

  /** @param player  its `seconds` are the duration of the motion on the screen */
  constructor(store, player) {
    this.store = store;
    this.player = player;
    this.lanes = new ScreenSurface($("lanes"), (surface) => Object.assign(this, this.drawBalls(surface)));
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

  /** Returns the ring for a spin. */
  ringOf(spin = this.facts.spin) {
    const { contact } = this.store;
    return { share: spin / fullSpeeds(contact).spin, words: contact ? turnsOf(spin) : shown(spin, 3) };
  }

  /** In the game the ring is always seen; after a try the title of the table has its spin. */
  get ringAtRest() { return !this.isLine ? null : this.store.state.chosen ? { ...this.ringOf(), words: "" } : this.ringOf(); }
  get isLine() { return this.mode === "game" && !this.stone; }
  get stone() { return this.store.ride?.stone ?? null; }

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
    document.documentElement.dataset.round = mode !== "game" ? "" : this.stone ? "stone" : "line";
    for (const id of ["lanes", "why-card"]) $(id).hidden = !ride;
    $("answers").hidden = mode !== "asking";
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
    const { tries, theirs, ended, hit } = this.tryNow;
    const stage = mode === "judged" ? mode : mode !== "game" ? "" : theirs && !tries ? "dared" : ended && hit ? "hit" : this.store.state.day ? "today" : "try";
    for (const [id, stages] of Object.entries(buttons)) $(id).hidden = !stages.includes(stage);
    // Before the first try there is nothing to play.
    $("player").style.visibility = mode === "game" && !tries ? "hidden" : "";
    $("lanes").setAttribute("aria-label", `${this.stone ? "A ball and a stone" : "Two equal bodies"} from above. ${$("story").textContent}`);
  }

  /** The last try for the line. */
  get tryNow() {
    const { facts, store: { state: { line, day, tries: theirs, orbits, chosen, fraction }, ride } } = this;
    const far = ride?.own.path ?? 0;
    const passage = ride?.passage;
    const hit = chosen > 0 && orbits.length > 1 && (passage ? passage.hit : Math.abs(far - line) <= reach);
    return { line, day, passage, far, slip: facts.slip, spin: facts.spin, tries: chosen, theirs, ended: fraction >= 1 && chosen > 0, hit };
  }

  /** Returns both bodies: their motions, and time and place at which each ceases to slide. */
  bodiesOf({ courses, plain, own, end }) {
    const { player, facts: { spin }, store: { state: { ball }, orbit, timeFactor } } = this;
    const lasts = end * timeFactor;
    const right = rightOf(orbit, courses[1], this.stone);
    const titles = ["without spin", spin === 0 ? "this one" : ball ? `spinning, ${turnsOf(spin)}` : "spinning"];
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
  say(text) { write($("told"), text); }

  drawBalls(surface, { theme } = this.store, aim = this.aim, ring = this.ring ?? this.ringAtRest) {
    const { ride, contact, state: { line } } = this.store;
    if (!ride) return { places: [] };
    const { stone } = this;
    const isAlone = stone || (this.isLine && surface.height < lowest);
    const unit = contact ? "m" : "";
    return drawLanes(surface, {
      lanes: this.lanesNow().slice(isAlone ? 1 : 0), radius: ride.radius, rolls: ride.rolls, unit, aim, ring, wide: this.isLine, ghosts: this.ghostsNow(),
      line: line ? { at: line, reach, words: length(line, unit), stone } : null,
    }, theme);
  }

  ghostsNow() { return ghostsOf(this.store, this.mode); }

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
        title: this.stone && this.aim ? "" : mode === "asking" || mode === "game" ? body.title : `${body.title}: ${has[i] ? slid(body) : "slides"}`,
        xs: body.xs, ys: body.ys, at: places[i], slid: track, rolled: ride.rolls && state.fraction > body.share ? body.until(state.fraction).slice(track.length - 2) : [],
        colour: i === 1 ? theme.swatch(state.chosen) : theme.soft, ruler: i === 1 ? ruler : null,
      };
    });
  }

  draw() {
    const { store: { ride, state }, mode, asked } = this;
    if (!ride) return;
    const ended = state.fraction >= 1;
    if (asked && mode === "watching" && ended) {
      asked.ended = true;
      this.show();
    } else if (mode === "game" && ended !== this.ended) this.speak();
    this.ended = ended;
    this.lanes.drawInSight();
  }
}
