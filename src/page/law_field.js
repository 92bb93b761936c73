// A choice among the laws, with a field for the number of a law that has one.
import { addNumberField, fillSelect } from "./fields.js";

/**
 * @param select   the list
 * @param place    where the number's field goes
 * @param laws     of the library: {name, meaning}, and {letter, example} of a family
 * @param none     the title of no law at all, if that is a choice
 * @param attempt  runs what may be rejected, and tells the reader
 * @param use      called with what a law is called, or null for none; throws an Error whose message says why it will not do
 */
export function lawField(select, place, { laws, key, none, attempt, use }) {
  const families = new Map(laws.filter(({ letter }) => letter).map((family) => [family.name, { ...family, number: family.example }]));
  fillSelect(select, [
    ...(none ? [{ name: "", title: none }] : []),
    ...laws.map(({ name, meaning, letter }) => ({ name, title: `${letter ? `${name}:${letter}` : name} – ${meaning}` })),
  ]);
  const field = addNumberField(place, {
    key, label: "its number",
    use: (value) => {
      use(`${select.value}:${value}`);
      families.get(select.value).number = value;
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
