// Fields, choices and sliders.
import { $, make, write } from "../dom.js";
import { parseNumber } from "../numbers.js";
import { allowed } from "../state/page_state.js";

/**
 * A number field with its label, in `parent`. What is wrong with a number is said beside it.
 *
 * @param use  called with a number that was typed; throws an Error whose message says why it will not do
 * @returns a function that shows a value from elsewhere, unless the reader is typing; undefined hides the field
 */
export function numberField(parent, { key, label, use }) {
  // Each key would be announced.
  const output = make("output", { className: "error", id: `${key}-error`, ariaLive: "off" });
  const input = make("input", { className: "number", inputMode: "decimal", autocomplete: "off", name: key });
  const wrapper = make("label", {}, label, input, output);
  parent.append(wrapper);
  input.setAttribute("aria-describedby", output.id);
  const say = (problem) => {
    write(output, problem);
    input.setAttribute("aria-invalid", problem ? "true" : "false");
  };
  let last = "";
  input.addEventListener("input", () => {
    try {
      use(parseNumber(input.value));
      say("");
    } catch (error) {
      say(error.message);
    }
  });
  // What cannot be used does not stay.
  input.addEventListener("change", () => {
    if (output.textContent === "") return;
    input.value = last;
    say("");
  });
  return (value) => {
    wrapper.hidden = value === undefined;
    if (value === undefined) return;
    last = Math.abs(value) >= 1e6 ? value.toExponential() : String(value);
    if (document.activeElement === input) return;
    if (input.value !== last) input.value = last;
    say("");
  };
}

/** Choices side by side, of which one is chosen. @param titles  of their names @returns shows the chosen one */
export function choiceButtons(parent, titles, choose) {
  const inputs = Object.entries(titles).map(([name, title]) => {
    const input = make("input", { type: "radio", name: parent.id, value: name, onchange: () => choose(name) });
    parent.append(make("label", {}, input, title));
    return input;
  });
  return (name) => inputs.forEach((input) => (input.checked = input.value === name));
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

/** @param titles  of the names of what can be chosen */
export function fillSelect(select, titles) {
  select.replaceChildren(...Object.entries(titles).map(([name, title]) => new Option(title, name)));
}

/** Controls of the state: each shows a value of it, and changes it. @param {Store} store */
export function makeControls(store) {
  return {
    /** A list of choices. @param of  (state): the name of the one that is chosen @param edit  (state, name) */
    choose(id, titles, of, edit) {
      fillSelect($(id), titles);
      $(id).addEventListener("change", () => store.ask((state) => edit(state, $(id).value)));
      store.shows.push((state) => ($(id).value = of(state)));
    },

    /** A number with its label, in `parent`. @param of  (store): its value; hidden where it has none @param edit  (state, value) */
    number(parent, key, label, of, edit) {
      const show = numberField(parent, { key, label, use: (value) => store.change((state) => edit(state, allowed(key, value))) });
      store.shows.push(() => show(of(store)));
    },

    /**
     * A slider.
     *
     * @param of  (store): {share of its length, text, perhaps spoken and disabled}; hidden where there is none
     * @param edit  (state, share)
     * @param parent  of the element around it
     */
    slider(name, label, of, edit, parent = $("sliders")) {
      const input = make("input", { type: "range", min: 0, max: 1000, id: `${name}-slider` });
      const output = make("output", { htmlFor: input.id });
      const title = make("label", { htmlFor: input.id, textContent: label });
      const all = make("div", { className: "slider", id: `${name}-control` }, title, output, input);
      parent.append(all);
      input.addEventListener("input", () => store.ask((state) => edit(state, Number(input.value) / 1000)));
      forgiveTouches(input);
      store.shows.push(() => {
        const shown = of(store);
        all.hidden = !shown;
        if (!shown) return;
        if (document.activeElement !== input) input.value = Math.round(1000 * shown.share);
        input.disabled = Boolean(shown.disabled);
        write(output, shown.text);
        input.setAttribute("aria-valuetext", shown.spoken ?? shown.text);
      });
    },
  };
}
