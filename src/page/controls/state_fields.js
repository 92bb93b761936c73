// Fields that change the state.
import { $ } from "../dom.js";
import { addNumberField, fillSelect } from "./fields.js";
import { requireAllowed } from "../state/page_state.js";

/** A list of choices. @param edit  (state, name) */
export function choose(id, choices, ask, edit) {
  fillSelect($(id), choices);
  $(id).addEventListener("change", () => ask((state) => edit(state, $(id).value)));
}

/** A number with its label, in `parent`. @param edit  (state, value) */
export const addNumber = (store, parent, key, label, edit) => addNumberField(parent, {
  key, label,
  use(value) {
    requireAllowed(key, value);
    store.change((state) => edit(state, value));
  },
});
