// The library's texts: _ and ^ begin an index or a power, {/:Italic x} is a letter in italics, {/*0.85 x} a size that is
// left to the style, and \ takes the next character as it is.

/** The runs of a text: {text, italic, level}; level 1 is a power, -1 an index, 0 the line. */
export function runsOf(markup) {
  const runs = [];
  const outer = [];  // what is around the groups that are open
  let style = { italic: false, level: 0 };
  let script = 0;    // the level of the character or the group that is next, if it is not the level here
  for (const [token, command] of markup.matchAll(/\\.|\{(?:\/(\S*) )?|./gsu)) {
    const { italic, level } = { ...style, ...(script && { level: script }) };
    script = { "^": 1, _: -1 }[token] ?? 0;
    if (script) continue;
    if (token === "}") {
      style = outer.pop() ?? style;
    } else if (token.startsWith("{")) {
      outer.push(style);
      style = { italic: italic || command === ":Italic", level };
    } else {
      const text = token.replace(/^\\(.)/su, "$1");
      const last = runs.at(-1);
      if (last?.italic === italic && last.level === level) last.text += text;
      else runs.push({ text, italic, level });
    }
  }
  return runs;
}

/** The text without its markup. */
export const plain = (markup) => runsOf(markup).map(({ text }) => text).join("");
