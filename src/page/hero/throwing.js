// Throws of bodies. The reader presses, drags and releases a body; speed and direction are those of the drag. The reader pulls the
// ring around the body to spin it; a second finger, the wheel and keys do the same. In the game a pull of the body to the side spins it, too.
import { $, write } from "../dom.js";
import { listen } from "../drawing/gestures.js";
import { ringGap } from "./hero_figure.js";
import { shown, turnsOf } from "../numbers.js";
import { fullSpeeds } from "./tries.js";

const reach = { touch: 16, mouse: 4 };  // pixels around a body or its ring that belong to it
const widest = 0.55;   // length of a throw of the full speed, divided by the width of the picture
const shortest = 12;   // shortest throw, pixels
const arrow = 90;      // length in pixels of the first arrow by which a stroke is aimed
const level = 5;       // degrees to either side that count as straight to the right
const turns = 2;       // turns of the hand for the full spin
const keySteps = 40;   // number of key presses to the full speed or the full spin

const round = (value) => Number(value.toPrecision(3));

/** @param {Store} store @param {Hero} hero @param {Player} player @param {Plane} plane @param startByCue  returns the start of a stroke */
export function makeThrowing(store, hero, player, plane, startByCue) {
  const canvas = $("lanes");
  /** @type {{slip: number, spin: number, heading: number, from: number[], pushed: boolean} | null} */
  let aim = null;
  let hand = [0, 0];  // place of the hand on the ring
  const most = () => fullSpeeds(store.contact);
  const radiusOf = () => store.state.ball?.radius ?? 1;
  const pixelsPerSpeed = () => (widest * hero.lanes.width) / most().slip;
  const isGame = () => hero.mode === "game";

  /** The place of the body that is thrown. */
  const ownPlace = () => hero.places.slice(-1)[0];
  /** Shows the throw as it would be now. */
  const show = (values) => {
    if (player.playing) player.toggle(false);
    const { x, y } = ownPlace();
    const { u, v, heading } = store.orbit;
    const slip = hero.stone ? arrow / pixelsPerSpeed() : v;
    const next = aim = { slip, spin: u / radiusOf(), heading, from: [x, y], pushed: Boolean(hero.stone), ...aim, ...values };
    const far = next.slip * pixelsPerSpeed();
    const towards = (next.heading * Math.PI) / 180;
    const aside = `${shown(Math.abs(next.heading))}° to the ${next.heading < 0 ? "right" : "left"}`;
    const words = hero.stone ? aside : store.contact ? `${shown(next.slip, 3)} m/s, ${turnsOf(next.spin)}` : `v = ${shown(next.slip, 3)}, u = ${shown(next.spin, 3)}`;
    if (!hero.stone) hero.ring = hero.ringOf(next.spin);
    hero.aim = next.pushed ? { from: next.from, to: [next.from[0] + far * Math.cos(towards), next.from[1] - far * Math.sin(towards)], words } : null;
    write($("told"), words);
    hero.lanes.draw();
  };
  const cancel = () => {
    if (!aim && !hero.ring) return;
    if (aim) hero.say("");
    aim = hero.aim = hero.ring = null;
    hero.draw();
  };
  const release = () => {
    const thrown = aim;
    cancel();
    if (!thrown || thrown.slip * pixelsPerSpeed() < shortest) return;
    const { heading } = thrown;
    const thrownBy = () => ({ u: Number((round(thrown.spin) * radiusOf()).toPrecision(12)), v: round(thrown.slip) });
    plane.startOrbit({ ...(hero.stone ? startByCue() : thrownBy()), heading });
    player.begin();
  };
  /** Returns the spin after a change by a share of the full spin. */
  const spun = (by) => {
    const { spin } = most();
    const now = aim?.spin ?? store.orbit.u / radiusOf();
    return { spin: Math.max(-spin, Math.min(spin, now + by * spin)) };
  };

  /** Returns the object at a pixel: a body, its ring, or in the game the disc inside the ring. */
  const partAt = (x, y, kind) => {
    if (!store.ride || hero.mode === "asking" || hero.places.length === 0) return null;
    const beside = hero.places.map((place) => Math.hypot(place.x - x, place.y - y) - place.radius);
    const [own] = beside.slice(-1);
    const gap = ringGap(hero.isLine);
    if (hero.isLine) return own <= gap - 6 ? "disc" : own <= gap + reach.touch ? "ring" : null;
    if (!hero.stone && own > 0 && Math.abs(own - gap) <= gap + reach[kind]) return "ring";
    return Math.min(...beside) > reach[kind] ? null : "body";
  };
  /**
   * Returns the turn to the left when the hand moves to (x, y). A hand on the disc turns it as at the lower end of the ring. So one
   * movement gives one turn, wherever it begins. A hand on the ring turns it about the centre; nearer to the centre its arm is the ring's.
   */
  const turnTo = (x, y, held) => {
    const { x: cx, y: cy, radius } = ownPlace();
    const out = radius + ringGap(hero.isLine);
    const [[fromX, fromY], [dx, dy]] = [hand, [x - hand[0], y - hand[1]]];
    hand = [x, y];
    if (held === "disc") return dx / out;
    const arm = Math.max(out, Math.hypot(fromX - cx, fromY - cy));
    return ((fromY - cy) * dx - (fromX - cx) * dy) / arm ** 2;
  };

  listen(canvas, {
    hold(x, y, kind) {
      const part = partAt(x, y, kind);
      hand = [x, y];
      return part;
    },
    pull(x, y, held, from) {
      if (held !== "body") return show(spun(turnTo(x, y, held) / (2 * Math.PI * turns)));
      const [dx, dy] = [x - from[0], from[1] - y];
      const heading = Math.round((Math.atan2(dy, dx) * 180) / Math.PI);
      show({ from, pushed: true, slip: Math.hypot(dx, dy) / pixelsPerSpeed(), heading: Math.abs(heading) <= level && !hero.stone ? 0 : heading });
    },
    turn: (radians) => hero.stone || show(spun(radians / (2 * Math.PI * turns))),
    release, cancel, leave: cancel, clear: cancel,
    // Before the first try, a tap runs nothing: nobody has thrown.
    tap: () => (aim ? release() : hero.mode !== "asking" && !(isGame() && store.state.chosen === 0) && player.toggle()),
    point(x, y) {
      const part = partAt(x, y, "mouse");
      canvas.style.cursor = part ? "grab" : "";
      const isRinged = Boolean(part) && !hero.stone;
      if (aim || isRinged === Boolean(hero.ring) || (player.playing && !hero.ring)) return;
      hero.ring = isRinged ? hero.ringOf() : null;
      hero.lanes.draw();
    },
    move(dx, dy) {
      if (!store.ride || hero.mode === "asking") return;
      const slip = aim?.slip ?? store.orbit.v;
      const pushed = aim?.pushed || dx !== 0;
      if (hero.stone) show({ heading: (aim?.heading ?? store.orbit.heading) + dy });
      else if (isGame()) show(spun(dy / keySteps));
      else show({ pushed, slip: Math.max(0, Math.min(2 * most().slip, slip + (dx * most().slip) / keySteps)), ...spun(dy / keySteps) });
    },
    enter: () => (aim ? release() : store.ride && hero.mode !== "asking" && show({})),
  });
}
