// The command line of the program that draws what the page shows.
import { bodyOf } from "./page_state.js";

const quoted = (text) => (/^[\w.,:=+-]+$/.test(text) ? text : `'${text}'`);

/**
 * @param request  of portrait_request.js
 * @param builtIn  the state's ball as the program knows it, if there is one
 */
export function commandLine(state, request, builtIn) {
  const words = ["contensou", "portrait"];
  const { ball, start } = request;
  if (ball) {
    words.push("--ball", ball.name);
    const options = { radius: "--radius", mass: "--mass", friction: "--friction", gravity: "--gravity" };
    for (const [key, option] of Object.entries(options)) {
      if (ball[key] !== builtIn[key]) words.push(option, ball[key]);
    }
    if (ball.patchBy !== builtIn.patchBy || ball.patch !== builtIn.patch) {
      words.push(ball.patchBy === "patch_radius" ? "--patch-radius" : "--spin-deceleration", ball.patch);
    }
    words.push("--slip", ball.velocityX, "--spin", ball.omegaZ);
  } else {
    if (state.body !== "ball") words.push("--body", state.body === "own" ? `${state.chi},${state.gamma}` : state.body);
    if (bodyOf(state).mu === undefined) words.push("--mu", state.mu);
    if (start) words.push("--u0", start.u, "--v0", start.v);
  }
  words.push("--law", request.law);
  if (request.against) words.push("--against", request.against);
  words.push("--view", request.view);
  if (request.window) words.push("--window", request.window.join(","));
  for (const { u, v } of request.through) words.push("--through", `${u},${v}`);
  if (request.isochrones !== 7) words.push("--isochrones", request.isochrones);
  if (request.field !== "none") words.push("--field", request.field);
  if (request.screen) words.push("--style", "screen");
  words.push("-o", "portrait.svg");
  return words.map((word) => quoted(String(word))).join(" ");
}
