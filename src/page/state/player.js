// Time: play, pause, scrub, and the speed of the page's clock.
import { $, write } from "../dom.js";
import { choiceButtons, forgiveTouches } from "../controls/fields.js";
import { shown } from "../numbers.js";

const shortest = 7;  // seconds on the screen
const longest = 12;
const fastest = { flat: 60, round: 30 };  // rad/s on the screen; faster marks would seem to turn back

export class Player {
  /** @param {Store} store */
  constructor(store) {
    this.store = store;
    this.showPart = choiceButtons($("span"), { sliding: "while it slides", whole: "until rest" },
      (part) => store.ask((state) => Object.assign(state, { part, fraction: 0 })));
    $("play").addEventListener("click", () => this.toggle());
    forgiveTouches($("time"));
    $("time").addEventListener("input", () => store.move({ fraction: Number($("time").value) / 1000 }));
  }

  /** Duration of the motion on the screen: its own time between the limits `shortest` and `longest`. */
  get seconds() {
    const { contact, end, timeFactor } = this.store;
    return contact ? Math.min(longest, Math.max(shortest, end * timeFactor)) : shortest;
  }

  /** Share of the spin that is drawn, so that the marks do not seem to turn back. */
  get spinShown() {
    const { orbit, end, timeFactor, ride } = this.store;
    return orbit && ride ? Math.min(1, (fastest[ride.rolls ? "round" : "flat"] * this.seconds * ride.radius) / (Math.abs(orbit.u) * end * timeFactor) || 1) : 1;
  }

  show() {
    const { spinShown, store: { state, end, timeFactor, contact, now } } = this;
    this.showPart(state.part);
    const factor = this.seconds / (end * timeFactor);
    const pace = factor > 1.05 ? `slowed ${shown(factor, 2)} times` : factor < 0.95 ? `${shown(1 / factor, 2)} times as fast` : "in real time";
    write($("pace"), !contact ? "" : spinShown > 0.95 ? pace : `${pace}, its spin ${factor / spinShown > 1 ? `${shown(factor / spinShown, 2)} times` : `${shown(spinShown / factor, 2)} times as fast`}`);
    $("time").value = Math.round(1000 * state.fraction);
    $("time").setAttribute("aria-valuetext", now ? this.timeText(now.tau) : "no motion");
    write($("clock"), now ? this.timeText(now.tau) : "");
  }

  timeText(tau) { return this.store.contact ? `${(tau * this.store.timeFactor).toFixed(3)} s` : `τ = ${shown(tau, 3)}`; }

  /** Plays from the beginning, unless the reader wants no motion. */
  begin() { this.toggle(this.store.moves); }

  toggle(playing = !this.playing) {
    this.playing = playing && Boolean(this.store.motion);
    write($("play"), this.playing ? "❚❚" : "▶");
    $("play").setAttribute("aria-label", this.playing ? "Pause" : "Play");
    if (!this.playing) return;
    if (this.store.state.fraction >= 1) this.store.move({ fraction: 0 });
    const run = this.run = {};
    let last = null;
    const step = (time) => {
      if (this.run !== run || !this.playing) return;
      const { state, motion } = this.store;
      if (!motion) return this.toggle(false);
      requestAnimationFrame(step);
      const passed = last === null ? 0 : Math.max(0, time - last);
      last = time;
      this.store.move({ fraction: Math.min(1, state.fraction + passed / 1000 / this.seconds) });
      // The motion is played once; the reader starts it again.
      if (this.store.state.fraction >= 1) this.toggle(false);
    };
    requestAnimationFrame(step);
  }
}
