// A choice among the laws, with a field for the number of a law that has one; and the reader's own pressure.
import { $ } from "../dom.js";
import { addNumberField, fillSelect } from "./fields.js";

const table = "table";  // what the name of a law begins with that is the reader's own: rho/pressure of each row
const mostRows = 200;   // of it, which go with the link

/** Whether a law is formulas. */
const isFormula = (law) => law?.includes("=");

/** What a law is called: a table by the file that the program would read. */
export const lawTitle = (law) => (law?.startsWith(`${table}:`) ? "pressure.csv" : law);

/** The name of the law of a CSV with columns rho and pressure. @throws {Error} if it has none */
export function lawOfTable(text) {
  const [header, ...rows] = text.replace(/^\ufeff/, "").trim().split(/\r\n?|\n/).map((line) => line.split(",").map((cell) => cell.trim()));
  const columns = ["rho", "pressure"].map((name) => header.indexOf(name));
  if (columns.includes(-1)) throw new Error("A pressure table has the columns rho and pressure: its first line must be \"rho,pressure\".");
  if (rows.length > mostRows) throw new Error(`This page takes tables of at most ${mostRows} rows, because its link contains them. The program takes longer ones: --law FILE.csv.`);
  return `${table}:${rows.map((row) => columns.map((column) => row[column] ?? "").join("/")).join(";")}`;
}

/** The table of a law of lawOfTable, as the file that the program reads; null of any other. */
export const tableOfLaw = (law) => (law.startsWith(`${table}:`) ? `rho,pressure\n${law.slice(table.length + 1).replaceAll("/", ",").replaceAll(";", "\n")}\n` : null);

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
  const showNumber = addNumberField(place, {
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
