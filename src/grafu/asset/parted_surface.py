"""Inputs that are one scanned or generated surface, parted into objects by a program that tells parts apart.

Such objects are open where they meet: their borders run through the same vertices, and are ragged. What is a front is
one object, its handle with it or apart, so none is cut into fronts. Sheets become boards, as a sheet has nothing to
hang by, with straight borders where they are rectangular. Names and labels are not asked.
"""

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.asset.split_fronts import with_joined_fronts
from grafu.asset.standing_handles import without_handles
from grafu.asset.straight_borders import plane_of, with_straight_borders
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Indices, Vec3, distinct
from grafu.geometry.components import edge_numbers, welded
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.backs import back_of


@final
@dataclass(frozen=True, slots=True)
class PartedSurfaceConfig:
    """When objects are pieces of one surface, and which of them are sheets.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    faces: int = 2000
    """So many faces all objects have together at least: fewer are drawn by hand ..."""
    largest: float = 0.005
    """... and none is larger than this (fraction of the whole surface): a drawn board has two large faces."""
    shared: float = 0.6
    """Of the borders of an object as much runs along another object's (fraction of the edges) ..."""
    most: float = 0.6
    """... and so it is with as many of the objects (fraction)."""
    even: float = 0.5
    """Length of the sum of the normals of a sheet, by area, at least (fraction of the area): what encloses something
    has less, and a sheet with a handle and a rim of its own more."""
    thick: float = 0.015
    """How thick a sheet becomes (fraction of the largest side of all)."""

    def __post_init__(self) -> None:
        require_positive(self, "faces")
        require_ratios(self, "largest", "shared", "most", "even", "thick")


def is_parted_surface(parts: Sequence[Part], config: PartedSurfaceConfig = PartedSurfaceConfig()) -> bool:
    """Whether most objects are open, and meet others along their borders, edge for edge; none has a large face."""
    meshes = [part.mesh for part in parts]
    areas = np.concatenate([mesh.face_areas for mesh in meshes]) if meshes else np.zeros(0)
    if len(meshes) < 2 or len(areas) < config.faces or areas.max() > config.largest * areas.sum():
        return False
    borders, shared = _borders(meshes)
    meet = (borders > 0) & (shared >= config.shared * borders)
    return bool(np.count_nonzero(meet) >= max(2.0, config.most * len(meshes)))


def with_boards(parts: tuple[Part, ...], config: PartedSurfaceConfig = PartedSurfaceConfig()) -> tuple[Part, ...]:
    """Returns the parts of a parted surface, each that is a sheet as a board: it gets a back and a rim.

    Borders of fronts are made straight, and handles that are one piece with a front are parts of their own.
    """
    meshes = [part.mesh for part in parts]
    extent = float(merge_meshes(meshes).box.size.max())
    thick = config.thick * extent
    facing = tuple(None if mesh.is_watertight else _facing(mesh, config) for mesh in meshes)
    parts, facing = with_joined_fronts(parts, facing, thick)
    straight = with_straight_borders(parts, facing, thick)
    taken = {part.id for part in parts}
    made: list[Part] = []
    for part, towards in zip(straight, facing, strict=True):
        made += (part,) if towards is None else _front(part, towards, extent, thick, taken)
    return tuple(made)


def _front(part: Part, towards: Vec3, extent: float, thick: float, taken: Collection[str]) -> tuple[Part, ...]:
    """Returns a sheet as a board, and the handles that are one piece with it."""
    front, *handles = without_handles(part, towards, plane_of(part.mesh, towards), extent, taken)
    return (_board(front, towards, thick), *handles)


def _borders(meshes: Sequence[TriangleMesh]) -> tuple[Indices, Indices]:
    """Returns how many border edges each mesh has, and how many of them a border of another mesh has, too."""
    whole = merge_meshes(meshes)
    position = welded(whole.vertices, 1e-6 * float(whole.box.size.max()))[whole.faces]
    edges, of = edge_numbers(position).ravel(), np.repeat(np.arange(len(meshes)), [3 * len(m.faces) for m in meshes])
    own, count = np.unique(edges * len(meshes) + of, return_counts=True)
    border = own[count == 1]
    edge, mesh = border // len(meshes), border % len(meshes)
    several = np.bincount(edge, minlength=int(edges.max()) + 1)[edge] > 1
    return np.bincount(mesh, minlength=len(meshes)), np.bincount(mesh[several], minlength=len(meshes))


def _board(part: Part, towards: Vec3, thick: float) -> Part:
    mesh = part.mesh
    plane = plane_of(mesh, towards)
    handle = float((mesh.vertices[distinct(mesh.faces)] @ towards).max()) - plane
    back = back_of(mesh, towards, handle + thick)
    material = max(part.surfaces, key=lambda surface: surface.mesh.area).material
    return replace(part, surfaces=(*part.surfaces, Surface(back, material)))


def _facing(mesh: TriangleMesh, config: PartedSurfaceConfig) -> Vec3 | None:
    """Returns the direction along an axis that a sheet faces; None for what is no sheet."""
    total = mesh.face_areas @ mesh.face_normals
    axis = int(np.argmax(np.abs(total)))
    if abs(float(total[axis])) < config.even * mesh.area:
        return None
    towards = np.zeros(3)
    towards[axis] = np.sign(total[axis])
    return towards
