// @ts-check
// Keeps the focus of the keyboard where it was when the markup around it is made anew.

/** @typedef {[string, string, boolean]} Known what a control is known by: name, value, whether one that begins so will do */

const NAMES = ["action", "switch", "part", "copy", "restore", "do", "shelves"]; // of `data-`, what controls are known by
const CONTROLS = "summary, a[href], button, input, select";

/** @param {Element} box */
const controlsIn = (box) => /** @type {HTMLInputElement[]} */ ([...box.querySelectorAll(CONTROLS)]);

/** @param {HTMLInputElement} control */
const isOpen = (control) => !control.disabled && !control.hidden && control.getClientRects().length > 0;

// Returns what gives the focus back to the control that has it now: to itself, to the one in its place, or next to it.
function heldFocus() {
  const held = /** @type {HTMLInputElement} */ (document.activeElement);
  if (!held || held === document.body) return () => {};
  /** @type {HTMLElement[]} */
  const around = [];
  for (let box = held.parentElement; box && box !== document.body; box = box.parentElement) around.push(box);
  const words = namesOf(held), root = around.find((box) => box.id), place = root && words[0] ? found(root, words[0]).indexOf(held) : 0;
  return () => {
    if (document.activeElement === held && isOpen(held)) return;
    const within = around.find((box) => box.isConnected && controlsIn(box).some(isOpen));
    const same = held.isConnected ? [held] : words.map((word) => inPlace(found(within, word), place));
    const near = within ? controlsIn(within) : [];
    [...same, ...near].find((control) => control && isOpen(control))?.focus({ preventScroll: true });
  };
}

/** @param {Element | undefined} box @param {Known} known @returns {HTMLInputElement[]} */
const found = (box, [name, value, isPart]) =>
  (box ? controlsIn(box) : []).filter((control) => {
    const said = name === "label" ? labelOf(control) : control.dataset[name] ?? "";
    return isPart ? said.startsWith(value) : said === value;
  });

const inPlace = (controls, place) => controls[Math.min(place, controls.length - 1)];
const labelOf = (control) => control.labels?.[0]?.textContent ?? "";

// Returns what a control is known by, the closest first: its name and value, and whether a value that begins so will do.
/** @param {HTMLInputElement} control @returns {Known[]} */
function namesOf(control) {
  /** @type {Known[]} */
  const words = NAMES.filter((name) => control.dataset[name] !== undefined).map((name) => [name, control.dataset[name] ?? "", false]);
  const option = /^--move .+=/.exec(control.dataset.copy ?? "");
  if (option) words.push(["copy", option[0], true]);
  if (!words.length && labelOf(control)) words.push(["label", labelOf(control), false]);
  return words;
}
