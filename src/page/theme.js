// Colours: of the page from its style sheet, of orbits by the time left. Dark to light is monotonous, so that figures
// read in grey and by colour-blind people.

const scales = {
  light: ["#d9a441", "#6f9f7c", "#23707f", "#173f73", "#0d1f4d"],
  dark: ["#a5672a", "#b98f4a", "#7fb59a", "#8fc7dd", "#dcecff"],
};

/** Okabe and Ito's colours for the reader's own orbits. */
const swatches = {
  light: ["#c22f5a", "#0072b2", "#b45f06", "#007a59", "#8a4fa3", "#5c656e"],
  dark: ["#ff7aa2", "#56b4e9", "#f0a830", "#35c79b", "#d49be6", "#b9c2ca"],
};

export const shades = 12;

function mixed(from, to, share) {
  const part = (colour, i) => parseInt(colour.slice(1 + 2 * i, 3 + 2 * i), 16);
  const parts = [0, 1, 2].map((i) => Math.round(part(from, i) + share * (part(to, i) - part(from, i))));
  return `#${parts.map((value) => value.toString(16).padStart(2, "0")).join("")}`;
}

function scale(stops) {
  return Array.from({ length: shades }, (_, i) => {
    const place = (i / (shades - 1)) * (stops.length - 1);
    const stop = Math.min(stops.length - 2, Math.floor(place));
    return mixed(stops[stop], stops[stop + 1], place - stop);
  });
}

const byTimeLeft = { light: scale(scales.light), dark: scale(scales.dark) };

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
    ink: colour("ink"), soft: colour("soft"), line: colour("line"), card: colour("card"), accent: colour("accent"),
    timeLeft: byTimeLeft[kind],
    isochrone: kind === "dark" ? "#8a7a66" : "#b9a58a",
    swatch: (index) => swatches[kind][index % swatches[kind].length],
    textSize: parseFloat(style.fontSize) * 0.78,
  };
}
