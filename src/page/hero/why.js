// Why spin matters: the friction on points of the patch, and its sum along the slide. The reader turns the spin.
import { $ } from "../dom.js";
import { ScreenSurface } from "../drawing/screen_surface.js";
import { widthOf } from "../drawing/surface.js";
import { shown, spinText } from "../numbers.js";
import { arrowOf, drawArc } from "./hero_figure.js";
import { fullSpeeds } from "./tries.js";

/** Pressures of the patch at a share of its radius, divided by their mean. */
const hertz = (rho) => 1.5 * Math.sqrt(1 - rho * rho);
const percent = (force) => (force < 0.001 ? "0" : shown(100 * force, force < 0.1 ? 1 : 2));
const pressures = { uniform: () => 1, ring: (rho) => (rho > 0.7 ? 1.5 : 0) };

const arrowShare = 0.18;  // length of an arrow of mean pressure, in radii of the patch
const steps = Array.from({ length: 11 }, (_, i) => i - 5);
/** Points of the patch whose friction is drawn, in radii. */
const points = steps.flatMap((i) => steps.map((j) => [(i + (j % 2) / 2) / 5.5, (0.92 * j) / 5.5]))
    .filter(([x, y]) => Math.hypot(x, y) <= 0.88);

/**
 * Draws the friction on points of the patch, seen from above, and its sum along the slide, which goes to the right.
 * @param scene  v: speed of the slide; rim: speed of the patch's rim about its centre, positive to the left; force: the library's sum along the slide,
 *   divided by the friction without spin; pressure(rho): at a radius, in means; colour: of the body
 */
export function drawPatch(surface, { v, rim, force, pressure, colour }, theme) {
  const { width, height } = surface;
  const size = theme.textSize;
  const isWide = width > 1.35 * height;
  const radius = Math.min(isWide ? height / 2 : width / 2, isWide ? 0.27 * width : 0.3 * height) - 14;
  const [x0, y0] = isWide ? [radius + 18, height / 2] : [width / 2, radius + 18];
  const still = v === 0 && rim === 0;
  surface.still([theme], theme.card, () => surface.shape([[x0, y0]], { radius, fill: theme.paper, stroke: theme.soft, width: 1.5 }));
  const arrows = still ? [] : points.map(([x, y]) => {
    const [vx, vy] = [v - rim * y, rim * x];
    const share = (arrowShare * radius * pressure(Math.hypot(x, y))) / (Math.hypot(vx, vy) || Infinity);
    return arrowOf(x0 + x * radius + (vx * share) / 2, y0 - y * radius - (vy * share) / 2, -vx * share, vy * share, 0.06 * radius);
  });
  surface.shape(arrows.map(({ line }) => line), { stroke: theme.ink, width: 1.4 });
  surface.shape(arrows.map(({ head }) => head), { fill: theme.ink });
  // The spin, as an arc around the patch.
  drawArc(surface, x0, y0, radius + 9, 0, (1.9 * Math.PI * rim) / (Math.abs(rim) + v || 1), colour, 3);
  // The sums: without spin, and with it.
  const [left, room] = isWide ? [2 * radius + 52, width - 2 * radius - 60] : [8, width - 16];
  const align = isWide ? "left" : "center", middle = isWide ? left : width / 2;
  const said = "of the friction slows the slide", isNarrow = widthOf(said, { size: 1.15 * size, bold: true }) > 1.1 * room;
  const words = still ? ["at rest", "nothing rubs"] : [`${percent(force)} %`, ...(isNarrow ? ["of the friction", "slows the slide"] : [said])];
  const line = (text, y, style) => surface.text(middle, y, text, { ...style, align, baseline: "middle", size: style.size * Math.min(1, room / widthOf(text, style)) });
  const top = isWide ? height / 2 - 5 * size : 2 * radius + 36 + 1.6 * size;
  line(words[0], top, { colour, size: 3 * size, bold: true });
  words.slice(1).forEach((text, i) => line(text, top + (2.6 + 1.4 * i) * size, { colour: theme.ink, size: 1.15 * size, bold: true }));
  [["all of it, without spin", 1, theme.soft], ["what is left along the slide", force, colour]].forEach(([text, share, fill], i) => {
    const y = top + (words.length + 2.7 + 2.7 * i) * size;
    const { line: shaft, head } = arrowOf(left + room, y, -share * room, 0, Math.min(14, share * room));
    surface.shape([shaft], { stroke: fill, width: 6 });
    if (share > 0.004) surface.shape([head], { fill });
    surface.text(left + room, y + 1.25 * size, text, { colour: theme.soft, size, align: "right", baseline: "middle" });
  });
}

/** @param {Store} store @param {Controls} controls @param {Player} player */
export function makeWhy(store, controls, player) {
  /** @type {{of: string, u: number} | null} spin that the reader gives the patch */
  let asked = null;
  /** The shown motion: with the spin of the reader, at the moment while it plays, else at the start. The force is the library's. */
  const shownNow = () => {
    const { orbit, now, state: { fraction }, system, library } = store;
    if (player.playing || asked?.of !== JSON.stringify(orbit)) asked = null;
    const { u, v } = asked ? { u: asked.u, v: orbit.v } : now && fraction > 0 && fraction < 1 ? now : orbit;
    return { u, v, force: store.keep("force", [system, u, v], () => library.plane.force(u, v)) };
  };
  const draw = (surface) => {
    const { theme, ride, state: { chosen, law, mu } } = store;
    if (!ride) return;
    const { u, v, force } = shownNow();
    drawPatch(surface, { v, rim: mu * u, force, pressure: pressures[law] ?? hertz, colour: theme.swatch(chosen) }, theme);
    $("patch").setAttribute("aria-label", `The friction on points of the contact patch, from above: ${percent(force)} % of it slows the slide`);
  };
  const picture = new ScreenSurface($("patch"), draw);
  const most = ({ ball }) => fullSpeeds(ball).spin * (ball?.radius ?? 1);
  // Small spins have more of the slider.
  controls.slider("why", "spin", ({ orbit, state }) => {
    if (!orbit) return null;
    const { u, force } = shownNow();
    return { share: Math.sqrt(Math.abs(u) / most(state)), text: spinText(u, state), spoken: `${spinText(u, state)}: ${percent(force)} % of the friction slows the slide` };
  }, (state, share) => {
    player.toggle(false);
    asked = { of: JSON.stringify(store.orbit), u: share ** 2 * most(state) };
  }, $("why-slider-place"));
  return { picture, draw };
}
