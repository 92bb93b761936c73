// Titles and hints of the library's views.

const texts = {
  uv: ["plane", "Zhuravlev's plane: sliding speed v against u = R ω, where ω is the spin about the vertical. Every motion ends at the origin."],
  log: ["log", "Logarithms of both speeds. Multiplying both speeds shifts an orbit along the diagonal. So all orbits, on each side of a ray, are one curve, shifted."],
  blowup: ["blow-up", "The origin is drawn as the inner half-circle, so that the direction of each orbit at its end is seen. In the chart (u, ln k) the line u = 0 is the origin."],
  disc: ["disc", "The whole half-plane in a half-disc (Poincaré): the circle is infinity."],
};

/** A view of the library with its title and a hint to the reader. */
export function described(view) {
  const [title, hint] = texts[view.name] ?? [view.name, ""];
  return { ...view, title, hint };
}
