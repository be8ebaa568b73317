// @ts-check
// Buttons that copy their line, for the command that made the page. They need no 3D view.

const SAID = 1500; // milliseconds for which a button states that it copied

document.addEventListener("click", async (event) => {
  const button = elementOf(event).closest("[data-copy]");
  if (!button || !(await copied(button))) return;
  button.toggleAttribute("data-copied", true);
  setTimeout(() => button.toggleAttribute("data-copied", false), SAID);
});

async function copied(button) {
  try {
    await navigator.clipboard.writeText(button.dataset.copy);
    return true;
  } catch {
    getSelection()?.selectAllChildren(button); // a page from a disk may not reach the clipboard in every browser
    return document.execCommand("copy");
  }
}
