// v, u and k against time, one above the other.
import { Frame } from "./frame.js";
import { superscript } from "./numbers.js";

const deepest = -6;  // decades of k that are shown below 1, at least

export function drawPanes(surface, { motions, end, now, timeFactor, contact, state: { chosen } }, theme) {
  const speedUnit = contact ? " (m/s)" : "";
  const size = theme.textSize;
  surface.fill(0, 0, surface.width, surface.height, theme.card);
  const left = 4.9 * size;
  const width = surface.width - left - size;
  const gap = 0.8 * size;
  const height = (surface.height - 3.4 * size - 2 * gap - 0.5 * size) / 3;
  const x = (label) => ({ low: 0, high: end * timeFactor, label });
  const place = (row) => ({ left, top: 0.5 * size + row * (height + gap), width, height });

  const highestV = Math.max(...motions.map(({ v }) => v[0]), Number.MIN_VALUE);
  const us = motions.map(({ u }) => u[0]);
  const [lowestU, highestU] = [Math.min(0, ...us), Math.max(0, ...us)];
  const rangeU = { low: 1.06 * lowestU, high: 1.06 * highestU || (lowestU === 0 ? 1 : 0) };
  // Without the last instant: at rest there is no k.
  const logs = motions.map((motion) => motion.k.slice(0, -1).map(Math.log10));
  const starts = logs.map((column) => column[0]).filter(Number.isFinite);
  const highestK = Math.ceil(Math.max(0, ...starts) + 0.1);
  const lowestK = Math.floor(Math.min(deepest, ...starts) - 0.1);

  const panes = [
    { frame: new Frame(place(0), x(undefined), { low: 0, high: 1.06 * highestV, label: `{/:Italic v}${speedUnit}` }), column: (m) => m.v, valueNow: now?.v },
    { frame: new Frame(place(1), x(undefined), { ...rangeU, label: `{/:Italic u}${speedUnit}` }), column: (m) => m.u, valueNow: now?.u },
    {
      frame: new Frame(place(2), x(contact ? "t (s)" : "τ"), { low: lowestK, high: highestK, label: "{/:Italic k}", tick: (value) => `10${superscript(Math.round(value))}` }),
      column: (m, i) => logs[i], valueNow: Math.log10(now?.k),
    },
  ];
  for (const { frame, column, valueNow } of panes) {
    frame.draw(surface, theme);
    surface.inside(frame, () => {
      motions.forEach((motion, index) => {
        const line = frame.line(motion.tau.map((tau) => tau * timeFactor), column(motion, index));
        surface.lines([line], { colour: theme.swatch(index), width: index === chosen ? 2.6 : 1.2 });
      });
      if (now) {
        const at = frame.px(now.tau * timeFactor);
        surface.lines([[at, frame.top, at, frame.top + frame.height]], { colour: theme.soft, dash: [3, 3] });
        const y = frame.py(valueNow);
        if (Number.isFinite(y)) surface.disc(at, y, 5, { fill: theme.swatch(chosen), stroke: theme.card });
      }
    });
  }
}
