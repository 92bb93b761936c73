// v, u and k against time, one above the other.
import { Frame } from "./frame.js";
import { superscript } from "./numbers.js";
import { borderOf } from "./surface.js";

const deepest = -6;  // decades of k that are shown below 1, at least

export function drawPanes(surface, store, theme) {
  const { motions, end, now, timeFactor, contact, state: { chosen } } = store;
  const panes = surface.still([motions, end, contact, theme], () => drawStill(surface, store, theme));
  if (!now) return;
  for (const { frame, key, scale } of panes) {
    surface.inside(frame, () => {
      const at = frame.px(now.tau * timeFactor);
      surface.shape([[at, frame.top, at, frame.top + frame.height]], { stroke: theme.soft, dash: [3, 3] });
      const y = frame.py(scale(now[key]));
      if (Number.isFinite(y)) surface.discs([at, y], 5, { fill: theme.swatch(chosen), stroke: theme.card });
    });
  }
}

function drawStill(surface, { motions, end, timeFactor, contact, state: { chosen } }, theme) {
  const speedUnit = contact ? " (m/s)" : "";
  const size = theme.textSize;
  surface.shape([borderOf(surface)], { fill: theme.card });
  const left = 4.9 * size;
  const width = surface.width - left - size;
  const gap = 0.8 * size;
  const height = (surface.height - 3.4 * size - 2 * gap - 0.5 * size) / 3;

  const highestV = Math.max(...motions.map(({ v }) => v[0]), Number.MIN_VALUE);
  const us = motions.map(({ u }) => u[0]);
  const [lowestU, highestU] = [Math.min(0, ...us), Math.max(0, ...us)];
  const starts = motions.map(({ k }) => Math.log10(k[0])).filter(Number.isFinite);
  const k = {
    low: Math.floor(Math.min(deepest, ...starts) - 0.1), high: Math.ceil(Math.max(0, ...starts) + 0.1),
    label: "{/:Italic k}", tick: (value) => `10${superscript(Math.round(value))}`,
  };
  const same = (value) => value;
  return [
    { key: "v", scale: same, y: { low: 0, high: 1.06 * highestV, label: `{/:Italic v}${speedUnit}` } },
    { key: "u", scale: same, y: { low: 1.06 * lowestU, high: 1.06 * highestU || (lowestU === 0 ? 1 : 0), label: `{/:Italic u}${speedUnit}` } },
    { key: "k", scale: Math.log10, y: k },
  ].map(({ key, scale, y }, row) => {
    const label = row < 2 ? undefined : contact ? "t (s)" : "τ";
    const place = { left, top: 0.5 * size + row * (height + gap), width, height };
    const frame = new Frame(place, { low: 0, high: end * timeFactor, label }, y);
    frame.draw(surface, theme);
    surface.inside(frame, () => motions.forEach((motion, index) => {
      const points = [];
      // At rest there is no k.
      const count = motion.tau.length - (key === "k" ? 1 : 0);
      for (let i = 0; i < count; ++i) points.push(motion.tau[i] * timeFactor, scale(motion[key][i]));
      surface.shape(frame.lines(points), { stroke: theme.swatch(index), width: index === chosen ? 2.6 : 1.2 });
    }));
    return { frame, key, scale };
  });
}
