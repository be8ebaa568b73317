"""How a mesh looks: materials, textures, and surfaces that carry both.

Some faces of a surface, and several surfaces of one material as one, keep their attributes.
"""

from collections.abc import Sequence
from dataclasses import field, replace
from functools import cached_property, lru_cache
from typing import Any, Final, Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Faces, Indices, Mat3, Mat4, Points, frozen_array, renumbered
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.shapes import Float, UInt8


@final
@dataclass(frozen=True, slots=True)
class Texture:
    """An encoded image, kept byte for byte from input to output."""

    name: str
    data: bytes = field(repr=False)
    mime: Literal["image/png", "image/jpeg"]


OPAQUE_ALPHA: Final = 0.95
"""Alpha of a colour from which on a material is opaque: what is clearer is glass (ratio)."""


@final
@dataclass(frozen=True, slots=True)
class Material:
    """A metallic-roughness material in glTF's terms; colours are linear RGB(A) in 0..1.

    Texture slots hold the image alone; all of them use the surface's one set of texture coordinates.
    """

    name: str = "default"
    base_color: tuple[float, float, float, float] = (0.8, 0.8, 0.8, 1.0)
    metallic: float = 0.0
    roughness: float = 0.8
    emissive: tuple[float, float, float] = (0.0, 0.0, 0.0)
    base_color_texture: Texture | None = None
    metallic_roughness_texture: Texture | None = None
    normal_texture: Texture | None = None
    occlusion_texture: Texture | None = None
    emissive_texture: Texture | None = None
    alpha_mode: Literal["OPAQUE", "MASK", "BLEND"] = "OPAQUE"
    alpha_cutoff: float = 0.5
    double_sided: bool = False

    @property
    def is_transparent(self) -> bool:
        """Whether one sees through it, as through glass: the colour is blended with what is behind it."""
        return self.alpha_mode == "BLEND" and self.base_color[3] < OPAQUE_ALPHA


@final
@dataclass(frozen=True, eq=False)
class Surface(ArrayValue):
    """A mesh with one material; per-vertex attributes are optional.

    `uv` follows OBJ and OpenGL (origin bottom left); `normals` are unit vectors in the object frame; `colors` is
    8-bit RGBA. `name` is what the input calls it, empty where it states nothing.

    Raises:
        ValueError: if an attribute's length is not the number of vertices.
    """

    mesh: TriangleMesh
    material: Material = Material()
    uv: Float[np.ndarray, "n 2"] | None = None
    normals: Points | None = None
    colors: UInt8[np.ndarray, "n 4"] | None = None
    name: str = ""

    def __post_init__(self) -> None:
        for name, dtype in (("uv", np.float64), ("normals", np.float64), ("colors", np.uint8)):
            values = getattr(self, name)
            if values is None:
                continue
            if len(values) != len(self.mesh.vertices):
                raise ValueError(f"`Surface.{name}` must have {len(self.mesh.vertices)} rows: got {len(values)}")
            object.__setattr__(self, name, frozen_array(values, dtype))

    @cached_property
    def is_empty(self) -> bool:
        """Whether there is no face."""
        return not len(self.mesh.faces)

    def transformed(self, T: Mat4) -> "Surface":
        """Returns the surface mapped by T, normals turned with it."""
        normals = self.normals
        if normals is not None:
            mapped = normals @ _inverse(T[:3, :3].tobytes())
            normals = mapped / np.maximum(np.sqrt(np.add.reduce(mapped * mapped, axis=1, keepdims=True)), 1e-300)
            normals.setflags(write=False)  # they need not be copied
        return Surface(self.mesh.transformed(T), self.material, self.uv, normals, self.colors, self.name)


@lru_cache(maxsize=64)  # the surfaces of one thing are mapped one after another
def _inverse(linear: bytes) -> Mat3:
    return frozen_array(np.linalg.inv(np.frombuffer(linear).reshape(3, 3)))


_WIDTHS = {"uv": 2, "normals": 3, "colors": 4}


def selected(surface: Surface, faces: Indices) -> Surface:
    """Returns the surface of some faces, given by number; vertices that none of them uses are dropped."""
    kept = surface.mesh.faces[faces]
    used, index = renumbered(kept, len(surface.mesh.vertices))
    mesh = TriangleMesh(surface.mesh.vertices[used], index)
    uv, normals, colors = (None if a is None else a[used] for a in (surface.uv, surface.normals, surface.colors))
    return replace(surface, mesh=mesh, uv=uv, normals=normals, colors=colors)


def attribute_rows(surface: Surface) -> Float[np.ndarray, "n k"]:
    """Returns position and attributes side by side, one row per vertex."""
    columns = [surface.mesh.vertices, surface.uv, surface.normals, surface.colors]
    return np.hstack([np.asarray(c, dtype=np.float64) for c in columns if c is not None])


def from_attributes(like: Surface, rows: Float[np.ndarray, "n k"], faces: Faces) -> Surface:
    """Returns a surface like the given one from rows as `attribute_rows` makes them; those that no face uses go."""
    used, index = renumbered(faces, len(rows))
    rows, at = rows[used], 3
    found: dict[str, Any] = {}
    for name, width in _WIDTHS.items():
        if getattr(like, name) is not None:
            found[name], at = rows[:, at : at + width], at + width
    if "normals" in found:
        found["normals"] = found["normals"] / np.maximum(
            np.linalg.norm(found["normals"], axis=1, keepdims=True), 1e-300
        )
    if "colors" in found:
        found["colors"] = np.clip(np.round(found["colors"]), 0, 255).astype(np.uint8)
    return replace(like, mesh=TriangleMesh(rows[:, :3], index), **found)


def joined(like: Surface, pieces: Sequence[Surface]) -> Surface:
    """Returns pieces of one surface, which have the attributes that it has, as one; same vertices become one."""
    mesh = merge_meshes([piece.mesh for piece in pieces])
    rows, index = np.unique(np.vstack([attribute_rows(piece) for piece in pieces]), axis=0, return_inverse=True)
    return from_attributes(like, rows, index.reshape(-1)[mesh.faces])
