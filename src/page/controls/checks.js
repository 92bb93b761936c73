// What the theory says of the chosen orbit, as a table: computed when the reader has paused.
import { $, make } from "../dom.js";
import { shown } from "../numbers.js";

const pause = 350;  // ms

export class Checks {
  constructor(store) {
    this.store = store;
    $("checks-card").addEventListener("toggle", () => this.show());
  }

  show() {
    const { state: { law, mu, body, chi, gamma }, orbit } = this.store;
    const key = JSON.stringify([law, mu, body, chi, gamma, orbit]);
    if (key === this.key || !$("checks-card").open) return;
    this.key = key;
    clearTimeout(this.timer);
    $("checks").setAttribute("aria-busy", "true");
    this.timer = setTimeout(() => this.check(orbit), pause);
  }

  check(orbit) {
    const cell = (textContent, properties) => make("td", { textContent, ...properties });
    const row = ({ name, measured, allowed, passed }) =>
      make("tr", {}, cell(name), cell(shown(measured, 2)), cell(shown(allowed, 2)), cell(passed ? "ok" : "FAIL", { className: passed ? "" : "failed" }));
    $("checks").removeAttribute("aria-busy");
    let rows;
    try {
      rows = orbit ? this.store.library.plane.checks(orbit.u, orbit.v).map(row) : [];
    } catch (error) {
      rows = [make("tr", {}, cell(error.message, { colSpan: 4 }))];
    }
    $("checks").tBodies[0].replaceChildren(...rows);
  }
}
