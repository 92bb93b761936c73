// The page. Actions of the reader change the state, and the page draws the state.
import { Address } from "./state/address.js";
import { makeBounce } from "./cards/bounce.js";
import { makeCue } from "./cards/cue.js";
import { makeControls } from "./controls/fields.js";
import { makeSettings } from "./controls/settings.js";
import { drawCopies } from "./plane/copies_figure.js";
import { $, isStill, write } from "./dom.js";
import { makeFilm } from "./share/film.js";
import { Hero } from "./hero/hero.js";
import { loadLibrary } from "./library.js";
import { shown } from "./numbers.js";
import { makeOrbits } from "./controls/orbits.js";
import { fromFragment, speaksOfNothing } from "./state/page_state.js";
import { drawPanes, panes } from "./share/panes_figure.js";
import { Plane } from "./plane/plane.js";
import { Player } from "./state/player.js";
import { rounds, tour } from "./state/presets.js";
import { today } from "./hero/tries.js";
import { makeShare } from "./share/share.js";
import { Store } from "./state/store.js";
import { ScreenSurface } from "./drawing/screen_surface.js";
import { makeThrowing } from "./hero/throwing.js";
import { makeWhy } from "./hero/why.js";
import { makeTyped } from "./cards/typed.js";
import { makePresets, makeTour } from "./controls/tour.js";

function start(library) {
  const opens = speaksOfNothing(location.hash, library);
  /** @type {string[]} */
  const problems = [];
  const store = new Store(library, fromFragment(location.hash, library, problems));
  store.moves = !isStill();
  store.tell = (problem) => {
    if (problem) store.show();
    write($("problem"), problem);
  };
  const player = new Player(store);
  const hero = new Hero(store, player);
  const plane = new Plane(store);
  const controls = makeControls(store);
  makeSettings(controls, store, plane);
  const why = makeWhy(store, controls, player);
  const { picture: cue, start: startByCue } = makeCue(store, controls, player);
  const bounce = makeBounce(store, controls);
  makeOrbits(store, plane);
  const address = new Address(store, hero);
  makeShare(store, { plane, hero, why, player, address, film: makeFilm(store, player), typed: makeTyped(store) });
  const go = (fragment, done = () => player.begin()) => store.ask((state) => {
    const { theme, embed, project, lab } = state;
    Object.assign(state, fromFragment(fragment, library), { theme, embed, project, lab });
  }, done);
  // Buttons for the question and for the game.
  const toRound = (round) => go(round, () => {
    player.toggle(false);
    hero.say("");
    $("lanes").focus();
  });
  $("again").addEventListener("click", () => go("", () => hero.ask()));
  $("to-line").addEventListener("click", () => toRound(rounds[0]));
  $("today-line").addEventListener("click", () => toRound(`day=${today()}`));
  $("next-line").addEventListener("click", () => toRound(rounds[(rounds.findIndex((round) => round.includes(`line=${store.state.line}`)) + 1) % rounds.length]));
  const project = (on = !store.state.project) => store.ask((state) => (state.project = on));
  $("project").addEventListener("click", () => project());
  addEventListener("keydown", ({ key, target }) => {
    if (key === "P" && !(target instanceof HTMLInputElement && target.inputMode === "decimal") && target !== $("formulas")) project();
    if (key === "Escape" && store.state.project) project(false);
  });
  $("try-line").addEventListener("click", () => {
    $("lanes").scrollIntoView({ block: "center" });
    $("lanes").focus();
  });
  makeTour(store, go);
  makePresets(store, go);
  makeThrowing(store, hero, player, plane, startByCue);

  const paneSurface = new ScreenSurface($("panes"), (surface) => {
    surface.fit(library.rowsOf(panes, surface.width));
    drawPanes(surface, store);
  });
  const copies = new ScreenSurface($("copies"), (surface) => drawCopies(surface, store, plane));
  const draw = () => {
    const { contact, now, end, timeFactor } = store;
    plane.draw();
    hero.draw();
    why.picture.drawInSight();
    bounce.drawInSight();
    paneSurface.drawInSight();
    copies.drawInSight();
    player.show();
    write($("instant"), now
      ? `${contact ? `t = ${shown(now.tau * timeFactor, 5)} s` : `τ = ${shown(now.tau, 5)}`} of ` +
        `${shown(end * timeFactor, 5)}:  u = ${shown(now.u, 4)}, v = ${shown(now.v, 4)}${now.u === 0 && now.v === 0 ? ", no slip" : `, k = ${shown(now.k, 4)}`}`
      : "No motion yet: choose a place in the plane.");
  };

  store.changed = (moment) => {
    if (!moment) {
      for (const kind of ["embed", "project", "lab"]) document.documentElement.classList.toggle(kind, store.state[kind]);
      document.documentElement.dataset.shows = tour[store.state.step].shows;
      store.show();
    }
    $("project").setAttribute("aria-pressed", String(store.state.project));
    draw();
    if (!player.playing || !moment) address.rememberSoon();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => store.ask(() => {}));
  // A printed page is light and shows the end of the motion.
  let screen;
  addEventListener("beforeprint", () => {
    const { theme, fraction } = store.state;
    screen = { theme, fraction };
    store.ask((state) => Object.assign(state, { theme: "light", fraction: 1 }));
    for (const surface of [hero.lanes, why.picture, plane.surface, bounce, cue, paneSurface, copies]) surface.draw();
  });
  addEventListener("afterprint", () => store.ask((state) => Object.assign(state, screen)));
  $("app").hidden = false;
  $("first-picture").remove();
  store.ask(() => {}, undefined, problems);
  // Without a link, the page asks the question. A link to a moment shows this moment; other links play.
  if (store.moves && opens && !store.state.embed) hero.ask();
  else if (store.state.fraction === 0 && !store.state.line) player.begin();
  return { store, player, hero, plane, library, get state() { return store.state; } };
}

loadLibrary().then((library) => (globalThis.page = start(library))).catch(globalThis.contensouFailed);
