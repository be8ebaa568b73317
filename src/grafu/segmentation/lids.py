"""The lid of what is called a chest, or a washing machine that is loaded from above: a shell that lies on it.

Both are known by their names alone. A washing machine that has a door in front has none above.
"""

from collections.abc import Sequence
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3
from grafu.geometry.config_checks import require_not_negative, require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.candidates import candidates, framed, merged
from grafu.segmentation.config import SegmentationConfig
from grafu.segmentation.division import FacePiece, split
from grafu.segmentation.fronts import fronts_among
from grafu.segmentation.mesh_shells import MeshShells, axes_from
from grafu.segmentation.view import ShellsView


@final
@dataclass(frozen=True, slots=True)
class LidConfig:
    """What may be the lid of a chest, or of what is loaded from above.

    Raises:
        ValueError: if a number is negative, or what must be a fraction is not between 0 and 1.
    """

    plan: float = 0.85
    """What of the chest's plan it covers at least (fraction of the area) ..."""
    most: float = 1.0
    """... and at most."""
    height: float = 0.3
    """How high it is at most (fraction of the chest's height)."""
    inset: float = 0.0
    """How much of the chest is beside it on the left and on the right at least (fraction of the width)."""
    near: float = 0.02
    """What stands at its height lies on it, or at its edge, within this of it (fraction of the width)."""

    def __post_init__(self) -> None:
        require_ratios(self, "plan", "height", "near")
        require_positive(self, "most")
        require_not_negative(self, "inset")


@final
@dataclass(frozen=True, slots=True)
class WasherConfig:
    """When a washing machine is loaded from above.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    lid: LidConfig = LidConfig(plan=0.35, most=0.85, height=0.1, inset=0.01)
    """Of its lid, which is set in; what covers others is their top."""
    door: float = 0.1
    """What covers as much of its face is a door (fraction) ..."""
    casing: float = 0.5
    """... and from here on its casing."""

    def __post_init__(self) -> None:
        require_ratios(self, "door", "casing")


def lid_of_chest(
    meshes: Sequence[TriangleMesh], open_to: Sequence[bool], config: LidConfig = LidConfig()
) -> dict[int, list[FacePiece]]:
    """Returns the object that holds the lid of a chest, cut into that, with what lies on it, and the rest, if any.

    Of the shells that cover the chest from above the lid is the largest.
    """
    shells = MeshShells.of(meshes)
    view = shells.seen(axes_from(0))
    lid = _lid(view, open_to, config)
    return {} if lid is None else _cut(shells, view, lid, meshes, config)


def lid_of_washer(
    meshes: Sequence[TriangleMesh], open_to: Sequence[bool], config: WasherConfig = WasherConfig()
) -> dict[int, list[FacePiece]]:
    """Returns the same of a washing machine; empty where it has a door in front.

    What covers most of its face is its casing, and what stands above the lid the panel of its controls.
    """
    shells = MeshShells.of(meshes)
    view = shells.seen(axes_from(0))
    lid = _lid(view, open_to, config.lid)
    if lid is None:
        return {}
    low, high = view.low.min(axis=0), view.high.max(axis=0)
    ratio = view.size[:, :2].prod(axis=1) / (high - low)[:2].prod()
    in_front = view.high[:, 2] >= high[2] - config.lid.near * (high - low)[0]
    below = view.high[:, 1] <= view.high[lid, 1]
    doors = in_front & below & (ratio >= config.door) & (ratio < config.casing)
    return {} if doors.any() else _cut(shells, view, lid, meshes, config.lid)


def count_held_fronts(
    meshes: Sequence[TriangleMesh], config: SegmentationConfig = SegmentationConfig(), axes: Mat3 | None = None
) -> int:
    """Returns how many plates with a handle are seen in front, also those that are objects of their own.

    The rows of `axes` are a viewer's: to the right, up, and towards it; None: it looks from -Y.
    """
    whole = MeshShells.of(meshes).seen(axes_from(0) if axes is None else axes)
    view, _ = merged(whole, framed(whole, config))
    plates = candidates(view, np.ones(len(view.owner), dtype=bool), config.candidates)
    return sum(front.is_held for front in fronts_among(view, plates, config))


def _lid(view: ShellsView, open_to: Sequence[bool], config: LidConfig) -> int | None:
    """Returns the number of the shell that is the largest lid, None where none is one."""
    low, high = view.low.min(axis=0), view.high.max(axis=0)
    plan, tall, wide = view.size[:, 0] * view.size[:, 2], high[1] - low[1], high[0] - low[0]
    whole = wide * (high - low)[2]
    lids = (plan >= config.plan * whole) & (plan <= config.most * whole)
    lids &= (view.low[:, 0] >= low[0] + config.inset * wide) & (view.high[:, 0] <= high[0] - config.inset * wide)
    lids &= (view.size[:, 1] <= config.height * tall) & (view.low[:, 1] > low[1] + tall / 2)
    lids &= np.asarray(open_to, dtype=bool)[view.owner]
    return max(np.flatnonzero(lids).tolist(), key=lambda k: float(plan[k] * view.size[k, 1]), default=None)


def _cut(
    shells: MeshShells, view: ShellsView, lid: int, meshes: Sequence[TriangleMesh], config: LidConfig
) -> dict[int, list[FacePiece]]:
    owner, middle = int(view.owner[lid]), float(view.low[lid, 1])
    wide = float(view.high[:, 0].max() - view.low[:, 0].min())
    beside = np.maximum(view.low - view.high[lid], view.low[lid] - view.high)[:, ::2].max(axis=1)
    on = (view.owner == owner) & ((view.low + view.high)[:, 1] / 2 >= middle) & (beside <= config.near * wide)
    start = sum(len(mesh.faces) for mesh in meshes[:owner])
    rest, (found,) = split(shells, owner, start, [tuple(np.flatnonzero(on).tolist())])
    return {owner: [*([FacePiece("rest", rest)] if len(rest) else []), FacePiece("lid", found)]}
