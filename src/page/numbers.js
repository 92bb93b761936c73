// Numbers as people type and read them.

/** A number from a field, or a sentence that says why it is none. @returns {{value: number, problem?: string}} */
export function parseNumber(text) {
  const trimmed = text.trim().replace("−", "-");
  if (trimmed === "") return { value: NaN, problem: "a number is needed" };
  if (/^[-+]?\d+,\d+$/.test(trimmed)) return { value: NaN, problem: `write ${trimmed.replace(",", ".")} with a point` };
  const value = Number(trimmed);
  if (!Number.isFinite(value)) return { value, problem: `'${trimmed}' is not a finite number` };
  return { value };
}

/** A number with a few digits, without needless zeros. */
export function shown(value, digits = 5) {
  if (value === Infinity) return "∞";
  if (value === -Infinity) return "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-4 ? exponential(value, digits) : String(Number(value.toPrecision(digits)));
  return text.replace("-", "−");
}

function exponential(value, digits) {
  const [mantissa, exponent] = value.toExponential(Math.max(0, digits - 1)).split("e");
  return `${Number(mantissa)}·10${superscript(Number(exponent))}`;
}

const superscripts = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

export function superscript(integer) {
  return [...String(integer)].map((character) => superscripts[character]).join("");
}

/** The largest of 1, 2, 5 times a power of ten that is at most x. */
export function roundDown(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return (x >= 5 * power ? 5 : x >= 2 * power ? 2 : 1) * power;
}

/** Round numbers in [low, high], about `wanted` of them, but two if more fit than one. */
export function ticks(low, high, wanted) {
  const of = (step) => {
    const values = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) values.push(i * step);
    return values;
  };
  const step = roundDown(((high - low) / wanted) * 1.4);
  const values = of(step);
  return values.length >= 2 ? values : of(roundDown(0.6 * step));
}

/** The text of a tick, with no more digits than its step needs. */
export function tickText(value, step) {
  if (Math.abs(value) < step / 1e6) return "0";
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const size = Math.abs(value);
  if (size >= 1e5 || decimals > 4) return shown(value, 3);
  return value.toFixed(decimals).replace("-", "−");
}
