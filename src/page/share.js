// What the reader takes along: a link, a command line, files.
import { commandLine } from "./command_line.js";
import { $, write } from "./dom.js";
import { csvOfOrbits, csvOfRide, filmOf, pngOf, save, textFile } from "./exports.js";
import { fillSelect, numberField } from "./fields.js";
import { plain } from "./markup.js";
import { toFragment } from "./page_state.js";
import { drawPanes } from "./panes_figure.js";
import { drawPortrait } from "./portrait_figure.js";
import { SvgSurface } from "./surface.js";

const widest = 12000;  // pixels; browsers have no larger canvas

export class Share {
  constructor(store, plane, hero, player, address) {
    this.store = store;
    const figures = {
      plane: ["the plane", "portrait", (surface) => drawPortrait(surface, { ...plane.scene(), cross: null }, store.theme)],
      lanes: ["the balls", "balls", (surface) => hero.drawBalls(surface)],
      patch: ["the patch", "patch", (surface) => hero.drawPatch(surface)],
      panes: ["the motion in time", "motion", (surface) => drawPanes(surface, store, store.theme)],
    };
    fillSelect($("picture"), Object.entries(figures).map(([name, [title]]) => ({ name, title })));
    const picture = () => {
      const [title, name, draw] = figures[$("picture").value];
      const { width, height } = $($("picture").value).getBoundingClientRect();
      const surface = new SvgSurface(Math.round(width), Math.round(height), `${title}: ${plain(store.portrait.figure.title)}`);
      draw(surface);
      return [name, surface.toString()];
    };
    const copy = async (text, what) => {
      try {
        await navigator.clipboard.writeText(text);
        write($("copied"), `${what} copied.`);
      } catch {
        write($("copied"), text);
      }
    };
    $("copy-link").addEventListener("click", () => {
      if (!address.link) $("copied").textContent = `This page has no address of its own here. What follows # in a link to it: ${toFragment(store.state)}`;
      else copy(address.link, location.protocol === "file:" ? "Link to the file on this computer" : "Link");
    });
    $("copy-embed").addEventListener("click", () => {
      const source = `${location.href.split("#")[0]}#${toFragment({ ...store.state, embed: true })}`;
      copy(`<iframe src="${source.replaceAll("&", "&amp;")}" width="800" height="760" title="${$("headline").textContent}"></iframe>`, "HTML");
    });
    $("copy-command").addEventListener("click", () => copy($("command").textContent, "Command"));
    $("copy-roll").addEventListener("click", () => copy($("roll-command").textContent, "Command"));
    $("save-svg").addEventListener("click", () => {
      const [name, svg] = picture();
      save(`${name}.svg`, textFile(svg, "image/svg+xml"));
    });
    let pngWidth = Math.max(2000, screen.width * devicePixelRatio);
    numberField($("png-width"), $("png-width-error"), (width) => {
      if (!(width >= 100 && width <= widest)) throw new Error(`100 to ${widest} pixels`);
      pngWidth = Math.round(width);
    }).show(pngWidth);
    $("save-png").addEventListener("click", async () => {
      const [name, svg] = picture();
      save(`${name}.png`, await pngOf(svg, pngWidth));
    });
    $("save-film").addEventListener("click", async () => {
      write($("copied"), `The film is being taken: ${Math.ceil(player.seconds)} s.`);
      save("balls.webm", await filmOf($("lanes"), (done) => player.once(done)));
      write($("copied"), "The film is saved.");
    });
    for (const [ending, type] of [["json", "application/json"], ["tex", "text/x-tex"]]) {
      $(`save-${ending}`).addEventListener("click", () => save(`portrait.${ending}`, textFile(store.library.portraitFile(store.request, ending), type)));
    }
    $("save-csv").addEventListener("click", () => {
      const [name, text] = store.contact && store.ride ? ["motion", csvOfRide(store.ride.courses[1])]
        : ["orbits", csvOfOrbits(store.state.orbits.map(({ u, v }) => store.library.plane.motion(u, v)))];
      save(`${name}.csv`, textFile(text, "text/csv"));
    });
  }

  show() {
    const { store: { state, request, portrait: { through }, body, library } } = this;
    const { portrait, roll } = commandLine(state, request, through, body, library.balls.find((ball) => ball.name === state.ball?.name));
    write($("command"), portrait);
    write($("roll-command"), roll ?? "");
    $("roll-line").hidden = !roll;
  }
}
