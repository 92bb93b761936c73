// A cue. The dot on the ball shows where the tip hits; it follows from the start. If the reader drags the dot, the start changes.
import { $, write } from "../dom.js";
import { listen } from "../drawing/gestures.js";
import { ScreenSurface } from "../drawing/screen_surface.js";
import { widthOf } from "../drawing/surface.js";
import { shown } from "../numbers.js";
import { shotOf } from "../plane/portrait_request.js";
import { startFrom } from "../state/page_state.js";

const fastest = 8;    // m/s
const steepest = 80;  // degrees
const degree = Math.PI / 180;

/**
 * Returns the stroke that gives a ball at rest a start, as si::struck: speed in m/s, right and above in radii, elevation in degrees.
 * @param {Start} start
 * @param ball  gamma; masses: mass of the ball divided by that of the cue; elevation: used if the start has no side spin; offset: largest offset of the tip, in radii
 * @returns null if no cue gives this start
 */
export function strikeOf({ u, v, along, across }, { gamma, masses, elevation, offset }) {
  const speed = Math.hypot(along, across);
  // The angular velocity times the radius, about the direction of the cue and about the horizontal to the left of it.
  const [about, back] = [(-v * across) / speed, (speed * speed - v * along) / speed];
  const tilt = u !== 0 ? Math.atan2(about * Math.sign(u), Math.abs(u)) : about === 0 ? elevation * degree : NaN;
  if (!(speed > 0 && tilt >= 0 && tilt < 89 * degree)) return null;
  const velocity = speed / Math.cos(tilt);
  const [right, above] = [u / Math.cos(tilt), back].map((part) => part / gamma / velocity);
  if (Math.hypot(right, above) > offset + 1e-4) return null;
  const digits = (value) => Number(value.toFixed(4));
  return { speed: digits((velocity * (1 + masses + gamma * (right * right + above * above))) / 2), right: digits(right), above: digits(above), elevation: digits(tilt / degree) };
}

/** The place of a tip, in radii to the right and above; a tip beyond the rim slips off, so it is moved to the rim. */
function onBall(tip, offset) {
  const over = Math.hypot(...tip) / offset;
  return over > 1 ? tip.map((part) => ((1 - 1e-12) * part) / over) : tip;
}

/** @param {Store} store @param {Controls} controls @param {Player} player @returns picture: picture of the cue; start(): start after the stroke */
export function makeCue(store, controls, player) {
  let stroke = { speed: 2, right: 0, above: 0, elevation: 0 };
  let [isStruck, face, read] = [false, { x: 0, y: 0, radius: 1 }, /** @type {unknown} */ (null)];
  const { cueMass, largestTipOffset: offset } = store.library;

  /** The start that the stroke gives to a ball. */
  const startOfBall = (ball) => {
    const { speed, elevation } = stroke;
    const [right, above] = onBall([stroke.right, stroke.above], offset);
    return startFrom(store.library.struck(shotOf(ball, store.orbit), speed, right, above, elevation), ball, 6);
  };
  /** Strikes the ball of a state. In the game the reader aims first. */
  const strike = (state, change) => {
    Object.assign(stroke, change);
    if (state.line) return;
    const start = startOfBall(state.ball);
    // A ball that is hit high slips backwards.
    start.heading = start.across === 0 && start.along < 0 ? 180 : 0;
    state.orbits[state.chosen] = start;
    Object.assign(state, { fraction: 0, isochrone: 0 });
  };
  const hit = (right, above) => {
    const [toRight, toAbove] = onBall([right, above].map((part) => Math.round(100 * part) / 100), offset);
    store.ask((state) => strike(state, { right: toRight, above: toAbove }));
  };
  const play = () => store.state.line || player.begin();
  const isFace = (x, y) => store.roller !== null && Math.hypot(x - face.x, y - face.y) < 1.1 * face.radius;
  const hitPixel = (x, y) => hit((x - face.x) / face.radius, (face.y - y) / face.radius);
  store.shows.push(() => {
    const ball = store.roller;
    const { gamma } = store.body;
    const found = ball && store.keep("stroke", [store.orbit, ball, gamma], () =>
      strikeOf(store.orbit, { gamma, masses: ball.mass / cueMass, elevation: stroke.elevation, offset }));
    if (found !== read) stroke = { ...stroke, ...found };
    // In the game each stroke waits for its aim, whatever moved the ball before.
    [read, isStruck] = [found, Boolean(found || (ball && store.state.line))];
    const { right, above } = stroke;
    const side = (value, more, less) => `${shown(Math.abs(value), 2)} radii ${value < 0 ? less : more} the centre`;
    write($("cue-says"), !ball ? "A cue strikes a real ball, one that can roll: choose one in the settings." : !isStruck ? "No cue gives this motion. Drag the dot for one that does."
      : `The tip hits ${[right && side(right, "right of", "left of"), above && side(above, "above", "below")].filter(Boolean).join(" and ") || "the centre"}.`);
    $("cue").setAttribute("aria-label", `The ball from behind the cue. ${$("cue-says").textContent}`);
    picture.drawInSight();
  });
  const slider = (name, label, most, least, unit) => controls.slider(`cue-${name}`, label, () => store.roller && { share: stroke[name] / most, text: `${shown(stroke[name], 3)}${unit}` },
    (state, share) => strike(state, { [name]: Number(Math.max(least, share * most).toPrecision(2)) }), $("cue-sliders"));
  slider("speed", "cue speed", fastest, 0.1, " m/s");
  slider("elevation", "butt raised by", steepest, 0, "°");

  const picture = new ScreenSurface($("cue"), (surface) => {
    const { theme, state: { chosen } } = store;
    surface.still([theme], theme.card, () => {});
    if (!store.roller) return;
    face = drawStroke(surface, stroke, isStruck, offset, theme.swatch(chosen), theme);
  });
  listen($("cue"), {
    hold: (x, y) => (isFace(x, y) ? "tip" : null),
    pull: hitPixel,
    tap: (x, y) => {
      if (isFace(x, y)) hitPixel(x, y);
      play();
    },
    release: play,
    move: (dx, dy) => store.roller && hit(stroke.right + dx / 20, stroke.above + dy / 20),
    enter: play,
  });
  return { picture, start: () => startOfBall(store.roller) };
}

/** The ball as the cue sees it, with the dot, and the cue from its side, beside or below it. @returns the ball's face, in pixels */
function drawStroke(surface, { right, above, elevation }, isStruck, offset, colour, theme) {
  const [{ width, height }, size] = [surface, theme.textSize];
  const isTall = height > 0.9 * width;
  const radius = isTall ? Math.min(0.36 * width, 0.24 * height - 1.2 * size) : Math.min(0.19 * width, 0.5 * height - 2 * size);
  const [x, y] = isTall ? [width / 2, 0.25 * height] : [0.24 * width, height / 2];
  const [side, level] = isTall ? [x, height - 1.1 * radius] : [width - 1.15 * radius, y];
  const half = isTall ? { left: 0, top: height / 2, width, height: height / 2 } : { left: 0.47 * width, top: 0, width: 0.53 * width, height };
  const ball = { radius, fill: theme.paper, stroke: theme.ink, width: 1.2 };
  surface.shape([[x, y], [side, level]], ball);
  surface.shape([[x, y]], { radius: offset * radius, stroke: theme.soft, dash: [3, 4] });
  surface.shape([[x - radius, y, x + radius, y], [x, y - radius, x, y + radius]], { stroke: theme.line });
  surface.shape([[half.left, level + radius, width, level + radius]], { stroke: theme.soft, width: 1.5 });
  const [cos, sin] = [Math.cos(elevation * degree), Math.sin(elevation * degree)];
  const depth = Math.sqrt(1 - right * right - above * above);
  const [tipX, tipY] = [side + radius * (above * sin - depth * cos), level - radius * (above * cos + depth * sin)];
  const back = (far) => [tipX - far * radius * cos, tipY - far * radius * sin];
  surface.inside(half, () => {
    surface.shape([[...back(0.15), ...back(9)]], { stroke: theme.soft, width: 6 });
    surface.shape([[tipX, tipY, ...back(0.12)]], { stroke: colour, width: 6 });
  });
  surface.shape([[x + right * radius, y - above * radius]], { radius: 0.13 * radius, fill: isStruck ? colour : theme.card, stroke: isStruck ? theme.card : colour, width: 2 });
  const words = "seen along the cue";
  surface.text(Math.max(x, widthOf(words, { size }) / 2), y + radius + 1.2 * size, words, { colour: theme.soft, size, align: "center", baseline: "middle" });
  return { x, y, radius };
}
