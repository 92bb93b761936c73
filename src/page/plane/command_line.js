// The command line by which the program draws the same picture.
import { shotOf } from "./portrait_request.js";

const quoted = (text) => (/^[\w.,:=+-]+$/.test(text) ? text : text.includes("'") ? `"${text}"` : `'${text}'`);
const line = (all) => all.map((word) => quoted(String(word))).join(" ");

/** Returns the command line that draws the plane of typed equations. @param {State} state @param {Figure} figure  this plane */
export const typedCommand = ({ system, points }, { panels: [{ x, y }] }) => line(["contensou", "portrait", "--system", system,
  ...(points.length ? ["--window", [x, y].map(({ low, high }) => `${low}:${high}`).join()] : []), ...points.flatMap((point) => ["--through", point.join()]), "-o", "system.svg"]);

/**
 * Returns the command lines {portrait, roll}; roll is null unless a real ball moves.
 * @param request  of portrait_request.js
 * @param through  points on the other orbits
 * @param body     has mu if the kind of body determines mu
 * @param builtIn  built-in ball with the name of the state's ball, if there is one
 */
export function commandLine(state, request, through, body, builtIn) {
  const { ball } = request;
  const start = request.orbits[request.chosen];
  const ofBall = [];
  if (ball) {
    ofBall.push("--ball", ball.name);
    const options = { radius: "--radius", mass: "--mass", friction: "--friction", gravity: "--gravity" };
    for (const [key, option] of Object.entries(options)) {
      if (ball[key] !== builtIn[key]) ofBall.push(option, ball[key]);
    }
    if (ball.slope) ofBall.push("--slope", ball.slope);
    if (ball.patchBy !== builtIn.patchBy || ball.patch !== builtIn.patch) {
      ofBall.push(ball.patchBy === "patch_radius" ? "--patch-radius" : "--spin-deceleration", ball.patch);
    }
  }
  const words = ["contensou", "portrait", ...ofBall, ...(ball?.rolling_friction ? ["--rolling-friction", ball.rolling_friction] : [])];
  if (ball) {
    words.push("--slip", ball.velocity[0], "--spin", ball.angular_velocity[2]);
  } else {
    if (state.body !== "ball") words.push("--body", state.body);
    if (body.mu === undefined) words.push("--mu", state.mu);
    if (start) words.push("--u0", start.u, "--v0", start.v);
  }
  words.push("--law", request.law);
  if (request.against) words.push("--against", request.against);
  words.push("--view", request.view);
  if (request.linear) words.push("--scale", "linear");
  if (request.window) words.push("--window", request.window.join(","));
  for (const { u, v } of through) words.push("--through", `${u},${v}`);
  if (request.isochrones !== 7) words.push("--isochrones", request.isochrones);
  if (request.field !== "none") words.push("--field", request.field);
  if (request.screen) words.push("--style", "screen");
  words.push("-o", "portrait.svg");
  return { portrait: line(words), roll: ball ? line(["contensou", "roll", ...ofBall, ...motionOf(state.ball, state.orbits[state.chosen]), "--law", request.law]) : null };
}

/** Returns options for start and rolling friction: slip v along x, spin u/R, or the velocities that the reader gave. */
function motionOf(ball, start) {
  const { velocity, angular_velocity: spin } = shotOf(ball, start);
  const rolling = ball.rollingFriction > 0 ? ["--rolling-friction", ball.rollingFriction] : [];
  if (velocity[0] === start.v && velocity[1] === 0) return ["--slip", start.v, "--spin", spin[2], ...rolling];
  return ["--velocity", velocity.join(), "--angular-velocity", spin.join(), ...rolling];
}
