// A lasso that is drawn over the view around what is to be a part of its own: the next drag draws it.

const LEAST = 0.004; // of the picture: two corners are farther apart
const FEWEST = 3; // corners
const MOST = 200; // corners that are stated: of more, every other one, and so on

class LassoTool {
  constructor(view, canvas) {
    this.view = view;
    this.canvas = canvas;
    this.svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    this.shape = document.createElementNS("http://www.w3.org/2000/svg", "polygon");
    this.svg.setAttribute("class", "overlay lasso");
    this.svg.setAttribute("aria-hidden", "true");
    this.svg.append(this.shape);
    canvas.after(this.svg);
    this.leave();
  }

  get active() {
    return Boolean(this.done);
  }

  // Waits for a lasso; `done` gets it: the eye and the corners, metres, in the frame of the model.
  begin(done) {
    this.view.closeAll();
    this.done = done;
    this.canvas.classList.add("drawing");
    this.canvas.focus();
  }

  leave() {
    this.done = null;
    this.canvas.classList.remove("drawing");
    this.shape.setAttribute("points", "");
  }

  // Returns what draws the lasso while the pointer moves.
  grab(start) {
    const places = [start];
    this.canvas.addEventListener("pointerup", () => this.close(places), { once: true });
    return (place) => {
      const last = places[places.length - 1];
      if (Math.hypot(place.x - last.x, place.y - last.y) < LEAST) return;
      places.push(place);
      const { clientWidth: w, clientHeight: h } = this.canvas;
      this.shape.setAttribute("points", places.map(({ x, y }) => `${(x * w).toFixed(1)},${(y * h).toFixed(1)}`).join(" "));
    };
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
