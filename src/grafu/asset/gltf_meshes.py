"""glTF mesh primitives to surfaces: triangles, strips and fans, with texture coordinates, normals and colours."""

from typing import Any

import numpy as np

from grafu.asset.gltf_buffers import GltfFile
from grafu.asset.gltf_materials import GltfMaterials
from grafu.asset.mesh_files import check_faces
from grafu.asset.options import Limits
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh

_TRIANGLES, _STRIP, _FAN = 4, 5, 6


class GltfMeshes:
    """The meshes of one document as surfaces, each made once; lines and points are left out with a note."""

    def __init__(self, file: GltfFile, limits: Limits) -> None:
        self.file, self.limits = file, limits
        self.materials = GltfMaterials(file)
        self.faces = 0
        self._own_notes: list[str] = []
        self._made: dict[int, tuple[Surface, ...]] = {}

    @property
    def notes(self) -> list[str]:
        """What was left out, in words."""
        return self._own_notes + self.materials.notes

    def get(self, index: Any) -> tuple[Surface, ...]:
        """Returns the surfaces of the mesh with this index.

        Raises:
            UnreadableAsset: if the mesh is not there or damaged.
            AssetTooLarge: if it has more faces than the limit.
        """
        if index not in self._made:
            mesh = self.file.item("meshes", index)
            found = [self._surface(p) for p in mesh.get("primitives", ())]
            self._made[index] = tuple(s for s in found if s is not None and not s.is_empty)
        surfaces = self._made[index]
        self.faces += sum(len(s.mesh.faces) for s in surfaces)
        check_faces(self.faces, str(self.file.path), self.limits)
        return surfaces

    def _surface(self, primitive: dict[str, Any]) -> Surface | None:
        if "KHR_draco_mesh_compression" in primitive.get("extensions", {}) and "POSITION" not in self._usable(
            primitive
        ):
            raise UnreadableAsset(
                f"{self.file.path} is compressed with Draco, which is not read: export it uncompressed"
            )
        mode, attributes = primitive.get("mode", _TRIANGLES), primitive.get("attributes", {})
        if mode not in (_TRIANGLES, _STRIP, _FAN) or "POSITION" not in attributes:
            self._own_notes.append("points or lines were left out")
            return None
        positions = self.file.accessor(attributes["POSITION"]).astype(np.float64)
        if positions.shape[1] != 3 or not np.isfinite(positions).all():
            raise self.file.damaged("positions are not three finite numbers each")
        indices = self._indices(primitive, len(positions))
        check_faces(len(indices) // 3, str(self.file.path), self.limits)
        faces = _faces(indices, mode)
        material = primitive.get("material")
        uv = self._attribute(attributes, f"TEXCOORD_{self.materials.uv_set(material)}", len(positions), 2)
        if uv is not None:
            uv = np.column_stack([uv[:, 0], 1.0 - uv[:, 1]])  # glTF counts v downwards from the top
        normals = self._attribute(attributes, "NORMAL", len(positions), 3)
        colors = self._colors(attributes, len(positions))
        return Surface(TriangleMesh(positions, faces), self.materials.get(material), uv, normals, colors)

    def _usable(self, primitive: dict[str, Any]) -> set[str]:
        """Returns the attributes whose accessors point to plain bytes (a Draco primitive may carry such a fallback)."""
        attributes = primitive.get("attributes", {})
        return {k for k, v in attributes.items() if "bufferView" in self.file.item("accessors", v)}

    def _indices(self, primitive: dict[str, Any], count: int) -> np.ndarray:
        if "indices" not in primitive:
            return np.arange(count)
        indices = self.file.accessor(primitive["indices"]).ravel().astype(np.int64)
        if len(indices) and (indices.min() < 0 or indices.max() >= count):
            raise self.file.damaged(f"a face names vertex {indices.max()} of {count}")
        return indices

    def _attribute(self, attributes: dict[str, Any], key: str, count: int, width: int) -> np.ndarray | None:
        if key not in attributes:
            return None
        values = self.file.accessor(attributes[key]).astype(np.float64)
        if values.shape != (count, width) or not np.isfinite(values).all():
            self._own_notes.append(f"damaged {key} values were left out")
            return None
        return values

    def _colors(self, attributes: dict[str, Any], count: int) -> np.ndarray | None:
        if "COLOR_0" not in attributes:
            return None
        values = self.file.accessor(attributes["COLOR_0"])
        if len(values) != count or values.shape[1] not in (3, 4):
            return None
        rgba = np.ones((count, 4))
        rgba[:, : values.shape[1]] = values
        return np.clip(np.round(rgba * 255), 0, 255).astype(np.uint8)


def _faces(indices: np.ndarray, mode: int) -> np.ndarray:
    if mode == _TRIANGLES:
        return indices[: len(indices) // 3 * 3].reshape(-1, 3)
    if len(indices) < 3:
        return np.zeros((0, 3), np.int64)
    if mode == _FAN:
        return np.column_stack([np.full(len(indices) - 2, indices[0]), indices[1:-1], indices[2:]])
    strip = np.column_stack([indices[:-2], indices[1:-1], indices[2:]])
    strip[1::2] = strip[1::2, [1, 0, 2]]
    return strip
