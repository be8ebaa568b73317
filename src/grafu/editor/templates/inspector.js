// @ts-check
// What can be chosen about one part, and about the whole piece: it shows what holds, and tells what the user chooses.

const DEGREES = 180 / Math.PI;
const CENTIMETRES = 100;
const tenths = (value, round = Math.round) => round(10 * value) / 10;

class Inspector {
  constructor({ choose, picked, at }) {
    this.choose = choose;
    this.hinges = at.hinges;
    this.rails = at.rails;
    this.limits = at.limits;
    this.part = this.before = "";
    this.pick = /** @type {HTMLSelectElement} */ (elementAt("#pick"));
    this.about = elementAt("#about-part");
    this.pick.addEventListener("change", () => picked(this.pick.value));
    controlsAt("[data-motion]").forEach((button) =>
      button.addEventListener("click", () => this.motion(button.dataset.motion)));
    controlsAt("[data-handle]").forEach((button) =>
      button.addEventListener("click", () => this.handle(button.dataset.handle)));
    controlsAt("[data-choice]").forEach((field) =>
      field.addEventListener("change", () => this.answer(field)));
    controlsAt("[data-offset]").forEach((field) =>
      field.addEventListener("change", () => this.place()));
    elementAt("#shelves-fields").addEventListener("change", (event) => {
      const field = /** @type {HTMLInputElement} */ (event.target);
      if (mayBeSent(field)) choose("shelves", field.dataset.shelves, entered(field));
    });
    elementAt("#left-out").addEventListener("click", (event) => {
      const { restore } = elementOf(event).dataset;
      if (restore) choose("restore", restore, true);
    });
  }

  show(state) {
    this.state = state;
    const { report, settings } = state;
    const moving = report.joints.map((joint) => joint.part);
    const still = report.parts.map((part) => part.id).filter((part) => !moving.includes(part));
    const groups = { "Moving parts": moving, "Other parts": still, "Added parts": report.added.map((one) => one.part).filter((part) => !(part in state.sides)) };
    const options = Object.entries(groups).filter(([, parts]) => parts.length).map(([label, parts]) => {
      const group = Object.assign(document.createElement("optgroup"), { label });
      group.append(...[...new Set(parts)].map((part) => new Option(part, part)));
      return group;
    });
    this.pick.replaceChildren(new Option("choose a part", ""), ...options);
    this.showWhole(settings);
    this.choosePart(this.part);
  }

  choosePart(part) {
    const options = [...this.pick.options].map((option) => option.value), known = options.includes(part);
    if (this.part && this.part !== part) this.before = this.part;
    this.part = known ? part : "";
    if (!options.includes(this.before) || this.before === this.part || !(this.before in this.state.sides)) this.before = "";
    this.pick.value = this.part;
    this.about.hidden = !this.part;
    if (this.part) this.showPart();
  }

  get joint() {
    return this.state.report.joints.find((joint) => joint.part === this.part);
  }

  get slides() {
    return this.state.sliding.includes(this.part);
  }

  get isAdded() {
    return !(this.part in this.state.sides);
  }

  showPart() {
    const { settings, sides, report } = this.state, { part, joint } = this;
    elementAt("#certainty").textContent = this.said();
    const word = this.word();
    controlsAt("[data-motion]").forEach((button) => {
      const side = button.dataset.motion ?? "";
      const borders = ["left", "right", "top", "bottom", "front", "back"];
      button.setAttribute("aria-pressed", String(side === word));
      button.disabled = this.isAdded || (borders.includes(side) && !sides[part].includes(side));
    });
    for (const name of ["accept", "automatic", "open"]) {
      controlAt(`[data-do="${name}"]`).disabled = this.isAdded || (name === "open" && !joint);
    }
    const join = controlAt('[data-do="join"]');
    join.disabled = this.isAdded || !this.before;
    join.textContent = this.before ? `Join with ${this.before}` : "Join with the part before";
    for (const name of ["split", "cut"]) controlAt(`[data-do="${name}"]`).disabled = this.isAdded;
    controlAt('[data-do="collision"]').hidden = !this.state.collisions[part];
    const choice = settings.joints[part] ?? {}, slides = this.slides;
    const unit = slides ? "cm" : "degrees", factor = slides ? CENTIMETRES : DEGREES;
    const opening = this.field("opening");
    limit(opening, this.limits[slides ? "slide" : "turn"], slides ? "centimetres" : "degrees");
    put(opening, choice.opening ? String(tenths(choice.opening * factor)) : "", part);
    opening.placeholder = joint ? String(tenths(joint.upper * factor)) : "automatic";
    elementAt("#unit").textContent = unit;
    this.field("template").replaceChildren(
      new Option(joint ? `automatic (${joint.template})` : "automatic", ""),
      ...(slides ? this.rails : this.hinges).map((id) => new Option(id, id)));
    this.field("template").value = choice.template ?? "";
    const style = settings.additions.fronts[part]?.style ?? "";
    this.field("handle").value = style;
    controlsAt("[data-handle]").forEach((button) => {
      button.disabled = !joint;
      button.setAttribute("aria-pressed", String(button.dataset.handle === style));
    });
    this.field("label").value = settings.labels[part] ?? "";
    ["opening", "template", "handle"].forEach((name) => (this.field(name).disabled = !joint));
    this.field("label").disabled = this.isAdded;
    const room = this.state.rooms[part];
    elementAt("#offset-fields").hidden = !room;
    if (room) this.showPlace(room, settings.additions.fronts[part]?.offset ?? [0, 0]);
    this.showShelves();
  }

  // Shows how far the handle is moved aside and up, metres; no field takes it beyond its front.
  showPlace(room, offset) {
    room.forEach(([least, most], k) => {
      const [low, high] = [[least, Math.ceil], [most, Math.floor]].map(([by, round]) => tenths(CENTIMETRES * by, round));
      limit(this.offsets[k], [Math.min(low, high), Math.max(low, high)], "centimetres: farther, it is not on its front");
      put(this.offsets[k], String(tenths(CENTIMETRES * offset[k])), this.part);
    });
  }

  get offsets() {
    return controlsAt("[data-offset]");
  }

  // Shows a field for each compartment that the part stands before, the lowest first.
  showShelves() {
    const { compartments, settings } = this.state, box = elementAt("#shelves-fields");
    const numbers = [...compartments.keys()].filter((k) => compartments[k].behind.includes(this.part));
    const floor = (k) => Math.min(...compartments[k].corners.map((corner) => corner[2]));
    numbers.sort((a, b) => floor(a) - floor(b));
    const about = [this.part, ...numbers].join(" ");
    if (box.dataset.about !== about) {
      box.dataset.about = about;
      box.replaceChildren(...numbers.map((number, k) => this.shelvesField(number, k, numbers.length)));
    }
    for (const number of numbers) {
      const chosen = settings.additions.compartments[number], { shelves, why } = compartments[number];
      put(box.querySelector(`[data-shelves="${number}"]`), String(chosen?.shelves ?? ""), about);
      const built = chosen && shelves < chosen.shelves ? `${shelves} of ${chosen.shelves} built${why ? `: ${why}` : ""}` : "";
      Object.assign(elementAt(`#built-${number}`), { textContent: built, hidden: !built });
    }
  }

  shelvesField(number, k, count) {
    const which = count > 1 ? `, compartment ${k + 1} of ${count} from below` : "";
    const row = document.createElement("div"), label = document.createElement("label");
    const field = Object.assign(document.createElement("input"), { type: "number", step: "1", autocomplete: "off" });
    const line = Object.assign(document.createElement("p"), { id: `built-${number}`, className: "fewer", hidden: true });
    limit(field, this.limits.shelves, "");
    field.dataset.shelves = String(number);
    line.setAttribute("role", "status");
    label.append(`Shelves behind it${which} (empty: automatic) `, field);
    row.append(label, line);
    return row;
  }

  showWhole(settings) {
    const { additions } = settings, { top, handles, grips } = additions;
    this.field("top").value = !top ? "none" : top.shape === "rectangle" ? "" : top.shape;
    this.field("hinge").value = settings.hinge;
    this.field("handles").value = !handles && !grips ? "none" : handles?.style ?? "";
    const added = this.state.report.added.map((one) => one.part);
    const buttons = additions.rejected.filter((part) => !added.includes(part)).map((part) => {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: `Restore ${part}` });
      button.dataset.restore = part;
      return button;
    });
    elementAt("#left-out").replaceChildren(...buttons);
  }

  field(name) {
    return controlAt(`[data-choice="${name}"]`);
  }

  // Returns the word for how the part moves: as chosen, else as built.
  word() {
    const chosen = this.state.settings.words.find(([part, question]) => part === this.part && question === "motion");
    if (chosen) return chosen[2];
    const built = this.state.motions[this.part];
    if (!this.joint || !built) return this.joint || this.isAdded ? "" : "fixed";
    const { moves, side } = built;
    if (moves === "turns") return side;
    if (moves === "slides") return ["left", "right", "top"].includes(side) ? `slide-${side === "top" ? "up" : side}` : "pull";
    return { folds: `fold-${side === "top" ? "up" : side}`, lifts: "lift-parallel", tilts: "tilt" }[moves] ?? "";
  }

  // Returns in words what the part is, and the confidence of its motion.
  said() {
    const { report, settings } = this.state;
    const added = report.added.find((one) => one.part === this.part);
    if (this.isAdded) return `${this.part}: ${added ? added.category : "added"}, added. Reject leaves it out.`;
    const category = report.parts.find((one) => one.id === this.part)?.category ?? "";
    const guesses = report.guesses.filter((guess) => guess.part === this.part && guess.question !== "label");
    const skipped = report.skipped.find((skip) => skip.request === this.part);
    const sure = this.part in settings.motions ? ["decided by hand"] : guesses.map((guess) => {
      const second = guess.runner_up ? ` (${guess.runner_up} ${Math.round(100 * guess.runner_up_score)} %)` : "";
      return `${guess.choice} ${Math.round(100 * guess.score)} %${second}`;
    });
    const static_ = this.joint ? [] : [skipped ? skipped.detail : "does not move"];
    return `${this.part}: ${[category, ...static_, ...sure].join("; ")}`;
  }

  motion(word) {
    if (this.part && word !== this.word()) this.choose("motion", this.part, word);
  }

  // Chooses a handle; the one that was chosen before is automatic again.
  handle(style) {
    if (this.part) this.choose("handle", this.part, this.field("handle").value === style ? null : style);
  }

  // Moves the handle to where both fields state, centimetres.
  place() {
    const may = this.offsets.map(mayBeSent);
    const offset = this.offsets.map((field) => (entered(field) ?? 0) / CENTIMETRES);
    if (may.every(Boolean)) this.choose("handle offset", this.part, offset.some(Boolean) ? offset : null);
  }

  answer(field) {
    const name = field.dataset.choice, text = field.value.trim();
    if (["top", "hinge", "handles"].includes(name)) this.choose(name, "", text || null);
    else if (name !== "opening") this.choose(name, this.part, text || null);
    else if (mayBeSent(field)) this.choose(this.slides ? "slide" : "turn", this.part, entered(field));
  }

  // Returns the parts whose motion was guessed and is not decided, each with its confidence, the least first.
  doubtful() {
    const { report, settings } = this.state, least = new Map();
    for (const { part, score } of report.guesses) {
      if (!(part in settings.motions) && !(part in settings.labels)) least.set(part, Math.min(score, least.get(part) ?? 1));
    }
    return [...least].sort((a, b) => a[1] - b[1]);
  }
}
