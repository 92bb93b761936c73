// Bytes as text that may stand in a script: seven of 116 letters hold six bytes, where base64 needs eight letters.

const [of, at, base] = [6, 7, 116];  // bytes, and letters, in a group
/** Letters of ASCII that are left out: they end a line or a file, or have a meaning in a text of a script. */
const left = [0, 9, 10, 11, 12, 13, 26, 27, 34, 60, 92, 127];
const letters = Array.from({ length: 128 }, (_, code) => code).filter((code) => !left.includes(code));
const digits = Array.from({ length: 128 }, (_, code) => letters.indexOf(code));

/** Returns the number of bytes, a space, and the bytes as text. */
export function packed(/** @type {Uint8Array} */ bytes) {
  const codes = [];
  for (let i = 0; i < bytes.length; i += of) {
    let number = 0;
    for (let j = of; j--;) number = 256 * number + (bytes[i + j] ?? 0);
    for (let j = at; j--; number = Math.floor(number / base)) codes.push(letters[number % base]);
  }
  return `${bytes.length} ${codes.map((code) => String.fromCharCode(code)).join("")}`;
}

export function unpacked(/** @type {string} */ text) {
  const bytes = new Uint8Array(parseInt(text));
  for (let i = text.indexOf(" ") + 1, byte = 0; byte < bytes.length; i += at, byte += of) {
    let number = 0;
    for (let j = at; j--;) number = base * number + digits[text.charCodeAt(i + j)];
    // Bytes behind the end of the array are dropped.
    for (let j = 0; j < of; ++j, number = Math.floor(number / 256)) bytes[byte + j] = number;
  }
  return bytes;
}
