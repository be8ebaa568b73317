// @ts-check
// A camera that goes round a point: azimuth from straight ahead (negative towards -X), elevation above the horizon.

const FOV = (28 * Math.PI) / 180;
const START = { azimuth: (-32 * Math.PI) / 180, elevation: (18 * Math.PI) / 180 };

class OrbitCamera {
  /** @type {number} */ distance;

  constructor(box) {
    this.box = box;
    this.size = Math.hypot(...minus(box[1], box[0])) || 1;
    this.aspect = 4 / 3;
    this.azimuth = START.azimuth;
    this.elevation = START.elevation;
    this.target = times(add(box[0], box[1]), 0.5);
    this.touched = false;
    this.reset();
  }

  reset() {
    Object.assign(this, START, { target: times(add(this.box[0], this.box[1]), 0.5), touched: false });
    this.fit();
  }

  // Stands so far away that the whole box is seen.
  fit() {
    const { right, up, forward } = this.axes(), half = Math.tan(FOV / 2) / 1.08;
    const away = corners(this.box).map((corner) => {
      const p = minus(corner, this.target);
      return Math.max(Math.abs(dot(p, right)) / (half * this.aspect), Math.abs(dot(p, up)) / half) - dot(p, forward);
    });
    this.distance = Math.max(...away);
  }

  resize(aspect) {
    this.aspect = aspect;
    if (!this.touched) this.fit();
  }

  axes() {
    const { azimuth: a, elevation: e } = this;
    const forward = [-Math.sin(a) * Math.cos(e), Math.cos(a) * Math.cos(e), -Math.sin(e)];
    const right = [Math.cos(a), Math.sin(a), 0];
    return { right, up: cross(right, forward), forward };
  }

  get eye() {
    return minus(this.target, times(this.axes().forward, this.distance));
  }

  orbit(dx, dy) {
    this.azimuth -= dx;
    this.elevation = clamp(this.elevation + dy, -1.5, 1.5);
    this.touched = true;
  }

  // Moves sideways by fractions of the picture's height.
  pan(dx, dy) {
    const { right, up } = this.axes(), reach = 2 * this.distance * Math.tan(FOV / 2);
    const moved = add(this.target, add(times(right, -dx * reach), times(up, dy * reach)));
    this.target = moved.map((x, k) => clamp(x, this.box[0][k] - this.size, this.box[1][k] + this.size));
    this.touched = true;
  }

  zoom(factor) {
    this.distance = clamp(this.distance * factor, 0.08 * this.size, 8 * this.size);
    this.touched = true;
  }

  matrix() {
    const { right, up, forward } = this.axes();
    const near = Math.max(0.02 * this.size, this.distance - 2.5 * this.size), far = this.distance + 4 * this.size;
    return product(perspective(FOV, this.aspect, near, far), viewed(this.eye, right, up, forward));
  }
}
