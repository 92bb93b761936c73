// A field for a number: what is wrong with it is said beside it, and only what is right is used.
import { $, make, write } from "../dom.js";
import { parseNumber } from "../numbers.js";
import { requireAllowed } from "../state/page_state.js";

/**
 * @param input   the text field
 * @param output  where a problem is said
 * @param use     called with a number that was typed; throws an Error whose message says why it will not do
 */
export function numberField(input, output, use) {
  const say = (problem) => {
    write(output, problem);
    input.setAttribute("aria-invalid", problem ? "true" : "false");
  };
  const read = () => {
    const { value, problem } = parseNumber(input.value);
    if (problem) return say(problem);
    try {
      use(value);
      say("");
    } catch (error) {
      say(error.message);
    }
  };
  let last = input.value;
  output.setAttribute("aria-live", "off");  // it is the field's description; each key would be announced
  input.addEventListener("input", read);
  // What cannot be used does not stay.
  input.addEventListener("change", () => {
    if (output.textContent === "") return;
    input.value = last;
    say("");
  });
  return {
    /** Shows a value that came from elsewhere, unless the reader is typing. */
    show(value) {
      const text = last = Math.abs(value) >= 1e6 ? value.toExponential() : String(value);
      if (document.activeElement === input) return;
      if (input.value !== text) input.value = text;
      say("");
    },
    say,
  };
}

/** A labelled number field with its place for a problem, in `parent`. */
export function addNumberField(parent, { key, label, use }) {
  const input = make("input", { className: "number", inputMode: "decimal", autocomplete: "off", name: key });
  const output = make("output", { className: "error", id: `${key}-error` });
  input.setAttribute("aria-describedby", output.id);
  const wrapper = make("label", {}, label, input, output);
  parent.append(wrapper);
  return { ...numberField(input, output, use), hide: (hidden) => (wrapper.hidden = hidden) };
}

/** Choices side by side, of which one is chosen. */
export function choiceButtons(parent, choices, choose) {
  const radio = ({ name }) => make("input", { type: "radio", name: parent.id, value: name, onchange: () => choose(name) });
  const inputs = choices.map(radio);
  parent.append(...choices.map(({ title }, i) => make("label", {}, inputs[i], title)));
  return { show: (name) => inputs.forEach((input) => (input.checked = input.value === name)) };
}

/** A finger that goes on to scroll has touched a slider by chance: that is taken back. */
export function forgiveTouches(input) {
  let before = "";
  input.addEventListener("pointerdown", () => (before = input.value));
  input.addEventListener("pointercancel", () => {
    input.value = before;
    input.dispatchEvent(new Event("input"));
  });
}

/** A slider above the patch's; `use` takes a fraction of its length. */
export function slider(name, label, use) {
  const input = make("input", { type: "range", min: 0, max: 1000, id: `${name}-slider` });
  const output = make("output", { htmlFor: input.id });
  const title = make("label", { htmlFor: input.id, textContent: label });
  $("mu-control").before(make("div", { className: "slider", id: `${name}-control` }, title, output, input));
  input.addEventListener("input", () => use(Number(input.value) / 1000));
  forgiveTouches(input);
  return {
    show(fraction, text) {
      if (document.activeElement !== input) input.value = Math.round(1000 * fraction);
      write(output, text);
      input.setAttribute("aria-valuetext", text);
    },
  };
}

export function fillSelect(select, choices) {
  select.replaceChildren(...choices.map(({ name, title }) => new Option(title, name)));
}

/** A list of choices. @param edit  (state, name) */
export function choose(id, choices, ask, edit) {
  fillSelect($(id), choices);
  $(id).addEventListener("change", () => ask((state) => edit(state, $(id).value)));
}

/** A number of the state with its label, in `parent`. @param edit  (state, value) */
export const addNumber = (store, parent, key, label, edit) => addNumberField(parent, {
  key, label,
  use(value) {
    requireAllowed(key, value);
    store.change((state) => edit(state, value));
  },
});
