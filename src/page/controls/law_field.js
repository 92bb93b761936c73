// A list of the laws, with a field for the number of a law.
import { $ } from "../dom.js";
import { numberField, fillSelect } from "./fields.js";

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
      const own = law?.includes("=") ? "your own formulas" : null;
      const [name, number] = own ? [law] : (law ?? "").split(":");
      if (own) ([...select.options].find(({ text }) => text === own) ?? select.appendChild(new Option(own))).value = name;
      select.value = name;
      place.hidden = number === undefined;
      showNumber(number && Number(number));
    },
  };
}
