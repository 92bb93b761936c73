// Elements of the page.

/** The element of that id, of whatever kind. */
export const $ = (/** @type {string} */ id) => /** @type {PageElement} */ (document.getElementById(id));

/** Whether the reader's system asks for less motion. */
export const isStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** Writes into an element; the text that is there already would lay the page out again. */
export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** An element with properties, and what is in it. @returns {PageElement} */
export function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

/** Makes `parent` have one child for each entry, and shows the entry in it: children stay, and with them the focus. */
export function showList(parent, entries, child, show) {
  while (parent.children.length > entries.length) parent.lastChild.remove();
  while (parent.children.length < entries.length) parent.append(child());
  entries.forEach((entry, index) => show(parent.children[index], entry, index));
}
