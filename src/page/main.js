// The page: what the reader does changes the state, and the state is drawn.
import { Address } from "./state/address.js";
import { makeChecks } from "./controls/checks.js";
import { makeBallCard } from "./controls/ball_card.js";
import { makeChoices } from "./controls/choices.js";
import { makeControls } from "./controls/fields.js";
import { makeSliders } from "./controls/sliders.js";
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
import { makePresets } from "./controls/presets_nav.js";
import { makeShare } from "./share/share.js";
import { Store } from "./state/store.js";
import { ScreenSurface } from "./drawing/screen_surface.js";
import { makeThrowing } from "./hero/throwing.js";
import { makeTour } from "./controls/tour.js";

function start(library) {
  const opens = speaksOfNothing(location.hash);
  const store = new Store(library, fromFragment(location.hash, library));
  /** Runs what may be rejected, and tells the reader. */
  const attempt = (action) => {
    try {
      action();
      write($("problem"), "");
    } catch (error) {
      controls.show();
      write($("problem"), error.message);
    }
  };
  const ask = (edit, done = () => {}) => attempt(() => {
    store.change((state) => {
      edit(state);
      // Without motion the end is shown.
      if (!player.moves && state.fraction === 0) state.fraction = 1;
    });
    done();
  });
  const stopText = (tau) => {
    const inTau = `τ* = ${shown(tau, 7)}${store.contact ? " m/s" : ""}`;
    return store.contact ? `${shown(tau * store.timeFactor, 6)} s  (${inTau})` : inTau;
  };
  const player = new Player(store, ask);
  const hero = new Hero(store, player);
  const plane = new Plane(store, { ask, stopText, removeOrbit: (index) => orbits.remove(index) });
  const controls = makeControls(store, ask);
  for (const make of [makeChoices, makeSliders, makeBallCard]) make(controls, store, plane, { ask, attempt });
  const orbits = makeOrbits(store, plane, { ask, stopText });
  const address = new Address(store, (asked) => ask((state) => Object.assign(state, asked)));
  const film = makeFilm(store, player, ask);
  const go = (fragment, step = 0) => ask((state) => Object.assign(state, fromFragment(fragment, library), { step, theme: state.theme, embed: state.embed, lab: state.lab }), () => player.toggle(player.moves));
  makeThrowing(store, hero, player, plane);

  const paneSurface = new ScreenSurface($("panes"), (surface) => {
    surface.fit(library.rowsOf(panes, surface.width));
    drawPanes(surface, store);
  });
  const copies = new ScreenSurface($("copies"), (surface) => drawCopies(surface, store, plane));
  const draw = () => {
    const { contact, now, end, timeFactor } = store;
    plane.draw();
    hero.draw();
    paneSurface.drawInSight();
    copies.drawInSight();
    player.show();
    write($("instant"), now
      ? `${contact ? `t = ${shown(now.tau * timeFactor, 5)} s` : `τ = ${shown(now.tau, 5)}`} of ` +
        `${shown(end * timeFactor, 5)}:  u = ${shown(now.u, 4)}, v = ${shown(now.v, 4)}${now.u === 0 && now.v === 0 ? ", no slip" : `, k = ${shown(now.k, 4)}`}`
      : "No orbit yet: click the plane.");
  };
  const shows = [
    () => plane.label(), () => hero.show(), controls.show, orbits.show, film.redraw, makeChecks(store), makeTour(go), makePresets(library, go),
    makeShare(store, { plane, hero, player, address, film }),
  ];
  store.listen(({ moment }) => {
    if (!moment) {
      for (const kind of ["embed", "lab"]) document.documentElement.classList.toggle(kind, store.state[kind]);
      document.documentElement.dataset.step = String(store.state.step);
      for (const show of shows) show(store.state);
    }
    draw();
    if (!player.playing || !moment) address.rememberSoon();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => ask(() => {}));
  // Paper is light, and has the end.
  let screen;
  addEventListener("beforeprint", () => {
    const { theme, fraction } = store.state;
    screen = { theme, fraction };
    ask((state) => Object.assign(state, { theme: "light", fraction: 1 }));
    for (const surface of [hero.lanes, hero.patch, plane.surface, paneSurface, copies]) surface.draw();
  });
  addEventListener("afterprint", () => ask((state) => Object.assign(state, screen)));
  $("app").hidden = false;
  $("first-picture").remove();
  player.moves = !isStill();
  ask(() => {});
  // Who opens the page is asked; a link to a moment shows that moment, other links play.
  if (player.moves && opens && !store.state.embed) hero.ask();
  else if (player.moves && store.state.fraction === 0) player.toggle(true);
  return { store, player, hero, plane, library, get state() { return store.state; } };
}

loadLibrary().then((library) => (globalThis.page = start(library))).catch(globalThis.contensouFailed);
