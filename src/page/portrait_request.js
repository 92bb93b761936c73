// What the page asks the library to draw. command_line.js writes the same request as options of the program.

/** How a ball turns that moves with its velocity, slides along x at v and spins with u = R omega. */
export const angularVelocity = ({ radius, velocityX, velocityY }, { u, v }) => ({ omegaX: -velocityY / radius, omegaY: (velocityX - v) / radius, omegaZ: u / radius });

/** A ball that does not turn but for its spin. */
const shotOf = (ball, { u, v }) => ({ ...ball, velocityX: v, velocityY: 0, omegaX: 0, omegaY: 0, omegaZ: u / ball.radius });

/**
 * @param {State} state
 * @param {{chi: number, gamma: number}} body
 * @param {boolean} screen  light on dark
 * @returns {PortraitRequest} null for what is not asked for
 */
export function portraitRequest(state, { chi, gamma }, screen) {
  const { law, mu, ball, orbits, chosen, view, window, isochrones, field, against } = state;
  return {
    law, mu, chi, gamma, orbits, chosen, view, window, isochrones, field, screen,
    // Without a motion there is no ball in the program's sense: only the mu of one.
    ball: ball && orbits[chosen] ? shotOf(ball, orbits[chosen]) : null,
    // A law is not compared with itself.
    against: against === law ? null : against,
  };
}
