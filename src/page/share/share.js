// Buttons for a link, a command line and files.
import { commandLine, typedCommand } from "../plane/command_line.js";
import { $, write } from "../dom.js";
import { csvOfOrbits, csvOfRide, pngOf, save } from "./exports.js";
import { fillSelect, numberField } from "../controls/fields.js";
import { plain } from "../drawing/runs.js";
import { shown } from "../numbers.js";
import { initialState, toFragment } from "../state/page_state.js";
import { drawPanes } from "./panes_figure.js";
import { drawPortrait } from "../drawing/figure.js";
import { SvgSurface, borderOf, widthOf } from "../drawing/surface.js";
import { inTries } from "../hero/story.js";
import { marksOf } from "../hero/tries.js";
import { filmOf } from "./video.js";

/** The film of a motion; and one for phones that ends before the answer, and asks. */
const films = { whole: { size: { width: 1280, height: 720 }, zoom: 2, rests: 2 }, question: { size: { width: 1080, height: 1080 }, zoom: 3, seconds: 4, rests: 2 } };

const letters = { text: 12.5, title: 20, top: 62, rim: 12 };  // pixels: sizes of words, height of the head, rim
const cut = 0.4;  // share of the shorter slide at which the film of the question ends: the bodies are still almost side by side
const widest = 12000;  // pixels; browsers have no larger canvas

/** @param {Store} store */
export function makeShare(store, { plane, hero, why, player, address, film, typed }) {
  const figures = {
    plane: ["the plane", "portrait", (surface) => drawPortrait(surface, { ...plane.scene(), cross: null }, store)],
    lanes: ["the balls", "balls", (surface) => hero.drawBalls(surface)],
    patch: ["the patch", "patch", (surface) => why.draw(surface)],
    panes: ["the motion in time", "motion", (surface) => drawPanes(surface, store)],
    "typed-plane": ["your own plane", "system", typed.draw],
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
  /** Copies a link to a state, with words before it. */
  const copyLink = (state, words = "") => {
    const link = address.linkOf(state);
    if (!link) return tell(`This page has no address here. Add this to a link to the page: #${toFragment(state)}`);
    return copy(words + link, location.protocol === "file:" ? "Link to the file on this computer" : "Link");
  };
  on("copy-link", () => copyLink(store.state));
  // A friend gets the line and the number of tries, but no throw.
  on("send", () => {
    const { state, state: { chosen: tries, line, day, orbits: [first] } } = store;
    const what = hero.stone ? "around the stone" : day ? `line of ${day} (${line} m)` : `line at ${line} m`;
    const { ball, body, law, mu, part, step } = state;
    return copyLink({ ...initialState(), ball, body, law, mu, part, step, line, day, tries, orbits: [first] }, `contensou, ${what}, ${inTries(tries)}: ${marksOf(store)}\n`);
  });
  on("copy-embed", async () => {
    const source = `${location.href.split("#")[0]}#${toFragment({ ...store.state, embed: true })}`;
    await copy(`<iframe src="${source.replaceAll("&", "&amp;")}" width="800" height="760" title="${$("headline").textContent}"></iframe>`, "HTML");
    if (location.protocol !== "file:") return;
    $("copied").append(" It names the file on this computer. For readers put the page on a server and use its address there.");
  });
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
    const asks = hero.mode === "judged" && id === "film-line";
    const draw = (surface, share) => {
      if (hero.key !== key) throw new Error("the motion was changed before its film was made");
      drawFilm(hero, surface, share, asks);
    };
    const how = asks ? films.question : { ...films.whole, seconds: player.seconds };
    save(asks ? "question.mp4" : "balls.mp4", await filmOf(how, draw, (share) => tell(`Film: ${Math.round(100 * share)} % is made.`)), "video/mp4");
    tell("The film is saved.");
  });
  on("save-csv", () => {
    const [name, text] = store.contact && store.ride ? ["motion", csvOfRide(store.ride.courses[1])]
      : ["orbits", csvOfOrbits(store.state.orbits.map(({ u, v }) => store.library.plane.motion(u, v)))];
    save(`${name}.csv`, text, "text/csv");
  });

  store.shows.push(() => {
    const { state, request, portrait: { through }, body, contact, library } = store;
    const { portrait, roll } = commandLine(state, request, through, body, library.balls.find((ball) => ball.name === state.ball?.name));
    write($("command"), portrait);
    write($("roll-command"), roll ?? "");
    $("roll-line").hidden = !roll;
    if (store.typed) write($("typed-command"), typedCommand(state, store.typed));
    // A hidden part of the page has no picture.
    for (const option of $("picture").options) option.hidden = $(option.value).hidden;
    const { ball, law } = state;
    $("engine-line").hidden = !ball || !contact;
    if (!ball || !contact) return;
    const changed = [...(ball.friction === ball.initial?.friction ? [] : ["--friction", ball.friction]), ...(law === ball.initial?.law ? [] : ["--law", law])];
    write($("engine-command"), `contensou engine --ball ${ball.name}${changed.map((word) => ` ${word}`).join("")}`);
    write($("engine-numbers"), `sliding friction ${shown(ball.friction)}, largest moment of friction ${shown(1000 * contact.momentArm, 4)} mm times the load`);
  });
}

/**
 * Draws a moment of a film.
 * @param {Hero} hero
 * @param share  share of the film without its last picture
 * @param asks   true: the film asks which body goes farther, and ends before one of them stops
 */
function drawFilm(hero, surface, share, asks) {
  const { player, store, store: { state: { fraction } }, asked } = hero;
  if (asks) hero.asked = { key: hero.key, guess: "", ended: false, turn: 0 };
  store.state.fraction = asks ? share * cut * hero.bodies[0].share : share;
  const theme = { ...store.theme, textSize: letters.text };
  const { width, height, context } = surface;
  surface.shape([borderOf(surface)], { fill: theme.card });
  const headline = asks && share === 1 ? "Which one slides farther?" : hero.said.headline;
  const title = { colour: theme.ink, bold: true, size: letters.title };
  surface.text(letters.rim, 28, headline, { ...title, size: letters.title * Math.min(1, (width - 2 * letters.rim) / widthOf(headline, title)) });
  const small = { colour: theme.soft, size: letters.text };
  // The address shows the source of a film that is sent on.
  surface.text(letters.rim, 50, /^http/.test(location.protocol) ? `${location.host}${location.pathname}` : "contensou", small);
  const clock = [player.timeText(store.now.tau), asks ? "" : $("pace").textContent].filter(Boolean).join(", ");
  surface.text(width - letters.rim, 50, clock, { ...small, align: "right" });
  context.save();
  // The words of the table begin 4 pixels from its left side.
  context.translate(letters.rim - 4, letters.top);
  Object.assign(surface, { width: width - 2 * letters.rim + 8, height: height - letters.top });
  hero.drawBalls(surface, { theme }, null, null);
  Object.assign(surface, { width, height });
  context.restore();
  hero.asked = asked;
  store.state.fraction = fraction;
}
