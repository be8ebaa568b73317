"""Which objects are cut where fronts and handles are drawn on their surfaces; `segmentation` finds these."""

from collections.abc import Mapping, Sequence
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.creased_surface import uv_islands
from grafu.segmentation.creases import drawn_fronts, drawn_handles
from grafu.segmentation.division import FacePiece
from grafu.segmentation.mesh_shells import MeshShells

Cuts = dict[int, list[FacePiece]]


@final
@dataclass(frozen=True, slots=True)
class DrawnCutConfig:
    """Where fronts and handles are looked for that are drawn on a surface.

    Raises:
        ValueError: if a count is not above 0, or a fraction not between 0 and 1.
    """

    few: int = 3
    """Fronts are looked for where an input has none or one besides, and so many objects at most ..."""
    some: int = 8
    """... or so many where one of them has most of the surface: a row of kitchen units with its worktop and sink ..."""
    most: float = 0.5
    """... as this much of it is (fraction of area)."""
    thick: float = 0.35
    """Handles are looked for on plates, no thicker than this (fraction of the middle side) ..."""
    faces: int = 200_000
    """... where these have so many faces at most."""

    def __post_init__(self) -> None:
        require_ratios(self, "most", "thick")
        require_positive(self, "few", "some", "faces")


def count_fronts(cuts: Mapping[int, Sequence[FacePiece]]) -> int:
    """Returns how many fronts are cut out."""
    return sum(piece.role == "front" for found in cuts.values() for piece in found)


def with_drawn_fronts(
    cuts: Cuts,
    parts: Sequence[Part],
    meshes: Sequence[TriangleMesh],
    open_to: Sequence[bool],
    materials: Sequence[Indices],
    config: DrawnCutConfig = DrawnCutConfig(),
    shells: MeshShells | None = None,
) -> Cuts:
    """Returns the cuts with those where fronts are drawn, if these are several more; by islands of UVs where no others.

    Where some objects are doors or drawers by name, other fronts of an object count only if each holds a handle: a
    maker who made one drawer an object may have drawn the others on the case. Where an object is a front with handles,
    none is drawn on other sides than that at -Y.

    Args:
        cuts: what is known.
        parts: the objects.
        meshes: the same, upright.
        open_to: which of them may be cut.
        materials: the number of the surface of each face.
        config: where they are looked for.
        shells: those of the meshes, where they are known.
    """
    if count_fronts(cuts) > 1 or not _is_nearly_one(meshes, config):
        return cuts
    named = [part.label.is_movable for part in parts]
    if any(named):
        others = [may and not is_named for may, is_named in zip(open_to, named, strict=True)]
        drawn = drawn_fronts(meshes, others, materials, shells=shells)
        return cuts | {k: pieces for k, pieces in drawn.items() if _are_held(pieces)}
    has_front = any(piece.role == "body" for pieces in cuts.values() for piece in pieces)
    drawn = drawn_fronts(meshes, open_to, materials, shells=shells, sides=1 if has_front else 4)
    found = {**cuts, **drawn} if not cuts or count_fronts(drawn) > count_fronts(cuts) + 1 else cuts
    if not found and any(surface.uv is not None for part in parts for surface in part.surfaces):
        return drawn_fronts(meshes, open_to, [_islands(part) for part in parts], shells=shells)
    return found


def _are_held(pieces: Sequence[FacePiece]) -> bool:
    """Whether several fronts are cut from an object, and as many handles at least."""
    fronts, handles = (sum(piece.role == role for piece in pieces) for role in ("front", "handle"))
    return 1 < fronts <= handles


def handles_on_plates(
    cuts: Mapping[int, Sequence[FacePiece]],
    meshes: Sequence[TriangleMesh],
    open_to: Sequence[bool],
    materials: Sequence[Indices],
    config: DrawnCutConfig = DrawnCutConfig(),
    shells: MeshShells | None = None,
) -> Cuts:
    """Returns the cuts of plates that are left on which handles are drawn; see `with_drawn_fronts`."""
    left = [may and k not in cuts for k, may in enumerate(open_to)]
    sides = [np.sort(mesh.box.size) for mesh in meshes]
    plates = [may and bool(size[0] <= config.thick * size[1]) for may, size in zip(left, sides, strict=True)]
    faces = sum(len(mesh.faces) for mesh, is_plate in zip(meshes, plates, strict=True) if is_plate)
    return drawn_handles(meshes, plates, materials, shells=shells) if faces <= config.faces else {}


def _is_nearly_one(meshes: Sequence[TriangleMesh], config: DrawnCutConfig) -> bool:
    """Whether an input has few objects, or not many more and one of them has most of the surface."""
    area = [mesh.area for mesh in meshes]
    return len(area) <= config.few or (len(area) <= config.some and max(area) >= config.most * sum(area))


def _islands(part: Part) -> Indices:
    """Returns the number of the UV island of each face of the part's mesh; no island has faces of two surfaces."""
    found: list[np.ndarray] = []
    for surface in part.surfaces:
        start = int(found[-1].max(initial=-1)) + 1 if found else 0
        one = np.zeros(len(surface.mesh.faces), np.int64)
        found.append(start + (one if surface.uv is None else uv_islands(surface.mesh, surface.uv)))
    return np.concatenate(found)
