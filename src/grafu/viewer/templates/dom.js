// @ts-check
// Elements of the page, with the types that their selectors stand for.

/** Returns the element that a selector finds first; the page must have one. @type {(selector: string) => HTMLElement} */
function elementAt(selector) {
  const found = document.querySelector(selector);
  if (!(found instanceof HTMLElement)) throw new Error(`the page has no element ${selector}`);
  return found;
}

/** Returns the control that a selector finds first. @type {(selector: string) => HTMLInputElement} */
const controlAt = (selector) => /** @type {HTMLInputElement} */ (elementAt(selector));

/** Returns all controls that a selector finds. @type {(selector: string) => HTMLInputElement[]} */
const controlsAt = (selector) => [...document.querySelectorAll(selector)].map((one) => /** @type {HTMLInputElement} */ (one));

/** Returns the element that an event is about. @type {(event: Event) => HTMLElement} */
const elementOf = (event) => /** @type {HTMLElement} */ (event.target);
