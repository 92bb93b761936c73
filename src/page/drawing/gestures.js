// Actions of fingers, mouse and keys on a canvas, in its pixels.

const slack = 6;    // pixels that a finger may move and still tap
const notch = 800;  // pixels of the wheel for one radian

/**
 * @param on  functions that are called. hold(x, y, kind) returns the object there that can be pulled, or null. turn(radians, held) turns this
 *            object, or the one under the wheel, to the left. The others are pull(x, y, held, from), release(), cancel(), tap(x, y, kind),
 *            drag(x, y), point(x, y), leave(), move(dx, dy), panel(), enter(), isochrone(), clear(), remove(), zoom(factor). kind is
 *            "mouse" or "touch"; move has steps of 1. All except hold may be missing
 */
export function listen(canvas, on) {
  const fingers = new Map();
  let start = null;
  let spread = [0, 0];  // of two fingers: pixels, and an angle to the left
  const place = ({ clientX, clientY }, { left, top } = canvas.getBoundingClientRect()) => [clientX - left, clientY - top];
  const kindOf = (event) => (event.pointerType === "touch" ? "touch" : "mouse");
  const spreadNow = () => {
    const [[ax, ay], [bx, by]] = [...fingers.values()];
    return [Math.hypot(ax - bx, ay - by), Math.atan2(ay - by, bx - ax)];
  };
  /** Returns true if the held object can be turned. */
  const turns = () => on.turn && start !== null && start.held !== null;
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    if (fingers.size === 1) start = { at: place(event), id: event.pointerId, dragged: false, held: on.hold(...place(event), kindOf(event)) };
    else if (!turns()) start = null;
    if (fingers.size === 2) spread = spreadNow();
  });
  canvas.addEventListener("pointermove", (event) => {
    const [x, y] = place(event);
    // The button was released outside the page, which gets no event there.
    if (event.buttons === 0) lose(event);
    if (fingers.has(event.pointerId)) fingers.set(event.pointerId, [x, y]);
    if (fingers.size === 2) {
      const [before, now] = [spread, spreadNow()];
      if (turns()) on.turn(Math.atan2(Math.sin(now[1] - before[1]), Math.cos(now[1] - before[1])), start.held);
      else if (Math.abs(now[0] / before[0] - 1) < 0.03) return;
      else on.zoom?.(before[0] / now[0]);
      spread = now;
    }
    if (fingers.size > 1 && start?.id !== event.pointerId) return;
    if (start && !start.dragged) {
      const [dx, dy] = [Math.abs(x - start.at[0]), Math.abs(y - start.at[1])];
      // A finger that goes up or down scrolls.
      start.dragged = Math.hypot(dx, dy) > slack && (kindOf(event) === "mouse" || start.held !== null || dx > dy);
    }
    if (!start?.dragged) on.point?.(x, y);
    else if (start.held === null) on.drag?.(x, y);
    else on.pull(x, y, start.held, start.at);
  });
  const lift = (event, use = (/** @type {typeof start} */ _) => {}) => {
    fingers.delete(event.pointerId);
    // Lifting a second finger does not release the object.
    if (turns() && start.id !== event.pointerId) return;
    use(start);
    start = null;
  };
  canvas.addEventListener("pointerup", (event) => lift(event, (start) => {
    if (start && !start.dragged) on.tap?.(...place(event), kindOf(event));
    else if (start && start.held !== null) on.release?.();
  }));
  const lose = (event) => fingers.has(event.pointerId) && lift(event, () => on.cancel?.());
  for (const lost of ["pointercancel", "lostpointercapture"]) canvas.addEventListener(lost, lose);
  canvas.addEventListener("pointerleave", () => on.leave?.());
  // A finger scrolls the page up and down, unless it takes hold of something.
  canvas.addEventListener("touchstart", (event) => {
    const [x, y] = place(event.touches[0]);
    if (event.cancelable && (event.touches.length > 1 || on.hold(x, y, "touch") !== null)) event.preventDefault();
  }, { passive: false });
  // Two fingers on a trackpad, or Ctrl and the wheel; the wheel alone scrolls the page.
  canvas.addEventListener("wheel", (event) => {
    const held = start ? start.held : on.turn ? on.hold(...place(event), "mouse") : null;
    if (!event.ctrlKey && (!on.turn || held === null)) return;
    event.preventDefault();
    if (on.turn && held !== null) on.turn(-event.deltaY / notch, held);
    else on.zoom?.(Math.exp(Math.max(-0.3, Math.min(0.3, event.deltaY / 200))));
  }, { passive: false });
  canvas.addEventListener("blur", () => on.leave?.());
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const fine = event.shiftKey ? 0.25 : 1;
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const actions = {
      "Enter": on.enter, "Delete": on.remove, "Backspace": on.remove, "Escape": on.clear, "i": on.isochrone, "p": on.panel,
      "+": on.zoom && (() => on.zoom(0.8)), "-": on.zoom && (() => on.zoom(1.25)),
    };
    if (steps[event.key]) on.move(...steps[event.key].map((step) => step * fine));
    else if (actions[event.key]) actions[event.key]();
    else return;
    event.preventDefault();
  });
}
