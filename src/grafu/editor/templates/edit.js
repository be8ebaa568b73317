// The page of a model that is edited: brings the view, the choices, the toolbar and the server together.

const AGAIN = 500; // milliseconds until it is asked again

class Editor {
  constructor(stage) {
    this.stage = stage;
    this.at = readJson("editor");
    this.view = new LiveView(stage, {
      chosen: (part) => this.inspector.choosePart(part),
      moved: (handle, by) => this.moveHandle(handle, by),
      movable: (handle) => this.isOnUprightFront(handle),
    });
    this.inspector = new Inspector({
      choose: (question, part, value) => this.choose(question, part, value),
      picked: (part) => this.pick(part),
    });
    Object.assign(this.inspector, { hinges: this.at.hinges, rails: this.at.rails });
    this.toolbar = new Toolbar({
      undo: () => this.server.act("undo"), redo: () => this.server.act("redo"), anew: () => this.server.act("anew"),
      stop: () => this.server.act("stop"), export: () => this.server.act("export"), next: () => this.next(),
      join: () => this.join(), split: () => this.about("split"), cut: () => this.cut(),
      accept: () => this.about("accept"), reject: () => this.about("reject"),
      collision: () => this.view.showCollision(this.state.collisions[this.inspector.part]),
      automatic: () => this.about("motion"), open: () => this.view.toggle(this.view.jointOf(this.view.view.chosen)),
    });
    this.server = new Server({ told: (status) => this.hear(status), failed: (why) => this.fail(why) });
    this.shown = 0;
    listenToKeys({ toolbar: this.toolbar, inspector: this.inspector, at: this.at, leave: () => this.pick("") });
    document.addEventListener("click", ({ target }) => this.apply(target.closest("[data-copy]")));
  }

  async hear(status) {
    this.latest = status.build;
    this.toolbar.show(status);
    this.building = Boolean(status.stage);
    if (!this.fetching) await this.catchUp();
  }

  // Shows the last build; one that comes meanwhile is shown next.
  async catchUp() {
    this.fetching = true;
    while (this.latest !== this.shown) {
      const built = await this.server.built().catch(() => null);
      if (built) this.show(built);
      else await new Promise((done) => setTimeout(done, AGAIN)); // it was built anew meanwhile, or the server is gone
    }
    this.fetching = false;
  }

  show({ state, scene, images }) {
    this.state = state;
    this.shown = state.build;
    document.getElementById("model-header").innerHTML = state.markup.header;
    document.getElementById("joint-panel").innerHTML = state.markup.panel;
    document.getElementById("sections").innerHTML = state.markup.sections;
    this.inspector.show(state);
    this.toolbar.doubtful(this.inspector.doubtful(), state.report.verdict.least_confidence);
    this.view.replace(scene, images);
    this.stage.className = "ready";
  }

  choose(question, part, value) {
    return this.server.choose(question, part, value).then((done) => {
      if (!done) this.inspector.choosePart(this.inspector.part); // shows again what holds
    });
  }

  about(question) {
    if (this.inspector.part) this.choose(question, this.inspector.part, null);
  }

  // Joins the part with the one that was chosen before it, which it becomes a piece of.
  join() {
    const { before, part } = this.inspector;
    if (before && part) this.choose("join", before, part).then(() => this.pick(before));
  }

  // Cuts what the next lasso encloses out of the part; what lies behind it, too, where that is wanted.
  cut() {
    const { part } = this.inspector;
    if (!part) return;
    document.getElementById("chosen").textContent = `Draw a lasso around what is to be cut out of ${part}. Esc leaves.`;
    this.view.lasso.begin((lasso) => {
      this.choose("cut", part, { ...lasso, through: document.getElementById("through").checked });
    });
  }

  pick(part) {
    this.view.chooseItem(this.view.itemNamed(part));
    this.inspector.choosePart(part);
  }

  next() {
    const parts = this.inspector.doubtful().map(([part]) => part);
    if (parts.length) this.pick(parts[(parts.indexOf(this.inspector.part) + 1) % parts.length]);
  }

  moveHandle(handle, [aside, up]) {
    const { report, settings } = this.state, { link } = report.added.find((one) => one.part === handle);
    const [x, y] = settings.additions.fronts[link]?.offset ?? [0, 0];
    this.choose("handle offset", link, [x + aside, y + up]);
  }

  // Whether a handle is on a front that stands upright and looks to the front: there X is aside and Z is up.
  isOnUprightFront(handle) {
    const sides = this.state.sides[this.state.report.added.find((one) => one.part === handle)?.link] ?? [];
    return ["left", "right", "top", "bottom"].every((side) => sides.includes(side));
  }

  // Applies an option that the tables name, such as `--move door_1=left`.
  apply(button) {
    const found = button && /^--move (.+)=([a-z-]+)$/.exec(button.dataset.copy);
    if (found) this.choose("motion", found[1], found[2]);
  }

  fail(why) {
    this.toolbar.fail(why);
  }
}

function startEditor() {
  const stage = document.getElementById("stage");
  try {
    window.grafuEditor = new Editor(stage);
  } catch (error) {
    goWithout(stage, error.message || error);
  }
}

startEditor();
