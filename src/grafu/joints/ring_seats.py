"""The seat and the lid of a toilet: a ring and a closed plate of one outline, both hinged along their common edge.

They are drawn one on the other, or raised, both or the lid alone. Names or the bowl below tell; a pane in the frame of
a table has no bowl.
"""

from collections.abc import Collection
from typing import Final, final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.asset.ring_seats import is_ring
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.graph.edges import Hinge
from grafu.joints.framed_leaves import SOURCE, relabelled
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan, moved_instead
from grafu.joints.plate_edges import PlateEdge, edges_of
from grafu.vocabulary import PartLabel

_WIDTH, _DEPTH, _UP = 0, 1, 2
_LEAVES: Final = (PartLabel.DOOR, PartLabel.UNKNOWN)
_RAYS: Final = 24  # along each side of a ring


@final
@dataclass(frozen=True)
class SeatPairConfig:
    """What is a seat with its lid; fractions of the length of the lid from back to front, where nothing else is stated.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    thin: float = 0.25
    """Greatest thickness of a seat, and of a lid."""
    alike: float = 0.2
    """How much seat and lid differ in width and in length at most."""
    near: float = 0.15
    """How far the edges are apart by which they are pinned."""
    aside: float = 0.1
    """How far the lid lies to the left or right of the seat at most (fraction of its width)."""
    bowl: float = 0.15
    """Least depth of the bowl in the middle of the seat ..."""
    middle: float = 0.3
    """... on more than the fraction `seen` of a middle that is so wide (fraction of each side of the seat)."""
    seen: float = 0.5
    """A drain may have no bottom (fraction of the middle)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, eq=False)
class SeatPair:
    """A seat, its lid, and the pin about which both open upwards."""

    seat: Part
    lid: Part
    pin: Axis


def seat_pair(asset: Asset, config: SeatPairConfig = SeatPairConfig()) -> SeatPair | None:
    """Returns the seat of an asset with its lid, both pinned at the back (+Y); None where it has none."""
    leaves = [part for part in asset.parts if part.label in _LEAVES and part.carried_by is None]
    plates = [(part, edges) for part in leaves if len(edges := list(edges_of(part.mesh, _WIDTH, config.thin))) > 1]
    are_rings = [is_ring(part) for part, _ in plates]
    rings = [plate for plate, has_opening in zip(plates, are_rings, strict=True) if has_opening]
    closed = [plate for plate, has_opening in zip(plates, are_rings, strict=True) if not has_opening]
    for seat, below in rings:
        for lid, above in closed:
            pin = _pin(seat, lid, below, above, config)
            are_named = seat.label is PartLabel.DOOR and lid.label is PartLabel.DOOR
            if pin is not None and (are_named or _is_on_bowl(seat, lid, asset, config)):
                return SeatPair(seat, lid, pin)
    return None


def with_seat_labels(asset: Asset, config: SeatPairConfig = SeatPairConfig()) -> Asset:
    """Returns the asset in which a seat and its lid are doors; else the asset itself."""
    pair = seat_pair(asset, config)
    return asset if pair is None else relabelled(asset, {pair.seat.id: PartLabel.DOOR, pair.lid.id: PartLabel.DOOR})


def with_seat_pair(
    plan: RealizationPlan, asset: Asset, settled: Collection[str] = (), config: SeatPairConfig = SeatPairConfig()
) -> RealizationPlan:
    """Returns the plan in which a seat and its lid turn about their common edge.

    Args:
        plan: the joints.
        asset: all parts, labelled (`with_seat_labels`).
        settled: the parts whose motions the user states.
        config: the thresholds.
    """
    pair = seat_pair(asset, config)
    if pair is None or {pair.seat.id, pair.lid.id} & set(settled):
        return plan
    own = {pair.seat.id, pair.lid.id}
    turning = [
        JointRequest(part.id, Hinge.joint_type, pair.pin, SOURCE, role=MotionRole.SEAT)
        for part in (pair.lid, pair.seat)
    ]
    return moved_instead(plan, own, turning)


def _pin(seat: Part, lid: Part, below: list[PlateEdge], above: list[PlateEdge], config: SeatPairConfig) -> Axis | None:
    """Returns the pin at the lowest common edge of two plates of one outline, the rear one of two that are level.

    It is above both: what lies below a pin moves to the front as it is raised, and away from a tank close behind.
    """
    width, other = float(seat.box.size[_WIDTH]), float(lid.box.size[_WIDTH])
    length, deep = below[0].across, above[0].across
    if abs(width - other) > config.alike * other or abs(length - deep) > config.alike * deep:
        return None
    if abs(float(seat.box.center[_WIDTH] - lid.box.center[_WIDTH])) > config.aside * other:
        return None
    near = config.near * deep
    common = [(a, b) for a in below for b in above if np.hypot(a.level - b.level, a.up - b.up) <= near]
    if not common:
        return None
    lowest = min(min(a.up, b.up) for a, b in common)
    level = [(a, b) for a, b in common if min(a.up, b.up) <= lowest + near]
    first, second = max(level, key=lambda pair: pair[0].level)
    place = seat.box.center.copy()
    place[_DEPTH], place[_UP] = min(first.level, second.level), max(first.high, second.high)
    return Axis(vec3(*place.tolist()), vec3(-1.0, 0.0, 0.0))


def _is_on_bowl(seat: Part, lid: Part, asset: Asset, config: SeatPairConfig) -> bool:
    """Whether the middle of a level seat shows a bowl below, deep and closed."""
    rest = [part.mesh for part in asset.parts if part not in (seat, lid)]
    if seat.box.thin_axis != _UP or not rest:
        return False
    mesh = merge_meshes(rest)
    depths = depths_below(RayCaster(mesh), seat.box, _UP, _RAYS, 0.0).reshape(_RAYS, _RAYS)
    edge = round(_RAYS * (1 - config.middle) / 2)
    inside = depths[edge:-edge, edge:-edge]
    return float((np.isfinite(inside) & (inside >= config.bowl * seat.box.size[_DEPTH])).mean()) >= config.seen
