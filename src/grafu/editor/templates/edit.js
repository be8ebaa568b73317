// @ts-check
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
      room: (handle) => this.roomOf(handle),
    });
    this.inspector = new Inspector({
      choose: (question, part, value) => this.choose(question, part, value),
      picked: (part) => this.pick(part),
      at: this.at,
    });
    this.toolbar = new Toolbar({
      undo: () => this.server.act("undo"), redo: () => this.server.act("redo"), anew: () => this.server.act("anew"),
      stop: () => this.server.act("stop"), export: () => this.server.act("export"), next: () => this.next(),
      join: () => this.join(), split: () => this.about("split"), cut: () => this.cut(),
      accept: () => this.about("accept"), reject: () => this.about("reject"),
      collision: () => this.view.showCollision(this.state.collisions[this.inspector.part]),
      automatic: () => this.about("motion"), open: () => this.view.toggle(this.view.jointOf(this.view.view.chosen)),
    });
    this.server = new Server({ told: (status) => this.hear(status), failed: (why) => this.fail(why) });
    this.shown = this.version = 0;
    listenToKeys({ toolbar: this.toolbar, inspector: this.inspector, at: this.at, leave: () => this.pick("") });
    document.addEventListener("click", (event) => this.apply(elementOf(event).closest("[data-copy]")));
  }

  async hear(status) {
    this.latest = status.build && status.version;
    const giveBack = heldFocus();
    this.toolbar.show(status);
    giveBack();
    this.building = Boolean(status.stage);
    if (status.error && !status.build) this.stage.className = "failed"; // there is nothing to show: the toolbar states why
    if (!this.fetching) await this.catchUp();
  }

  // Shows the last build, and what was learned of it later; what comes meanwhile is shown next.
  async catchUp() {
    this.fetching = true;
    while (this.latest > this.version) {
      const shown = await this.learn().catch(() => false);
      if (!shown) await new Promise((done) => setTimeout(done, AGAIN)); // it was built anew meanwhile, or the server is gone
    }
    this.fetching = false;
  }

  async learn() {
    const state = await this.server.state(), isNew = state.build !== this.shown;
    const built = isNew ? await this.server.sceneOf(state) : null;
    this.show(state, built);
    return true;
  }

  // Shows a state; `built` is its scene where that is another one than before.
  show(state, built) {
    const giveBack = heldFocus();
    this.state = state;
    elementAt("#model-header").innerHTML = state.markup.header;
    elementAt("#sections").innerHTML = state.markup.sections;
    if (built) {
      elementAt("#joint-panel").innerHTML = state.markup.panel;
      this.view.replace(built.scene, built.images);
    }
    this.inspector.show(state);
    this.toolbar.doubtful(this.inspector.doubtful(), state.report.verdict.least_confidence);
    this.stage.className = "ready";
    this.shown = state.build;
    this.version = state.version;
    giveBack();
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
    this.view.lasso.begin(part, (lasso) => {
      this.choose("cut", part, { ...lasso, through: controlAt("#through").checked });
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
    const front = this.frontOf(handle), [x, y] = this.offsetOn(front);
    this.choose("handle offset", front, [x + aside, y + up]);
  }

  // Whether a handle is on a front that stands upright and looks to the front: there X is aside and Z is up.
  isOnUprightFront(handle) {
    return this.state.upright.includes(this.frontOf(handle));
  }

  // Returns how far a handle can be moved from where it is: aside and up, the least and the most, metres.
  roomOf(handle) {
    const front = this.frontOf(handle), offset = this.offsetOn(front);
    return this.state.rooms[front].map((range, k) => range.map((by) => by - offset[k]));
  }

  frontOf(handle) {
    return this.state.report.added.find((one) => one.part === handle)?.link;
  }

  offsetOn(front) {
    return this.state.settings.additions.fronts[front]?.offset ?? [0, 0];
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
  const stage = elementAt("#stage");
  performance.mark("view");
  try {
    Object.assign(window, { grafuEditor: new Editor(stage) });
  } catch (error) {
    goWithout(stage, error.message || error);
  }
}

whenSeen().then(startEditor);
