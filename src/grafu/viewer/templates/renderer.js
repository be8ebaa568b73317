// @ts-check
// Draws the scene with WebGL 2: opaque surfaces, then the floor's shadow, then glass from far to near.

const SHADOW_SIDE = 2048;
const ATTRIBUTES = ["position", "normal", "uv", "color"];

class Renderer {
  constructor(canvas) {
    this.gl = canvas.getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: true });
    if (!this.gl) throw new Error("no WebGL 2");
    this.canvas = canvas;
    this.paint = this.program(VERTEX, FRAGMENT);
    this.depth = this.program(VERTEX, DEPTH_FRAGMENT);
    this.floor = this.program(FLOOR_VERTEX, FLOOR_FRAGMENT);
    this.blank = this.texture(null);
    this.lampMap = this.shadowMap();
    this.picked = this.pickTarget();
    this.meshes = [];
    this.images = [];
  }

  // Takes a scene and its images in the place of those before.
  show(scene, images) {
    const gl = this.gl;
    this.meshes.forEach(({ array, buffers }) => {
      gl.deleteVertexArray(array);
      buffers.forEach((buffer) => gl.deleteBuffer(buffer));
    });
    this.images.forEach((image) => image && gl.deleteTexture(image));
    this.scene = scene;
    this.meshes = scene.meshes.map((mesh) => this.upload(mesh));
    this.images = images.map((image) => image && this.texture(image));
    this.pieces = scene.items.flatMap((item, index) => item.pieces.map((piece) => ({ ...piece, item: index })));
  }

  program(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    ATTRIBUTES.forEach((name, k) => gl.bindAttribLocation(program, k, name));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) || "no program");
    const places = {};
    for (let k = 0; k < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); k++) {
      const { name } = gl.getActiveUniform(program, k);
      places[name] = gl.getUniformLocation(program, name);
    }
    return { program, places };
  }

  upload(mesh) {
    const gl = this.gl, array = gl.createVertexArray(), buffers = [];
    const store = (target, data) => {
      const buffer = gl.createBuffer();
      buffers.push(buffer);
      gl.bindBuffer(target, buffer);
      gl.bufferData(target, data, gl.STATIC_DRAW);
    };
    gl.bindVertexArray(array);
    store(gl.ARRAY_BUFFER, mesh.vertices);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, true, 8, 0);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 2, gl.BYTE, true, 8, 6);
    for (const [k, data, kind, count] of [[2, mesh.uv, gl.UNSIGNED_SHORT, 2], [3, mesh.colors, gl.UNSIGNED_BYTE, 4]]) {
      if (!data) continue;
      store(gl.ARRAY_BUFFER, data);
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, count, kind, true, 4, 0);
    }
    store(gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
    gl.bindVertexArray(null);
    const wide = mesh.indices instanceof Uint32Array;
    return { array, buffers, count: mesh.indices.length, kind: wide ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT };
  }

  texture(image) {
    const gl = this.gl, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    if (image) {
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    } else {
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4).fill(255));
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    }
    return texture;
  }

  shadowMap() {
    const gl = this.gl, texture = gl.createTexture(), frame = gl.createFramebuffer();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, SHADOW_SIDE, SHADOW_SIDE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, texture, 0);
    gl.drawBuffers([gl.NONE]);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return { texture, frame };
  }

  pickTarget() {
    const gl = this.gl, frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    const formats = [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT16, gl.DEPTH_ATTACHMENT]];
    for (const [format, place] of formats) {
      const store = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, store);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, 1, 1);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, store);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return frame;
  }

  // Draws one picture. `view` states what is shown: see `View.shows`.
  draw(camera, poses, view) {
    const gl = this.gl, matrix = camera.matrix(), lamp = lampMatrix(camera, this.scene.reach);
    const glassy = (piece) => view.alpha(piece) < 0.99;
    const shown = this.pieces.filter((piece) => view.shows(piece));
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.lampMap.frame);
    gl.viewport(0, 0, SHADOW_SIDE, SHADOW_SIDE);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.begin(this.depth, { camera: lamp.matrix });
    shown.filter((piece) => !glassy(piece)).forEach((piece) => this.drawPiece(this.depth, piece, poses));
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.beginPaint(camera, matrix, lamp);
    shown.filter((piece) => !glassy(piece)).forEach((piece) => this.paintPiece(piece, poses, view));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    this.drawFloor(matrix, lamp, view);
    this.beginPaint(camera, matrix, lamp);
    const far = (piece) => dot(minus(middle(this.scene.items[piece.item].box), camera.eye), camera.axes().forward);
    const panes = shown.filter(glassy).sort((a, b) => far(b) - far(a));
    panes.forEach((piece) => this.paintPiece(piece, poses, view));
    gl.depthMask(true);
  }

  begin({ program, places }, { camera }) {
    this.gl.useProgram(program);
    this.gl.uniformMatrix4fv(places.camera, false, camera);
  }

  beginPaint(camera, matrix, lamp) {
    const gl = this.gl, { places } = this.paint, { closed } = this.scene;
    this.begin(this.paint, { camera: matrix });
    gl.uniformMatrix4fv(places.lamp, false, lamp.matrix);
    gl.uniform3fv(places.eye, camera.eye);
    gl.uniform3fv(places.toward, lamp.toward);
    gl.uniform1f(places.grain, 0.0022 * camera.size);
    gl.uniform1f(places.floorHeight, closed[0][2]);
    gl.uniform1f(places.height, closed[1][2] - closed[0][2] || 1);
    this.bind(0, this.lampMap.texture, places.shadows);
  }

  bind(unit, texture, place) {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
    this.gl.uniform1i(place, unit);
  }

  paintPiece(piece, poses, view) {
    const gl = this.gl, { places } = this.paint, look = view.look(piece);
    const image = look.texture === null ? null : this.images[look.texture];
    gl.uniform4fv(places.base, look.color);
    gl.uniform3fv(places.glow, look.emissive);
    gl.uniform3f(places.look, look.metallic, look.roughness, look.mode === "MASK" ? look.cutoff : -1);
    gl.uniform4fv(places.mark, view.mark(piece));
    gl.uniform1i(places.textured, image ? 1 : 0);
    gl.uniform4fv(places.uvBox, piece.uv ? [...piece.uv[0], ...piece.uv[1]] : [0, 0, 1, 1]);
    this.bind(1, image ?? this.blank, places.image);
    gl.vertexAttrib4fv(3, [1, 1, 1, 1]);
    this.drawPiece(this.paint, piece, poses);
  }

  drawPiece({ places }, piece, poses) {
    const gl = this.gl, mesh = this.meshes[piece.mesh];
    gl.uniformMatrix4fv(places.link, false, poses[this.scene.items[piece.item].link]);
    gl.uniform3fv(places.low, piece.low);
    gl.uniform3fv(places.size, piece.size);
    gl.bindVertexArray(mesh.array);
    gl.drawElements(gl.TRIANGLES, mesh.count, mesh.kind, 0);
  }

  drawFloor(matrix, lamp, view) {
    const gl = this.gl, { places } = this.floor, [low, high] = this.scene.closed;
    const wide = 1.1 * Math.hypot(...minus(this.scene.reach[1], this.scene.reach[0]));
    this.begin(this.floor, { camera: matrix });
    gl.uniformMatrix4fv(places.lamp, false, lamp.matrix);
    gl.uniform4f(places.foot, low[0], low[1], high[0], high[1]);
    gl.uniform4f(places.span, low[0] - wide, low[1] - wide, high[0] + wide, high[1] + wide);
    gl.uniform1f(places.floorHeight, low[2]);
    gl.uniform1f(places.height, high[2] - low[2] || 1);
    gl.uniform1f(places.strength, view.shadow);
    this.bind(0, this.lampMap.texture, places.shadows);
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  // Returns the index of the item at a point (fractions of the picture, y downwards), or -1.
  pick(camera, poses, view, x, y) {
    const gl = this.gl, w = this.canvas.width, h = this.canvas.height;
    const zoomed = [w, 0, 0, 0, 0, h, 0, 0, 0, 0, 1, 0, w * (1 - 2 * x), h * (2 * y - 1), 0, 1];
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.picked);
    gl.viewport(0, 0, 1, 1);
    gl.disable(gl.BLEND);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.begin(this.depth, { camera: product(zoomed, camera.matrix()) });
    for (const piece of this.pieces) {
      if (!view.shows(piece)) continue;
      const code = piece.item + 1;
      gl.uniform4f(this.depth.places.mark, (code & 255) / 255, ((code >> 8) & 255) / 255, (code >> 16) / 255, 1);
      this.drawPiece(this.depth, piece, poses);
    }
    const pixel = new Uint8Array(4);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
  }
}

const middle = ([low, high]) => times(add(low, high), 0.5);

// The key light stands up and to the right of the camera and sees all that the object can reach.
function lampMatrix(camera, box) {
  const { right, up, forward } = camera.axes();
  const aside = add(add(times(right, 0.34), times(up, 0.72)), times(forward, -0.8));
  const toward = unit(add(aside, [0, 0, 0.35]));
  const half = 0.62 * (Math.hypot(...minus(box[1], box[0])) || 1), side = unit(cross([0, 0.001, 1], toward));
  const eye = add(middle(box), times(toward, 2 * half));
  const view = viewed(eye, side, cross(toward, side), times(toward, -1));
  return { toward, matrix: product(parallel(half, 0.2 * half, 3.6 * half), view) };
}
