"""What is cut where no front is a shell: fronts drawn on a welded surface, and the lid of what is called a chest.

A groove, a step or another material parts a drawn front from its case.

The foot of a groove around a door, or the corner where a raised or sunk front meets its frame, is an inner corner; the
outer edges of a case and of a front are none. So a surface that is parted at its inner corners, and where its material
changes, has each front as a patch, with the edges that it has.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from grafu.geometry.arrays import Indices
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.candidates import candidates
from grafu.segmentation.config import SegmentationConfig
from grafu.segmentation.creased_surface import CreasedSurface
from grafu.segmentation.division import FacePiece, FoundFronts, fronts_by_object
from grafu.segmentation.fronts import FrontShells
from grafu.segmentation.hidden_fronts import outline
from grafu.segmentation.mesh_shells import MeshShells, axes_from
from grafu.segmentation.surface_config import CreaseConfig
from grafu.segmentation.surroundings import overlaps, within
from grafu.segmentation.view import ShellsView
from grafu.shapes import Bool

FrontsOfObjects = dict[int, tuple[FrontShells, ...]]


def drawn_fronts(
    meshes: Sequence[TriangleMesh],
    open_to: Sequence[bool],
    materials: Sequence[Indices],
    config: SegmentationConfig = SegmentationConfig(),
    shells: MeshShells | None = None,
    sides: int = 4,
) -> dict[int, list[FacePiece]]:
    """Returns for each mesh on which fronts are drawn what it is cut into, as it is seen from its best side.

    Only clear fronts count: several of one mesh, or one with a handle. `FacePiece.towards` is where they look.

    Args:
        meshes: the objects of an input, Z up, their front most likely at -Y; any unit.
        open_to: which of them may be cut.
        materials: for each mesh the number of each face's material.
        config: the thresholds.
        shells: those of the meshes, where they are known.
        sides: from how many sides they are looked at, in the order of `axes_from`.
    """
    if not any(len(mesh.faces) and is_open for mesh, is_open in zip(meshes, open_to, strict=True)):
        return {}
    whole = shells or MeshShells.of(meshes)
    surfaces = [CreasedSurface.of(mesh, m, config.creases) for mesh, m in zip(meshes, materials, strict=True)]
    most = 0.0
    pieces: dict[int, list[FacePiece]] = {}
    for turn in range(sides):
        axes = axes_from(turn)
        patches = [surface.patches(axes[2], config.creases) for surface in surfaces]
        parted = whole.parted(patches)
        view = parted.seen(axes)
        may = np.asarray(open_to)[parted.owner] & ~_is_in_edge(view, whole, config)
        found = fronts_by_object(view, may, [False] * len(meshes), config)
        clear = found.clear(config.division)
        others = _fronts_themselves(view, clear, config)
        clear = _besides(others, clear, view, config)
        area = sum(outline(view, front) for fronts in clear.values() for front in fronts)
        if area > most:
            most = area
            pieces = FoundFronts(_trimmed(clear, view, config.creases), {}, turn=turn).pieces(parted)
        if pieces or len(others):
            break  # the front is most likely at -Y: other sides count only where it shows none
    return {k: [replace(p, is_sheet=p.role == "front") for p in found] for k, found in sorted(pieces.items())}


def _fronts_themselves(view: ShellsView, clear: FrontsOfObjects, config: SegmentationConfig) -> Indices:
    """Returns the plates of the objects without clear fronts that are a front, but for what is drawn on it."""
    left = ~np.isin(view.owner, [*clear])
    low, high = np.full((int(view.owner.max()) + 1, 2), np.inf), np.full((int(view.owner.max()) + 1, 2), -np.inf)
    np.minimum.at(low, view.owner, view.low[:, :2])
    np.maximum.at(high, view.owner, view.high[:, :2])
    whole = (high - low).prod(axis=1)[view.owner]
    left &= view.size[:, :2].prod(axis=1) >= config.creases.main * whole
    return candidates(view, left, config.candidates) if len(low) > 1 else np.zeros(0, np.int64)


def _besides(others: Indices, clear: FrontsOfObjects, view: ShellsView, config: SegmentationConfig) -> FrontsOfObjects:
    """Returns the clear fronts of objects; where other objects are fronts themselves, only what cannot be their case.

    A maker who made some drawers objects of their own may have drawn on the case what lies behind or beside these.
    Fronts on it count if each is held and has none of the others before it.
    """

    def is_one(front: FrontShells) -> bool:
        plate, nested = front.shells[0], config.members.nested
        return front.is_held and not any(overlaps(view, other)[plate] >= nested for other in others.tolist())

    return {k: found for k, found in clear.items() if not len(others) or all(is_one(front) for front in found)}


def _is_in_edge(view: ShellsView, whole: MeshShells, config: SegmentationConfig) -> Bool[np.ndarray, " shells"]:
    """Whether each patch is too thick for a front, and a piece of the edge of a lying board: a lid or a worktop.

    A drawer that is drawn as one body is as low, and its patch has most of its outline.
    """
    of = np.zeros(len(view.owner), np.int64)
    of[view.shell] = whole.shell
    low, high = np.full((len(whole.owner), 3), np.inf), np.full((len(whole.owner), 3), -np.inf)
    np.minimum.at(low, of, view.low)
    np.maximum.at(high, of, view.high)
    size, plate = (high - low)[of], config.candidates.plate
    lies = size[:, 1] <= plate * size[:, ::2].min(axis=1)
    is_piece = view.size[:, :2].prod(axis=1) < config.creases.main * size[:, :2].prod(axis=1)
    return np.asarray(lies & is_piece & (view.size[:, 2] > plate * view.size[:, :2].min(axis=1)))


def drawn_handles(
    meshes: Sequence[TriangleMesh],
    plates: Sequence[bool],
    materials: Sequence[Indices],
    config: SegmentationConfig = SegmentationConfig(),
    shells: MeshShells | None = None,
) -> dict[int, list[FacePiece]]:
    """Returns for each plate with a handle drawn on its surface, or two, that plate without them, and these.

    They stand out farther than mouldings do. See `drawn_fronts`; `plates` tells which meshes may be such, `shells` are
    those of all.
    """
    if not any(plates):
        return {}
    kept, found = np.asarray(plates), dict[int, list[FacePiece]]()
    whole = shells or MeshShells.of(meshes)
    surfaces = {k: CreasedSurface.of(meshes[k], materials[k], config.creases) for k in np.flatnonzero(kept).tolist()}
    for turn in range(4):
        axes = axes_from(turn)
        patches = [np.zeros(len(mesh.faces), np.int64) for mesh in meshes]
        for k, surface in surfaces.items():
            patches[k] = surface.patches(axes[2], config.creases)
        if not any(patch.any() for patch in patches):
            continue
        parted = whole.parted(patches)
        view = parted.seen(axes)
        single = fronts_by_object(view, kept[parted.owner], [False] * len(meshes), config).with_handles
        single = {k: front for k, front in single.items() if _stand_out(view, front, config.creases)}
        found |= FoundFronts({}, single).pieces(parted)
        if found:
            break
    return found


def _stand_out(view: ShellsView, front: FrontShells, config: CreaseConfig) -> bool:
    """Whether all handles of a front stand out of it far enough."""
    for handle in front.handles:
        low, high = view.low[[*handle]].min(axis=0), view.high[[*handle]].max(axis=0)
        out = float(high[2] - view.high[front.shells[0], 2])
        if out < config.stand_out * float((high - low)[:2].min()):
            return False
    return True


def _trimmed(
    found: Mapping[int, tuple[FrontShells, ...]], view: ShellsView, config: CreaseConfig
) -> dict[int, tuple[FrontShells, ...]]:
    """Returns fronts without what reaches beyond the outline of their plate: the groove around it stays in its case."""
    near = config.near * float((view.high.max(axis=0) - view.low.min(axis=0)).max())
    return {
        owner: tuple(
            replace(front, shells=tuple(s for s in front.shells if s == front.shells[0] or inner[s]))
            for front in fronts
            for inner in (within(view, front.shells[0], near),)
        )
        for owner, fronts in found.items()
    }
