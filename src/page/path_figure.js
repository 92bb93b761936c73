// The path of a ball on the table, seen from above, both axes on one scale.
import { Frame } from "./frame.js";

/**
 * @param scene  {x, y, textbookX, textbookY: columns in m, rollsAt: {x, y}, now: {x, y}, radius: of the ball in m}
 */
export function drawPath(surface, scene, theme) {
  const size = theme.textSize;
  surface.fill(0, 0, surface.width, surface.height, theme.card);
  const place = { left: 4.2 * size, top: 0.8 * size, width: surface.width - 5.2 * size, height: surface.height - 4.4 * size };
  const range = (...columns) => [Math.min(...columns.map((column) => Math.min(...column))) - scene.radius,
    Math.max(...columns.map((column) => Math.max(...column))) + scene.radius];
  const [left, right] = range(scene.x, scene.textbookX);
  const [low, high] = range(scene.y, scene.textbookY);
  const metresPerPixel = Math.max((right - left) / place.width, (high - low) / place.height) * 1.06;
  const around = (middle, pixels) => ({ low: middle - (pixels * metresPerPixel) / 2, high: middle + (pixels * metresPerPixel) / 2 });
  const frame = new Frame(place, { ...around((left + right) / 2, place.width), label: "{/:Italic x} (m)" },
    { ...around((low + high) / 2, place.height), label: "{/:Italic y} (m)" });
  frame.draw(surface, theme);
  surface.inside(frame, () => {
    surface.lines([[frame.px(frame.x.low), frame.py(0), frame.px(frame.x.high), frame.py(0)]], { colour: theme.line });
    surface.lines([frame.line(scene.textbookX, scene.textbookY)], { colour: theme.soft, width: 1.5, dash: [5, 4] });
    surface.lines([frame.line(scene.x, scene.y)], { colour: theme.accent, width: 2.5 });
    const [x, y] = [frame.px(scene.rollsAt.x), frame.py(scene.rollsAt.y)];
    surface.disc(x, y, 4.5, { fill: theme.card, stroke: theme.ink });
    surface.text(x, y - 9, "rolls", { colour: theme.soft, size, align: "center", halo: theme.card });
    if (scene.now) {
      surface.disc(frame.px(scene.now.x), frame.py(scene.now.y), Math.min(14, Math.max(5, scene.radius / metresPerPixel)), { fill: theme.swatch(scene.index), stroke: theme.card });
    }
  });
}
