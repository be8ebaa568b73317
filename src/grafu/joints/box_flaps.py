"""Flaps of cartons and tool boxes: plates along the upper rim of an open body, on two opposite walls or on all four.

They stand at any angle, from closed to hanging down outside. Each turns about the edge along its wall.
"""

from collections.abc import Collection, Iterator
from typing import Final, final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.graph.edges import Hinge
from grafu.joints.framed_leaves import SOURCE, relabelled
from grafu.joints.plan import JointRequest, RealizationPlan, moved_instead
from grafu.joints.plate_edges import edges_of
from grafu.shapes import Bool, Float
from grafu.vocabulary import PartLabel

BoxEnds = Float[np.ndarray, "n 3"]
_UP: Final = 2
_RAYS: Final = 16  # along each side of a body


@final
@dataclass(frozen=True)
class BoxFlapConfig:
    """What counts as a flap of a box; fractions of the longest side of the box, where nothing else is stated.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    thin: float = 0.12
    """Greatest thickness of a flap (fraction of its width across its wall): one with a crease is thicker."""
    near: float = 0.04
    """How far the edge of a flap lies off the rim at most."""
    long: float = 0.6
    """Least length of a flap (fraction of its wall)."""
    wide: float = 0.65
    """Greatest width of a flap (fraction of the side that it reaches across): each of two closes half of the box."""
    high: float = 0.2
    """Least height of the box: a tray and a table's top are lower."""
    hollow: float = 0.5
    """The box is open from above down to half its height on more than this (fraction of its plan)."""
    rest: float = 0.25
    """Where no names tell, what is neither box nor flap is smaller than this on each side."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, eq=False)
class BoxFlaps:
    """A box, and the line about which each of its flaps turns; positive opens."""

    body: Part
    flaps: tuple[tuple[Part, Axis], ...]


def box_flaps(asset: Asset, config: BoxFlapConfig = BoxFlapConfig()) -> BoxFlaps | None:
    """Returns the box of an asset with its flaps; None where it has none.

    Flaps are doors, or nameless where all else is small: boards on a case may stand as they do.
    """
    leaves = [part for part in asset.parts if part.label in (PartLabel.DOOR, PartLabel.UNKNOWN)]
    low, high = (np.array([getattr(part.box, end) for part in leaves]).reshape(-1, 3) for end in ("low", "high"))
    for body in asset.parts:
        box = body.box
        is_body = not body.label.is_movable and body.label is not PartLabel.HANDLE and body.carried_by is None
        if not is_body or not box.size.all() or box.size[_UP] < config.high * box.size.max():
            continue
        near = _at_rim(low, high, box, config)
        others = (part for part, is_near in zip(leaves, near.tolist(), strict=True) if is_near and part is not body)
        lines = [(part, *line) for part in others for line in _wall_of(part, box, config)]
        opposite = any((axis, -side) in {(a, s) for _, a, s, _ in lines} for _, axis, side, _ in lines)
        flaps = tuple((part, _pin(axis, side, place)) for part, axis, side, place in lines)
        if opposite and _is_told([part for part, _ in flaps], body, asset, config) and _is_open(body, config):
            return BoxFlaps(body, flaps)
    return None


def with_flap_labels(asset: Asset, config: BoxFlapConfig = BoxFlapConfig()) -> Asset:
    """Returns the asset in which the flaps of a box are doors and the box is none; else the asset itself."""
    found = box_flaps(asset, config)
    if found is None:
        return asset
    body = {found.body.id: PartLabel.SIDE_PANEL} if found.body.label is PartLabel.UNKNOWN else {}
    return relabelled(asset, {**body, **{part.id: PartLabel.DOOR for part, _ in found.flaps}})


def with_box_flaps(
    plan: RealizationPlan, asset: Asset, settled: Collection[str] = (), config: BoxFlapConfig = BoxFlapConfig()
) -> RealizationPlan:
    """Returns the plan in which the flaps of a box turn about the edges along its walls.

    Args:
        plan: the joints.
        asset: all parts, labelled (`with_flap_labels`).
        settled: the parts whose motions the user states.
        config: the thresholds.
    """
    found = box_flaps(asset, config)
    if found is None:
        return plan
    own = {found.body.id, *(part.id for part, _ in found.flaps)} - set(settled)
    body = (found.body.id,)
    turning = [
        JointRequest(part.id, Hinge.joint_type, axis, SOURCE, mounts=body)
        for part, axis in found.flaps
        if part.id in own
    ]
    return moved_instead(plan, own, turning)


def _at_rim(low: BoxEnds, high: BoxEnds, box: Box, config: BoxFlapConfig) -> Bool[np.ndarray, " n"]:
    """Returns which boxes, given by their ends, come near the upper rim of a box and are long beside one of its walls.

    Few do, and edges are looked for on these alone.
    """
    near = config.near * float(box.size.max())
    is_beside = ((low <= box.high + near) & (high >= box.low - near)).all(axis=1)
    is_level = (low[:, _UP] <= box.high[_UP] + near) & (high[:, _UP] >= box.high[_UP] - near)
    is_long = ((high - low)[:, :_UP] >= config.long * box.size[:_UP]).any(axis=1)
    return np.asarray(is_beside & is_level & is_long)


def _is_told(flaps: list[Part], body: Part, asset: Asset, config: BoxFlapConfig) -> bool:
    """Whether flaps are doors, or all but them and the box is small."""
    if all(part.label is PartLabel.DOOR for part in flaps):
        return True
    rest = (part.box.size for part in asset.parts if part not in flaps and part is not body)
    return all(bool((size < config.rest * body.box.size.max()).all()) for size in rest)


def _is_open(body: Part, config: BoxFlapConfig) -> bool:
    box = body.box
    depths = depths_below(RayCaster(body.mesh), box, _UP, _RAYS, float(box.size.max()))
    return float((depths >= box.size[_UP] / 2).mean()) > config.hollow


def _wall_of(part: Part, box: Box, config: BoxFlapConfig) -> Iterator[tuple[int, int, Vec3]]:
    """Yields the one wall of a box that a plate has an edge along: its axis, its side (-1 or 1), and the edge's middle.

    Of several walls it is that of which the edge takes most.
    """
    near = config.near * float(box.size.max())
    found: list[tuple[float, int, int, Vec3]] = []
    for axis in (0, 1):
        along = 1 - axis
        length = float(part.box.size[along])
        if part.box.low[along] < box.low[along] - near or part.box.high[along] > box.high[along] + near:
            continue
        for edge in edges_of(part.mesh, along, config.thin):
            fits = length >= config.long * box.size[along] and edge.across <= config.wide * box.size[axis]
            for side, wall in ((-1, float(box.low[axis])), (1, float(box.high[axis]))):
                if fits and np.hypot(edge.level - wall, edge.up - float(box.high[_UP])) <= near:
                    place = np.array(part.box.center)
                    place[axis], place[_UP] = edge.level, edge.up
                    found.append((length / float(box.size[along]), axis, side, vec3(*place.tolist())))
    if found:
        _, axis, side, place = max(found, key=lambda one: one[0])
        yield axis, side, place


def _pin(axis: int, side: int, place: Vec3) -> Axis:
    """Returns the line along a wall about which a flap opens upwards and outwards: square to the way out and up."""
    outwards = np.zeros(3)
    outwards[axis] = side
    return Axis(place, vec3(*np.cross([0.0, 0.0, 1.0], outwards).tolist()))
