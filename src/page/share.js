// What the reader takes along: a link, a command line, files.
import { commandLine } from "./command_line.js";
import { $ } from "./dom.js";
import { csvOf, filmOf, pngOf, save, textFile } from "./exports.js";
import { plain } from "./markup.js";
import { toFragment } from "./page_state.js";
import { drawPortrait } from "./portrait_figure.js";
import { SvgSurface } from "./surface.js";

export class Share {
  constructor(store, plane, player, address) {
    this.store = store;
    this.plane = plane;
    const copy = async (text, what) => {
      try {
        await navigator.clipboard.writeText(text);
        $("copied").textContent = `${what} copied.`;
      } catch {
        $("copied").textContent = text;
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
    $("save-svg").addEventListener("click", () => save("portrait.svg", textFile(this.svg(), "image/svg+xml")));
    $("save-png").addEventListener("click", async () => save("portrait.png", await pngOf(this.svg())));
    $("save-film").addEventListener("click", async () => {
      $("copied").textContent = `The film is being taken: ${Math.ceil(player.seconds)} s.`;
      save("balls.webm", await filmOf($("lanes"), (done) => player.once(done)));
      $("copied").textContent = "The film is saved.";
    });
    for (const [ending, type] of [["json", "application/json"], ["tex", "text/x-tex"]]) {
      $(`save-${ending}`).addEventListener("click", () => save(`portrait.${ending}`, textFile(store.library.portraitFile(store.request, ending), type)));
    }
    $("save-csv").addEventListener("click", () => save("orbits.csv", textFile(csvOf(store.state.orbits.map(({ u, v }) => store.library.plane.motion(u, v)), store.contact?.secondsPerTau), "text/csv")));
  }

  svg() {
    const { width, height } = $("plane").getBoundingClientRect();
    const surface = new SvgSurface(Math.round(width), Math.round(height), plain(this.store.portrait.figure.title));
    drawPortrait(surface, { ...this.plane.scene(), cross: null }, this.plane.theme);
    return surface.toString();
  }

  show() {
    const { store: { state, request, portrait: { through }, body, library } } = this;
    const { portrait, roll } = commandLine(state, request, through, body, library.balls.find((ball) => ball.name === state.ball?.name));
    $("command").textContent = portrait;
    $("roll-command").textContent = roll ?? "";
    $("roll-line").hidden = !roll;
  }
}
