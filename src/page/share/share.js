// Buttons for a link, a command line and files.
import { commandLine } from "../plane/command_line.js";
import { $, write } from "../dom.js";
import { citation, csvOfOrbits, csvOfRide, pngOf, save } from "./exports.js";
import { fillSelect, numberField } from "../controls/fields.js";
import { plain } from "../drawing/runs.js";
import { toFragment } from "../state/page_state.js";
import { drawPanes } from "./panes_figure.js";
import { drawPortrait } from "../drawing/figure.js";
import { SvgSurface } from "../drawing/surface.js";
import { filmOf } from "./video.js";

const widest = 12000;  // pixels; browsers have no larger canvas

/** @param {Store} store */
export function makeShare(store, { plane, hero, player, address, film }) {
  const figures = {
    plane: ["the plane", "portrait", (surface) => drawPortrait(surface, { ...plane.scene(), cross: null }, store)],
    lanes: ["the balls", "balls", (surface) => hero.drawBalls(surface)],
    patch: ["the patch", "patch", (surface) => hero.drawPatch(surface)],
    panes: ["the motion in time", "motion", (surface) => drawPanes(surface, store)],
    "film-fit": ["the fit of a film", "fit", (surface) => film.draw(surface)],
  };
  fillSelect($("picture"), Object.fromEntries(Object.entries(figures).map(([name, [title]]) => [name, title])));
  const picture = () => {
    const [title, name, draw] = figures[$("picture").value];
    const { width, height } = $($("picture").value).getBoundingClientRect();
    return { title, name, draw, width: Math.round(width), height: Math.round(height) };
  };
  const tell = (text) => {
    write($("copied"), text);
    hero.say(text);
  };
  /** Connects a button to an action. If the action fails, the page shows the reason. */
  const on = (id, action) => $(id).addEventListener("click", async () => {
    try {
      await action();
    } catch (error) {
      tell(`This could not be done: ${error.message || error.name}.`);
    }
  });
  const copy = async (text, what) => {
    const copied = await navigator.clipboard?.writeText(text).then(() => true, () => false);
    tell(copied ? `${what} copied.` : text);
  };
  const copyLink = () => {
    if (!address.link) return tell(`This page has no address here. Add this to a link to the page: #${toFragment(store.state)}`);
    return copy(address.link, location.protocol === "file:" ? "Link to the file on this computer" : "Link");
  };
  for (const id of ["copy-link", "send"]) on(id, copyLink);
  on("copy-embed", async () => {
    const source = `${location.href.split("#")[0]}#${toFragment({ ...store.state, embed: true })}`;
    await copy(`<iframe src="${source.replaceAll("&", "&amp;")}" width="800" height="760" title="${$("headline").textContent}"></iframe>`, "HTML");
    if (location.protocol !== "file:") return;
    $("copied").append(" It names the file on this computer. For readers put the page on a server and use its address there.");
  });
  on("copy-citation", () => copy(citation(address.link ?? "", $("version").textContent), "BibTeX"));
  on("copy-command", () => copy($("command").textContent, "Command"));
  on("copy-roll", () => copy($("roll-command").textContent, "Command"));
  on("save-svg", () => {
    const { title, name, draw, width, height } = picture();
    const surface = new SvgSurface(width, height, `${title}: ${plain(store.portrait.figure.title)}`);
    draw(surface);
    save(`${name}.svg`, surface.toString(), "image/svg+xml");
  });
  let pngWidth = Math.max(2000, screen.width * devicePixelRatio);
  const useWidth = (width) => {
    if (!(width >= 100 && width <= widest)) throw new Error(`100 to ${widest} pixels`);
    pngWidth = Math.round(width);
  };
  numberField($("pictures"), { key: "png-width", label: "pixels of the PNG", use: useWidth })(pngWidth);
  on("save-png", async () => {
    const { name, draw, ...size } = picture();
    save(`${name}.png`, await pngOf(draw, size, pngWidth), "image/png");
  });
  for (const id of ["save-film", "film-line"]) on(id, async () => {
    if (!store.ride) throw new Error("there is no motion");
    const { key } = hero;
    const draw = (surface, share) => {
      if (hero.key !== key) throw new Error("the motion was changed before its film was made");
      hero.drawFilm(surface, share);
    };
    save("balls.mp4", await filmOf(player.seconds, draw, (share) => tell(`Film: ${Math.round(100 * share)} % is made.`)), "video/mp4");
    tell("The film is saved.");
  });
  on("save-tex", () => save("portrait.tex", store.library.plane.portraitFile(store.request), "text/x-tex"));
  on("save-csv", () => {
    const [name, text] = store.contact && store.ride ? ["motion", csvOfRide(store.ride.courses[1])]
      : ["orbits", csvOfOrbits(store.state.orbits.map(({ u, v }) => store.library.plane.motion(u, v)))];
    save(`${name}.csv`, text, "text/csv");
  });

  store.shows.push(() => {
    const { state, request, portrait: { through }, body, library } = store;
    const { portrait, roll } = commandLine(state, request, through, body, library.balls.find((ball) => ball.name === state.ball?.name));
    write($("command"), portrait);
    write($("roll-command"), roll ?? "");
    $("roll-line").hidden = !roll;
    // Without a fit, a film has no picture.
    const { options } = $("picture");
    options[options.length - 1].hidden = $("film-fit").hidden;
  });
}
