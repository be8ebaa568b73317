// @ts-check
// Mouse, touch and keys on the 3D view. One finger up and down scrolls the page, so that the view never traps the page's scroll.

const STEP = 0.12; // radians a key press
const SLACK = 5; // pixels that a click may move

class Gestures {
  constructor(canvas, camera, { changed, pointed, clicked, grabbed }) {
    this.canvas = canvas;
    this.camera = camera;
    this.changed = changed;
    this.pointed = pointed;
    this.clicked = clicked;
    this.grabbed = grabbed;
    this.pointers = new Map();
    this.moved = 0;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.pointers.delete(event.pointerId));
    canvas.addEventListener("pointerleave", () => this.pointers.size || this.pointed(null));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("dblclick", () => this.after(() => camera.reset()));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  after(action) {
    action();
    this.changed();
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height };
  }

  down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.pointers.size !== 1) return;
    this.moved = 0;
    this.drag = event.button === 0 && !event.shiftKey ? this.grabbed(this.place(event)) : null;
  }

  move(event) {
    const held = this.pointers.get(event.pointerId);
    if (!held) {
      if (event.pointerType !== "touch") this.pointed(this.place(event));
      return;
    }
    const before = this.spread(), dx = event.clientX - held.x, dy = event.clientY - held.y;
    this.moved += Math.abs(dx) + Math.abs(dy);
    Object.assign(held, { x: event.clientX, y: event.clientY });
    const height = this.canvas.clientHeight;
    if (this.pointers.size > 1) {
      this.camera.pan(dx / height / 2, dy / height / 2);
      if (before > 0 && this.spread() > 0) this.camera.zoom(before / this.spread());
    } else if (event.buttons & 6 || event.shiftKey) {
      this.camera.pan(dx / height, dy / height);
    } else if (this.drag) {
      if (this.moved >= SLACK) this.drag(this.place(event));
    } else {
      this.camera.orbit((dx / height) * 4, (dy / height) * 4);
    }
    this.changed();
  }

  up(event) {
    const alone = this.pointers.size === 1;
    this.pointers.delete(event.pointerId);
    if (alone && this.moved < SLACK) this.clicked(this.place(event));
    if (alone) this.drag = null;
  }

  // Returns how far two fingers are apart.
  spread() {
    const [a, b] = [...this.pointers.values()];
    return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  }

  // The wheel scrolls the page until the view has the focus.
  wheel(event) {
    if (!event.ctrlKey && document.activeElement !== this.canvas) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    this.after(() => this.camera.zoom(Math.exp(clamp(event.deltaY * lines, -240, 240) * 0.0016)));
  }

  key(event) {
    const { camera } = this, side = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const actions = {
      "+": () => camera.zoom(0.88), "=": () => camera.zoom(0.88), "-": () => camera.zoom(1 / 0.88),
      Home: () => camera.reset(), 0: () => camera.reset(), Escape: () => this.clicked(null),
    };
    const direction = side[event.key];
    const action = direction
      ? () => (event.shiftKey ? camera.pan(0.05 * direction[0], -0.05 * direction[1]) : camera.orbit(-STEP * direction[0], -STEP * direction[1]))
      : actions[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.after(action);
  }
}
