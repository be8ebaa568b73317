// @ts-check
// The page of one model: brings data, picture, gestures and controls together.

const PATIENCE = 3000; // milliseconds: a page that lies behind others is not painted

// Waits until what the page states is seen: then WebGL takes its second or two, in which nothing is painted.
function whenSeen() {
  const painted = new Promise((done) => new PerformanceObserver(done).observe({ type: "paint", buffered: true }));
  return Promise.race([painted, new Promise((done) => setTimeout(done, PATIENCE))]);
}

function goWithout(stage, why) {
  stage.className = "without";
  elementAt("#view-note").textContent =
    `This browser cannot show the model in 3D (${why}): the pictures below show it as it came and open.`;
}

class ModelView {
  /** @type {Joints} */ joints;
  /** @type {OrbitCamera} */ camera;
  /** @type {View} */ view;

  constructor(stage) {
    this.canvas = stage.querySelector("canvas");
    this.label = stage.querySelector(".label");
    this.said = elementAt("#chosen");
    this.renderer = new Renderer(this.canvas);
    this.overlay = new Overlay(stage.querySelector("svg.overlay"));
    this.frames = 0;
    document.addEventListener("click", (event) => {
      const button = /** @type {HTMLElement} */ (elementOf(event).closest("[data-part]"));
      if (button && this.scene) this.chooseItem(this.itemNamed(button.dataset.part), true);
    });
    this.canvas.addEventListener("webglcontextlost", () => goWithout(stage, "the graphics card went away"));
  }

  // Takes a scene in the place of the one before; the camera stays where it was.
  show(scene, images) {
    const isFirst = !this.scene;
    this.scene = scene;
    this.overlay.scene = scene;
    this.renderer.show(scene, images);
    this.controls?.playing(false);
    this.joints = new Joints(scene);
    this.view = Object.assign(new View(scene), { shadow: this.view?.shadow ?? 0.5 });
    this.pointer = null;
    if (isFirst) this.begin();
    this.controls = new Controls(document, this.joints, this.view, {
      changed: () => this.redraw(),
      focused: (joint) => this.focus(joint),
    });
    this.theme();
    this.resize();
  }

  begin() {
    this.camera = new OrbitCamera(this.scene.reach);
    this.gestures = new Gestures(this.canvas, this.camera, {
      changed: () => this.redraw(),
      pointed: (place) => this.point(place),
      clicked: (place) => this.choose(place),
      grabbed: (place) => this.grab(place),
    });
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.theme());
  }

  theme() {
    this.view.shadow = matchMedia("(prefers-color-scheme: dark)").matches ? 0.7 : 0.42;
    this.redraw();
  }

  resize() {
    const fine = Math.min(devicePixelRatio || 1, 2), { clientWidth: w, clientHeight: h } = this.canvas;
    if (!w || !h) return;
    Object.assign(this.canvas, { width: Math.round(w * fine), height: Math.round(h * fine) });
    this.camera.resize(w / h);
    this.draw();
  }

  redraw() {
    if (this.waiting || !this.renderer) return;
    this.waiting = requestAnimationFrame((time) => {
      this.waiting = 0;
      this.tick(time);
    });
  }

  tick(time) {
    const elapsed = this.moving ? Math.min((time - this.moving) / 1000, 0.25) : 0.016;
    const goesOn = this.joints.step(elapsed);
    this.moving = goesOn ? time : 0;
    this.draw();
    if (goesOn) this.redraw();
  }

  draw() {
    const poses = this.joints.poses();
    if (this.pointer) this.hover(this.renderer.pick(this.camera, poses, this.view, this.pointer.x, this.pointer.y));
    this.renderer.draw(this.camera, poses, this.view);
    this.overlay.draw(this.camera, this.view.joint, poses, [this.canvas.clientWidth, this.canvas.clientHeight]);
    this.frames += 1;
  }

  point(place) {
    this.pointer = place;
    if (!place) this.hover(-1);
    this.redraw();
  }

  hover(index) {
    this.view.hovered = index;
    this.label.hidden = index < 0;
    if (index < 0) return;
    this.label.textContent = this.scene.items[index].name;
    const { x, y } = this.pointer, right = x > 0.6;
    this.label.style.left = right ? "auto" : `${100 * x}%`;
    this.label.style.right = right ? `${100 * (1 - x)}%` : "auto";
    this.label.style.top = `${100 * y}%`;
  }

  choose(place) {
    const found = place ? this.renderer.pick(this.camera, this.joints.poses(), this.view, place.x, place.y) : -1;
    this.chooseItem(found === this.view.chosen ? -1 : found);
  }

  // Returns what moves with the pointer from a place on, or nothing: then the camera turns.
  /** @param {{x: number, y: number}} place @returns {((place: {x: number, y: number}) => void) | null} */
  grab(place) {
    return null;
  }

  // Marks an item and states what it is and which joint moves it; its axes are drawn.
  chooseItem(index, seen = false) {
    this.view.chosen = index;
    const item = this.scene.items[index], joint = item ? this.scene.links[item.link].joint : null;
    this.focused = joint;
    this.view.joint = joint;
    this.said.textContent = item ? this.described(item, joint) : this.said.dataset.empty ?? "";
    if (seen) this.canvas.scrollIntoView({ block: "nearest" });
    this.redraw();
  }

  described(item, joint) {
    const kind = item.role === "hardware" ? "hardware" : item.role === "added" ? `${item.label}, added` : item.label;
    const part = joint === null ? "" : this.scene.joints[joint].part, own = part === item.name;
    const moves = joint === null ? "is static" : own ? "has its own joint" : `moves with ${part}`;
    const was = item.source ? ` (“${item.source}” in the input)` : "";
    return `${item.name}${was}: ${kind}, ${moves}`;
  }

  itemNamed(name) {
    return this.scene.items.findIndex((item) => item.name === name);
  }

  focus(joint) {
    this.view.joint = joint ?? this.focused ?? null;
    this.redraw();
  }

  // For tests and for the curious: where a link stands, as 16 numbers, column by column.
  pose(linkId) {
    return this.joints.poses()[this.scene.links.findIndex((link) => link.id === linkId)];
  }
}
