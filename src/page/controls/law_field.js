// A choice among the laws, with a field for the number of a law that has one; and the reader's own pressure.
import { $ } from "../dom.js";
import { numberField, fillSelect } from "./fields.js";

const table = "table:";  // what the name of a law begins with that is the reader's own; its CSV follows
const longest = 6000;   // letters of it, which go with the link

/** Whether a law is formulas. */
const isFormula = (law) => law?.includes("=");

/** What a law is called: a table by the file that the program would read. */
export const lawTitle = (law) => (law?.startsWith(table) ? "pressure.csv" : law);

/** The name of the law of a CSV with columns rho and pressure. @throws {Error} if it is too long */
export function lawOfTable(text) {
  if (text.length <= longest) return `${table}${text.replace(/^\ufeff/, "").trim()}`;
  throw new Error(`This page takes tables of at most ${longest} letters, because its link contains them. The program takes longer ones: --law FILE.csv.`);
}

/** The table of a law of lawOfTable, as the file that the program reads; null of any other. */
export const tableOfLaw = (law) => (law.startsWith(table) ? `${law.slice(table.length)}\n` : null);

/**
 * @param {string} id  of the list, and with -exponent of where the number's field goes
 * @param {Store} store
 * @param {{key: string, none?: string, use: (name: string | null) => void}} how
 *   none: the title of no law at all, if that is a choice;
 *   use: called with what a law is called, or null for none; throws an Error whose message says why it will not do
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
