// Bytes as text that may stand in a script: 22 of 121 letters hold 19 bytes, where base64 needs 26 letters.

const [of, at, base] = [19, 22, 121];  // bytes, and letters, in a group
/** Letters of ASCII that are left out: they end a line or a file, or have a meaning in a text of a script. */
const left = [0, 10, 13, 26, 34, 60, 92];
const letters = Array.from({ length: 128 }, (_, code) => code).filter((code) => !left.includes(code));
const digits = Array.from({ length: 128 }, (_, code) => letters.indexOf(code));

/** Returns the number of bytes, a space, and the bytes as text. */
export function packed(/** @type {Uint8Array} */ bytes) {
  const codes = [];
  for (let i = 0; i < bytes.length; i += of) {
    const group = Array.from({ length: of }, (_, j) => bytes[i + j] ?? 0);
    // Divides the number with these digits to the base 256 by the other base; the remainder is the next letter.
    for (let j = at; j--;) {
      let rest = 0;
      for (let k = of; k--; rest %= base) {
        rest = 256 * rest + group[k];
        group[k] = Math.floor(rest / base);
      }
      codes.push(letters[rest]);
    }
  }
  return `${bytes.length} ${codes.map((code) => String.fromCharCode(code)).join("")}`;
}

export function unpacked(/** @type {string} */ text) {
  const bytes = new Uint8Array(parseInt(text));
  const group = new Uint8Array(of);
  for (let i = text.indexOf(" ") + 1, byte = 0; byte < bytes.length; i += at, byte += of) {
    group.fill(0);
    for (let j = at; j--;) {
      let rest = digits[text.charCodeAt(i + j)];
      for (let k = 0; k < of; ++k, rest >>= 8) {
        rest += base * group[k];
        group[k] = rest;
      }
    }
    // Bytes behind the end of the array are dropped.
    bytes.set(group.subarray(0, bytes.length - byte), byte);
  }
  return bytes;
}
