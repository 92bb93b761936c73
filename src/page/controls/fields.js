// Fields, choices and sliders.
import { $, make, write } from "../dom.js";
import { parseNumber } from "../numbers.js";
import { allowed } from "../state/page_state.js";

/**
 * Makes a number field with its label in `parent`. A message beside the field tells why a number is wrong.
 * @param use  called with a typed number; throws an Error with the reason if the number is not allowed
 * @returns a function that shows a value from elsewhere, unless the reader is typing; undefined hides the field
 */
export function numberField(parent, { key, label, use }) {
  // A screen reader would read the output after each key.
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
  // Replace a number that is not allowed by the last allowed one.
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

/** Returns a message of the library, whose program has options, for the page, which has none. */
export const withoutOptions = (message) => message.replace(/^portrait: /, "").replace(/give its value with --param (\S+)=VALUE/, "write its value at the end: ; $1 = 0.8")
  .replace("give the others a value with --param NAME=VALUE", "write their values at the end: ; a = 0.8");

/** Makes choices side by side. @param titles  titles by names @returns a function that shows the chosen one */
export function choiceButtons(parent, titles, choose) {
  const inputs = Object.entries(titles).map(([name, title]) => {
    const input = make("input", { type: "radio", name: parent.id, value: name, onchange: () => choose(name) });
    parent.append(make("label", {}, input, title));
    return input;
  });
  return (name) => inputs.forEach((input) => (input.checked = input.value === name));
}

/** Restores a slider if a finger touched it only to scroll the page. */
export function forgiveTouches(input) {
  let before = "";
  input.addEventListener("pointerdown", () => (before = input.value));
  input.addEventListener("pointercancel", () => {
    input.value = before;
    input.dispatchEvent(new Event("input"));
  });
}

/** Fills a list of choices. @param titles  titles by names */
export function fillSelect(select, titles) { select.replaceChildren(...Object.entries(titles).map(([name, title]) => new Option(title, name))); }

/** Makes controls, each of which shows and changes a value of the state. @param {Store} store */
export function makeControls(store) {
  return {
    /** A list of choices. @param of  (state): name of the chosen one @param edit  (state, name) */
    choose(id, titles, of, edit) {
      fillSelect($(id), titles);
      $(id).addEventListener("change", () => store.ask((state) => edit(state, $(id).value)));
      store.shows.push((state) => ($(id).value = of(state)));
    },

    /** A number with its label, in `parent`. @param of  (store): its value, or undefined to hide the field @param edit  (state, value) */
    number(parent, key, label, of, edit) {
      const show = numberField(parent, { key, label, use: (value) => store.change((state) => edit(state, allowed(key, value))) });
      store.shows.push(() => show(of(store)));
    },

    /**
     * A slider.
     * @param of  (store): {share of its length, text, perhaps spoken and disabled}, or nothing to hide the slider
     * @param edit  (state, share)
     * @param parent  parent of the slider's element
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
