// Bodies are thrown: pressed, dragged and let go. The way of the hand is the speed, its direction the direction; a second
// finger or the wheel spins them. Keys do the same.
import { $, write } from "../dom.js";
import { listen } from "../drawing/gestures.js";
import { shown } from "../numbers.js";

const reach = { touch: 16, mouse: 4 };  // pixels beside a body from which it is taken hold of
const widest = 0.55;   // of the picture's width: a throw of the full speed
const full = { real: { slip: 2, spin: 500 }, free: { slip: 5, spin: 5 } };  // m/s and rad/s; without units
const shortest = 12;   // pixels of a throw
const level = 5;       // degrees to either side that count as straight to the right
const turns = 2;       // of the hand, for the full spin
const keySteps = 40;   // to the full speed, and to the full spin

const round = (value) => Number(value.toPrecision(3));

/** @param {Store} store @param {Hero} hero @param {Player} player @param {Plane} plane */
export function makeThrowing(store, hero, player, plane) {
  const canvas = $("lanes");
  /** @type {{slip: number, spin: number, heading: number, from: number[]} | null} */
  let aim = null;
  const most = () => full[store.contact ? "real" : "free"];
  const radiusOf = () => store.state.ball?.radius ?? 1;
  const pixelsPerSpeed = () => (widest * hero.lanes.width) / most().slip;

  /** Shows the throw as it would be now. */
  const show = (values) => {
    if (player.playing) player.toggle(false);
    const [{ x, y }] = hero.places.slice(-1);
    const { u, v, heading } = store.orbit;
    const next = aim = { slip: v, spin: u / radiusOf(), heading, from: [x, y], ...aim, ...values };
    const far = next.slip * pixelsPerSpeed();
    const angle = (next.heading * Math.PI) / 180;
    const words = store.contact ? `${shown(next.slip, 3)} m/s, ${shown(next.spin, 3)} rad/s` : `v = ${shown(next.slip, 3)}, u = ${shown(next.spin, 3)}`;
    hero.aim = { from: next.from, to: [next.from[0] + far * Math.cos(angle), next.from[1] - far * Math.sin(angle)], words };
    write($("told"), words);
    hero.lanes.draw();
  };
  const cancel = () => {
    if (!aim) return;
    aim = hero.aim = null;
    hero.draw();
  };
  const release = () => {
    const thrown = aim;
    cancel();
    if (!thrown || thrown.slip * pixelsPerSpeed() < shortest) return;
    const start = { u: round(thrown.spin) * radiusOf(), v: round(thrown.slip), heading: thrown.heading };
    plane.startOrbit(start);
    player.begin();
  };
  /** More spin, or the other way. */
  const spun = (by) => {
    const { spin } = most();
    const now = aim?.spin ?? store.orbit.u / radiusOf();
    return { spin: Math.max(-spin, Math.min(spin, now + by * spin)) };
  };

  const isBody = (x, y, beside = 0) => hero.places.some((place) => Math.hypot(place.x - x, place.y - y) <= place.radius + beside);

  listen(canvas, {
    hold(x, y, kind) {
      if (!store.ride) return null;
      return (isBody(x, y) ? "body" : hero.asked ? null : hero.ruler.at(x, y, kind)) ?? (isBody(x, y, reach[kind]) ? "body" : null);
    },
    pull(x, y, held, from) {
      if (held !== "body") return hero.ruler.pull(held, x, y);
      const [dx, dy] = [x - from[0], from[1] - y];
      const heading = Math.round((Math.atan2(dy, dx) * 180) / Math.PI);
      show({ from, slip: Math.hypot(dx, dy) / pixelsPerSpeed(), heading: Math.abs(heading) <= level ? 0 : heading });
    },
    turn: (radians, held) => held === "body" && show(spun(radians / (2 * Math.PI * turns))),
    release, cancel, leave: cancel,
    clear() {
      cancel();
      hero.ruler.reset();
    },
    ruler: () => store.ride && !hero.asked && hero.ruler.next(),
    tap: () => player.toggle(),
    point(x, y) {
      canvas.style.cursor = isBody(x, y) ? "grab" : hero.asked ? "" : { to: "ew-resize", from: "ew-resize", both: "move" }[hero.ruler.at(x, y, "mouse")?.part ?? ""] ?? "";
    },
    move(dx, dy) {
      if (!store.ride) return;
      if (hero.ruler.part) return hero.ruler.move(4 * dx, 4 * dy);
      const slip = aim?.slip ?? store.orbit.v;
      show({ slip: Math.max(0, Math.min(2 * most().slip, slip + (dx * most().slip) / keySteps)), ...spun(dy / keySteps) });
    },
    enter: () => (aim ? release() : store.ride && show({})),
  });
}
