// What the theory says of the chosen orbit, as a table: computed when the reader has paused.
import { $, make } from "../dom.js";
import { shown } from "../numbers.js";

const pause = 350;  // ms

/** @param {Store} store */
export function makeChecks(store) {
  const [card, table] = [$("checks-card"), $("checks")];
  let [known, timer] = ["", 0];
  const cell = (textContent, properties = {}) => make("td", { textContent, ...properties });
  const row = ({ name, measured, allowed, passed }) =>
    make("tr", {}, cell(name), cell(shown(measured, 2)), cell(shown(allowed, 2)), cell(passed ? "ok" : "FAIL", { className: passed ? "" : "failed" }));
  const rowsOf = ({ u, v }) => {
    try {
      return store.library.plane.checks(u, v).map(row);
    } catch (error) {
      return [make("tr", {}, cell(error.message, { colSpan: 4 }))];
    }
  };
  const show = () => {
    const { state: { law, mu, body, chi, gamma }, orbit } = store;
    const key = JSON.stringify([law, mu, body, chi, gamma, orbit]);
    if (key === known || !card.open) return;
    known = key;
    clearTimeout(timer);
    table.setAttribute("aria-busy", "true");
    timer = setTimeout(() => {
      table.removeAttribute("aria-busy");
      table.tBodies[0].replaceChildren(...orbit ? rowsOf(orbit) : []);
    }, pause);
  };
  card.addEventListener("toggle", show);
  store.shows.push(show);
}
