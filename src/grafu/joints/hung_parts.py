"""What hangs on a door or drawer goes with it: liners, bins and racks on a door's inside, edges of a hollow leaf.

Such parts lie within the outline of the front and touch nothing but it; runners, hinges and handles hold nothing. What
was guessed to move by itself does not where the front covers it. What is on the link of the body of a robot hangs on no
front of another link. They are found by boxes and contacts, so fronts that
stand turned about Z keep what they were predicted to carry.
"""

from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Final, final

from grafu.asset.body_link import body_link
from grafu.asset.names import spoken
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.geometry.touching import near_pairs, touching_pairs
from grafu.joints.behind_fronts import groups_held_by
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

_DEPTH = 1
_ACROSS = [0, 2]
_SOFT: Final = frozenset({"gasket", "seal"})
"""Words of parts that a closed door presses against its case: of what they touch, both may be."""
_STAY: Final = frozenset({PartLabel.LEG, PartLabel.HANDLE})


@final
@dataclass(frozen=True)
class HungPartsConfig:
    """What hangs on a front; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("touching", "slack")
    touching: float = 0.0003
    """As near as this a part touches another (metres): rounding, and no clearance."""
    slack: float = 0.004
    """How far a part may stand out of the outline of its front (metres)."""
    deep: float = 0.5
    """How far behind its front a part reaches at most (fraction of the depth of the piece of furniture): a shelf may
    touch it, and of a cabinet on a wall the case touches nothing else."""
    small: float = 0.5
    """The outline of what was guessed to move by itself at most (fraction of the front's)."""

    def __post_init__(self) -> None:
        require_positive(self, "touching", "slack")
        require_ratios(self, "deep", "small")


def with_hung_parts(
    plan: RealizationPlan, asset: Asset, settled: Collection[str] = (), config: HungPartsConfig = HungPartsConfig()
) -> RealizationPlan:
    """Returns the plan in which what hangs on a front alone is attached to it, and does not move by itself.

    Args:
        plan: the joints.
        asset: all parts.
        settled: the parts whose motions the user states.
        config: the thresholds.
    """
    config = at_scale(config, metre_on(asset.extent))
    made = {request.moving: request for request in plan.joints}
    for request in sorted(plan.joints, key=lambda r: -_outline(asset.part(r.moving).box)):
        if request.moving in made and _may_carry(made[request.moving], asset):
            own = made[request.moving]
            hung = _hung_on(own, asset, made, settled, config)
            gone = [name for name in hung if name in made]
            riding = [part for name in gone for part in made[name].attached if part not in hung]
            made[request.moving] = replace(own, attached=tuple(dict.fromkeys((*own.attached, *hung, *riding))))
            made = {name: other for name, other in made.items() if name not in gone}
    return replace(plan, joints=tuple(made[r.moving] for r in plan.joints if r.moving in made))


def _outline(box: Box) -> float:
    return float(box.size[_ACROSS].prod())


def _may_carry(request: JointRequest, asset: Asset) -> bool:
    """Whether a request moves a front that faces -Y."""
    part = asset.part(request.moving)
    return part.box.thin_axis == _DEPTH and (part.label.is_movable or part.label is PartLabel.UNKNOWN)


def _hung_on(
    request: JointRequest,
    asset: Asset,
    made: Mapping[str, JointRequest],
    settled: Collection[str],
    config: HungPartsConfig,
) -> list[str]:
    """Returns the parts that hang on the front of a request, and the gaskets that are pressed between it and its case.

    What else moves stays what it is, unless it was taken for a door and lies hidden behind the front.
    """
    own, front = {request.moving, *request.attached}, asset.part(request.moving).box
    guessed = (asset.part(name) for name in made if name not in settled and name != request.moving)
    covered = {part.id for part in guessed if _is_covered_guess(part, front, config)}
    others = [other for name, other in made.items() if name not in covered and name != request.moving]
    taken = {part for other in others for part in (other.moving, *other.attached)} | (own - covered)
    body = body_link(asset)
    fixed = body if asset.part(request.moving).source.link != body else ""
    farthest = float(front.low[_DEPTH]) + config.deep * float(_piece_of(request.moving, asset).size[_DEPTH])
    loose = (p for p in asset.parts if p.id not in taken and not (fixed and p.source.link == fixed))
    near = (p for p in loose if _lies_within(p.box, front, config.slack))
    inside = {p.id for p in near if p.label not in _STAY and p.box.high[_DEPTH] <= farthest}
    soft = {name for name in inside if _SOFT & set(spoken(asset.part(name).source.name))}
    held = own - inside
    found = [name for group in groups_held_by(held, inside - soft, asset, config.touching, soft) for name in group]
    return [*found, *_pressed(soft, held.union(found), asset, config.touching)]


def _piece_of(part: str, asset: Asset) -> Box:
    """Returns the box of the piece of furniture that has a part: that of all where they are one piece."""
    standing = asset.standing_of(part)
    known = {one.id: one.box for one in asset.parts}
    boxes = [known[name] for name in standing.parts if name in known] if standing is not None else []
    return Box.enclosing(boxes) if boxes else asset.box


def _pressed(soft: Collection[str], moving: Collection[str], asset: Asset, tolerance: float) -> list[str]:
    """Returns the gaskets that touch what moves, whatever else they touch as it is closed."""
    parts = [asset.part(name) for name in (*sorted(soft), *sorted(moving))]
    pairs = [pair for pair in near_pairs([p.box for p in parts], tolerance) if pair[0] < len(soft) <= pair[1]]
    touching = {first for first, _ in touching_pairs([p.mesh for p in parts], pairs, tolerance)}
    return [parts[k].id for k in sorted(touching)]


def _lies_within(box: Box, front: Box, slack: float) -> bool:
    """Whether a box lies within the outline of a front, or of what stands out of it: not beside it."""
    inside = (box.low >= front.low - slack)[_ACROSS].all() and (box.high <= front.high + slack)[_ACROSS].all()
    return bool(inside)


def _is_covered_guess(part: Part, front: Box, config: HungPartsConfig) -> bool:
    """Whether a part that was taken for a door or drawer is hidden behind a front, and much smaller than it."""
    behind = part.box.low[_DEPTH] >= front.high[_DEPTH] - config.touching
    is_whole = part.label is PartLabel.DRAWER
    return bool(behind) and not is_whole and _outline(part.box) <= config.small * _outline(front)
