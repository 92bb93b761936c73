// v, u and k against time.
import { drawFigure, figureOf, panelOf } from "../drawing/figure.js";
import { italic } from "../drawing/runs.js";
import { decades } from "../numbers.js";

const deepest = -6;      // decades of k that are shown below 1, at least
const most = 1500;       // points of a film that are drawn
const scales = { v: Number, u: Number, k: Math.log10 };

export const panes = { panels: Object.keys(scales), columns: 3, narrowest: 190 };

export function drawPanes(surface, store) {
  const { motions, end, now, timeFactor, contact, measured, theme, state: { chosen, ball } } = store;
  const frames = drawFigure(surface, [motions, end, contact, measured, ball?.name], () => figureOf(theme, panes, panesOf(store)), store);
  if (!now) return;
  panes.panels.forEach((key, i) => surface.inside(frames[i], () => {
    const at = frames[i].px(now.tau * timeFactor);
    surface.shape([[at, frames[i].top, at, frames[i].top + frames[i].height]], { stroke: theme.soft, dash: [3, 3] });
    const y = frames[i].py(scales[key](now[key]));
    if (Number.isFinite(y)) surface.shape([[at, y]], { radius: 5, fill: theme.swatch(chosen), stroke: theme.card, width: 1.5 });
  }));
}

/** Returns the measured values {v, u} of a film of this ball, each as points t0, v0, t1, v1, ... */
function pointsOf({ measured, end, timeFactor, state: { ball } }) {
  if (!measured || measured.ball !== ball?.name) return {};
  const { t, slip = [], spin = [] } = measured.columns;
  const step = Math.ceil(t.length / most);
  const isSeen = (value, i) => i % step === 0 && !Number.isNaN(value) && t[i] <= end * timeFactor;
  const points = (column, scale) => Array.from(column).flatMap((value, i) => (isSeen(value, i) ? [t[i], scale * value] : []));
  return { v: points(slip, 1), u: points(spin, ball.radius) };
}

function panesOf(store) {
  const { motions, end, timeFactor, contact, theme, state: { chosen } } = store;
  const seen = pointsOf(store);
  const starts = (key) => motions.map((motion) => motion[key][0]);
  const [lowestU, highestU] = [Math.min(0, ...starts("u")), Math.max(0, ...starts("u"))];
  const powers = starts("k").map(Math.log10).filter(Number.isFinite);
  const ranges = {
    v: { low: 0, high: 1.06 * Math.max(...starts("v"), Number.MIN_VALUE) },
    u: { low: 1.06 * lowestU, high: 1.06 * highestU || (lowestU === 0 ? 1 : 0) },
    k: decades(Math.floor(Math.min(deepest, ...powers) - 0.1), Math.ceil(Math.max(0, ...powers) + 0.1)),
  };
  return Object.entries(ranges).map(([key, range]) => {
    const lines = motions.map((motion, index) => {
      // At rest there is no k.
      const times = key === "k" ? motion.tau.slice(0, -1) : motion.tau;
      const points = Array.from(times).flatMap((tau, i) => [tau * timeFactor, scales[key](motion[key][i])]);
      return { lines: points, colour: theme.swatch(index), width: index === chosen ? 2.6 : 1.2 };
    });
    const marks = seen[key] ? [{ points: seen[key], colour: theme.ink, size: 0.5 }] : [];
    const unit = key !== "k" && contact ? " (m/s)" : "";
    return panelOf([italic(key), unit], { name: contact ? "t (s)" : "τ", low: 0, high: end * timeFactor }, range, lines, marks);
  });
}
