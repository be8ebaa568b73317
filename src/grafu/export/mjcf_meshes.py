"""Visuals as meshes that MuJoCo takes: one look each, at least four corners, some area. It knows no links.

A visual of one look is the OBJ file that a URDF names too; others are divided by look into files of their own.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.export.mjcf_looks import Look, look_of
from grafu.export.obj import ObjFolder
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Vec3
from grafu.geometry.mesh import TriangleMesh

_FEWEST_CORNERS = 4
_LEAST_AREA = 1e-10  # square metres: a hundredth of a millimetre each way, which nobody sees and no solver needs


@final
@dataclass(frozen=True, slots=True)
class DrawnMesh:
    """A mesh of one look: its OBJ file in the folder, and the look."""

    file: str
    look: Look


def drawn_meshes(visual: Visual, shared: str, origin: Vec3, folder: ObjFolder) -> Iterator[DrawnMesh]:
    """Yields the meshes of a visual relative to `origin` (metres); `shared` is the OBJ file of the whole of it.

    What has no area is left out. Files are added to the folder where the whole will not do.
    """
    groups: dict[Look, list[Surface]] = {}
    for surface in visual.surfaces:
        if not surface.is_empty:
            groups.setdefault(look_of(surface), []).append(surface)
    uniform = len(groups) == 1 and len({s.uv is None for s in visual.surfaces if not s.is_empty}) == 1
    for look, surfaces in groups.items():
        if sum(surface.mesh.area for surface in surfaces) < _LEAST_AREA:
            continue
        if uniform and _corners(surfaces) >= _FEWEST_CORNERS:
            yield DrawnMesh(shared, look)
        else:
            drawn = tuple(_plain(surface, look) for surface in surfaces)
            yield DrawnMesh(folder.add_visual(replace(visual, surfaces=_divided(drawn)), origin), look)


def _corners(surfaces: list[Surface] | tuple[Surface, ...]) -> int:
    return len(np.unique(np.vstack([s.mesh.vertices[np.unique(s.mesh.faces)] for s in surfaces]), axis=0))


def _plain(surface: Surface, look: Look) -> Surface:
    """Returns a surface that has coordinates in the image only where the look has one: a file has them all or none."""
    return surface if look.textured else replace(surface, uv=None)


def _divided(surfaces: tuple[Surface, ...]) -> tuple[Surface, ...]:
    """Returns the same surfaces; where they have too few corners, the first face gets one more in its middle."""
    if _corners(surfaces) >= _FEWEST_CORNERS:
        return surfaces
    largest = max(range(len(surfaces)), key=lambda k: surfaces[k].mesh.area)
    return (*surfaces[:largest], _with_middle(surfaces[largest]), *surfaces[largest + 1 :])


def _with_middle(surface: Surface) -> Surface:
    """Returns a surface whose largest face is divided into three around its middle."""
    mesh, face = surface.mesh, int(np.argmax(surface.mesh.face_areas))
    a, b, c = (int(corner) for corner in mesh.faces[face])
    new = len(mesh.vertices)
    fan = [[a, b, new], [b, c, new], [c, a, new]]
    faces = np.vstack([np.delete(mesh.faces, face, axis=0), fan])

    def extended(values: np.ndarray) -> np.ndarray:
        return np.vstack([values, values[[a, b, c]].mean(axis=0)]).astype(values.dtype)

    return Surface(
        TriangleMesh(extended(mesh.vertices), faces),
        surface.material,
        None if surface.uv is None else extended(surface.uv),
        None if surface.normals is None else extended(surface.normals),
        None if surface.colors is None else extended(surface.colors),
        surface.name,
    )
