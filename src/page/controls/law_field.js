// A list of the laws, with a field for the number of a law; the reader's own pressure is a law, too.
import { $ } from "../dom.js";
import { numberField, fillSelect } from "./fields.js";

const table = "table:";  // prefix of the name of the reader's own law; its CSV follows
const longest = 6000;   // letters of this CSV, which is part of the link

/** Returns true for a law of formulas. */
const isFormula = (law) => law?.includes("=");

/** Returns the name of a law; for a table, the file that the program would read. */
export const lawTitle = (law) => (law?.startsWith(table) ? "pressure.csv" : law);

/** Returns the name of the law of a CSV with columns rho and pressure. @throws {Error} if the CSV is too long */
export function lawOfTable(text) {
  if (text.length <= longest) return `${table}${text.replace(/^\ufeff/, "").trim()}`;
  throw new Error(`This page takes tables of at most ${longest} letters, because its link contains them. The program takes longer ones: --law FILE.csv.`);
}

/** Returns the table of a law made by lawOfTable, as the file that the program reads; null for another law. */
export const tableOfLaw = (law) => (law.startsWith(table) ? `${law.slice(table.length)}\n` : null);

/**
 * @param {string} id  id of the list; with -exponent, id of the parent of the number's field
 * @param {Store} store
 * @param {{key: string, none?: string, use: (name: string | null) => void}} how
 *   none: title of the choice of no law, if there is this choice;
 *   use: called with the name of a law, or null for none; throws an Error with the reason if the law is not allowed
 */
export function lawField(id, store, { key, none, use }) {
  const { laws } = store.library;
  const [select, place] = [$(id), $(`${id}-exponent`)];
  const numbers = new Map(laws.filter(({ letter }) => letter).map(({ name, example }) => [name, example]));
  const titles = laws.map(({ name, meaning, letter }) => [name, `${letter ? `${name}:${letter}` : name} – ${meaning}`]);
  fillSelect(select, { ...(none && { "": none }), ...Object.fromEntries(titles) });
  const showNumber = numberField(place, {
    key, label: "its number",
    use: (value) => {
      use(`${select.value}:${value}`);
      numbers.set(select.value, value);
    },
  });
  select.addEventListener("change", () => store.attempt(() => {
    const number = numbers.get(select.value);
    use(number === undefined ? select.value || null : `${select.value}:${number}`);
  }));
  return {
    show(law) {
      const own = tableOfLaw(law ?? "") ? "pressure.csv – your own pressure" : isFormula(law) ? "your own formulas" : null;
      const [name, number] = own ? [law] : (law ?? "").split(":");
      if (own) ([...select.options].find(({ text }) => text === own) ?? select.appendChild(new Option(own))).value = name;
      select.value = name;
      place.hidden = number === undefined;
      showNumber(number && Number(number));
    },
  };
}
