"""Single doors that are called sliding slide beside their opening; doors that lap each other are found before.

They are found by boxes, so leaves that stand turned about Z stay as they were predicted.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.names import spoken
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.graph.edges import Slide
from grafu.joints.plan import JointRequest, RealizationPlan

SOURCE = "rule"
"""`JointRequest.source` of a sliding door: its name tells."""
_WORDS = ("sliding", "slide", "bypass")  # or what begins so: `slidelink`
_KINDS = frozenset({"pocket", "barn"})  # of sliding doors, by where they go and what they come from
_UP = 2


@final
@dataclass(frozen=True)
class NamedSlideConfig:
    """When a door that is called sliding does so; all are fractions of its own sides.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    thin: float = 0.2
    """Greatest thickness of a leaf (fraction of its shorter other side)."""
    room: float = 0.5
    """Within the piece it needs room beside it for at least this fraction of its width."""
    lap: float = 0.1
    """What it cuts into by more than this as it slides, another door, blocks it (fraction of its thickness)."""

    def __post_init__(self) -> None:
        require_ratios(self, "thin", "room", "lap")


def with_sliding_doors(
    plan: RealizationPlan, asset: Asset, config: NamedSlideConfig = NamedSlideConfig()
) -> RealizationPlan:
    """Returns the plan in which doors that are called sliding slide to the side with more room, and do not turn.

    What rides on a leaf goes with it. A leaf without room on either side stays as it was predicted.
    """
    doors = [asset.part(request.moving) for request in plan.joints if request.kind.turns]
    joints = (_sliding(r, asset, doors, config) if r.kind.turns and not r.parent else r for r in plan.joints)
    return replace(plan, joints=tuple(joints))


def _sliding(request: JointRequest, asset: Asset, doors: list[Part], config: NamedSlideConfig) -> JointRequest:
    """Returns the request of a hinged door that is called sliding as one that slides; any other as it is."""
    leaf = asset.part(request.moving)
    if not any(word.startswith(_WORDS) or word in _KINDS for word in spoken(leaf.source.name)):
        return request
    own = {leaf.id, *request.attached}
    static = [part.box for part in asset.parts if part.id not in own and not part.label.is_movable]
    shift = next(_shifts(leaf, asset, doors, static, config), None)
    if shift is None:
        return request
    reach = float(np.abs(shift).max())
    axis = Axis(leaf.box.center, shift / reach)
    return JointRequest(request.moving, Slide.joint_type, axis, SOURCE, reach, (), request.attached)


def _shifts(leaf: Part, asset: Asset, doors: list[Part], static: list[Box], config: NamedSlideConfig) -> Iterator[Vec3]:
    """Yields the shifts of an upright leaf along X or Y to beside where it stands, metres, the longer first.

    What ends in the box of a static part comes after what does not: a pocket is beside the wall on the other side.
    """
    across = int(np.argmin(leaf.box.size))
    if across == _UP or leaf.box.size[across] > config.thin * np.delete(leaf.box.size, across).min():
        return
    along = 1 - across
    width = float(leaf.box.size[along])
    rooms = ((asset.box.high - leaf.box.high)[along], (leaf.box.low - asset.box.low)[along])
    inner = leaf.box.grown(-config.lap * float(leaf.box.size[across]))
    shifts = [sign * min(float(room), width) * np.eye(3)[along] for room, sign in zip(rooms, (1.0, -1.0), strict=True)]
    paths = [Box(inner.low + shift, inner.high + shift) for shift in shifts]
    blocked = [any(box.overlaps(path) for box in static) for path in paths]
    for _, _, room, shift, moved in sorted(
        zip(blocked, (-room for room in rooms), rooms, shifts, paths, strict=True), key=lambda side: side[:2]
    ):
        if room >= config.room * width and not any(d is not leaf and d.box.overlaps(moved) for d in doors):
            yield shift
