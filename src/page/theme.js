// Colours: of the page from its style sheet, and of the reader's own orbits. Those of portraits are the library's.

const plain = { light: "#0072b2", dark: "#56b4e9" };

/** Okabe and Ito's colours for the reader's own orbits. */
const swatches = {
  light: ["#c22f5a", "#0072b2", "#b45f06", "#007a59", "#8a4fa3", "#5c656e"],
  dark: ["#ff7aa2", "#56b4e9", "#f0a830", "#35c79b", "#d49be6", "#b9c2ca"],
};

export function isDark(choice) {
  return choice === "auto" ? matchMedia("(prefers-color-scheme: dark)").matches : choice === "dark";
}

/** @param choice  "auto", "light" or "dark" */
export function themeOf(choice) {
  const kind = isDark(choice) ? "dark" : "light";
  document.documentElement.dataset.theme = kind;
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(`--${name}`).trim();
  return {
    ink: colour("ink"), soft: colour("soft"), line: colour("line"), card: colour("card"), paper: colour("paper"), accent: colour("accent"),
    swatch: (index) => swatches[kind][index % swatches[kind].length],
    /** Of a body that slides: the colour of an orbit, or another for the one beside it. */
    lane: (index) => {
      const own = swatches[kind][index % swatches[kind].length] ?? plain[kind];
      return { colour: own, faint: `${own}66` };
    },
    textSize: parseFloat(style.fontSize) * 0.78,
  };
}
