// The phase plane as a figure, on any surface.
import { Frame } from "./frame.js";
import { shown } from "./numbers.js";
import { shades } from "./theme.js";
import { mirrored, ray, scaledBranch, states } from "./views.js";

const decadesOfTime = 4;  // that the colours of a view with many scales tell apart

/** Where the plane is drawn: the frame of a view on a surface of this size. */
export function planeFrame(view, context, width, height, theme) {
  const size = theme.textSize;
  const place = view.bare
    ? { left: 8, top: 8 + 1.6 * size, width: width - 16, height: height - 16 - 1.6 * size }
    : { left: 4.6 * size, top: 2 * size, width: width - 5.6 * size, height: height - 5.6 * size };
  return new Frame(place, ...view.axes({ ...context, aspect: place.height / place.width }));
}

/** The orbits that fill a view, beside the reader's own; the longest time left that its colours tell, where it is endless. */
export function familyOf(view, context, library, timeUnit) {
  if (!view.shifts) {
    const [x, y] = view.axes(context);
    const corner = view.state(x.high, y.high, context);
    const portrait = library.plane.portrait(corner.u, corner.v, timeUnit);
    const orbits = portrait.orbits.map((orbit) => {
      const lnU = orbit.u.map((value) => Math.log(Math.abs(value)));
      return { u: orbit.u, v: orbit.v, lnU, lnV: orbit.lnK.map((value, i) => value + lnU[i] + Math.log(context.mu)), left: orbit.left };
    });
    return { orbits, isochrones: portrait.isochrones.map(({ tau, u, v }) => ({ tau, ...states(u, v) })) };
  }
  const { branches } = library.plane.branches();
  const right = branches.flatMap((branch) => view.shifts(context).map((shift) => scaledBranch(branch, shift, context.mu)));
  return {
    orbits: view.bothSigns ? right.flatMap((orbit) => [orbit, mirrored(orbit)]) : right,
    isochrones: [],
    longest: view.endless ? 30 * library.plane.stop(...context.window).tau : undefined,
  };
}

/** The isochrone of one stop time, from the library's isochrone of the time 1; both signs of u where a view shows them. */
export function isochroneOf(unit, tau, view) {
  const right = states(unit.u.map((value) => value * tau), unit.v.map((value) => value * tau));
  return view.bothSigns ? [right, mirrored(right)] : [right];
}

/**
 * @param scene  {view, context, frame, family, own: [{columns, chosen}], isochrone: [columns], marker: {u, v, lnU, lnV},
 *               cross: {x, y}, timeFactor, title, shortTitle}
 */
export function drawPlane(surface, scene, theme) {
  const { view, context, frame } = scene;
  const columnX = (s) => Array.from(s.u, (_, i) => view.x(s, i, context));
  const columnY = (s) => Array.from(s.u, (_, i) => view.y(s, i, context));
  const line = (s) => frame.line(columnX(s), columnY(s));

  surface.fill(0, 0, surface.width, surface.height, theme.card);
  surface.inside(frame, () => {
    drawGuides();
    surface.lines(scene.family.isochrones.map(line), { colour: theme.isochrone, width: 1, dash: [5, 4] });
    drawFamily();
    if (scene.isochrone) surface.lines(scene.isochrone.map(line), { colour: theme.ink, width: 2, dash: [2, 3] });
    scene.own.forEach(({ columns, chosen }, index) => {
      const path = line(columns);
      surface.lines([path], { colour: theme.card, width: chosen ? 6 : 4 });
      surface.lines([path], { colour: theme.swatch(index), width: chosen ? 3.2 : 2 });
    });
  });
  if (view.border) {
    const border = view.border();
    surface.lines([frame.line(border.map(([x]) => x), border.map(([, y]) => y))], { colour: theme.soft });
    surface.lines([frame.line([-1, 1], [0, 0])], { colour: theme.soft });
    surface.text(frame.px(0.5), frame.py(0) + 6, "u", { colour: theme.ink, size: theme.textSize + 3, italic: true, baseline: "top" });
    surface.text(frame.px(0) + 6, frame.py(0.5), "v", { colour: theme.ink, size: theme.textSize + 3, italic: true, halo: theme.card });
  } else {
    frame.draw(surface, theme);
  }
  for (const { x, y, stable } of view.points?.(context) ?? []) {
    surface.disc(frame.px(x), frame.py(y), 4.5, { fill: stable ? theme.ink : theme.card, stroke: theme.ink });
  }
  drawIsochroneLabels();
  scene.own.forEach(({ columns, chosen }, index) => {
    const [x, y] = [frame.px(view.x(columns, 0, context)), frame.py(view.y(columns, 0, context))];
    if (visible(x, y)) surface.disc(x, y, chosen ? 5 : 4, { fill: theme.card, stroke: theme.swatch(index), width: 2.5 });
  });
  if (scene.marker) {
    const [x, y] = [frame.px(view.x(scene.marker, 0, context)), frame.py(view.y(scene.marker, 0, context))];
    if (visible(x, y)) surface.disc(x, y, 6.5, { fill: theme.swatch(scene.markerIndex), stroke: theme.card, width: 2 });
  }
  if (scene.cross) {
    const [x, y] = [frame.px(scene.cross.x), frame.py(scene.cross.y)];
    surface.lines([[x - 9, y, x + 9, y], [x, y - 9, x, y + 9]], { colour: theme.ink, width: 1.5 });
  }
  drawLegend();

  function visible(x, y) {
    return x >= frame.left - 1 && x <= frame.left + frame.width + 1 && y >= frame.top - 1 && y <= frame.top + frame.height + 1;
  }

  function drawGuides() {
    for (const k of view.guides ?? []) {
      const guide = ray(k, context);
      surface.lines((view.bothSigns ? [guide, mirrored(guide)] : [guide]).map(line), { colour: theme.line, width: 1.5, dash: [7, 5] });
    }
    if (context.regime === 1) {
      const invariant = ray(context.terminalRatio, context);
      surface.lines((view.bothSigns ? [invariant, mirrored(invariant)] : [invariant]).map(line), { colour: theme.accent, width: 2 });
    }
  }

  function drawFamily() {
    const longest = scene.family.longest ?? Math.max(...scene.family.orbits.map((orbit) => firstVisibleTime(orbit)));
    const byShade = Array.from({ length: shades }, () => []);
    const shadeOf = (left) => {
      const share = view.manyScales ? 1 + Math.log10(left / longest) / decadesOfTime : left / longest;
      return Math.max(0, Math.min(shades - 1, Math.floor(share * shades)));
    };
    const heads = [];
    for (const orbit of scene.family.orbits) {
      const [xs, ys] = [columnX(orbit), columnY(orbit)];
      let start = 0;
      for (let i = 1; i <= xs.length; ++i) {
        const shade = shadeOf(orbit.left[start]);
        if (i < xs.length && shadeOf(orbit.left[i]) === shade) continue;
        const end = Math.min(xs.length, i + 1);
        byShade[shade].push(frame.line(xs.slice(start, end), ys.slice(start, end)));
        start = i;
      }
      const head = arrowHead(frame, xs, ys);
      if (head) heads.push([head.shape, theme.timeLeft[shadeOf(orbit.left[head.index])]]);
    }
    byShade.forEach((lines, shade) => surface.lines(lines, { colour: theme.timeLeft[shade], width: 1.3 }));
    for (const [shape, colour] of heads) surface.polygon(shape, colour);
  }

  function firstVisibleTime(orbit) {
    for (let i = 0; i < orbit.u.length; ++i) {
      if (visible(frame.px(view.x(orbit, i, context)), frame.py(view.y(orbit, i, context)))) return orbit.left[i];
    }
    return 0;
  }

  function drawIsochroneLabels() {
    const size = theme.textSize * 0.92;
    for (const isochrone of scene.family.isochrones) {
      if (!isochrone.u.some((value) => value > 0)) continue;
      // On the right half, at the middle of what is seen of it.
      const path = line(isochrone);
      const seen = [];
      for (let i = 0; i < path.length; i += 2) {
        if (visible(path[i], path[i + 1]) && path[i] > frame.px(0) + size) seen.push(i);
      }
      if (seen.length < 2) continue;
      const [first, last] = [seen[0], seen.at(-1)];
      const middle = (path[first + 1] + path[last + 1]) / 2;
      const nearest = seen.reduce((best, i) => (Math.abs(path[i + 1] - middle) < Math.abs(path[best + 1] - middle) ? i : best), first);
      const x = Math.min(path[nearest], frame.left + frame.width - 2 * size);
      surface.text(x, path[nearest + 1], shown(isochrone.tau * scene.timeFactor, 3),
        { colour: theme.soft, size, align: "center", baseline: "middle", halo: theme.card });
    }
  }

  function drawLegend() {
    const size = theme.textSize;
    const [width, height] = [size * 0.6, size * 0.6];
    const right = frame.left + frame.width;
    const [top, bottom] = [frame.top - 1.4 * size, frame.top - 0.8 * size];
    const narrow = frame.width < 36 * size;
    const style = { colour: theme.soft, size: size * 0.92 };
    const start = right - shades * width - 2.6 * size;
    theme.timeLeft.forEach((colour, shade) => surface.fill(start + shade * width, top, width + 0.5, height, colour));
    surface.text(right, bottom, "long", { ...style, align: "right" });
    surface.text(start - 4, bottom, narrow ? "0" : "time left: 0", { ...style, align: "right" });
    surface.text(frame.left, bottom, narrow ? scene.shortTitle : scene.title, { colour: theme.ink, size, bold: true });
  }
}

/** A triangle a little before the middle of the visible part of a line, and the point of the line it comes after. */
function arrowHead(frame, xs, ys) {
  const [px, py] = [xs.map((x) => frame.px(x)), ys.map((y) => frame.py(y))];
  const inside = (i) => px[i] >= frame.left && px[i] <= frame.left + frame.width && py[i] >= frame.top && py[i] <= frame.top + frame.height;
  const piece = (i) => (inside(i) && inside(i - 1) ? Math.hypot(px[i] - px[i - 1], py[i] - py[i - 1]) : 0);
  let length = 0;
  for (let i = 1; i < px.length; ++i) length += piece(i);
  if (length < 40) return null;
  let wanted = 0.42 * length;
  for (let index = 1; index < px.length; ++index) {
    const here = piece(index);
    if (here === 0 || wanted > here) {
      wanted -= here;
      continue;
    }
    const [ex, ey] = [(px[index] - px[index - 1]) / here, (py[index] - py[index - 1]) / here];
    const [x, y] = [px[index - 1] + ex * wanted, py[index - 1] + ey * wanted];
    const shape = [x + 5 * ex, y + 5 * ey, x - 4 * ex - 3.2 * ey, y - 4 * ey + 3.2 * ex, x - 4 * ex + 3.2 * ey, y - 4 * ey - 3.2 * ex];
    return { shape, index };
  }
  return null;
}
