// Numbers as people type and read them.

/** Reads a number. @throws {Error} with the reason, if the text is no number */
export function parseNumber(text) {
  const trimmed = text.trim().replace("−", "-");
  if (trimmed === "") throw new Error("a number is needed");
  if (/^[-+]?\d+,\d+$/.test(trimmed)) throw new Error(`write ${trimmed.replace(",", ".")} with a point`);
  const value = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(trimmed) ? Number(trimmed) : NaN;
  if (!Number.isFinite(value)) throw new Error(`'${trimmed}' is not a finite number`);
  return value;
}

/** A number with a few digits, without needless zeros. */
export function shown(value, digits = 5) {
  const size = Math.abs(value);
  const [mantissa, exponent] = size.toExponential(digits - 1).split("e").map(Number);
  const text = size === Infinity ? "∞"
    : size >= 1e5 || (size > 0 && size < 1e-4) ? `${mantissa}·10${superscript(exponent)}` : String(Number(size.toPrecision(digits)));
  return value < 0 ? `−${text}` : text;
}

export const superscript = (integer) =>
  [...String(integer)].map((sign) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]).join("");

/** A number in words, which have no powers of ten. */
const inWords = (value, least, unit, digits = 3) => {
  const large = value >= 1e5 && value < 1e12 && Number(value.toPrecision(digits)).toLocaleString("en").replaceAll(",", "\u202f");
  return `${large || (value === 0 || value >= least ? shown(value, digits) : `less than ${least}`)}${unit}`;
};

/** A length in words, such as 52.9 mm; without a unit, a number. */
export const length = (metres, unit) => (!unit ? inWords(metres, 1e-4, "") : metres >= 0.1 ? inWords(metres, 0, " m") : inWords(1000 * metres, 0.01, " mm"));

/** A time in words; without a unit, a number. */
export const duration = (t, unit) => (unit ? inWords(t, 1e-3, " s") : inWords(t, 1e-4, ""));

/** An angular velocity in words, from rad/s. */
export const turnsOf = (spin, words = "turns/s") => `${shown(spin / 2 / Math.PI, 3)} ${words}`;

/** A spin in turns per second, in the Lab also in rad/s, or without units. */
export const spinText = (u, { ball, lab }) => (ball ? `${turnsOf(u / ball.radius)}${lab ? ` (${shown(u / ball.radius, 3)} rad/s)` : ""}` : `u = ${shown(u, 3)}`);

/** The largest of 1, 2, 5 times a power of ten that is at most x. */
export function roundDown(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return (x >= 5 * power ? 5 : x >= 2 * power ? 2 : 1) * power;
}

/** Returns an axis of powers of ten, in decades. If they are few, 2 and 5 times each are added. */
export function decades(low, high) {
  const few = high - low < 2.5;
  const step = Math.ceil((high - low) / 5);
  const [first, last] = [low, high].map((at) => Math.floor(at / step));
  const powers = Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
  const ticks = few ? powers.flatMap((power) => [1, 2, 5].map((times) => power + Math.log10(times))) : powers;
  const text = (at) => (few ? shown(10 ** at, 1) : at === 0 ? "1" : `10${superscript(at)}`);
  return { low, high, ticks: ticks.filter((at) => at >= low && at <= high).map((at) => ({ at, text: text(at) })) };
}
