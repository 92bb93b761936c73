// Curves divided by their starts, which is one line for all that are copies; and their times until the stop over their sizes.
import { sizeOf } from "./copies.js";
import { Frame } from "../drawing/frame.js";
import { superscript } from "../numbers.js";
import { italic } from "../drawing/runs.js";

const fewest = 1.3;  // decades that are seen to either side of the size 1

/**
 * @param surface  what it is drawn on
 * @param {import("../state/store.js").Store} store
 * @param {{copies: import("./copies.js").Copies, sizes: ReturnType<import("./sizes.js").makeSizes>}} plane
 */
export function drawCopies(surface, store, { copies, sizes }) {
  const { theme, orbit, motion, state: { orbits, chosen }, motions } = store;
  const pull = copies.now;
  // What sizes are compared with.
  const first = pull ?? sizes.from ?? (orbit ? { base: orbit, stop: motion.stop } : null);
  surface.still([motions, pull, sizes.from, copies.ghosts, theme], theme.card, () => {
    if (!orbit || !first) return;
    const { base, stop } = first;
    const decades = Math.max(fewest, Math.abs(Math.log10(sizeOf(orbit, base).c)) + 0.4);
    const size = theme.textSize;
    const [top, height] = [1.9 * size, surface.height - 3.6 * size];
    const half = Math.min(0.62, 1 - 11 * size / surface.width) * surface.width;
    const shares = new Frame({ left: 2.6 * size, top, width: half - 4 * size, height }, { low: 0, high: 1, label: "" }, { low: 0, high: 1.04 });
    const power = (value) => `10${superscript(Math.round(value))}`;
    const step = Math.ceil(decades / 2.5);
    const ticks = [-step, 0, step].map((at) => ({ at, text: at === 0 ? "1" : power(at) }));
    const times = new Frame({ left: half + 2.2 * size, top, width: surface.width - half - 3 * size, height }, { low: -decades, high: decades, label: "", ticks }, { low: -decades, high: decades, ticks });
    const caption = (frame, text) => surface.text(frame.left, 0.9 * size, text, { colour: theme.ink, size, baseline: "middle" });
    const index = { words: "0", italic: false, level: -1 };
    caption(shares, [italic("v"), "/", italic("v"), index, ", dashed ", italic("u"), "/", italic("u"), index, ", by ", italic("t"), "/", italic("t"), "*"]);
    caption(times, [italic("t"), "* by size ", italic("c")]);
    for (const frame of [shares, times]) frame.draw(surface, theme);

    surface.inside(times, () => surface.shape(times.lines([-decades, -decades, decades, decades]), { stroke: theme.line, width: 3 }));
    const show = ({ tau, u, v }, start, itsStop, colour, width) => {
      for (const [key, column, whole] of [["v", v, start.v], ["u", u, start.u]]) {
        if (whole === 0) continue;
        const points = Array.from(tau).flatMap((t, i) => [t / itsStop, column[i] / whole]);
        surface.inside(shares, () => surface.shape(shares.lines(points), { stroke: colour, width, dash: key === "u" ? [5, 4] : [] }));
      }
      const { c } = sizeOf(start, base);
      const place = times.pixel([Math.log10(c), Math.log10(itsStop / stop)]);
      if (times.contains(place[0], place[1])) surface.shape([place], { radius: width + 1.5, fill: colour, stroke: theme.card });
    };
    motions.forEach((own, index) => index !== chosen && show(own, orbits[index], own.stop, theme.swatch(index), 1.4));
    for (const { motion: ghost, u, v, stop: its } of copies.ghosts) show(ghost, { u, v }, its, `${theme.swatch(chosen)}99`, 1.4);
    show(motion, orbit, motion.stop, theme.swatch(chosen), 2.6);
  });
}
