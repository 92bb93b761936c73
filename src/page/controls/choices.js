// Ball, body and law, and what the plane shows.
import { $, isStill, write } from "../dom.js";
import { choiceButtons } from "./fields.js";
import { save } from "../share/exports.js";
import { lawField, lawOfTable, tableOfLaw } from "./law_field.js";
import { shown } from "../numbers.js";
import { bodyOf, initialState, takeBall, unrolled } from "../state/page_state.js";
import { isDark } from "../drawing/theme.js";

/** The titles of entries of the library, by their names. */
const titlesOf = (entries) => Object.fromEntries(entries.map(({ name, title = name.replace("-", " ") }) => [name, title]));

const fieldTitles = { none: "none", motion: "of the motion (2.6)", regularised: "regularised (2.7)" };

/** @param {Controls} controls @param {Store} store @param {Plane} plane */
export function makeChoices(controls, store, plane) {
  const { balls, bodies, views, lawName } = store.library;
  const ofBalls = { "": "any size, any unit", ...titlesOf(balls) };
  controls.choose("ball", ofBalls, ({ ball }) => ball?.name ?? "", (state, value) => {
    const ball = balls.find(({ name }) => name === value);
    if (ball) takeBall(state, ball);
    else Object.assign(state, { ball: null, part: "whole", orbits: state.orbits.map(unrolled) });
  });
  controls.choose("body", { ...titlesOf(bodies), own: "your own χ and γ" }, ({ body }) => body, (state, body) => {
    state.body = body;
    const { mu, largestMu } = bodyOf(state, store.library);
    state.mu = mu ?? Math.min(state.mu, largestMu);
  });
  for (const [key, label] of Object.entries({ chi: "χ = 1 + mR²/J_h", gamma: "γ = mR²/J_z" })) {
    controls.number($("inertia"), key, label, ({ state }) => state[key], (state, value) => (state[key] = value));
  }
  controls.choose("field", fieldTitles, ({ field }) => field, (state, field) => (state.field = field));
  ["U", "V"].forEach((name, side) => {
    const shown = ({ portrait }) => Number(portrait.window[side].toPrecision(6));
    controls.number($("window"), name, name, shown, (state, value) => {
      plane.zooming.before = undefined;
      state.window = store.portrait.window.map((other, i) => (i === side ? value : other));
    });
  });
  const useLaw = (key) => (name) => store.change((state) => (state[key] = name && lawName(name)));
  const law = lawField("law", store, { key: "exponent", use: useLaw("law") });
  const against = lawField("against", store, { key: "against-exponent", none: "no other law", use: useLaw("against") });
  $("pressure").addEventListener("change", async () => {
    const text = await $("pressure").files[0]?.text().catch(() => "") ?? "";
    store.attempt(() => useLaw("law")(lawOfTable(text)));
    $("pressure").value = "";
  });
  const formulas = $("formulas");
  formulas.addEventListener("change", () => store.attempt(() => useLaw("law")(formulas.value.trim())));
  $("save-pressure").addEventListener("click", () => save("pressure.csv", tableOfLaw(store.state.law), "text/csv"));
  $("isochrones").addEventListener("change", () => store.ask((state) => {
    state.isochrones = $("isochrones").checked ? initialState().isochrones : 0;
  }));
  const showView = choiceButtons($("views"), titlesOf(views), (name) => plane.zooming.view(name));
  $("theme").addEventListener("click", () => store.ask((state) => {
    state.theme = state.theme === "auto" ? (isDark("auto") ? "light" : "dark") : "auto";
  }));
  $("lab").addEventListener("click", () => store.ask((state) => (state.lab = !state.lab), () => store.state.lab &&
    $("columns").scrollIntoView({ behavior: isStill() ? "instant" : "smooth" })));

  controls.shows.push(() => {
    const { state, facts, view, contact, request } = store;
    $("lab").setAttribute("aria-expanded", String(state.lab));
    law.show(state.law);
    if (state.law.includes("=") && document.activeElement !== formulas) formulas.value = state.law;
    $("save-pressure").hidden = !tableOfLaw(state.law);
    against.show(request.against);
    for (const option of $("against").options) option.disabled = option.value === state.law;
    $("isochrones").checked = state.isochrones > 0;
    $("field").disabled = $("isochrones").disabled = !view.layered;
    $("body-label").hidden = Boolean(state.ball);
    $("inertia").hidden = state.body !== "own";
    showView(state.view);
    write($("view-hint"), view.hint);
    const without = contact?.without ? `. The plane is without rolling friction: ${contact.without}.` : "";
    write($("terminal"), `k → ${shown(facts.terminalRatio, 6)}: ${facts.meaning}${without}`);
    $("theme").setAttribute("aria-label", `Theme: ${state.theme === "auto" ? "as the system" : state.theme}`);
  });
}
