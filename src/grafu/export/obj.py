"""Visuals as OBJ files with their MTL files and textures, all names relative.

What MTL cannot say (metallic-roughness and occlusion images, the alpha cutoff) is left out; GLB keeps it. The OBJ files
of an object are the same for every format that names them: visuals whole, convex pieces for collision.
"""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.articulation.physics import PhysicsModel
from grafu.dataclass import dataclass
from grafu.export.names import NameBook
from grafu.export.output_names import file_safe
from grafu.export.shading import corner_normals
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import Indices, Vec3, first_of_each
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid

_SUFFIX = {"image/png": ".png", "image/jpeg": ".jpg"}
_MULTIPLIERS = np.array(  # odd and of no pattern: rows that differ get keys that differ
    [
        *(0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9),
        *(0x27D4EB2F165667C5, 0x5851F42D4C957F2D, 0x94D049BB133111EB),
    ],
    dtype=np.uint64,
)


@final
class ObjFolder:
    """Collects the OBJ, MTL and image files of one folder; every image is written once."""

    def __init__(self, crease_angle: float) -> None:
        self.files: dict[str, bytes] = {}
        self._crease = crease_angle
        self._names = NameBook()
        self._textures: dict[tuple[bytes, str], str] = {}

    def add_visual(self, visual: Visual, origin: Vec3) -> str:
        """Adds a visual, its coordinates relative to `origin` (metres), and returns the name of its OBJ file."""
        stem = self._names.unique(file_safe(visual.name))
        surfaces = [s for s in visual.surfaces if not s.is_empty]
        names = _material_names(surfaces)
        self.files[f"{stem}.mtl"] = "\n".join(self._described(names)).encode()
        groups = "".join(self._groups(surfaces, names, origin))
        self.files[f"{stem}.obj"] = f"mtllib {stem}.mtl\no {file_safe(visual.name)}\n{groups}".encode()
        return f"{stem}.obj"

    def add_mesh(self, name: str, mesh: TriangleMesh, origin: Vec3) -> str:
        """Adds a bare mesh, without normals and materials, and returns the name of its OBJ file."""
        stem = self._names.unique(file_safe(name))
        text = _rows("v", mesh.vertices - origin) + _plain_faces(mesh.faces)
        self.files[f"{stem}.obj"] = text.encode()
        return f"{stem}.obj"

    def _groups(self, surfaces: list[Surface], names: dict[Material, str], origin: Vec3) -> Iterator[str]:
        """Yields one group of faces per surface; indices count through the file, from 1."""
        first = np.ones(3, dtype=np.int64)
        for surface in surfaces:
            shading = corner_normals(surface, self._crease)
            points, point = _distinct(_coordinates(surface, origin))
            normals, normal = _distinct(np.round(shading.normals, 7) + 0.0)  # without rounding noise and minus zeros
            yield _rows("v", points) + _rows("vn", normals)
            columns = [point[surface.mesh.faces], normal[shading.corners]]
            sizes = [len(points), 0, len(normals)]
            if surface.uv is not None:
                uv, place = _distinct(np.nan_to_num(surface.uv, posinf=0.0, neginf=0.0))
                yield _rows("vt", uv)
                columns.insert(1, place[surface.mesh.faces])
                sizes[1] = len(uv)
            yield f"usemtl {names[surface.material]}\n"
            yield _faces(columns, first)
            first += np.array(sizes)

    def _described(self, names: dict[Material, str]) -> Iterator[str]:
        for material, name in names.items():
            r, g, b, alpha = material.base_color
            yield f"newmtl {name}"
            yield f"Kd {r:.6g} {g:.6g} {b:.6g}"
            yield f"Ks {0.04 + 0.5 * material.metallic:.6g} " * 2 + f"{0.04 + 0.5 * material.metallic:.6g}"
            yield f"Ns {1000.0 * (1.0 - material.roughness) ** 2:.6g}"
            yield f"d {alpha if material.alpha_mode != 'OPAQUE' else 1.0:.6g}"
            yield "Ke {:.6g} {:.6g} {:.6g}".format(*material.emissive)
            yield f"Pr {material.roughness:.6g}\nPm {material.metallic:.6g}\nillum 2"
            for key, texture in _maps(material):
                yield f"{key} {self.add_texture(texture)}"

    def add_texture(self, texture: Texture) -> str:
        """Adds an image, once, and returns the name of its file."""
        key = (texture.data, texture.mime)
        if key not in self._textures:
            stem = file_safe(texture.name.removesuffix(_SUFFIX[texture.mime]))
            name = f"textures/{self._names.unique(stem)}{_SUFFIX[texture.mime]}"
            self._textures[key] = name
            self.files[name] = texture.data
        return self._textures[key]


def _maps(material: Material) -> Iterator[tuple[str, Texture]]:
    slots = {
        "map_Kd": material.base_color_texture,
        "map_Ke": material.emissive_texture,
        "norm": material.normal_texture,
    }
    for key, texture in slots.items():
        if texture is not None:
            yield key, texture


def _material_names(surfaces: list[Surface]) -> dict[Material, str]:
    book = NameBook()
    materials = dict.fromkeys(surface.material for surface in surfaces)
    return {material: book.unique(file_safe(material.name)) for material in materials}


def _coordinates(surface: Surface, origin: Vec3) -> np.ndarray:
    vertices = surface.mesh.vertices - origin
    if surface.colors is None:
        return vertices
    return np.hstack([vertices, surface.colors[:, :3] / 255.0])  # a common extension of the format


def _distinct(rows: np.ndarray) -> tuple[np.ndarray, Indices]:
    """Returns the rows without repetition, and the number of each row's like: files become shorter by far."""
    bits = np.ascontiguousarray(rows, dtype=np.float64).view(np.uint64)
    keys = (bits ^ (bits >> np.uint64(32))) @ _MULTIPLIERS[: bits.shape[1]]
    first, number = first_of_each(keys)
    if not np.array_equal(rows[first][number], rows):  # two rows of one key: it never was seen, but must not be wrong
        return rows, np.arange(len(rows))
    return rows[first], number


def _rows(key: str, values: np.ndarray) -> str:
    """Returns one line per row; eight digits hold single precision."""
    line = key + " %.8g" * values.shape[1] + "\n"
    return (line * len(values)) % tuple(values.ravel().tolist())


def _plain_faces(faces: np.ndarray) -> str:
    return ("f %d %d %d\n" * len(faces)) % tuple((faces + 1).ravel().tolist())


def _faces(columns: list[np.ndarray], first: Indices) -> str:
    """Returns one line per face; `columns` number its corners' places, coordinates in images if any, and normals."""
    corner, starts = ("%d/%d/%d", first) if len(columns) == 3 else ("%d//%d", first[[0, 2]])
    numbers = np.stack(columns, axis=-1) + starts
    line = f"f {corner} {corner} {corner}\n"
    return (line * len(numbers)) % tuple(numbers.ravel().tolist())


MESHES = "meshes"
"""The folder of the OBJ files, beside the file that names them."""


@final
@dataclass(frozen=True, slots=True)
class ObjSet:
    """A folder of OBJ files and which of them is what.

    `visuals` are by link, in the link's order, those without faces, or that swing, left out. `pieces` are by link and
    by the place of a hull among the link's shapes; boxes need no file.
    """

    folder: ObjFolder
    visuals: dict[str, tuple[tuple[Visual, str], ...]]
    pieces: dict[tuple[str, int], str]


def obj_set(articulated: ArticulatedObject, physics: PhysicsModel, crease_angle: float) -> ObjSet:
    """Returns the OBJ files of an object, relative to the frames of its links; `crease_angle` is radians."""
    made = ObjSet(ObjFolder(crease_angle), {}, {})
    for link in articulated.links_from_root:
        _add_link(made, link, physics)
    return made


def collision_name(link: str, number: int) -> str:
    """Returns the name of the collision shape at a place among a link's shapes."""
    return f"{link}_collision_{number}"


def _add_link(made: ObjSet, link: Link, physics: PhysicsModel) -> None:
    origin = physics.origins[link.id]
    drawn = [visual for visual in link.rigid_visuals if len(visual.mesh.faces)]
    made.visuals[link.id] = tuple((visual, made.folder.add_visual(visual, origin)) for visual in drawn)
    for number, shape in enumerate(physics.shapes[link.id]):
        if isinstance(shape, ConvexSolid):
            name = collision_name(link.id, number)
            made.pieces[link.id, number] = made.folder.add_mesh(name, shape.mesh, origin)
