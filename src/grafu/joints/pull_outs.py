"""Pull-out units: a slim front with a rack behind it that nothing else holds. Both slide out as one.

They are found by boxes and contacts, so fronts that stand turned about Z stay as they were predicted. What touches its
front is a rack also where runners, known by their names, carry it, and where parts stand close beside it.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.shells import shell_numbers
from grafu.graph.edges import Slide
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.behind_fronts import groups_held_by, groups_within, is_within_outline, touched_by
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.racks import hangs_together
from grafu.joints.waste_bins import is_bucket
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a pull-out unit: the rack behind the front shows that it slides."""
_UP, _DEPTH = 2, 1
_OUT = vec3(0.0, -1.0, 0.0)


@final
@dataclass(frozen=True)
class PullOutConfig:
    """What counts as a front with a rack behind it; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("reach", "clear", "touching")
    slim: float = 0.6
    """Greatest width of the front (fraction of its height) ..."""
    wide: float = 1.0
    """... and where the rack touches it (fraction of its height)."""
    touching: float = 0.0003
    """As near as this a rack touches its front, or what holds it (metres): rounding, and no clearance."""
    upright: float = 0.9
    """From this cosine on to the vertical the predicted hinge is at a side of the front, and to the front what slides
    comes out there."""
    pieces: int = 3
    """How many parts a rack has at least, or shells that hang together where it is drawn in fewer parts, unless it is
    a bin: one board may be a shelf whose pins are not drawn."""
    tall: float = 0.5
    """Least height of a rack (fraction of the front's height)."""
    deep: float = 0.5
    """Least depth of a rack (fraction of the depth of the whole)."""
    reach: float = 0.04
    """How far behind the front, or in it, the rack's near end lies at most (metres)."""
    clear: float = 0.02
    """A rack stays this far within the outline of its front (metres): what comes nearer to it is the case."""
    wall: float = 0.7
    """A board across the depth that fills this fraction of the outline, both ways, is the back of the case."""
    back: float = 0.1
    """What stands behind all but this far part of the rack's depth may touch it: the back of the case (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "reach", "clear", "pieces", "wide", "touching")
        require_ratios(self, "slim", "upright", "tall", "deep", "wall", "back")


def with_pull_outs(
    plan: RealizationPlan, asset: Asset, graph: FunctionalGraph, config: PullOutConfig = PullOutConfig()
) -> RealizationPlan:
    """Returns the plan in which a front with a rack behind it slides out with the rack, and does not turn.

    Pieces of that rack, such as baskets, that were guessed to move by themselves do not.
    """
    config = at_scale(config, metre_on(asset.extent))
    made = {request.moving: request for request in plan.joints}
    for request in plan.joints:
        if request.moving in made:
            guessed = {name for name in made if asset.part(name).label is PartLabel.UNKNOWN} - {request.moving}
            kept = (other for name, other in made.items() if name not in guessed)
            moving = {part for other in kept for part in (other.moving, *other.attached)}
            static = [part for part in asset.parts if part.id not in moving]
            pulled = _pulled_out(request, asset, static, graph, config)
            taken = {*pulled.attached} - {*request.attached}
            made = {name: other for name, other in made.items() if name not in taken}
            made[request.moving] = pulled
    return replace(plan, joints=tuple(made[r.moving] for r in plan.joints if r.moving in made))


def _pulled_out(
    request: JointRequest, asset: Asset, static: list[Part], graph: FunctionalGraph, config: PullOutConfig
) -> JointRequest:
    """Returns the request of a front with a rack behind it as one that slides out with it; any other as it is."""
    front = asset.part(request.moving).box
    hinged = request.kind.turns and abs(float(request.axis.direction[_UP])) >= config.upright
    pulled = not request.kind.turns and float(request.axis.direction @ _OUT) >= config.upright
    ratio = float(front.size[0] / max(front.size[_UP], 1e-9)) if front.thin_axis == _DEPTH else np.inf
    if not ((hinged or pulled) and ratio <= config.wide) or request.parent or request.coupling:
        return request
    rack = _rack(request, front, asset, static, graph, config) if ratio <= config.slim else []
    rack = rack or _carried_rack(request, front, asset, static, config)
    if not rack:
        return request
    return JointRequest(
        request.moving,
        Slide.joint_type,
        Axis(front.center, _OUT),
        SOURCE,
        attached=(*request.attached, *rack),
        choice=request.choice,
    )


def _rack(
    request: JointRequest, front: Box, asset: Asset, static: list[Part], graph: FunctionalGraph, config: PullOutConfig
) -> list[str]:
    """Returns the parts behind a front that hang together and that nothing beside, above or below them holds."""
    own = {request.moving, *request.attached}
    inside = {part.id: part.box for part in static if _is_behind(part.box, front, config)}
    for found in groups_within(inside, graph):
        if not _is_rack(found, front, asset, config):
            continue
        box = Box.enclosing(inside[name] for name in found)
        touched = touched_by(found, asset, graph, own)
        far = float(box.high[_DEPTH]) - config.back * float(box.size[_DEPTH])
        if all(float(asset.part(name).box.low[_DEPTH]) >= far for name in touched):
            return list(found)
    return []


def _carried_rack(
    request: JointRequest, front: Box, asset: Asset, static: list[Part], config: PullOutConfig
) -> list[str]:
    """Returns the parts behind a front that hang together and touch it, and else nothing but runners."""
    own = {request.moving, *request.attached}
    inside = {p.id for p in static if _is_behind(p.box, front, config)}
    groups = groups_held_by(own, inside, asset, config.touching)
    return next((list(found) for found in groups if _is_rack(found, front, asset, config)), [])


def _is_rack(found: Sequence[str], front: Box, asset: Asset, config: PullOutConfig) -> bool:
    """Whether parts that hang together begin near a front, are tall and deep, and several, or a bin."""
    box = Box.enclosing(asset.part(name).box for name in found)
    near = abs(float(box.low[_DEPTH] - front.high[_DEPTH])) <= config.reach
    tall = box.size[_UP] >= config.tall * front.size[_UP]
    deep = box.size[_DEPTH] >= config.deep * asset.box.size[_DEPTH]
    if not (near and tall and deep):
        return False
    if len(found) >= config.pieces:
        return True
    mesh = merge_meshes([asset.part(name).mesh for name in found])
    return is_bucket(mesh) or (int(shell_numbers(mesh).max()) + 1 >= config.pieces and hangs_together(mesh))


def _is_behind(box: Box, front: Box, config: PullOutConfig) -> bool:
    """Whether a part may be one of a rack: well within a front's outline, behind it, and no back of the case."""
    across = [0, _UP]
    behind = is_within_outline(box, front, config.clear) and box.low[_DEPTH] >= front.low[_DEPTH]
    wall = box.thin_axis == _DEPTH and np.all(box.size[across] >= config.wall * front.size[across])
    return bool(behind and not wall)
