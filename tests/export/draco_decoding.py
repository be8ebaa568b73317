"""Decodes Draco primitives of a GLB by the codec for JavaScript, which is no part of grafu and none of DracoPy.

It comes by `npm install --no-package-lock` in the repository.
"""

import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

_PACKAGE = Path(__file__).parents[2] / "node_modules" / "draco3dgltf"
_SCRIPT = """
const fs = require("fs"), draco = require(process.argv[1]), data = fs.readFileSync(process.argv[2]);
const size = data.readUInt32LE(12), gltf = JSON.parse(data.subarray(20, 20 + size).toString());
const binary = data.subarray(28 + size);
draco.createDecoderModule({}).then(lib => {
  const found = gltf.meshes.map(mesh => mesh.primitives.map(primitive => {
    const packed = primitive.extensions.KHR_draco_mesh_compression, view = gltf.bufferViews[packed.bufferView];
    const bytes = new Int8Array(binary.subarray(view.byteOffset, view.byteOffset + view.byteLength));
    const buffer = new lib.DecoderBuffer(), decoder = new lib.Decoder(), made = new lib.Mesh();
    buffer.Init(bytes, bytes.length);
    if (!decoder.DecodeBufferToMesh(buffer, made).ok()) throw new Error("not decoded");
    const arrays = {}, face = new lib.DracoInt32Array(), indices = [];
    for (const [name, id] of Object.entries(packed.attributes)) {
      const attribute = decoder.GetAttributeByUniqueId(made, id), values = new lib.DracoFloat32Array();
      decoder.GetAttributeFloatForAllPoints(made, attribute, values);
      arrays[name] = Array.from({length: values.size()}, (_, k) => values.GetValue(k));
    }
    for (let k = 0; k < made.num_faces(); k++) {
      decoder.GetFaceFromMesh(made, k, face);
      indices.push(face.GetValue(0), face.GetValue(1), face.GetValue(2));
    }
    return {arrays, indices, points: made.num_points()};
  }));
  console.log(JSON.stringify(found));
});
"""


def decoded(data: bytes, folder: Path) -> list[list[dict[str, np.ndarray]]]:
    """Returns for each mesh and primitive its attributes by glTF's names, one row a point, and `indices`, (n, 3)."""
    node = shutil.which("node")
    if node is None or not _PACKAGE.exists():
        assert not os.environ.get("CI"), "draco3dgltf is missing: run `npm install --no-package-lock`"
        pytest.skip("node or draco3dgltf is not installed")
    path = folder / "packed.glb"
    path.write_bytes(data)
    done = subprocess.run([node, "-e", _SCRIPT, str(_PACKAGE), str(path)], capture_output=True, text=True, check=True)
    return [
        [
            {name: np.array(values).reshape(one["points"], -1) for name, values in one["arrays"].items()}
            | {"indices": np.array(one["indices"]).reshape(-1, 3)}
            for one in mesh
        ]
        for mesh in json.loads(done.stdout)
    ]
