// The top of the page: what the ball does, beside one that does not spin.
import { $, make, write } from "./dom.js";
import { drawLanes, drawPatch } from "./hero_figure.js";
import { duration, length, shown } from "./numbers.js";
import { say } from "./story.js";
import { ScreenSurface } from "./screen_surface.js";
import { borderOf, CanvasSurface, widthOf } from "./surface.js";
import { rideOn } from "./turning.js";

const titleLines = 3.8;  // of a film, in sizes of the text
const fastest = 9;  // rad/s on the screen; a faster spin is drawn in a part of its size, so that its marks turn one way to the eye

export class Hero {
  /** @param player  whose `seconds` are what the motion lasts on the screen */
  constructor(store, player) {
    this.store = store;
    /** @type {any} what is said, and what moves */
    this.titles = this.rides = this.ends = this.barTitles = this.most = null;
    /** @type {any[]} what is drawn, the ball without spin first */
    this.balls = [];
    this.player = player;
    /** @type {CanvasSurface | null} of the film that is being taken */
    this.film = null;
    this.lanes = new ScreenSurface($("lanes"), (surface) => this.drawBalls(surface));
    this.patch = new ScreenSurface($("patch"), (surface) => this.drawPatch(surface));
    this.bars = ["this", "plain"].map((name) => {
      const [title, bar, number] = ["span", "div", "b"].map((tag) => make(tag, { className: tag === "div" ? "bar-of" : "" }));
      bar.append(make("i"));
      $("bars").append(make("div", { id: `slid-${name}` }, title, number, bar));
      return { title, bar: bar.firstChild, number };
    });
  }

  /** Everything but the moment. */
  show() {
    const { store: { state, ride, orbit, motion, timeFactor, library: { plane } } } = this;
    for (const id of ["lanes", "patch", "bars"]) $(id).hidden = !ride;
    if (!ride) {
      write($("headline"), "Click the plane: a motion starts there");
      write($("story"), "Up is sliding, sideways is spinning.");
      return;
    }
    const ball = state.ball;
    this.unit = ball ? "m" : "";
    const lasts = ride.end * timeFactor;
    const { radius, own, plain, rest } = ride;
    const spin = orbit.u / (ball?.radius ?? 1);
    this.spinShown = Math.min(1, (fastest * this.player.seconds * radius) / (Math.abs(orbit.u) * lasts) || 1);
    // A path that curves is seen from where it leads to the right.
    const [x, y] = ["x", "y"].map((key) => ride.courses[1][key].at(-1));
    const heading = Math.abs(y) > 1e-12 * Math.abs(x) ? Math.atan2(y, x) : 0;
    this.rides = ride.courses.map((course) => rideOn(course, heading, this.spinShown));
    this.radius = radius;
    this.facts = {
      name: ball ? ball.title.replace(/ (on|of) .*/, "") : ride.rolls ? "ball" : "puck", real: Boolean(ball), rolls: ride.rolls, spin, slip: orbit.v,
      along: orbit.along, across: orbit.across, least: ride.least, own, plain, rest, stop: motion.stop * timeFactor, turningAlone: orbit.u === 0 ? 0 : plane.stop(orbit.u, 0) * timeFactor,
    };
    const { headline, story } = say(this.facts);
    write($("headline"), headline);
    write($("story"), story);
    this.most = Math.max(own.path, plain.path);
    this.titles = [spin === 0 ? "this one" : `spinning${ball ? ` ${shown(spin, 3)} rad/s` : ""}`, "without spin"];
    this.ends = [own.end, plain.end];
    this.barTitles = this.ends.map((end, i) => `${["This one slides", "Without spin"][i]} for ${duration(end, this.unit)}`);
    $("lanes").setAttribute("aria-label", `Two equal bodies from above. ${story}`);
  }

  drawPatch(surface) {
    const { now, theme } = this.store;
    if (now) drawPatch(surface, { still: now.u === 0 && now.v === 0, k: now.k, spin: Math.sign(now.u), force: now.force }, theme);
  }

  drawBalls(surface) {
    if (this.store.ride) drawLanes(surface, { lanes: this.balls, radius: this.radius, unit: this.unit }, this.store.theme);
  }

  /** The canvas of a film, on which the balls are drawn from now on under what is said of them, with the clock. */
  beginFilm() {
    const { lanes: { width, height }, store: { theme: { textSize } } } = this;
    const ratio = globalThis.devicePixelRatio || 1;
    const size = { width, height: height + titleLines * textSize };
    const even = (side) => 2 * Math.round((ratio * side) / 2);  // as films need it
    this.film = new CanvasSurface(Object.assign(document.createElement("canvas"), { width: even(size.width), height: even(size.height) }), size);
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

  ballsNow() {
    const { store: { state, ride, timeFactor, end, theme }, rides } = this;
    const duration = end * timeFactor;
    const time = state.fraction * duration;
    const does = (i, own) => (time < (1 - 1e-12) * this.ends[own] ? "slides" : !ride.rolls ? "stands" : time < (rides[i].rest?.t ?? Infinity) ? "rolls" : "rests");
    const lane = (i, own) => ({
      title: `${this.titles[own]}: ${does(i, own)}`,
      xs: rides[i].xs, ys: rides[i].ys, at: rides[i].at(state.fraction),
      slides: rides[i].until(this.ends[own] / duration), colour: own === 0 ? theme.swatch(state.chosen) : theme.soft,
    });
    return [lane(0, 1), lane(1, 0)];
  }

  draw() {
    const { store: { ride, now }, unit } = this;
    if (!ride) return;
    this.balls = this.ballsNow();
    if (this.film) this.drawFilm(this.film);
    else this.lanes.drawInSight();
    this.patch.drawInSight();
    $("patch").setAttribute("aria-label", `The patch from below: friction against sliding is ${shown(100 * now.force, 2)} % of f N` +
      (now.k < 1 && now.u !== 0 ? "; one point of it does not slip" : ""));
    this.bars.forEach(({ title, bar, number }, own) => {
      const path = Math.min(this.balls[1 - own].at.path, [ride.own, ride.plain][own].path);
      write(title, this.barTitles[own]);
      write(number, length(path, unit));
      bar.style.width = `${(100 * path) / this.most || 0}%`;
      bar.style.background = this.balls[1 - own].colour;
    });
  }
}
