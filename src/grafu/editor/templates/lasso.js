// @ts-check
// A lasso that is drawn over the view around what is to be a part of its own: the next drag draws it, or the keyboard
// sets its corners one by one.

const LEAST = 0.004; // of the picture: two corners are farther apart
const FEWEST = 3; // corners
const MOST = 200; // corners that are stated: of more, every other one, and so on
const STRIDE = 0.02; // of the picture: what an arrow moves the cursor by; with Shift a fifth
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

const drawn = (name) => document.createElementNS("http://www.w3.org/2000/svg", name);

class LassoTool {
  constructor(view, canvas) {
    this.view = view;
    this.canvas = canvas;
    this.svg = drawn("svg");
    this.shape = drawn("polygon");
    this.mark = drawn("path");
    this.mark.setAttribute("class", "cursor");
    this.svg.setAttribute("class", "overlay lasso");
    this.svg.setAttribute("aria-hidden", "true");
    this.svg.append(this.shape, this.mark);
    this.said = elementAt("#chosen");
    this.corners = [];
    this.cursor = { x: 0.5, y: 0.5 };
    canvas.after(this.svg);
    canvas.addEventListener("keydown", (event) => this.active && this.key(event));
    this.leave();
  }

  get active() {
    return Boolean(this.done);
  }

  // Waits for a lasso around something of a part; `done` gets it: the eye and the corners, metres, in the frame of the model.
  begin(part, done) {
    this.view.closeAll();
    this.done = done;
    this.canvas.classList.add("drawing");
    this.canvas.focus();
    const [x, y] = this.view.onScreen(this.view.itemNamed(part));
    this.cursor = { x: clamp(x, 0, 1), y: clamp(y, 0, 1) };
    this.corners = [];
    this.show();
    this.said.textContent =
      `Draw a lasso around what is to be cut out of ${part}. By keys: the arrows move the cursor (with Shift by little), ` +
      "Enter sets a corner, Enter again at the same place closes the lasso, Backspace takes a corner back, Esc leaves.";
  }

  leave() {
    this.done = null;
    this.canvas.classList.remove("drawing");
    this.shape.setAttribute("points", "");
    this.mark.setAttribute("d", "");
  }

  // Returns what draws the lasso while the pointer moves.
  grab(start) {
    const places = [start];
    this.mark.setAttribute("d", "");
    this.canvas.addEventListener("pointerup", () => this.close(places), { once: true });
    return (place) => {
      const last = places[places.length - 1];
      if (Math.hypot(place.x - last.x, place.y - last.y) < LEAST) return;
      places.push(place);
      this.outline(places);
    };
  }

  key(event) {
    const by = ARROWS[event.key], acts = { Enter: () => this.enter(), Backspace: () => this.back(), Escape: () => this.escape() };
    if (event.ctrlKey || event.metaKey || event.altKey || !(by || acts[event.key])) return;
    event.preventDefault();
    event.stopImmediatePropagation(); // it turns no camera and chooses no part
    if (by) this.walk(by, event.shiftKey ? STRIDE / 5 : STRIDE);
    else acts[event.key]();
  }

  walk([aside, down], stride) {
    const { clientWidth: w, clientHeight: h } = this.canvas, { x, y } = this.cursor;
    this.cursor = { x: clamp(x + (aside * stride * h) / w, 0, 1), y: clamp(y + down * stride, 0, 1) };
    this.show();
    this.said.textContent = `${this.where()}.`;
  }

  // Sets a corner where the cursor is; a second time at the same place, or at the first corner, closes the lasso.
  enter() {
    const near = (corner) => corner && Math.hypot(corner.x - this.cursor.x, corner.y - this.cursor.y) < LEAST;
    const again = near(this.corners.at(-1)), closes = again || near(this.corners[0]);
    if (closes && this.corners.length >= FEWEST) {
      this.said.textContent = `Lasso of ${this.corners.length} corners closed.`;
      this.close(this.corners);
      return;
    }
    if (!again) this.corners.push(this.cursor);
    this.show();
    const more = FEWEST - this.corners.length;
    this.said.textContent = `${this.counted()} set ${this.where()}${more > 0 ? `; ${more} more at least` : "; Enter again closes the lasso"}.`;
  }

  back() {
    this.corners.pop();
    this.show();
    this.said.textContent = `Taken back: ${this.counted()} left.`;
  }

  escape() {
    this.leave();
    this.said.textContent = "Left without a cut.";
  }

  counted() {
    return `${this.corners.length} corner${this.corners.length === 1 ? "" : "s"}`;
  }

  // Returns in words where the cursor is, and on what.
  where() {
    const { x, y } = this.cursor, item = this.view.scene.items[this.view.at(x, y)];
    return `${Math.round(100 * x)} % from the left, ${Math.round(100 * y)} % from the top, on ${item ? item.name : "nothing"}`;
  }

  show() {
    const { clientWidth: w, clientHeight: h } = this.canvas, x = this.cursor.x * w, y = this.cursor.y * h;
    this.outline([...this.corners, this.cursor]);
    this.mark.setAttribute("d", `M${x - 9} ${y}h18M${x} ${y - 9}v18`);
  }

  outline(places) {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    this.shape.setAttribute("points", places.map(({ x, y }) => `${(x * w).toFixed(1)},${(y * h).toFixed(1)}`).join(" "));
  }

  close(places) {
    const done = this.done;
    this.leave();
    const each = Math.ceil(places.length / MOST), kept = places.filter((_, k) => k % each === 0);
    if (kept.length >= FEWEST) done({ eye: this.view.camera.eye, corners: kept.map((place) => this.corner(place)) });
  }

  // Returns the point of the picture's plane, through the middle of the view, that a place shows.
  corner({ x, y }) {
    const { camera } = this.view, { right, up, forward } = camera.axes(), half = camera.distance * Math.tan(FOV / 2);
    const aside = times(right, (2 * x - 1) * half * camera.aspect), above = times(up, (1 - 2 * y) * half);
    return add(add(camera.eye, times(forward, camera.distance)), add(aside, above));
  }
}
