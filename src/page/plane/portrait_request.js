// The request of the page to the library for a portrait. command_line.js writes the same request as options of the program.
import { unrolled } from "../state/page_state.js";

/** Returns a ball and its start under the names of the library. The slip v points along x, and u = R omega. @param resistance  rolling friction */
export const shotOf = (ball, { u, v, along, across }, resistance = 0) => ({
  ...ball, slip: undefined, spin: undefined, [ball.patchBy]: ball.patch, rolling_friction: resistance,
  velocity: [along, across], angular_velocity: [0 - across, along - v, u].map((speed) => speed / ball.radius),
});

/**
 * Returns the request. The plane does not depend on the rolling of a body.
 * @param {State} state
 * @param {{chi: number, gamma: number, drive: number, resistance: number}} body  drive: drive of a slope or of rolling friction; resistance: rolling friction
 * @param {boolean} screen  light on dark
 * @returns {PortraitRequest} members that are not requested are null
 */
export function portraitRequest(state, { chi, gamma, drive, resistance }, screen) {
  const { law, mu, ball, chosen, view, window, field, against, lab } = state;
  const orbits = state.orbits.map(unrolled);
  return {
    law, mu, chi, gamma, drive, orbits, chosen, window, field, screen,
    // Outside the Lab the plane shows curves alone.
    isochrones: lab ? state.isochrones : 0,
    view, linear: view === "uv",
    // Without a motion the request has no ball, only its mu.
    ball: ball && orbits[chosen] ? shotOf(ball, orbits[chosen], resistance) : null,
    // A law is not compared with itself.
    against: against === law ? null : against,
  };
}
