// @ts-check
// The data of the page: JSON tables and one buffer (zlib, then base64). docs/pages.md describes the form.

const readJson = (id) => JSON.parse(elementAt("#" + id).textContent);

async function inflated(id) {
  const text = atob(elementAt("#" + id).textContent.trim());
  const bytes = Uint8Array.from(text, (sign) => sign.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

const loadScene = async () => cutScene(readJson("scene"), await inflated("geometry"));

// Returns the scene with its buffer cut into typed arrays, ready for upload.
function cutScene(scene, buffer) {
  scene.meshes = scene.meshes.map((mesh) => ({
    vertices: new Uint8Array(buffer, ...mesh.vertices),
    indices: mesh.bits === 32
      ? new Uint32Array(buffer, mesh.indices[0], mesh.indices[1] / 4)
      : new Uint16Array(buffer, mesh.indices[0], mesh.indices[1] / 2),
    uv: mesh.uv && new Uint8Array(buffer, ...mesh.uv),
    colors: mesh.colors && new Uint8Array(buffer, ...mesh.colors),
  }));
  return scene;
}

function loadImage(uri) {
  return new Promise((resolve) => {
    const image = new Image();
    image.onload = () => resolve(image);
    image.onerror = () => resolve(null);
    image.src = uri;
  });
}
