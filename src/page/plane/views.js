// What the page says of the library's views.

const texts = {
  uv: ["plane", "The paper's plane: sliding v against pivoting u = R ω, ω the spin about the vertical. Every orbit runs into the origin."],
  bent: ["bent", "The plane, with v below the shading on the scale of a power where μ is small: orbits then run straight into the origin."],
  patch: ["patch", "Both speeds as the rim of the patch has them: the slope of a ray is k = v/(μ|u|)."],
  log: ["log", "Logarithms of both speeds. Scaling moves an orbit along the diagonal: all of them are copies of one curve."],
  similarity: ["similarity", "Canonical coordinates: here scaling is a shift along p = ln v, and every orbit is the same curve, shifted."],
  blowup: ["blow-up", "The origin blown up, so that it is seen by direction: to the inner half-circle, and to the line u = 0 of the chart (u, ln k)."],
  disc: ["disc", "The whole half-plane on Poincaré's disc: infinity is the circle."],
  time: ["time", "Both speeds over their starts, and k, while the time τ passes to the stop τ*. By scaling, only k at the start matters. A click there is a moment."],
  pair: ["pair", "The plane, and beside it ln k against u: how orbits enter the origin."],
};

/** A view of the library with its title and a hint to the reader. */
export function described(view) {
  const [title, hint] = texts[view.name] ?? [view.name, ""];
  return { ...view, title, hint };
}
