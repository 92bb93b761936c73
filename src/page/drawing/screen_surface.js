// A canvas of the page: of the size that the layout gives it, sharp, and drawn where it is seen.
import { borderOf, CanvasSurface } from "./surface.js";

const smallestWidth = 120;  // pixels; a hidden or minimised page has none

/** A canvas of the page. */
export class ScreenSurface extends CanvasSurface {
  inSight = true;
  late = false;  // what is there now has still to be drawn
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

  /** Asks the page for the size, which lays the page out. */
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

  /** Draws; where the reader has scrolled away from it, when he comes back. */
  drawInSight() {
    if (this.inSight) this.draw();
    else this.late = true;
  }

  /**
   * Begins a picture with its ground and what stays while only the moment moves: a copy, unless something in `keys` has
   * changed. In `draw` another may begin, which stays for longer.
   *
   * @template Value
   * @param {unknown[]} keys
   * @param {string} ground
   * @param {() => Value} draw
   * @param {boolean} covered  something that moves is drawn over it
   * @returns {Value} what `draw` has returned
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
      this.shape([borderOf(this)], { fill: ground });
      this.depth += 1;
      try {
        Object.assign(kept, { key, value: draw(), picture: undefined });
      } finally {
        this.depth -= 1;
      }
    }
    // What changes at each drawing is not worth a copy.
    if (again && !kept.picture) {
      kept.picture = Object.assign(document.createElement("canvas"), size);
      kept.picture.getContext("2d")?.drawImage(canvas, 0, 0);
    }
    return /** @type {Value} */ (kept.value);
  }
}
