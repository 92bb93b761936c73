// Facts about a motion, in SI units or, without units, in those of v; and sentences made from them.
import { duration, length, shown, turnsOf } from "../numbers.js";

const hardly = 1e-3;  // m, a path too short to be seen
const bent = 3;       // degrees, least curvature of a path that is called curved
const much = 1.5;     // ratio of distances from which the headline has this ratio
const some = 1.05;

/**
 * The facts. own, plain: results of plane.slide for this body and for one that does not spin.
 * @typedef {{
 *   name: string, real: boolean, rolls: boolean, slip: number, spin: number, along: number, across: number, least: number, own: Slide, plain: Slide,
 *   stop: number, rest?: {t: number, x: number, y: number} | null,
 * }} Facts  spin: without units u; least: slip below which a ball rolls; stop: time when slip and spin end
 */

/** Returns the facts about the chosen motion. @returns {Facts} */
export function factsOf({ state: { ball }, ride: { own, plain, rest, rolls, least }, orbit: { u, v, along, across } }) {
  return {
    name: ball ? ball.title.replace(/ (on|of) .*/, "") : rolls ? "ball" : "puck", real: Boolean(ball), rolls, spin: u / (ball?.radius ?? 1), slip: v,
    along, across, least, own, plain, rest, stop: own.stop,
  };
}

/** Returns the kind of the motion. @returns {keyof typeof sentences} */
export function regimeOf(/** @type {Facts} */ { real, rolls, slip, spin, along, across, least, own, plain }) {
  if (slip <= least || (real && rolls && own.path < hardly)) {
    return rolls && Math.hypot(along, across) > least ? "rolls" : spin === 0 ? "rests" : "spins";
  }
  if (spin === 0) return "plain";
  const times = own.path / plain.path;
  if (times >= much) return "much";
  if (across !== 0 && Math.abs(own.turned) > bent) return "curves";
  return times >= some ? "more" : rolls ? "soon" : "together";
}

const more = (ratio, word) => (ratio - 1 < 1e-5 ? `equally ${word}` : ratio >= much ? `${shown(ratio, 2)} times as ${word}`
  : `${shown(100 * (ratio - 1), 2)} % ${{ far: "farther", long: "longer" }[word]}`);

/** Words that name a body, own or plain, or are emphasised. */
const named = (kind, words) => `[${kind}|${words}]`;

/** The parts of the sentences. */
function wordsOf(/** @type {Facts} */ facts) {
  const { name, real, rolls, slip, spin, along, across, own, plain } = facts;
  const unit = real ? "m" : "";
  const time = (t) => `${real ? "" : "τ = "}${duration(t, unit)}`;
  const leave = along === slip && across === 0 ? "leave at" : "land with a slip of";
  const turns = spin === 0 ? "does not spin" : real ? `with ${shown(Math.abs(spin) / 2 / Math.PI, 2)} turns a second` : `with u = ${spin < 0 ? "−" : ""}${length(Math.abs(spin), "")}`;
  return {
    ...facts, thing: name.split(" ").at(-1), time, leave, then: rolls ? "then rolls" : "and stops", turns,
    speed: real ? `${shown(slip, 3)} m/s` : `v = ${length(slip, "")}`,
    far: named("own", length(own.path, unit)), byBook: length(plain.path, unit), farPlain: named("plain", length(plain.path, unit)),
    times: own.path / plain.path, longer: more(own.end / plain.end, "long"),
  };
}

const two = ({ name, leave, speed, farPlain, byBook, then, turns, far, longer, times }) =>
  `Two equal ${name}s ${leave} ${speed}. ${named("plain", "One does not spin")}: it slides ${farPlain}, ${then}. Textbooks: ${byBook} for both. ` +
  `${named("own", "The other spins")} ${turns}: it slides ${far}, ${named("times", more(times, "far"))}, and takes ${longer}.`;

const sentences = {
  much: (words) => [`Spin a ${words.thing}, and it slides ${shown(words.times, 2)} times as far`, two(words)],
  more: (words) => [`Spin makes this ${words.thing} slide ${shown(100 * (words.times - 1), 2)} % farther`, two(words)],
  soon: (words) => [`This ${words.thing} soon rolls, and keeps spinning`, `${two(words)} Its spin ends after ${words.time(words.stop)}.`],
  together: (words) => [`This ${words.thing} slides hardly farther, and spins to the end`, two(words)],
  curves: (words) => [`The path of this ${words.thing} curves by ${shown(Math.abs(words.own.turned), 2)}°`,
    `Its slip of ${words.speed} does not point along its path. Friction acts against the slip and bends the path by ` +
    `${shown(Math.abs(words.own.turned), 2)}° in ${words.far}; then it rolls straight on. Without the spin about the vertical it would bend by ` +
    `${shown(Math.abs(words.plain.turned), 2)}° in ${words.farPlain}.`],
  plain: (words) => ["Without spin, textbooks are right",
    `This ${words.name} ${words.leave.replace(/^\w+/, "$&s")} ${words.speed} and ${words.turns}: ` +
    `it slides ${words.farPlain}, ${words.then}. Textbooks predict the same distance with spin. Give it spin and compare.`],
  rolls: (words) => [words.slip > words.least ? `This ${words.thing} rolls almost at once` : `This ${words.thing} already rolls`,
    `${words.slip > words.least ? `It slides for only ${words.time(words.own.end)} and ${words.far}.` : "It slides too slowly to be seen."}${words.spin === 0 ? "" : ` Its spin ends after ${words.time(words.stop)}.`}`],
  spins: (words) => [`A ${words.thing} that spins in place`,
    `It does not move along the table. The contact patch rubs as it turns, so the ${words.thing} turns ever slower and stops after ${words.time(words.stop)}.`],
  rests: (words) => [`A ${words.thing} at rest`, "Nothing slides and nothing spins."],
};

const piecesOf = (sentence) => sentence.split(/\[(.*?)\]/).map((piece, i) => (i % 2 ? piece.split("|") : ["", piece]));

/** Returns {headline, story} of a motion, and the pieces of the story: [name of a body or "", words]. */
export function say(/** @type {Facts} */ facts) {
  const [headline, sentence] = sentences[regimeOf(facts)](wordsOf(facts));
  const { rest } = facts;
  const end = rest ? ` It rests after ${shown(rest.t, 3)} s, ${length(Math.hypot(rest.x, rest.y), "m")} from its start.` : "";
  const pieces = piecesOf(sentence + end);
  return { headline, pieces, story: pieces.map(([, words]) => words).join("") };
}

/** Headline and story if there is no motion. */
export const nothing = { headline: "Choose a place in the plane: a motion starts there", pieces: [["", "Up: faster sliding. To the side: faster spin."]] };

export const answers = { spins: "the one that spins", plain: "the one without spin", equal: "equally far" };

/** The question at the beginning; with the reader's guess, until the motion has ended. */
export const question = (guess = "") => ({
  headline: "One puck spins. Which slides farther?",
  pieces: [["", guess ? `You said: ${guess}.` : "Two equal pucks leave side by side at the same speed. One spins, the other does not. Your guess?"]],
});

/** The verdict on a guess. */
export function judged(guess, /** @type {Facts} */ { own, plain }) {
  const [far, farPlain] = [own, plain].map(({ path }) => length(path, "m"));
  return {
    [answers.spins]: `You are right: the one that spins went ${far}, the other ${farPlain}`,
    [answers.plain]: `You said the one without spin: it went ${farPlain}. The one that spins went ${far}`,
    [answers.equal]: `You said equally far, as textbooks do: ${farPlain}. The one that spins went ${far}`,
  }[guess];
}

export const inTries = (tries) => `in ${tries} ${tries === 1 ? "try" : "tries"}`;

/** Returns the last words of a hit: the number of tries, and that of the friend who sent the line. */
const counted = ({ tries, theirs }) => `${inTries(tries)}${theirs ? `; your friend needed ${theirs}` : ""}`;

/** Words about a mouse and keys, which the page hides on a device without them. */
const byMouse = (words) => ["mouse", words];

/** Returns task and result of a try in the game of the stone. */
const around = ({ passage: { until, off }, tries, theirs, ended, hit }) => ({
  headline: theirs && !tries ? `A friend curled around the stone ${inTries(theirs)}. You?`
    : !ended ? "Strike the ball around the stone and over the mark."
    : until < 1 ? `Try ${tries} touches the stone`
      : hit ? `Around the stone and over the mark, ${counted({ tries, theirs })}`
        : `Try ${tries} misses the mark by ${length(off, "m")}`,
  pieces: [["", "Drag the ball to aim, and let go to strike it. Set dot, speed and butt of the cue: a raised butt and a tip off the centre bend the path. "],
    byMouse("The keys ↑ and ↓ aim, too, and Enter strikes.")],
});

/** Returns task and result of a try in the game of the line or of the stone. */
export function goal({ passage, line, day, far, slip, spin, tries, theirs, ended, hit }) {
  if (passage) return around({ passage, tries, theirs, ended, hit });
  const off = length(Math.abs(far - line), "m");
  const missed = far < line ? `${off} short of the line` : `${off} beyond the line`;
  return {
    headline: theirs && !tries ? `A friend reached the line ${inTries(theirs)}. You?`
      : !ended ? `Same push, ${shown(slip, 3)} m/s. Reach the line, by spin alone.`
      : `${turnsOf(spin, "turns a second")} give ${length(far, "m")}: ${hit ? `the line, ${counted({ tries, theirs })}` : missed}`,
    pieces: [["", `${day && `Line of ${day} (UTC). `}Pull the puck sideways, or turn its ring, to spin it; let go, and it slides. `],
      byMouse("The wheel and the keys ↑ and ↓ spin it, too; a click or Enter lets it go.")],
  };
}
