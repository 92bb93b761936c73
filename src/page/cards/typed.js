// A plane of the reader's own: typed equations, and orbits through points. The library draws it.
import { $, write } from "../dom.js";
import { withoutOptions } from "../controls/fields.js";
import { drawFigure } from "../drawing/figure.js";
import { listen } from "../drawing/gestures.js";
import { plain } from "../drawing/runs.js";
import { ScreenSurface } from "../drawing/screen_surface.js";
import { pointsIn } from "../state/page_state.js";

/** @param {Store} store @returns the drawing of the plane on a surface */
export function makeTyped(store) {
  const [equations, points, says] = ["typed", "typed-points", "typed-says"].map($);
  /** @type {Frame[]} */
  let frames = [];
  const draw = (surface) => {
    const { typed } = store;
    if (typed) frames = drawFigure(surface, [typed], () => typed, store);
  };
  const picture = new ScreenSurface($("typed-plane"), draw);
  const ask = (edit) => {
    write(says, "Computing…");
    // The browser shows the message before the work begins.
    setTimeout(() => {
      write($("typed-problem"), "");
      try {
        store.change(edit);
      } catch (error) {
        write($("typed-problem"), withoutOptions(error.message));
        write(says, "");
      }
    }, 50);
  };
  equations.addEventListener("change", () => {
    points.value = "";
    ask((state) => Object.assign(state, { system: equations.value.trim(), points: [] }));
  });
  points.addEventListener("change", () => ask((state) => (state.points = pointsIn(points.value))));
  const tap = (px, py) => {
    const [frame] = frames;
    if (!frame?.contains(px, py)) return;
    const { x, y } = frame.at(px, py);
    const rounded = ({ low, high }, value) => Number(value.toFixed(Math.max(0, 3 - Math.floor(Math.log10(high - low)))));
    ask((state) => state.points.push([rounded(frame.x, x), rounded(frame.y, y)]));
  };
  listen($("typed-plane"), { hold: () => null, move: () => {}, tap });
  store.shows.push((state) => {
    const { typed } = store;
    for (const id of ["typed-plane", "typed-points-label", "typed-command"]) $(id).hidden = !typed;
    write(says, typed ? "A click starts an orbit." : "");
    if (!typed) return;
    equations.value = state.system;
    if (document.activeElement !== points) points.value = state.points.map((point) => point.join(", ")).join("; ");
    const names = [...typed.panels[0].lines, ...typed.panels[0].marks].map(({ legend }) => plain(legend)).filter(Boolean);
    $("typed-plane").setAttribute("aria-label", `Phase portrait of ${state.system}. It shows ${names.join(", ")}.`);
    picture.drawInSight();
  });
  return { draw };
}
