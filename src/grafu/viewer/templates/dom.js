// @ts-check
// Elements of the page, with the types that their selectors stand for.

/** Returns the control that a selector finds first. @type {(selector: string) => HTMLInputElement} */
const controlAt = (selector) => document.querySelector(selector);

/** Returns all controls that a selector finds. @type {(selector: string) => HTMLInputElement[]} */
const controlsAt = (selector) => [...document.querySelectorAll(selector)].map((one) => /** @type {HTMLInputElement} */ (one));

/** Returns the element that an event is about. @type {(event: Event) => HTMLElement} */
const elementOf = (event) => /** @type {HTMLElement} */ (event.target);
