// The top of the page: what the ball does, beside one that does not spin.
import { $, make, write } from "./dom.js";
import { drawLanes, drawPatch, length } from "./hero_figure.js";
import { shown } from "./numbers.js";
import { CanvasSurface } from "./surface.js";
import { rideOn } from "./turning.js";

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
    this.lanes = new CanvasSurface($("lanes"), (surface) => this.drawBalls(surface));
    this.patch = new CanvasSurface($("patch"), (surface) => this.drawPatch(surface));
    this.bars = ["this", "plain"].map((name) => {
      const [title, bar, number] = ["span", "div", "b"].map((tag) => make(tag, { className: tag === "div" ? "bar-of" : "" }));
      bar.append(make("i"));
      $("bars").append(make("div", { id: `slid-${name}` }, title, number, bar));
      return { title, bar: bar.firstChild, number };
    });
  }

  /** Everything but the moment. */
  show() {
    const { store: { state, ride, orbit, timeFactor } } = this;
    for (const id of ["lanes", "patch", "bars"]) $(id).hidden = !ride;
    if (!ride) {
      write($("headline"), "Click the plane: a motion starts there");
      write($("story"), "Up is sliding, sideways is spinning.");
      return;
    }
    const ball = state.ball;
    this.unit = ball ? "m" : "";
    const slid = (slide) => slide.length * timeFactor;
    const duration = ride.end * timeFactor;
    const { radius } = ride;
    const spin = Math.abs(orbit.u) / radius;
    this.spinShown = Math.min(1, (fastest * this.player.seconds) / (spin * duration) || 1);
    // A path that curves is seen from where it leads to the right.
    const [x, y] = ["x", "y"].map((key) => ride.courses[1][key].at(-1));
    const heading = Math.abs(y) > 1e-12 * Math.abs(x) ? Math.atan2(y, x) : 0;
    this.rides = ride.courses.map((course) => rideOn(course, heading, this.spinShown));
    this.radius = radius;
    this.say(ride, spin, slid);
  }

  /** The headline and what it rests on: live numbers. */
  say({ own, plain, rolls, rest }, spin, slid) {
    const { store: { state, orbit, timeFactor }, unit } = this;
    const [far, farPlain] = [own, plain].map((slide) => length(slid(slide), unit));
    const times = own.length / plain.length;
    const more = (ratio, word) => (ratio >= 1.5 ? `${shown(ratio, 2)} times as ${word}` : `${shown(100 * (ratio - 1), 2)} % ${{ far: "farther", long: "longer" }[word]}`);
    const name = state.ball ? state.ball.title.replace(/ (on|of) .*/, "") : rolls ? "ball" : "puck";
    const thing = name.split(" ").at(-1);
    const turns = state.ball ? `${shown(spin / 2 / Math.PI, 2)} times a second` : `with u = ${shown(orbit.u, 3)}`;
    const speed = state.ball ? `${shown(orbit.v, 3)} m/s` : `v = ${shown(orbit.v, 3)}`;
    const leave = !state.ball || (state.ball.velocityX === orbit.v && state.ball.velocityY === 0) ? "leave" : "touch down, slipping";
    const until = rolls ? "then it rolls" : "then it stops";
    write($("headline"), spin === 0 ? `This ${thing} does not spin: friction holds it at once`
      : orbit.v === 0 ? `A ${thing} that spins in place`
        : times > 1.5 ? `Spin a ${thing}, and it slides ${shown(times, 2)} times as far` : times > 1.005
          ? `Spin makes this ${thing} slide ${shown(100 * (times - 1), 2)} % farther` : "Here spin changes little");
    write($("story"), spin === 0
      ? `This ${name} slips at ${speed} and does not spin: it slides ${farPlain}, ${until}. Textbooks say the same of one that spins: give it spin, and see.`
      : orbit.v === 0 ? `Nothing slides: only the rim of the patch rubs, and the ${thing} turns ever slower.`
        : `Two equal ${name}s ${leave} at ${speed}. One does not spin: it slides ${farPlain}, ${until}. The other spins ${turns}: it slides ${far}, ` +
          `${more(times, "far")} and ${more(own.end / plain.end, "long")}. Textbooks say ${farPlain} both times.`);
    if (rest) $("story").append(` It rests after ${shown(rest.t, 3)} s, ${length(Math.hypot(rest.x, rest.y), unit)} from its start.`);
    this.most = Math.max(own.length, plain.length) * timeFactor;
    this.titles = [
      spin === 0 ? "this one" : `spinning${state.ball ? ` ${shown(orbit.u / this.radius, 3)} rad/s` : ""}`,
      "without spin; and in textbooks, spin or not",
    ];
    this.ends = [own, plain].map((slide) => slide.end * timeFactor);
    const seconds = state.ball ? " s" : "";
    this.barTitles = [own, plain].map((slide, i) => `${["This one slides", "Without spin"][i]} for ${shown(slide.end * timeFactor, 3)}${seconds}`);
    $("lanes").setAttribute("aria-label", `Two equal bodies from above. ${$("story").textContent}`);
  }

  drawPatch(surface) {
    const { now, theme } = this.store;
    if (now) drawPatch(surface, { still: now.u === 0 && now.v === 0, k: now.k, spin: Math.sign(now.u), force: now.force }, theme);
  }

  drawBalls(surface) {
    if (this.store.ride) drawLanes(surface, { lanes: this.balls, radius: this.radius, unit: this.unit }, this.store.theme);
  }

  ballsNow() {
    const { store: { state, ride, timeFactor, end, theme }, rides } = this;
    const duration = end * timeFactor;
    const time = state.fraction * duration;
    const does = (i, own) => (time < this.ends[own] ? "slides" : !ride.rolls ? "stands" : time < (rides[i].rest?.t ?? Infinity) ? "rolls" : "rests");
    const lane = (i, own) => ({
      title: `${this.titles[own]}: ${does(i, own)}`,
      xs: rides[i].xs, ys: rides[i].ys, at: rides[i].at(state.fraction),
      slidesTo: Math.sqrt(this.ends[own] / duration) * (rides[i].xs.length - 1), colour: theme.swatch(own === 0 ? state.chosen : 1),
    });
    return [lane(0, 1), lane(1, 0)];
  }

  draw() {
    const { store: { ride, now }, unit } = this;
    if (!ride) return;
    this.balls = this.ballsNow();
    this.lanes.draw();
    this.patch.draw();
    $("patch").setAttribute("aria-label", `The patch from below: friction against sliding is ${shown(100 * now.force, 2)} % of f N` +
      (now.k < 1 && now.u !== 0 ? "; one point of it does not slip" : ""));
    this.bars.forEach(({ title, bar, number }, own) => {
      const { slid } = this.balls[1 - own].at;
      write(title, this.barTitles[own]);
      write(number, length(slid, unit));
      bar.style.width = `${(100 * slid) / this.most || 0}%`;
      bar.style.background = this.balls[1 - own].colour;
    });
  }
}
