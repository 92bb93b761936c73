// The views: for each of their panels, where a state lies in it, and the state at one of its points. The library says
// what is drawn there (portraits/*_view.cpp); these are the same maps, for what the page draws and points at itself.
//
// A state is {u, v, lnV, lnK, left, start}: near the stop v underflows long before its logarithm does; `left` is the time
// left and `start` the state that its orbit is drawn from. A context has mu and the window [U, V]. A view is layered where
// isochrones and a field are drawn.

const quarter = Math.PI / 2;

/** The height of v on its axis and back (portraits/speed_scale.hpp): linear where the exponent is 1. */
function height({ v, lnV }, { window: [, V], exponent }) {
  if (exponent === 1) return v;
  const lnX = lnV - Math.log(V);
  return (Math.exp(lnX) + Math.exp(exponent * lnX)) / 2;
}
function speedAt(y, { window: [, V], exponent }) {
  if (exponent === 1) return y;
  let [low, high] = [Math.log(y) - 1, Math.log(2 * y)];
  for (let i = 0; i < 60; ++i) {
    const middle = (low + high) / 2;
    if ((Math.exp(middle / exponent) + Math.exp(middle)) / 2 < y) low = middle;
    else high = middle;
  }
  return V * Math.exp((low + high) / 2 / exponent);
}

const speeds = {
  place: (state, context) => [state.u, height(state, context)],
  state: (x, y, context) => ({ u: x, v: speedAt(y, context) }),
};

const contact = {
  place: ({ u, lnK }) => [u, lnK],
  state: (x, y, { mu }) => (x === 0 ? null : { u: x, v: mu * Math.abs(x) * Math.exp(y) }),
};

/** The half-plane of the patch in polar coordinates, its radius made finite; the origin is a circle of radius `hole`. */
function polar(hole) {
  return {
    place({ u, v, lnK, start }, { mu, window: [, V] }) {
      const distance = Math.hypot(mu * u, v) / V;
      const radius = hole === 0 ? distance / Math.hypot(1, distance) : hole + ((1 - hole) * distance) / (1 + distance);
      const angle = lnK > 0 ? quarter - Math.atan(Math.exp(-lnK)) : Math.atan(Math.exp(lnK));
      // Also at rest, where u is 0, the side that the orbit comes from.
      return [((start ?? { u }).u < 0 ? -1 : 1) * radius * Math.cos(angle), radius * Math.sin(angle)];
    },
    state(x, y, { mu, window: [, V] }) {
      const radius = Math.hypot(x, y);
      if (y < 0 || radius <= hole || radius > 0.999) return null;
      const share = (radius - hole) / (1 - hole);
      const distance = V * (hole === 0 ? radius / Math.sqrt(1 - radius * radius) : share / (1 - share));
      return { u: (distance * x) / radius / mu, v: (distance * y) / radius };
    },
  };
}

/** A pane against the share of the stop time; a point of it is a moment, not a state. */
const overTime = (value) => ({
  place: (s) => [1 - s.left / s.start.left, value(s)],
  moment: (x) => x,
});

export const views = [
  {
    name: "uv",
    title: "plane",
    hint: "The paper's plane: sliding v against pivoting u = R ω, ω the spin about the vertical. Every orbit runs into the origin. Where μ is small, v below the shading is on the scale of a power, on which orbits are straight.",
    layered: true,
    panels: [speeds],
  },
  {
    name: "patch",
    title: "patch",
    hint: "Both speeds as the rim of the patch has them: the slope of a ray is k = v/(μ|u|).",
    layered: true,
    panels: [{
      place: (state, context) => [context.mu * state.u, height(state, context)],
      state: (x, y, context) => ({ u: x / context.mu, v: speedAt(y, context) }),
    }],
  },
  {
    name: "log",
    title: "log",
    hint: "Logarithms of both speeds. Scaling moves an orbit along the diagonal: all of them are copies of one curve.",
    panels: [{
      place: ({ u, lnV }, { mu, window: [, V] }) => [Math.log((mu * Math.abs(u)) / V), lnV - Math.log(V)],
      state: (x, y, { mu, window: [, V] }) => ({ u: (V * Math.exp(x)) / mu, v: V * Math.exp(y) }),
    }],
  },
  {
    name: "similarity",
    title: "similarity",
    hint: "Canonical coordinates: here scaling is a shift along p = ln v, and every orbit is the same curve, shifted.",
    panels: [
      {
        place: ({ lnV, lnK }, { mu }) => [mu * Math.exp(Math.min(lnK, 50)), lnV],
        state: (x, y) => (x > 0 ? { u: Math.exp(y) / x, v: Math.exp(y) } : null),
      },
      {
        place: ({ lnV, lnK }) => [lnK, lnV],
        state: (x, y, { mu }) => ({ u: Math.exp(y - x) / mu, v: Math.exp(y) }),
      },
    ],
  },
  {
    name: "blowup",
    title: "blow-up",
    hint: "The origin blown up, so that it is seen by direction: to the inner half-circle, and to the line u = 0 of the chart (u, ln k).",
    panels: [polar(0.35), contact],
  },
  {
    name: "disc",
    title: "disc",
    hint: "The whole half-plane on Poincaré's disc: infinity is the circle.",
    panels: [polar(0)],
  },
  {
    name: "time",
    title: "time",
    hint: "Both speeds over their starts, and k, while the time τ passes to the stop τ*. By scaling, only k at the start matters. A click there is a moment.",
    panels: [overTime(({ u, start }) => u / start.u), overTime(({ v, start }) => v / start.v), overTime(({ lnK }) => lnK)],
  },
  {
    name: "pair",
    title: "pair",
    hint: "The plane, and beside it ln k against u: how orbits enter the origin.",
    layered: true,
    panels: [speeds, contact],
  },
];

export const viewNamed = (name) => views.find((view) => view.name === name) ?? views[0];

/** A state by its speeds, where neither is so small that only its logarithm is left. */
export function stateOf(u, v, mu) {
  return { u, v, lnV: Math.log(v), lnK: Math.log(v / (mu * Math.abs(u))) };
}

/** Where the rows of an orbit of the library lie in a panel: columns, from where the time `from` is left. */
export function placesOf(orbit, panel, context, from = Infinity) {
  const row = (i, start) => ({ u: orbit.u[i], v: orbit.v[i], lnV: orbit.lnV[i], lnK: orbit.lnK[i], left: orbit.left[i], start });
  const start = row(0);
  const first = Math.max(0, orbit.left.findIndex((left) => left <= from * (1 + 1e-12)));
  const places = Array.from(orbit.u.slice(first), (_, i) => panel.place(row(first + i, start), context));
  return [places.map(([x]) => x), places.map(([, y]) => y)];
}
