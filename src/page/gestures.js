// What fingers, mouse and keys do on the plane, in pixels of the canvas.

const slack = 6;  // pixels that a finger may move and still tap

/**
 * @param on  {tap(x, y), drag(x, y), point(x, y), leave(), move(dx, dy), enter(), remove(), zoom(factor)}; move has steps of 1
 */
export function listen(canvas, on) {
  let start = null;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    start = { at: place(event), dragged: false };
  });
  canvas.addEventListener("pointermove", (event) => {
    const [x, y] = place(event);
    if (start && !start.dragged) start.dragged = Math.hypot(x - start.at[0], y - start.at[1]) > slack;
    if (start?.dragged) on.drag(x, y);
    on.point(x, y);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (start && !start.dragged) on.tap(...place(event));
    start = null;
  });
  canvas.addEventListener("pointercancel", () => (start = null));
  canvas.addEventListener("pointerleave", () => on.leave());
  // Two fingers on a trackpad, or Ctrl and the wheel; the wheel alone scrolls the page.
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    on.zoom(Math.exp(Math.max(-0.3, Math.min(0.3, event.deltaY / 200))));
  }, { passive: false });
  canvas.addEventListener("blur", () => on.leave());
  canvas.addEventListener("keydown", (event) => {
    const fine = event.shiftKey ? 0.25 : 1;
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const actions = { Enter: on.enter, Delete: on.remove, "+": () => on.zoom(0.8), "-": () => on.zoom(1.25) };
    if (steps[event.key]) on.move(...steps[event.key].map((step) => step * fine));
    else if (actions[event.key]) actions[event.key]();
    else return;
    event.preventDefault();
  });
}
