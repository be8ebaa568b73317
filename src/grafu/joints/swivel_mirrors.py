"""Mirrors between two posts swivel about the level line between these: found by name, and by what holds them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import radians
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.asset.names import spoken
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.graph.edges import Hinge
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.small_knobs import SOURCE
from grafu.scene.scale import metre_on

_UP = 2
_MIRROR = "mirror"
_HOLDS = frozenset({"post", "stand", "support", "upright", "bracket"})  # what is called so is no piece of it


@final
@dataclass(frozen=True)
class MirrorConfig:
    """What counts as a mirror that swivels; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("gap", "touching")
    thin: float = 0.25
    """Greatest thickness of a mirror, its frame counted in (fraction of its shorter other side)."""
    gap: float = 0.03
    """How far a post stands beside it at most (metres)."""
    middle: float = 0.06
    """The posts reach past this middle part of its height (fraction)."""
    touching: float = 0.005
    """What is called a mirror, too, and is this near, is a piece of it (metres)."""
    tilt: float = radians(25)
    """How far it swivels, its upper edge to the front (radians)."""

    def __post_init__(self) -> None:
        require_positive(self, "gap", "touching", "tilt")
        require_ratios(self, "thin", "middle")


def swivel_mirrors(asset: Asset, config: MirrorConfig = MirrorConfig()) -> frozenset[str]:
    """Returns the parts of an asset that are mirrors between two posts, without the other pieces of these mirrors."""
    called = _called_mirrors(asset)
    if not called:
        return frozenset()
    boxes = {part.id: part.box for part in asset.parts if part.carried_by is None}
    return frozenset(r.moving for r in _requests(called, boxes, at_scale(config, metre_on(asset.extent))))


def with_stated_mirrors(plan: RealizationPlan, asset: Asset) -> RealizationPlan:
    """Returns the plan in which mirrors between posts swivel no further than stated: they turn about their middle."""
    mirrors = swivel_mirrors(asset) & {request.moving for request in plan.joints if request.kind.turns}
    if not mirrors:
        return plan
    joints = (replace(r, stop=r.reference) if r.moving in mirrors else r for r in plan.joints)
    return replace(plan, joints=tuple(joints))


def mirror_requests(
    made: ArticulatedObject, asset: Asset, config: MirrorConfig = MirrorConfig()
) -> tuple[JointRequest, ...]:
    """Returns how the mirrors among the static parts of an object swivel; `asset` is what it was made from."""
    called = _called_mirrors(asset)
    if not called:
        return ()
    boxes = {visual.name: visual.mesh.box for visual in made.link(made.root).visuals}
    return tuple(_requests([name for name in called if name in boxes], boxes, at_scale(config, metre_on(asset.extent))))


def _called_mirrors(asset: Asset) -> list[str]:
    names = {part.id: set(spoken(part.source.name)) for part in asset.parts if part.carried_by is None}
    return [name for name, called in names.items() if _MIRROR in called and not _HOLDS & called]


def _requests(mirrors: Sequence[str], boxes: dict[str, Box], config: MirrorConfig) -> Iterator[JointRequest]:
    taken: set[str] = set()
    for name in sorted(mirrors, key=lambda name: -float(np.prod(np.sort(boxes[name].size)[1:]))):
        if name in taken:
            continue
        pieces = [other for other in mirrors if boxes[other].overlaps(boxes[name], config.touching)]
        whole = Box.enclosing(boxes[piece] for piece in pieces)
        others = [box for other, box in boxes.items() if other not in pieces]
        if _is_between_posts(whole, others, config):
            taken.update(pieces)
            across = vec3(1.0, 0.0, 0.0) if whole.thin_axis == 1 else vec3(0.0, 1.0, 0.0)
            attached = tuple(piece for piece in pieces if piece != name)
            axis = Axis(whole.center, across)
            yield JointRequest(name, Hinge.joint_type, axis, SOURCE, config.tilt, attached=attached)


def _is_between_posts(mirror: Box, others: Sequence[Box], config: MirrorConfig) -> bool:
    """Whether a slim upright plate has something beside both its edges at half height, and nothing right below it."""
    thin = mirror.thin_axis
    if thin == _UP or mirror.size[thin] > config.thin * np.delete(mirror.size, thin).min():
        return False
    across = 1 - thin
    half = 0.5 * config.middle * float(mirror.size[_UP])
    low, high = float(mirror.center[_UP]) - half, float(mirror.center[_UP]) + half
    tall = [box for box in others if box.low[_UP] <= low and box.high[_UP] >= high]
    beside = [box for box in tall if box.low[thin] < mirror.high[thin] and box.high[thin] > mirror.low[thin]]
    gaps = np.array([[mirror.low[across] - box.high[across], box.low[across] - mirror.high[across]] for box in beside])
    return len(gaps) > 1 and bool((np.abs(gaps) <= config.gap).any(axis=0).all())
