// A choice among the laws, with a field for the exponent where the law has one.
import { addNumberField, fillSelect } from "./fields.js";

const titles = {
  pade: "Padé (the paper's system)", exact: "exact (Hertz)", uniform: "uniform pressure", punch: "flat punch", ring: "ring",
  paraboloid: "paraboloid", elliptic: "elliptic limit surface", potential8: "8th-degree potential",
};
const family = "pressure";
const ofFamily = /^pressure:(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)$/;

/** The exponent of a law pressure:P, or NaN. */
export const exponentOf = (law) => Number(ofFamily.exec(law ?? "")?.[1] ?? NaN);

/** Whether the library has a law of that name. */
export function isLaw(law, { laws, largestExponent }) {
  const exponent = exponentOf(law);
  return laws.includes(law) || (exponent > -1 && exponent <= largestExponent);
}

/**
 * @param select   the list
 * @param place    where the exponent's field goes
 * @param library  {laws, largestExponent}
 * @param none     the title of no law at all, if that is a choice
 * @param attempt  runs what may be rejected, and tells the reader
 * @param use      called with a law's name, or null for none; throws an Error whose message says why it will not do
 */
export function lawField(select, place, { library, key, none, attempt, use }) {
  fillSelect(select, [
    ...(none ? [{ name: "", title: none }] : []),
    ...library.laws.map((name) => ({ name, title: titles[name] ?? name })),
    { name: family, title: "pressure (1 − ρ²)ᴾ" },
  ]);
  let exponent = 0.5;
  const field = addNumberField(place, {
    key, label: "exponent P",
    use: (value) => {
      if (value === -1) throw new Error("the limit P → −1 is the law ring");
      if (!(value > -1 && value <= library.largestExponent)) throw new Error(`−1 < P ≤ ${library.largestExponent} is required`);
      use(`${family}:${value}`);
      exponent = value;
    },
  });
  select.addEventListener("change", () => attempt(() => use(select.value === family ? `${family}:${exponent}` : select.value || null)));
  return {
    show(law) {
      const value = exponentOf(law);
      const chosen = !Number.isNaN(value);
      if (chosen) exponent = value;
      select.value = chosen ? family : law ?? "";
      place.hidden = !chosen;
      field.show(exponent);
    },
  };
}
