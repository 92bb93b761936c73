// Texts: a string, or an array of strings and of the library's runs (portraits/text.hpp).

/** @typedef {{words: string, italic: boolean, level: number}} Run  level 1 is a power, -1 an index, 0 the line */
/** @typedef {string | (string | Run)[]} Text */

/** @returns {Run[]} */
export const runsOf = (/** @type {Text} */ text) =>
  (typeof text === "string" ? [text] : text).map((run) => (typeof run === "string" ? { words: run, italic: false, level: 0 } : run));

/** The words of a text alone. */
export const plain = (/** @type {Text} */ text) => runsOf(text).map(({ words }) => words).join("");

export const italic = (/** @type {string} */ words) => ({ words, italic: true, level: 0 });
