// The command line of the program that gives the same picture.

import { bodyOf } from "./page_state.js";

const quoted = (text) => (/^[\w.,:=+-]+$/.test(text) ? text : `'${text}'`);

/** @param builtIn  the state's ball as the program knows it, if there is one */
export function commandLine(state, builtIn) {
  const words = ["contensou", "portrait"];
  const orbit = state.orbits[state.chosen];
  if (state.ball) {
    words.push("--ball", state.ball.name);
    const options = { radius: "--radius", mass: "--mass", friction: "--friction", gravity: "--gravity" };
    for (const [key, option] of Object.entries(options)) {
      if (state.ball[key] !== builtIn[key]) words.push(option, state.ball[key]);
    }
    if (state.ball.patchBy !== builtIn.patchBy || state.ball.patch !== builtIn.patch) {
      words.push(state.ball.patchBy === "patch_radius" ? "--patch-radius" : "--spin-deceleration", state.ball.patch);
    }
    if (orbit) {
      words.push("--slip", orbit.v, "--spin", orbit.u / state.ball.radius);
    }
  } else {
    if (state.body !== "ball") words.push("--body", state.body === "own" ? `${state.chi},${state.gamma}` : state.body);
    if (bodyOf(state).mu === undefined) words.push("--mu", state.mu);
    if (orbit) words.push("--u0", orbit.u, "--v0", orbit.v);
  }
  words.push("--law", state.law, "--window", state.window.join(","), "-o", "portrait.svg");
  return words.map((word) => quoted(String(word))).join(" ");
}
