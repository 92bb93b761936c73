// A choice among the laws, with a field for the number of a law that has one.
import { $ } from "./dom.js";
import { addNumberField, fillSelect } from "./fields.js";

/**
 * @param {string} id  of the list, and with -exponent of where the number's field goes
 * @param {{laws: Law[], key: string, none?: string, attempt: (action: () => void) => void, use: (name: string | null) => void}} how
 *   none: the title of no law at all, if that is a choice; attempt: runs what may be rejected, and tells the reader;
 *   use: called with what a law is called, or null for none; throws an Error whose message says why it will not do
 */
export function lawField(id, { laws, key, none, attempt, use }) {
  const [select, place] = [$(id), $(`${id}-exponent`)];
  const families = new Map(laws.filter(({ letter }) => letter).map((family) => [family.name, { ...family, number: family.example }]));
  fillSelect(select, [
    ...(none ? [{ name: "", title: none }] : []),
    ...laws.map(({ name, meaning, letter }) => ({ name, title: `${letter ? `${name}:${letter}` : name} – ${meaning}` })),
  ]);
  const field = addNumberField(place, {
    key, label: "its number",
    use: (value) => {
      use(`${select.value}:${value}`);
      Object.assign(families.get(select.value) ?? {}, { number: value });
    },
  });
  select.addEventListener("change", () => attempt(() => {
    const family = families.get(select.value);
    use(family ? `${family.name}:${family.number}` : select.value || null);
  }));
  return {
    show(law) {
      const [name, number] = (law ?? "").split(":");
      select.value = name;
      place.hidden = number === undefined;
      if (!place.hidden) field.show(Number(number));
    },
  };
}
