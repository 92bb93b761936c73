// The library's texts: _ and ^ begin an index or a power, {/:Italic x} is a letter in italics, {/*0.85 x} a size that is
// left to the style, and \ takes the next character as it is.

/** The runs of a text: {text, italic, level}; level 1 is a power, -1 an index, 0 the line. */
export function runsOf(markup, italic = false) {
  const runs = [];
  let at = 0;
  const add = (text, slanted, level) => {
    const last = runs.at(-1);
    if (last && last.italic === slanted && last.level === level) last.text += text;
    else runs.push({ text, italic: slanted, level });
  };
  const character = () => {
    if (markup[at] === "\\" && at + 1 < markup.length) ++at;
    const [first] = markup.slice(at);
    at += first.length;
    return first;
  };
  const group = (slanted, level) => {
    at += 1;
    const command = /^\/(\S*) /.exec(markup.slice(at));
    if (command) at += command[0].length;
    piece(slanted || command?.[1] === ":Italic", level);
    at += 1;
  };
  function piece(slanted, level) {
    while (at < markup.length && markup[at] !== "}") {
      const sign = markup[at];
      if (sign === "{") {
        group(slanted, level);
      } else if (sign === "_" || sign === "^") {
        at += 1;
        const script = sign === "^" ? 1 : -1;
        if (markup[at] === "{") group(slanted, script);
        else if (at < markup.length) add(character(), slanted, script);
      } else {
        add(character(), slanted, level);
      }
    }
  }
  piece(italic, 0);
  return runs;
}

/** The text without its markup. */
export const plain = (markup) => runsOf(markup).map(({ text }) => text).join("");
