// What the page asks the library to draw. command_line.js writes the same request as options of the program.

/** A ball that slides along x at v and spins with u = R omega, and nothing else. */
const shotOf = (ball, { u, v }) => ({ ...ball, velocityX: v, velocityY: 0, omegaX: 0, omegaY: 0, omegaZ: u / ball.radius });

/**
 * @param plane   of the library, with the state's law and body chosen
 * @param body    {chi, gamma}
 * @param screen  light on dark
 * @returns {law, mu, chi, gamma, ball, start, view, window, through: [{u, v}], isochrones, field, against, screen}; null
 *          for what is not asked for
 */
export function portraitRequest(state, plane, { chi, gamma }, screen) {
  const start = state.orbits[state.chosen] ?? null;
  return {
    law: state.law, mu: state.mu, chi, gamma, start,
    // Without a motion there is no ball in the program's sense: only the mu of one.
    ball: state.ball && start ? shotOf(state.ball, start) : null,
    view: state.view, window: state.window,
    through: state.orbits.filter((orbit, index) => index !== state.chosen && orbit.u !== 0 && orbit.v !== 0)
      .map(({ u, v }) => (state.window ? plane.inside(u, v, ...state.window) : { u, v })),
    // A law is not compared with itself.
    isochrones: state.isochrones, field: state.field, against: state.against === state.law ? null : state.against, screen,
  };
}
