// A film of a ball that the reader gives to the page: the library finds its friction and its patch, and the ball takes them.
import { $ } from "../dom.js";
import { csvOfFilm, save, textFile } from "./exports.js";
import { lawTitle } from "../controls/law_field.js";
import { startOf } from "../state/page_state.js";
import { drawFigure } from "../drawing/figure.js";
import { shotOf } from "../plane/portrait_request.js";
import { ScreenSurface } from "../drawing/screen_surface.js";

export class Film {
  constructor(store, player, ask) {
    this.store = store;
    this.player = player;
    this.ask = ask;
    /** @type {Figure | null} the data with the fitted motion, and what is left */
    this.figure = null;
    this.picture = new ScreenSurface($("film-fit"), (surface) => this.draw(surface));
    $("film").addEventListener("change", () => this.read($("film").files[0]));
    $("save-residuals").addEventListener("click", () => save("residuals.csv", textFile(csvOfFilm(this.store.measured.columns), "text/csv")));
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
      event.preventDefault();
      const file = event.dataTransfer?.files[0];
      if (file) this.read(file);
    });
  }

  draw(surface) {
    const { figure, store } = this;
    if (!figure) throw new Error("no film has been fitted");
    drawFigure(surface, [figure], () => figure, store);
  }

  redraw() {
    if (this.figure) this.picture.drawInSight();
  }

  show(figure) {
    const { store, picture, picture: { canvas } } = this;
    this.figure = figure;
    canvas.hidden = $("save-residuals").hidden = !figure;
    if (!figure) return;
    picture.fit(store.library.rowsOf(figure, canvas.clientWidth));
    this.redraw();
  }

  async read(file) {
    const say = (status, problem = "", { report = "", figure = null } = {}) => {
      $("film-status").textContent = status;
      $("film-problem").textContent = problem;
      $("film-report").textContent = report;
      $("film-report").hidden = !report;
      this.show(figure);
      $("film-card").scrollIntoView({ block: "nearest" });
    };
    this.ask((state) => (state.lab = true));
    try {
      say(`${file.name} is fitted...`);
      const text = await file.text();
      // What is said is seen before the work begins.
      await new Promise((seen) => setTimeout(seen, 50));
      const found = this.fit(file.name, text);
      say(`${file.name} is fitted: the ball above has its friction, patch, slip and spin now.`, "", found);
    } catch (error) {
      say("", error.message);
    }
    // The same file may be chosen again.
    $("film").value = "";
  }

  /** What the library finds, in words and as a figure; the ball is then as it was found. */
  fit(name, text) {
    const { store: { library, request, state } } = this;
    if (!state.ball) throw new Error("A film is of a real ball: choose one above, its radius is needed.");
    const laws = [request.law, request.against].filter(Boolean);
    const ball = request.ball ?? shotOf(state.ball, startOf(0, 0));
    const found = library.fit(text, name, ball, laws.join());
    this.store.measured = { columns: found.measured, ball: ball.name };
    this.ask((next) => Object.assign(next, {
      law: laws.find((law) => lawTitle(law) === found.law) ?? found.law, window: null, chosen: 0, fraction: 0, orbits: [startOf(found.spin * ball.radius, found.slip, found.velocityX, found.velocityY)],
      ball: { ...next.ball, friction: found.friction, patchBy: "patch_radius", patch: found.patch },
    }));
    this.player.toggle(this.player.moves);
    return { report: `${found.notes}${found.report}`, figure: found.figure };
  }
}
