// A ball that falls on the floor with the motion of the start, and one without spin, which leaves at another angle.
import { $, write } from "../dom.js";
import { drawFigure, figureOf, panelOf } from "../drawing/figure.js";
import { ScreenSurface } from "../drawing/screen_surface.js";
import { widthOf } from "../drawing/surface.js";
import { drawBall } from "../hero/hero_figure.js";
import { rotation } from "../hero/turning.js";
import { shown } from "../numbers.js";
import { shotOf } from "../plane/portrait_request.js";
import { tour } from "../state/presets.js";

const highest = 1;      // m
const haste = 3;        // the motion on the table lasts this many times as long as this one
const mostTurned = 60;  // rad, largest angle by which the drawn ball turns

const angleOf = ({ after, up }) => (Math.atan2(after, up) * 180) / Math.PI;

/** @param {Store} store @param {Controls} controls @returns a function that draws the card */
export function makeBounce(store, controls) {
  /** The rebounds without spin and with spin; or a message, which is empty while the card is hidden. @returns {Rebound[] | string} */
  const rebounds = () => {
    const { library, orbit, roller: ball, state: { law, drop, restitution, step } } = store;
    if (tour[step].shows !== "bounce") return "";
    if (!ball) return "A real ball that can roll bounces here: choose one in the settings.";
    const asBuilt = ball.patch === ball.initial?.patch && ball.patchBy === ball.initial.patchBy;
    return store.keep("rebounds", [ball, law, orbit, drop, restitution], () => {
      try {
        return [{ ...orbit, u: 0 }, orbit].map((start) => library.bounce(law, shotOf(ball, start), asBuilt, drop, restitution));
      } catch ({ message }) {
        return message;
      }
    });
  };
  controls.slider("drop", "falls from", ({ roller, state: { drop } }) => roller && { share: drop / highest, text: `${shown(drop, 2)} m` },
    (state, share) => (state.drop = Number(Math.max(0.01, share * highest).toPrecision(2))), $("bounce-sliders"));
  controls.slider("restitution", "restitution", ({ roller, state: { restitution } }) => roller && { share: restitution, text: shown(restitution, 2) },
    (state, share) => (state.restitution = Number(share.toFixed(2))), $("bounce-sliders"));
  store.shows.push(() => {
    const found = rebounds();
    const [plain, own] = typeof found === "string" ? [] : found;
    const leaves = (rebound) => `${shown(angleOf(rebound), 3)}° from the vertical, at ${shown(rebound.after, 3)} m/s along the floor`;
    write($("bounce-says"), own ? `The ball leaves ${leaves(own)}. Without spin: ${leaves(plain)}, as textbooks predict for both.` : found);
    $("bounce").setAttribute("aria-label", `Two balls that bounce. ${$("bounce-says").textContent}`);
  });
  return new ScreenSurface($("bounce"), (surface) => {
    const { theme, state: { drop, fraction, chosen }, orbit, roller: ball } = store;
    const bodies = rebounds();
    if (!ball || typeof bodies === "string") return surface.still([theme], theme.card, () => {});
    const [{ down, up, before }, { radius, gravity }] = [bodies[0], ball];
    const [falls, rises] = [down, 2 * up].map((speed) => speed / gravity);
    /** The centre of a ball, in m. */
    const placeAt = (t, { after }) => [t * (t < 0 ? before : after), radius + (t < 0 ? drop - (gravity * (t + falls) ** 2) / 2 : (up - (gravity * t) / 2) * t)];
    const colours = [theme.soft, theme.swatch(chosen)];
    const [low, high] = [-before * falls - radius, Math.max(...bodies.map(({ after }) => after)) * rises + radius];
    // The vertical axis fills the height of a picture that is higher than the motion; the floor stays at its lower end.
    const most = Math.max(Math.max(drop, (up * rises) / 4) + 2 * radius, ((high - low) * (surface.height - 5 * theme.textSize)) / surface.width);
    const [frame] = drawFigure(surface, [bodies, radius, chosen], () => figureOf(theme, { columns: 1, narrowest: 230 }, [{
      ...panelOf("", { name: "m", low, high }, { low: 0, high: most },
        bodies.map((body, i) => ({ colour: colours[i], width: 2.5, lines: Array.from({ length: 121 }, (_, j) => placeAt(((falls + rises) * j) / 120 - falls, body)).flat() }))),
      to_scale: true,
    }]), store);
    const time = Math.min(1, haste * fraction) * (falls + rises) - falls;
    const turned = (orbit.u / radius) * (falls + rises);
    bodies.forEach((body, i) => {
      const [x, y] = frame.pixel(placeAt(time, body));
      const turn = rotation([0, 0, (i * turned * Math.min(1, mostTurned / Math.abs(turned)) * (time + falls)) / (falls + rises)]);
      drawBall(surface, { x, y, radius: frame.px(radius) - frame.px(0), rolls: true }, turn, colours[i], theme);
      const style = { colour: colours[i], size: 1.1 * theme.textSize, bold: true, align: "right", halo: theme.card };
      const words = `${shown(angleOf(body), 3)}°`;
      // The angles stand over the tops of the paths, that of the ball without spin to the left.
      const [topX, topY] = frame.pixel(placeAt(up / gravity, body));
      surface.text(i ? Math.min(surface.width, topX + widthOf(words, style)) : topX - 6, topY - 6, words, style);
    });
  });
}
