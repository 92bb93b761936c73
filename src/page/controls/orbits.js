// The list of the reader's orbits, and the form that starts one.
import { $, make, showList, write } from "../dom.js";
import { parseNumber, shown } from "../numbers.js";

/** @param {Store} store @param {Plane} plane */
export function makeOrbits(store, plane) {
  const list = $("orbits");
  const form = $("add-orbit");

  function item() {
    const choose = make("button", { type: "button" }, make("span", { className: "start" }), make("span", { className: "stop" }));
    const discard = make("button", { type: "button", textContent: "✕", className: "remove" });
    const entry = make("li", {}, choose, discard);
    const index = () => [...list.children].indexOf(entry);
    choose.addEventListener("click", () => plane.chooseOrbit(index()));
    discard.addEventListener("click", () => {
      const removed = index();
      plane.removeOrbit(removed);
      // The focus stays near the removed orbit.
      const next = list.children[Math.min(removed, list.children.length - 1)];
      /** @type {HTMLElement} */ (next?.querySelector(".remove") ?? form.elements.u).focus();
    });
    return entry;
  }

  /** Shows fields for slip and spin of a real ball, else for the reduced speeds. */
  const titles = () => (store.state.ball ? { u: "spin (rad/s)", v: "slip (m/s)" } : { u: "u₀", v: "v₀" });
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    let [what, problem] = ["", ""];
    try {
      const [u, v] = ["u", "v"].map((name) => {
        what = `${titles()[name]}: `;
        return parseNumber(form.elements[name].value);
      });
      what = "This start cannot be shown: ";
      if (v < 0) throw new Error(`${titles().v} must be ≥ 0`);
      if (u === 0 && v === 0) throw new Error("both speeds are 0: that is a body at rest");
      plane.startOrbit({ u: u * (store.state.ball?.radius ?? 1), v }, (edit, done) => done(store.change(edit)));
    } catch (error) {
      problem = what + error.message;
    }
    write(form.querySelector("output"), problem);
  });
  $("clear-orbits").addEventListener("click",
    () => store.ask((state) => Object.assign(state, { orbits: [], isochrone: 0, fraction: 0 })));

  store.shows.push(({ orbits, chosen, ball }) => {
    const { motions, others, request, theme } = store;
    $("clear-orbits").hidden = orbits.length < 2;
    for (const [name, title] of Object.entries(titles())) write(form.elements[name].previousElementSibling, title);
    showList(list, orbits, item, (entry, { u, v }, index) => {
      entry.className = index === chosen ? "chosen" : "";
      entry.style.setProperty("--swatch", theme.swatch(index));
      entry.dataset.tau = motions[index].stop;
      const [choose, discard] = entry.children;
      choose.setAttribute("aria-pressed", String(index === chosen));
      write(choose.children[0], `u₀ = ${shown(u, 4)}, v₀ = ${shown(v, 4)}` +
        (ball ? `: spin ${shown(u / ball.radius, 4)} rad/s, slip ${shown(v, 4)} m/s` : ""));
      const other = others ? `; by ${request.against} ${store.stopText(others[index])}` : "";
      write(choose.children[1], `stops at ${store.stopText(motions[index].stop)}${other}`);
      discard.setAttribute("aria-label", `Remove orbit ${index + 1}`);
    });
  });
}
