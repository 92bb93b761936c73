// Colours of the page, from its style sheet, and of the reader's own orbits. The library chooses the colours of portraits.

/** Okabe and Ito's colours for the reader's own orbits. The ball without spin is grey. */
const swatches = {
  light: ["#c22f5a", "#0072b2", "#b45f06", "#007a59", "#8a4fa3", "#7a6a00"],
  dark: ["#ff7aa2", "#56b4e9", "#f0a830", "#35c79b", "#d49be6", "#dede6a"],
};

const darkness = globalThis.matchMedia?.("(prefers-color-scheme: dark)");

export const isDark = (choice) => (choice === "auto" ? darkness.matches : choice === "dark");

/** @type {Theme | null} */
let known = null;
globalThis.addEventListener?.("resize", () => (known = null));

/** @typedef {Record<"ink" | "soft" | "line" | "card" | "paper" | "kind", string> & {large: boolean, textSize: number, swatch: (index: number) => string}} Theme */

/**
 * Returns the same object until dark, light or the size of the window changes, because reading the style sheet takes long.
 * @param choice  "auto", "light" or "dark"
 * @returns {Theme}
 */
export function themeOf(choice) {
  const kind = isDark(choice) ? "dark" : "light";
  const large = document.documentElement.classList.contains("project");
  if (known?.kind === kind && known.large === large) return known;
  document.documentElement.dataset.theme = kind;
  const style = getComputedStyle(document.documentElement);
  const colours = ["ink", "soft", "line", "card", "paper"].map((name) => [name, style.getPropertyValue(`--${name}`).trim()]);
  const textSize = parseFloat(style.fontSize) * 0.78;
  const swatch = (index) => swatches[kind][index % swatches[kind].length];
  return (known = { .../** @type {Theme} */ (/** @type {unknown} */ (Object.fromEntries(colours))), kind, large, textSize, swatch });
}
