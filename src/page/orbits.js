// The list of the reader's orbits, and the form that starts one.
import { $, make, showList } from "./dom.js";
import { parseNumber, shown } from "./numbers.js";

export class Orbits {
  /** @param {import("./store.js").Store} store @param {import("./plane.js").Plane} plane */
  constructor(store, plane, { ask, stopText }) {
    this.store = store;
    this.plane = plane;
    this.ask = ask;
    this.stopText = stopText;
    $("add-orbit").addEventListener("submit", (event) => {
      event.preventDefault();
      this.addTyped(event.target);
    });
    $("clear-orbits").addEventListener("click", () => ask((state) => Object.assign(state, { orbits: [], isochrone: 0, fraction: 0 })));
  }

  show(theme) {
    const { state, motions } = this.store;
    $("clear-orbits").hidden = motions.length < 2;
    showList($("orbits"), motions, () => this.item(), (item, motion, index) => {
      const { u, v } = state.orbits[index];
      item.className = index === state.chosen ? "chosen" : "";
      item.style.setProperty("--swatch", theme.swatch(index));
      item.dataset.tau = motion.stop;
      const [choose, remove] = item.children;
      choose.setAttribute("aria-pressed", String(index === state.chosen));
      choose.children[0].textContent = `u₀ = ${shown(u, 4)}, v₀ = ${shown(v, 4)}` +
        (state.ball ? `: spin ${shown(u / state.ball.radius, 4)} rad/s, slip ${shown(v, 4)} m/s` : "");
      choose.children[1].textContent = `stops at ${this.stopText(motion.stop)}`;
      remove.setAttribute("aria-label", `Remove orbit ${index + 1}`);
    });
  }

  item() {
    const choose = make("button", { type: "button" }, make("span", { className: "start" }), make("span", { className: "stop" }));
    const remove = make("button", { type: "button", textContent: "✕", className: "remove" });
    const item = make("li", {}, choose, remove);
    const index = () => [...item.parentElement.children].indexOf(item);
    choose.addEventListener("click", () => this.ask((state) => Object.assign(state, { chosen: index(), fraction: 0 })));
    remove.addEventListener("click", () => {
      const removed = index();
      this.remove(removed);
      // The focus stays near the one that is gone.
      const next = $("orbits").children[Math.min(removed, $("orbits").children.length - 1)];
      (next?.querySelector(".remove") ?? $("add-orbit").elements.u).focus();
    });
    return item;
  }

  remove(index) {
    this.ask((state) => {
      state.orbits.splice(index, 1);
      if (state.chosen >= index) state.chosen -= 1;
      state.fraction = 0;
    });
  }

  addTyped(form) {
    const output = form.querySelector("output");
    const say = (text) => (output.textContent = text);
    const [u, v] = ["u", "v"].map((name) => parseNumber(form.elements[name].value));
    if (u.problem || v.problem) return say(u.problem ? `u₀: ${u.problem}` : `v₀: ${v.problem}`);
    if (v.value < 0) return say("a sliding speed is ≥ 0");
    if (u.value === 0 && v.value === 0) return say("u₀ = v₀ = 0 is rest");
    say("");
    this.plane.startOrbit({ u: u.value, v: v.value }, (edit, done) => {
      try {
        this.store.change(edit);
        done();
      } catch (error) {
        say(`This start cannot be shown: ${error.message}`);
      }
    });
  }
}
