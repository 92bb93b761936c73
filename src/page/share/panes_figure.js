// v, u and k against time, one above the other.
import { Frame } from "../drawing/frame.js";
import { superscript } from "../numbers.js";
import { italic } from "../drawing/runs.js";

const deepest = -6;  // decades of k that are shown below 1, at least

export function drawPanes(surface, store, theme) {
  const { motions, end, now, timeFactor, contact, measured, state: { chosen, ball } } = store;
  const panes = surface.still([motions, end, contact, theme, measured, ball?.name], theme.card, () => drawStill(surface, store, theme));
  if (!now) return;
  for (const { frame, key, scale } of panes) {
    surface.inside(frame, () => {
      const at = frame.px(now.tau * timeFactor);
      surface.shape([[at, frame.top, at, frame.top + frame.height]], { stroke: theme.soft, dash: [3, 3] });
      const y = frame.py(scale(now[key]));
      if (Number.isFinite(y)) surface.shape([[at, y]], { radius: 5, fill: theme.swatch(chosen), stroke: theme.card, width: 1.5 });
    });
  }
}

const most = 1500;  // points of a film that are drawn

/** What a film of this ball has measured, as points t0, v0, t1, v1, ...; {v, u}. */
function pointsOf({ measured, state: { ball } }) {
  if (!measured || measured.ball !== ball?.name) return {};
  const { t, slip = [], spin = [] } = measured.columns;
  const step = Math.ceil(t.length / most);
  const points = (column, scale) => Array.from(column).flatMap((value, i) => (i % step || Number.isNaN(value) ? [] : [t[i], scale * value]));
  return { v: points(slip, 1), u: points(spin, ball.radius) };
}

function drawStill(surface, store, theme) {
  const { motions, end, timeFactor, contact, state: { chosen } } = store;
  const seen = pointsOf(store);
  const size = theme.textSize;
  const [left, gap] = [4.9 * size, 0.8 * size];
  const height = (surface.height - 3.9 * size - 2 * gap) / 3;
  const starts = (key) => motions.map((motion) => motion[key][0]);
  const [lowestU, highestU] = [Math.min(0, ...starts("u")), Math.max(0, ...starts("u"))];
  const decades = starts("k").map(Math.log10).filter(Number.isFinite);
  const name = (letter) => [italic(letter), letter !== "k" && contact ? " (m/s)" : ""];
  return [
    { key: "v", scale: Number, low: 0, high: 1.06 * Math.max(...starts("v"), Number.MIN_VALUE) },
    { key: "u", scale: Number, low: 1.06 * lowestU, high: 1.06 * highestU || (lowestU === 0 ? 1 : 0) },
    {
      key: "k", scale: Math.log10, tick: (value) => `10${superscript(Math.round(value))}`,
      low: Math.floor(Math.min(deepest, ...decades) - 0.1), high: Math.ceil(Math.max(0, ...decades) + 0.1),
    },
  ].map(({ key, scale, ...range }, row) => {
    const label = row < 2 ? undefined : contact ? "t (s)" : "τ";
    const place = { left, top: 0.5 * size + row * (height + gap), width: surface.width - left - size, height };
    const frame = new Frame(place, { low: 0, high: end * timeFactor, label }, { ...range, label: name(key) });
    frame.draw(surface, theme);
    surface.inside(frame, () => motions.forEach((motion, index) => {
      const points = [];
      // At rest there is no k.
      const count = motion.tau.length - (key === "k" ? 1 : 0);
      for (let i = 0; i < count; ++i) points.push(motion.tau[i] * timeFactor, scale(motion[key][i]));
      surface.shape(frame.lines(points), { stroke: theme.swatch(index), width: index === chosen ? 2.6 : 1.2 });
    }));
    if (seen[key]) surface.inside(frame, () => surface.shape([frame.lines(seen[key]).flat()], { radius: 1.6, fill: theme.ink }));
    return { frame, key, scale };
  });
}
