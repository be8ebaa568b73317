// @ts-check
// Keys for all that is done often. Letters and digits do not act where text is typed or a list has the focus; undo and
// redo act there, too, but where what is typed was not sent: that is undone by the browser.

const MOTIONS = { 1: "left", 2: "right", 3: "top", 4: "bottom", 5: "pull", 6: "fixed" };

function listenToKeys({ toolbar, inspector, at, leave }) {
  const go = (by) => at.count > 1 && (location.href = `../${(at.number + by + at.count) % at.count}/`);
  const plain = {
    n: () => toolbar.do("next"), a: () => toolbar.do("accept"), r: () => toolbar.do("reject"), o: () => toolbar.do("open"),
    g: () => toolbar.do("join"), s: () => toolbar.do("split"), c: () => toolbar.do("cut"),
    j: () => go(1), k: () => go(-1), Escape: leave,
  };
  document.addEventListener("keydown", (event) => {
    const typing = /** @type {HTMLInputElement} */ (elementOf(event).closest("input:not([type=checkbox]):not([type=range]), select"));
    if (event.altKey || event.defaultPrevented) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (event.ctrlKey || event.metaKey) {
      const name = key === "z" ? (event.shiftKey ? "redo" : "undo") : key === "y" ? "redo" : "";
      if (!name || (typing?.matches("input") && isUnsent(typing))) return;
      toolbar.do(name);
    } else if (typing) {
      return;
    } else if (MOTIONS[key]) {
      const button = controlAt(`[data-motion="${MOTIONS[key]}"]`);
      if (!inspector.part || button.disabled) return;
      inspector.motion(MOTIONS[key]);
    } else if (plain[key]) {
      plain[key]();
    } else {
      return;
    }
    event.preventDefault();
  });
}
