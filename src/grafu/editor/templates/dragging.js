// @ts-check
// The 3D view of a model that is edited: a click opens a front, and one that is chosen is dragged along its joint.

const NEAR = 1e-9; // pixels squared for a full motion: less is a motion along the line of view
const OPENING = 0.45; // seconds
const NEARBY = 6; // pixels that a pointer may miss a handle by: many are three wide

class LiveView extends ModelView {
  constructor(stage, { chosen, moved, movable, room }) {
    super(stage);
    this.told = chosen;
    this.moved = moved;
    this.movable = movable;
    this.roomOf = room;
    this.lasso = new LassoTool(this, this.canvas);
  }

  choose(place) {
    const found = place ? this.renderer.pick(this.camera, this.joints.poses(), this.view, place.x, place.y) : -1;
    this.chooseItem(found);
    if (found >= 0) this.toggle(this.jointOf(found));
  }

  closeAll() {
    this.joints.stop();
    this.joints.joints.forEach((joint, k) => joint.coupling || this.joints.set(k, joint.lower));
    this.redraw();
  }

  chooseItem(index, seen = false) {
    if (this.lasso.active) this.lasso.leave();
    this.view.clashing.clear();
    super.chooseItem(index, seen);
    this.told(this.subject(index));
  }

  jointOf(index) {
    return this.scene.links[this.scene.items[index]?.link]?.joint ?? null;
  }

  // Returns the part that a choice about an item is about: of what moves with a front, or carries it, the front.
  subject(index) {
    const item = this.scene.items[index], joint = this.jointOf(index);
    if (!item) return "";
    if (item.role === "added") return item.name;
    return joint === null ? (item.role === "part" ? item.name : "") : this.scene.joints[joint].part;
  }

  toggle(joint) {
    if (joint === null) return;
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.joints.moveOne(joint, this.joints.fraction(joint) < 0.5, calm ? 0 : OPENING);
    this.redraw();
  }

  // Shows where a part collides first: its joint at that value, what cuts into what in red. Again: as it was before.
  showCollision({ value, others }) {
    const { clashing, chosen } = this.view, joint = this.jointOf(chosen), { link } = this.scene.items[chosen];
    const shown = clashing.size > 0;
    clashing.clear();
    this.joints.stop();
    this.joints.set(joint, shown ? this.joints.joints[joint].lower : value);
    if (!shown) {
      this.scene.items.forEach((item, k) => {
        if (others.includes(item.name) || (item.link === link && item.role === "part")) clashing.add(k);
      });
    }
    this.redraw();
  }

  grab(place) {
    if (this.lasso.active) return this.lasso.grab(place);
    if (this.view.chosen < 0) return null;
    const handle = this.handleNear(place);
    if (handle >= 0) return this.grabHandle(handle, place);
    const index = this.at(place.x, place.y), joint = this.jointOf(index);
    if (index < 0 || this.subject(index) !== this.subject(this.view.chosen)) return null;
    return joint === null ? null : this.grabJoint(index, this.joints.leader(joint), place);
  }

  // Returns the item that is seen at a place, or -1.
  at(x, y) {
    return this.renderer.pick(this.camera, this.joints.poses(), this.view, x, y);
  }

  // Returns the handle at a place, or next to it, that can be moved: it is chosen, or is on the front that is. -1: none.
  handleNear({ x, y }) {
    const aside = NEARBY / this.canvas.clientWidth, up = NEARBY / this.canvas.clientHeight;
    for (const [right, down] of [[0, 0], [-0.5, 0], [0.5, 0], [0, -0.5], [0, 0.5], [-1, 0], [1, 0], [0, -1], [0, 1]]) {
      const index = this.at(x + right * aside, y + down * up), item = this.scene.items[index];
      if (item && this.isOfChosen(index) && this.movable(item.name)) return index;
    }
    return -1;
  }

  // Whether an item is a handle that was added, which is chosen itself, or whose front is.
  isOfChosen(index) {
    const item = this.scene.items[index], chosen = this.subject(this.view.chosen), joint = this.jointOf(index);
    if (item.role !== "added" || item.label !== "handle") return false;
    return item.name === chosen || (joint !== null && this.scene.joints[joint].part === chosen);
  }

  grabJoint(index, joint, start) {
    let last = start;
    return (place) => {
      const along = this.screenMotion(index, joint), length = along[0] ** 2 + along[1] ** 2;
      const by = [place.x - last.x, place.y - last.y];
      last = place;
      if (length < NEAR) return;
      this.joints.stop();
      const { lower, upper } = this.joints.joints[joint];
      const fraction = (by[0] * along[0] + by[1] * along[1]) / length;
      this.joints.set(joint, this.joints.values[joint] + fraction * (upper - lower));
    };
  }

  // Returns how far the middle of an item moves over the picture (fractions of it) for the whole motion of a joint, as
  // it does from where it stands.
  screenMotion(index, joint) {
    const { lower, upper } = this.joints.joints[joint], value = this.joints.values[joint];
    const step = 0.01 * (upper - lower), other = value + step > upper ? value - step : value + step;
    const values = [...this.joints.values];
    const [from, to] = [value, other].map((at) => {
      this.joints.values[joint] = at;
      this.joints.follow(joint);
      return this.onScreen(index);
    });
    this.joints.values = values;
    const sign = other > value ? 100 : -100;
    return [sign * (to[0] - from[0]), sign * (to[1] - from[1])];
  }

  onScreen(index) {
    const item = this.scene.items[index], moved = mapped(this.joints.poses()[item.link], middle(item.box));
    const clip = mapped(this.camera.matrix(), moved);
    return [0.5 + clip[0] / clip[3] / 2, 0.5 - clip[1] / clip[3] / 2];
  }

  // Moves a handle over its closed front, aside (X) and up (Z), and states in the end how far it was moved.
  grabHandle(index, start) {
    const item = this.scene.items[index], pieces = this.renderer.pieces.filter((piece) => piece.item === index);
    const lows = pieces.map((piece) => piece.low);
    const at = this.onScreen(index), clip = (by) => {
      const moved = mapped(this.camera.matrix(), mapped(this.joints.poses()[item.link], add(middle(item.box), by)));
      return [0.5 + moved[0] / moved[3] / 2 - at[0], 0.5 - moved[1] / moved[3] / 2 - at[1]];
    };
    const [ax, ay] = clip([1e-3, 0, 0]), [bx, by] = clip([0, 0, 1e-3]), area = ax * by - ay * bx;
    if (Math.abs(area) < 1e-12) return null;
    let offset = [0, 0];
    const room = this.roomOf(item.name);
    const finish = () => {
      if (offset[0] || offset[1]) this.moved(item.name, offset);
    };
    this.canvas.addEventListener("pointerup", finish, { once: true });
    return (place) => {
      const x = place.x - start.x, y = place.y - start.y;
      offset = [(1e-3 * (x * by - y * bx)) / area, (1e-3 * (ax * y - ay * x)) / area];
      offset = offset.map((by, k) => clamp(by, ...room[k]));
      pieces.forEach((piece, k) => (piece.low = add(lows[k], [offset[0], 0, offset[1]])));
      this.redraw();
    };
  }

  // Takes the place of a build that was shown: what stood open stays open, what was chosen stays chosen.
  replace(scene, images) {
    const before = this.scene && {
      open: new Map(this.joints.joints.map((joint, k) => [joint.part, this.joints.fraction(k)])),
      chosen: this.scene.items[this.view.chosen]?.name,
      switches: ["hardware", "added", "categories"].map((name) => [name, this.view[name]]),
    };
    this.show(scene, images);
    if (!before) return;
    before.switches.forEach(([name, on]) => {
      for (const box of controlsAt(`input[data-switch="${name}"]`)) box.checked = this.view[name] = on;
    });
    this.joints.joints.forEach((joint, k) => {
      if (!joint.coupling && before.open.get(joint.part) > 0) this.joints.setFraction(k, before.open.get(joint.part));
    });
    super.chooseItem(this.itemNamed(before.chosen));
  }
}
