// @ts-check
// The wall of models: a word and colours filter it, j and k go through what is shown.

const cards = /** @type {HTMLElement[]} */ ([...document.querySelectorAll("#wall > li")]);
const box = controlAt("#filter");
const colours = controlsAt("button[data-colour]");

function filterWall() {
  const word = box.value.trim().toLowerCase();
  const pressed = colours.filter((one) => one.getAttribute("aria-pressed") === "true").map((one) => one.dataset.colour);
  cards.forEach((card) => {
    const { words = "", colour } = card.dataset;
    card.hidden = !words.includes(word) || (pressed.length > 0 && !pressed.includes(colour));
  });
  elementAt("#found").textContent = `${cards.filter((card) => !card.hidden).length} of ${cards.length} models`;
}

box.addEventListener("input", filterWall);
colours.forEach((button) =>
  button.addEventListener("click", () => {
    button.setAttribute("aria-pressed", String(button.getAttribute("aria-pressed") !== "true"));
    filterWall();
  }));
document.addEventListener("keydown", (event) => {
  const by = { j: 1, k: -1 }[event.key];
  if (!by || event.ctrlKey || event.metaKey || event.altKey || event.target === box) return;
  const shown = cards.filter((card) => !card.hidden).map((card) => card.querySelector("a"));
  const at = shown.findIndex((link) => link === document.activeElement);
  shown[at < 0 ? (by > 0 ? 0 : shown.length - 1) : Math.min(Math.max(at + by, 0), shown.length - 1)]?.focus();
  event.preventDefault();
});
filterWall();
