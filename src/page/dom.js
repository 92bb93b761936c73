// Elements of the page.

/** Returns the element with an id. */
export const $ = (/** @type {string} */ id) => /** @type {PageElement} */ (document.getElementById(id));

/** Returns true if the reader's system asks for less motion. */
export const isStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** Writes a text into an element. The same text is not written again, because the browser would compute the layout again. */
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Makes an element with properties and children. @returns {PageElement} */
export function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

/** Gives `parent` one child for each entry, and shows the entry in it. Existing children stay, and keep the focus. */
export function showList(parent, entries, child, show) {
  while (parent.children.length > entries.length) parent.lastChild.remove();
  while (parent.children.length < entries.length) parent.append(child());
  entries.forEach((entry, index) => show(parent.children[index], entry, index));
}
