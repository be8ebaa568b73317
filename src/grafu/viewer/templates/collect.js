// @ts-check
// Collects the options that are chosen on a page from a disk: one settings.json, and one command that uses it.

const collecting = readJson("collecting");
const collectedMoves = new Map();

// Returns a word as a shell takes it.
const quoted = (word) => (/^[\w./:@%+=-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

// Returns the folder of all results: two above this page; where the page does not lie on a disk, its usual name.
function resultsFolder() {
  if (location.protocol !== "file:") return "results";
  const steps = decodeURIComponent(location.pathname).split("/").slice(0, -2).join("/");
  return steps.replace(/^\/([A-Za-z]:)/, "$1") || "/";
}

function collectedSettings() {
  const motions = { ...collecting.settings.motions };
  collectedMoves.forEach((word, part) => (motions[part] = collecting.words[word]));
  return { ...collecting.settings, motions };
}

function showCollected() {
  const command = ["grafu", "functionalize", collecting.input, "--settings", "settings.json", "--out", resultsFolder(), "--overwrite"];
  if (collecting.name) command.push("--name", collecting.name);
  if (collecting.formats.length) command.push("--formats", collecting.formats.join(","));
  const button = elementAt("#collected-command");
  button.textContent = button.dataset.copy = command.map(quoted).join(" ");
  elementAt("#collected").hidden = !collectedMoves.size;
  elementAt("#collected-said").textContent = [...collectedMoves].map(([part, word]) => `${part}: ${word}`).join(", ");
  document.querySelectorAll("[data-copy]").forEach((one) => {
    const found = moveOf(one);
    if (found) one.setAttribute("aria-pressed", String(collectedMoves.get(found[1]) === found[2]));
  });
}

function moveOf(button) {
  const found = /^--move (.+)=([a-z-]+)$/.exec(button?.dataset.copy ?? "");
  return found && collecting.words[found[2]] ? found : null;
}

document.addEventListener("click", (event) => {
  const found = moveOf(elementOf(event).closest("[data-copy]"));
  if (!found) return;
  event.stopPropagation(); // it is chosen, not copied alone
  if (collectedMoves.get(found[1]) === found[2]) collectedMoves.delete(found[1]);
  else collectedMoves.set(found[1], found[2]);
  showCollected();
}, true);

elementAt("#collected-save").addEventListener("click", () => {
  const file = new Blob([JSON.stringify(collectedSettings(), null, 1)], { type: "application/json" });
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(file), download: "settings.json" });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
});
showCollected();
