// Keys for all that is done often; none of them acts while text is typed or a list is open.

const MOTIONS = { 1: "left", 2: "right", 3: "top", 4: "bottom", 5: "pull", 6: "fixed" };

function listenToKeys({ toolbar, inspector, at, leave }) {
  const go = (by) => at.count > 1 && (location.href = `../${(at.number + by + at.count) % at.count}/`);
  const plain = {
    n: () => toolbar.do("next"), a: () => toolbar.do("accept"), r: () => toolbar.do("reject"), o: () => toolbar.do("open"),
    g: () => toolbar.do("join"), s: () => toolbar.do("split"), c: () => toolbar.do("cut"),
    j: () => go(1), k: () => go(-1), Escape: leave,
  };
  document.addEventListener("keydown", (event) => {
    const typing = event.target.closest("input:not([type=checkbox]):not([type=range]), select, textarea");
    if (event.altKey || event.defaultPrevented || typing) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (event.ctrlKey || event.metaKey) {
      const name = key === "z" ? (event.shiftKey ? "redo" : "undo") : key === "y" ? "redo" : "";
      if (!name) return;
      toolbar.do(name);
    } else if (MOTIONS[key]) {
      const button = document.querySelector(`[data-motion="${MOTIONS[key]}"]`);
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
