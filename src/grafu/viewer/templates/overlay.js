// @ts-check
// Lines over the 3D view: of one joint the axis as it was stated (dashed) and as it was built, with an arrow.

class Overlay {
  constructor(svg) {
    this.svg = svg;
    this.scene = null;
    this.lines = ["stated", "built", "head"].map((name) => {
      const shape = document.createElementNS("http://www.w3.org/2000/svg", name === "head" ? "polygon" : "line");
      shape.setAttribute("class", `axis ${name}`);
      svg.append(shape);
      return shape;
    });
  }

  // Draws the axes of a joint, or none (null); `size` is the picture's width and height in pixels.
  draw(camera, index, poses, [width, height]) {
    const link = this.scene.links.findIndex((l) => index !== null && l.joint === index), seen = this.middle(link);
    this.svg.toggleAttribute("hidden", !seen);
    if (!seen) return;
    const joint = this.scene.joints[index], matrix = camera.matrix();
    const above = poses[this.scene.links[link].parent];
    /** @returns {Segment} */
    const drawn = (line) => {
      const [p, d] = line, near = add(p, times(d, dot(minus(seen.center, p), d)));
      const from = joint.motion[0] ? near : seen.center, half = 0.62 * seen.size;
      /** @returns {[number, number]} */
      const seenAt = (by) => {
        const moved = mapped(above, add(from, by)), clip = mapped(matrix, moved);
        return [(0.5 + clip[0] / clip[3] / 2) * width, (0.5 - clip[1] / clip[3] / 2) * height];
      };
      return [seenAt(times(d, joint.motion[0] ? -half : 0)), seenAt(times(d, half))];
    };
    const [stated, built, head] = this.lines;
    stated.toggleAttribute("hidden", !joint.initial);
    if (joint.initial) place(stated, drawn(joint.initial));
    const ends = drawn(joint.axis);
    place(built, ends);
    head.setAttribute("points", arrow(ends));
  }

  // Returns the middle of a link's parts at rest and their greatest extent, or null where there is nothing to see.
  middle(link) {
    const boxes = this.scene.items.filter((item) => item.link === link && item.box).map((item) => item.box);
    if (!boxes.length) return null;
    const low = [0, 1, 2].map((k) => Math.min(...boxes.map((box) => box[0][k])));
    const high = [0, 1, 2].map((k) => Math.max(...boxes.map((box) => box[1][k])));
    return { center: times(add(low, high), 0.5), size: Math.max(...minus(high, low)) };
  }
}

/** @typedef {[[number, number], [number, number]]} Segment two points, pixels */

/** @param {SVGElement} line @param {Segment} ends */
function place(line, [[x1, y1], [x2, y2]]) {
  Object.entries({ x1, y1, x2, y2 }).forEach(([name, value]) => line.setAttribute(name, value.toFixed(1)));
}

// Returns the corners of an arrow's head at the second of two points.
/** @param {Segment} ends */
function arrow([[x1, y1], [x2, y2]]) {
  const length = Math.hypot(x2 - x1, y2 - y1) || 1, dx = (x2 - x1) / length, dy = (y2 - y1) / length;
  const points = [[0, 0], [-11, 5], [-11, -5]].map(([a, b]) => [x2 + a * dx - b * dy, y2 + a * dy + b * dx]);
  return points.map((point) => point.map((x) => x.toFixed(1)).join(",")).join(" ");
}
