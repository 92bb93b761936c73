// A field for a number: what is wrong with it is said beside it, and only what is right is used.
import { parseNumber } from "./numbers.js";

/**
 * @param input   the text field
 * @param output  where a problem is said
 * @param use     called with a number that was typed; throws an Error whose message says why it will not do
 */
export function numberField(input, output, use) {
  const say = (problem) => {
    output.textContent = problem;
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
  input.addEventListener("input", read);
  return {
    /** Shows a value that came from elsewhere, unless the reader is typing. */
    show(value) {
      if (document.activeElement === input) return;
      const text = String(value);
      if (input.value !== text) input.value = text;
      say("");
    },
    say,
  };
}

/** A labelled number field with its place for a problem, in `parent`. */
export function addNumberField(parent, { key, label, use }) {
  const wrapper = document.createElement("label");
  const input = Object.assign(document.createElement("input"), { className: "number", inputMode: "decimal", autocomplete: "off", name: key });
  const output = Object.assign(document.createElement("output"), { className: "error", id: `${key}-error` });
  input.setAttribute("aria-describedby", output.id);
  wrapper.append(label, input, output);
  parent.append(wrapper);
  return numberField(input, output, use);
}

/** Buttons of which one is chosen; arrow keys go round. */
export function choiceButtons(parent, choices, choose) {
  const buttons = choices.map(({ name, title }) => {
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: title });
    button.setAttribute("role", "radio");
    button.dataset.name = name;
    button.addEventListener("click", () => choose(name));
    parent.append(button);
    return button;
  });
  parent.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const next = buttons[(buttons.indexOf(document.activeElement) + step + buttons.length) % buttons.length];
    next.focus();
    next.click();
  });
  return {
    show(name) {
      for (const button of buttons) {
        const chosen = button.dataset.name === name;
        button.setAttribute("aria-checked", String(chosen));
        button.tabIndex = chosen ? 0 : -1;
      }
    },
  };
}

export function fillSelect(select, choices) {
  select.replaceChildren(...choices.map(({ name, title }) => new Option(title, name)));
}
