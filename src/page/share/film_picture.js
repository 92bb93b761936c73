// The pictures of a film: headline, address and clock, and the bodies below them.
import { $ } from "../dom.js";
import { borderOf, widthOf } from "../drawing/surface.js";

const letters = { text: 12.5, title: 20, top: 62, rim: 12 };  // pixels: sizes of words, height of the head, rim
const cut = 0.4;  // share of the shorter slide at which the film of the question ends: the bodies are still almost side by side

/**
 * Draws a moment of a film.
 * @param {Hero} hero
 * @param share  share of the film without its last picture
 * @param asks   true: the film asks which body goes farther, and ends before one of them stops
 */
export function drawFilm(hero, surface, share, asks) {
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
