// A film of a ball. The library finds friction and patch, and the ball of the page gets these values.
import { $ } from "../dom.js";
import { csvOfFilm, save } from "./exports.js";
import { startFrom, startOf } from "../state/page_state.js";
import { drawFigure } from "../drawing/figure.js";
import { shotOf } from "../plane/portrait_request.js";
import { ScreenSurface } from "../drawing/screen_surface.js";

/** @param {Store} store @param {Player} player @returns draw(surface) */
export function makeFilm(store, player) {
  /** @type {Figure | null} the data with the fitted motion and the residuals */
  let figure = null;
  const draw = (surface) => {
    const fitted = figure;
    if (!fitted) throw new Error("no film has been fitted");
    drawFigure(surface, [fitted], () => fitted, store);
  };
  const picture = new ScreenSurface($("film-fit"), (surface) => {
    if (!figure) return;
    surface.fit(store.library.rowsOf(figure, surface.width));
    draw(surface);
  });

  /** Shows the result of the library in words and as a figure, and gives the ball the fitted values. */
  const fit = (name, text) => {
    const { library, request, state } = store;
    if (!state.ball) throw new Error("Choose a real ball above first: the fit needs its radius.");
    const laws = request.against ? [request.law, request.against] : [request.law];
    const ball = request.ball ?? shotOf(state.ball, startOf(0, 0));
    const found = library.fit(text, name, ball, laws);
    store.measured = { columns: found.measured, ball: ball.name };
    store.ask((next) => Object.assign(next, {
      law: found.law, window: null, chosen: 0, fraction: 0,
      orbits: [startFrom(found.start, ball)],
      ball: { ...next.ball, friction: found.friction, patchBy: "patch_radius", patch: found.patch },
    }));
    player.begin();
    return { report: `${found.notes}${found.report}`, figure: found.figure };
  };

  const say = (status, problem = "", found = { report: "", figure: /** @type {Figure | null} */ (null) }) => {
    $("film-status").textContent = status;
    $("film-problem").textContent = problem;
    $("film-report").textContent = found.report;
    figure = found.figure;
    $("film-report").hidden = $("film-fit").hidden = $("save-residuals").hidden = !figure;
    picture.measure();
    picture.draw();
    store.show();
    $("film-card").scrollIntoView({ block: "nearest" });
  };
  const read = async (file) => {
    store.ask((state) => (state.lab = true));
    try {
      say(`Fitting ${file.name}...`);
      const text = await file.text();
      // The browser shows the message before the work begins.
      await new Promise((seen) => setTimeout(seen, 50));
      const found = fit(file.name, text);
      say(`${file.name} is fitted. The ball above now has the fitted friction, patch, slip and spin.`, "", found);
    } catch (error) {
      // The page has no options.
      say("", error.message.replace("no row has a time between --from and --until", "the file has no rows"));
    }
    // The same file may be chosen again.
    $("film").value = "";
  };
  $("film").addEventListener("change", () => read($("film").files[0]));
  $("save-residuals").addEventListener("click", () => save("residuals.csv", csvOfFilm(store.measured?.columns ?? {}), "text/csv"));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) read(file);
  });
  store.shows.push(() => picture.drawInSight());
  return { draw };
}
