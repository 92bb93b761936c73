// Bytes as text that may stand in a script: two of 91 letters hold 13 bits, where base64 needs a tenth more letters.

/** The letters are those of ASCII from ! on, without " < and \. */
const left = [34, 60, 92];
const digitOf = (/** @type {number} */ code) => code - 33 - left.filter((other) => code > other).length;
const digits = Uint8Array.from({ length: 127 }, (_, code) => Math.max(0, digitOf(code)));
const letters = Array.from({ length: 127 }, (_, code) => code).filter((code) => code > 32 && !left.includes(code)).map((code) => String.fromCharCode(code));

/** Returns the number of bytes, a space, and the bytes as text. */
export function packed(/** @type {Uint8Array} */ bytes) {
  let [text, held, bits] = [`${bytes.length} `, 0, 0];
  const put = () => (text += letters[(held & 8191) % 91] + letters[Math.floor((held & 8191) / 91)]);
  for (const byte of bytes) {
    held |= byte << bits;
    bits += 8;
    if (bits < 13) continue;
    put();
    [held, bits] = [held >> 13, bits - 13];
  }
  if (bits > 0) put();
  return text;
}

export function unpacked(/** @type {string} */ text) {
  const bytes = new Uint8Array(parseInt(text));
  let [held, bits, at] = [0, 0, 0];
  for (let i = text.indexOf(" ") + 1; i < text.length; i += 2) {
    held |= (digits[text.charCodeAt(i)] + 91 * digits[text.charCodeAt(i + 1)]) << bits;
    for (bits += 13; bits >= 8; bits -= 8) {
      bytes[at++] = held;
      held >>= 8;
    }
  }
  return bytes;
}
