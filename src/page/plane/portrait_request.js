// What the page asks the library to draw. command_line.js writes the same request as options of the program.
import { unrolled } from "../state/page_state.js";

/** A ball with its start, by the names that the library has: it slips along x at v and spins with u = R omega. @param resistance  rolling friction */
export const shotOf = (ball, { u, v, along, across }, resistance = 0) => ({
  ...ball, slip: undefined, spin: undefined, [ball.patchBy]: ball.patch, rolling_friction: resistance,
  velocity: [along, across], angular_velocity: [0 - across, along - v, u].map((speed) => speed / ball.radius),
});

/**
 * Of how a body turns forward the plane knows nothing.
 *
 * @param {State} state
 * @param {{chi: number, gamma: number, drive: number, resistance: number}} body  drive: of a slope, and of rolling friction, the resistance
 * @param {boolean} screen  light on dark
 * @returns {PortraitRequest} null for what is not asked for
 */
export function portraitRequest(state, { chi, gamma, drive, resistance }, screen) {
  const { law, mu, ball, chosen, view, window, field, against, lab } = state;
  const orbits = state.orbits.map(unrolled);
  return {
    law, mu, chi, gamma, drive, orbits, chosen, window, field, screen,
    // The first floor shows curves alone.
    isochrones: lab ? state.isochrones : 0,
    view, linear: view === "uv",
    // Without a motion there is no ball in the program's sense: only the mu of one.
    ball: ball && orbits[chosen] ? shotOf(ball, orbits[chosen], resistance) : null,
    // A law is not compared with itself.
    against: against === law ? null : against,
  };
}
