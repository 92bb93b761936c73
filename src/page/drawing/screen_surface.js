// A canvas of the page. It has the size of its place in the layout and the pixels of the screen, and is drawn only in sight.
import { borderOf, CanvasSurface } from "./surface.js";

const smallestWidth = 120;  // pixels; a hidden or minimised page has none

/** A canvas of the page. */
export class ScreenSurface extends CanvasSurface {
  inSight = true;
  late = false;  // true: it must be drawn when it comes into sight
  /** @type {{key: unknown[], value?: unknown, picture?: HTMLCanvasElement}[]} pictures of `still`, each with the next in it */
  kept = [];
  depth = 0;

  /** @param picture  draws on the surface, also when the page gives the canvas another size */
  constructor(canvas, picture) {
    super(canvas);
    this.picture = picture;
    new ResizeObserver(() => {
      const { width, height } = this;
      this.measure();
      if (width !== this.width || height !== this.height) this.draw();
    }).observe(canvas);
    new IntersectionObserver(([{ isIntersecting }]) => {
      this.inSight = isIntersecting;
      if (isIntersecting && this.late) this.draw();
    }, { rootMargin: "100px" }).observe(canvas);
  }

  /** Reads the size. The browser then computes the layout of the page. */
  measure() {
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
  }

  /** Gives the canvas the height of so many rows of panels. */
  fit(/** @type {number} */ rows) {
    const { canvas, canvas: { dataset } } = this;
    if (dataset.rows === String(rows)) return;
    dataset.rows = String(rows);
    canvas.style.setProperty("--rows", dataset.rows);
    this.measure();
  }

  draw() {
    this.late = false;
    if (this.width === 0) this.measure();
    if (this.width >= smallestWidth) this.picture(this);
  }

  /** Draws now, or, if the canvas is out of sight, when it comes into sight. */
  drawInSight() {
    if (this.inSight) this.draw();
    else this.late = true;
  }

  /**
   * Draws the ground and the parts of a picture that do not move. If no value of `keys` has changed, a copy is drawn. The
   * function `draw` may call `still` for parts that change less often.
   * @template Value
   * @param {unknown[]} keys
   * @param {string} ground
   * @param {() => Value} draw
   * @param {boolean} covered  true: moving parts are drawn over it
   * @returns {Value} result of `draw`
   */
  still(keys, ground, draw, covered = true) {
    const { canvas, context } = this;
    const kept = (this.kept[this.depth] ??= { key: [] });
    const ratio = globalThis.devicePixelRatio || 1;
    const size = { width: Math.round(this.width * ratio), height: Math.round(this.height * ratio) };
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const key = [...keys, ratio, size.width, size.height];
    const again = key.every((part, i) => part === kept.key[i]);
    if (again && !covered) return /** @type {Value} */ (kept.value);
    if (again && kept.picture) context.drawImage(kept.picture, 0, 0, size.width / ratio, size.height / ratio);
    else {
      // The canvas may be wider than the page's pixels by a part of one.
      this.shape([borderOf({ width: this.width + 1, height: this.height + 1 })], { fill: ground });
      this.depth += 1;
      try {
        Object.assign(kept, { key, value: draw(), picture: undefined });
      } finally {
        this.depth -= 1;
      }
    }
    // A picture that changes at each drawing needs no copy.
    if (again && !kept.picture) {
      kept.picture = Object.assign(document.createElement("canvas"), size);
      kept.picture.getContext("2d")?.drawImage(canvas, 0, 0);
    }
    return /** @type {Value} */ (kept.value);
  }
}
