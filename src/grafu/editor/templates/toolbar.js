// @ts-check
// The buttons above the view and the lines below them: what is being built, what went wrong, what was exported.

class Toolbar {
  constructor(actions) {
    this.actions = actions;
    this.progress = elementAt("#progress");
    this.fault = elementAt("#fault");
    controlsAt("[data-do]").forEach((button) =>
      button.addEventListener("click", () => this.do(button.dataset.do)));
  }

  button(name) {
    return controlAt(`[data-do="${name}"]`);
  }

  do(name) {
    if (!this.button(name).disabled && !this.button(name).hidden) this.actions[name]();
  }

  // Shows how things are.
  show({ stage, error, exported, undo, redo, build, seconds }) {
    const busy = Boolean(stage);
    this.button("undo").disabled = !undo;
    this.button("redo").disabled = !redo;
    this.button("anew").disabled = !build && !error;
    this.button("export").disabled = !build;
    this.button("stop").hidden = !busy || stage === "judge"; // which gives way to every choice
    elementAt("#bar").hidden = !busy;
    document.body.toggleAttribute("data-busy", busy);
    if (busy) this.progress.textContent = `${STAGES[stage] ?? stage} ...`;
    else if (exported) this.progress.textContent = exportedWords(exported);
    else this.progress.textContent = build ? `built in ${seconds.toFixed(2)} s; every choice is saved` : "";
    this.fail(error);
  }

  fail(why) {
    this.fault.hidden = !why;
    this.fault.textContent = why;
  }

  // Counts the guesses that are not decided, those below a confidence as doubtful.
  doubtful(guesses, least) {
    const count = guesses.filter(([, score]) => score < least).length;
    this.button("next").disabled = !guesses.length;
    this.button("next").textContent = count || !guesses.length ? `Next doubtful joint (${count})` : "Next joint to check";
  }
}

function exportedWords({ folder, formats, "left out": leftOut }) {
  const left = Object.keys(leftOut);
  const without = left.length ? `; without ${left.join(", ")}: more must be installed for ${left.length > 1 ? "them" : "it"}` : "";
  return `exported to ${folder}: ${formats.join(", ")}${without}`;
}
