// What fingers, mouse and keys do on the plane, in pixels of the canvas.

const slack = 6;  // pixels that a finger may move and still tap

/**
 * @param on  hold(x, y, kind): what lies there and can be pulled, or null; pull(x, y, held), tap(x, y, kind), drag(x, y),
 *            point(x, y), leave(), move(dx, dy), panel(), enter(), isochrone(), clear(), remove(), zoom(factor); kind is
 *            "mouse" or "touch", and move has steps of 1
 */
export function listen(canvas, on) {
  const fingers = new Map();
  let start = null;
  let spread = 0;  // of two fingers, in pixels
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const kindOf = (event) => (event.pointerType === "touch" ? "touch" : "mouse");
  const distance = () => {
    const [[ax, ay], [bx, by]] = [...fingers.values()];
    return Math.hypot(ax - bx, ay - by);
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    start = fingers.size === 1 ? { at: place(event), dragged: false, held: on.hold(...place(event), kindOf(event)) } : null;
    if (fingers.size === 2) spread = distance();
  });
  canvas.addEventListener("pointermove", (event) => {
    const [x, y] = place(event);
    if (fingers.has(event.pointerId)) fingers.set(event.pointerId, [x, y]);
    if (fingers.size === 2) {
      const now = distance();
      if (Math.abs(now / spread - 1) < 0.03) return;
      on.zoom(spread / now);
      spread = now;
      return;
    }
    if (start && !start.dragged) {
      const [dx, dy] = [Math.abs(x - start.at[0]), Math.abs(y - start.at[1])];
      // A finger that goes up or down scrolls.
      start.dragged = Math.hypot(dx, dy) > slack && (kindOf(event) === "mouse" || start.held !== null || dx > dy);
    }
    if (!start?.dragged) on.point(x, y);
    else if (start.held === null) on.drag(x, y);
    else on.pull(x, y, start.held);
  });
  const lift = (event) => {
    fingers.delete(event.pointerId);
    start = null;
  };
  canvas.addEventListener("pointerup", (event) => {
    if (start && !start.dragged) on.tap(...place(event), kindOf(event));
    lift(event);
  });
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("pointerleave", () => on.leave());
  // A finger scrolls the page up and down, unless it takes hold of something.
  canvas.addEventListener("touchstart", (event) => {
    const [x, y] = place(event.touches[0]);
    if (event.cancelable && (event.touches.length > 1 || on.hold(x, y, "touch") !== null)) event.preventDefault();
  }, { passive: false });
  // Two fingers on a trackpad, or Ctrl and the wheel; the wheel alone scrolls the page.
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    on.zoom(Math.exp(Math.max(-0.3, Math.min(0.3, event.deltaY / 200))));
  }, { passive: false });
  canvas.addEventListener("blur", () => on.leave());
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const fine = event.shiftKey ? 0.25 : 1;
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const actions = {
      "Enter": on.enter, "Delete": on.remove, "Backspace": on.remove, "Escape": on.clear, "i": on.isochrone, "p": on.panel,
      "+": () => on.zoom(0.8), "-": () => on.zoom(1.25),
    };
    if (steps[event.key]) on.move(...steps[event.key].map((step) => step * fine));
    else if (actions[event.key]) actions[event.key]();
    else return;
    event.preventDefault();
  });
}
