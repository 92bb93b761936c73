// Curves divided by their starts, which are one line for all copies; the strip (ln k, ln v), in which a copy is the curve
// moved up or down; and stop times against sizes.
import { sizeOf } from "./copies.js";
import { drawFigure, figureOf, panelOf } from "../drawing/figure.js";
import { decades } from "../numbers.js";
import { italic } from "../drawing/runs.js";

const fewest = 1.3;  // decades shown on each side of the size 1, at least
const deep = 1.3;    // decades of v that the strip shows below the starts, at least
const shape = { columns: 2, narrowest: 150 };

/** @param surface  surface for the figure @param {Store} store @param {{copies: Copies}} plane */
export function drawCopies(surface, store, { copies }) {
  const { theme, orbit, motion, state: { orbits, chosen }, motions } = store;
  const pull = copies.now;
  // Sizes are relative to this start.
  const first = pull ?? (orbit ? { base: orbit, stop: motion.stop } : null);
  const curves = () => [
    ...motions.map((own, index) => ({ ...own, start: orbits[index], colour: theme.swatch(index), width: 1.5 })),
    ...copies.ghosts.map((ghost) => ({ ...ghost, colour: `${theme.swatch(chosen)}99`, width: 1.5 })),
    { ...motion, start: orbit, colour: theme.swatch(chosen), width: 3 },
  ];
  if (!first) return surface.still([theme], theme.card, () => {});
  const figure = () => figureOf(theme, shape, panelsOf(curves(), first, theme));
  drawFigure(surface, [motions, pull?.base, copies.ghosts, chosen], figure, store, { covered: false });
}

/** The four panels: v and u divided by their starts, the strip, stop times against sizes. */
export function panelsOf(curves, { base, stop }, theme) {
  const zero = { words: "0", italic: false, level: -1 };
  const byTime = (key) => panelOf([italic(key), "/", italic(key), zero, " against ", italic("t"), "/", italic("t"), "*"], { low: 0, high: 1 }, { low: 0, high: 1.04 },
    curves.filter(({ start }) => start[key] !== 0).map(({ start, stop: its, colour, width, ...motion }) =>
      ({ colour, width, lines: Array.from(motion.tau).flatMap((t, i) => [t / its, motion[key][i] / start[key]]) })));

  const logarithm = (value) => Math.log10(Math.abs(value));
  const tops = curves.map(({ start }) => logarithm(start.v)).filter(Number.isFinite);
  const [low, high] = [Math.min(0, ...tops) - deep, Math.max(...tops, -deep) + 0.2];
  const lines = curves.map(({ k, v, colour, width }) =>
    ({ colour, width, lines: Array.from(k).flatMap((ratio, i) => (logarithm(v[i]) > low ? [logarithm(ratio), logarithm(v[i])] : [])) }));
  const ratios = lines.flatMap(({ lines }) => lines.filter((value, i) => i % 2 === 0 && Number.isFinite(value)));
  const strip = panelOf([italic("v"), " against ", italic("k")], decades(Math.min(-0.6, ...ratios) - 0.2, Math.max(0.6, ...ratios) + 0.2), decades(low, high), lines);

  const points = curves.map(({ start, stop: its, colour, width }) => ({ points: [logarithm(sizeOf(start, base).c), logarithm(its / stop)], colour, size: (width + 1.5) / 3.6 }));
  const half = Math.max(fewest, ...points.flatMap(({ points }) => points.map(Math.abs)).filter(Number.isFinite)) + 0.2;
  const times = panelOf([italic("t"), "* against ", italic("c")], decades(-half, half), decades(-half, half), [{ lines: [-half, -half, half, half], colour: theme.line, width: 3 }], points);
  return [byTime("v"), byTime("u"), strip, times];
}
