"""What doors and windows of buildings have in common: leaves in a frame, with what is on each of them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.graph.edges import Hinge
from grafu.joints.drawn_across import closes_about, is_along
from grafu.joints.motion_choice import DIRECTIONS, MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a leaf in a frame: its shape tells."""
_WIDTH, _DEPTH, _UP = 0, 1, 2
_ACROSS = "it is drawn open, across its frame: close it in the model"

LeafRequest = Callable[[Part, Sequence[Part]], JointRequest | None]
"""Returns the joint of a leaf with what is on it; None where it stays."""


@final
@dataclass(frozen=True, eq=False)
class FramedLeaves:
    """A frame, its leaves, and what is on each leaf: panes, bars, handles, locks; `inner_frames` stand in the frame."""

    frame: Part
    leaves: tuple[Part, ...]
    on_leaf: tuple[tuple[Part, ...], ...]
    inner_frames: tuple[Part, ...] = ()

    def is_fixed(self, leaf: Part) -> bool:
        """Whether a leaf is fixed in the frame: others are called doors, and it is not."""
        return not is_called_door(leaf) and any(is_called_door(other) for other in self.leaves)

    def held_side(self, leaf: Part, near: float, level: float) -> Side | None:
        """Returns the upright edge of a leaf that can hang on something; None where both can, or none.

        At the other edge stands a leaf that turns itself: no farther away than the fraction `near` of the width of the
        leaf, and along the fraction `level` of its height at least.
        """
        turning = [other.box for other in self.leaves if other is not leaf and not self.is_fixed(other)]
        sides = (Side.LEFT, Side.RIGHT)
        free = [side for side in sides if not any(_meets(leaf, side, box, near, level) for box in turning)]
        return free[0] if len(free) == 1 else None

    def with_joints(self, plan: RealizationPlan, asset: Asset, request: LeafRequest) -> RealizationPlan:
        """Returns the plan whose joints are those of the leaves alone.

        A leaf that is drawn open, across its frame, closes about the edge about which it fits there; it is refused
        where it fits about none.
        """
        joints, across = list[JointRequest](), list[Refusal]()
        for leaf, on_it in zip(self.leaves, self.on_leaf, strict=True):
            opened = None if is_along(leaf) else closes_about(leaf, self.frame.box)
            if opened is not None:
                attached = tuple(part.id for part in on_it)
                made = JointRequest(leaf.id, Hinge.joint_type, opened.axis, SOURCE, attached=attached)
                joints.append(replace(made, drawn_at=opened.angle))
            elif not is_along(leaf):
                across.append(Refusal(leaf.id, Reason.NO_MOTION, _ACROSS))
            elif (found := request(leaf, on_it)) is not None:
                joints.append(found)
        parts = {part.id for part in asset.parts}
        refused = (*(r for r in plan.refused if r.part not in parts), *across)
        return replace(plan, joints=tuple(joints), refused=refused)


def _meets(leaf: Part, side: Side, other: Box, near: float, level: float) -> bool:
    """Whether a box stands right at one side of a leaf, along most of its height."""
    box, along = leaf.box, DIRECTIONS[side]
    gap = float(along @ (other.center - box.center) - abs(along) @ (other.half + box.half))
    shared = min(box.high[_UP], other.high[_UP]) - max(box.low[_UP], other.low[_UP])
    return bool(abs(gap) <= near * box.size[_WIDTH] and shared >= level * box.size[_UP])


def is_called_door(part: Part) -> bool:
    """Whether a part is a door by its name, or by the user."""
    return part.label is PartLabel.DOOR and part.labelled_by in ("name", "user")


def relabelled(asset: Asset, labels: Mapping[str, PartLabel]) -> Asset:
    """Returns the asset in which shape has given some parts other labels; those that the user gave stay."""
    parts = (
        part
        if labels.get(part.id, part.label) is part.label or part.labelled_by == "user"
        else replace(part, label=labels[part.id], labelled_by="shape")
        for part in asset.parts
    )
    return replace(asset, parts=tuple(parts))


def turning_leaf(leaf: Part, on_it: Sequence[Part], asset: Asset, side: Side, opens_backwards: bool) -> JointRequest:
    """Returns the joint of a leaf that turns about one of its edges, to the viewer or away from them."""
    axes = (axis_of_motion(leaf, MotionChoice(Moves.TURNS, side, inwards=k), asset.box) for k in (False, True))
    axis = next(axis for axis in axes if (_sets_off(axis, side) > 0) == opens_backwards)
    return JointRequest(leaf.id, Hinge.joint_type, axis, SOURCE, attached=tuple(part.id for part in on_it))


def _sets_off(axis: Axis, side: Side) -> float:
    """Returns the depth component of the direction in which a leaf's free edge sets off."""
    return float(np.cross(axis.direction, -DIRECTIONS[side])[_DEPTH])


def nearer_to_back(leaf: Part, frame: Box, flush: float) -> bool | None:
    """Whether a leaf is nearer to the back face of its frame than to the front; None where it is in the middle.

    It is in the middle where the two gaps differ by at most the fraction `flush` of the frame's depth.
    """
    before = float(leaf.box.low[_DEPTH] - frame.low[_DEPTH])
    behind = float(frame.high[_DEPTH] - leaf.box.high[_DEPTH])
    if abs(before - behind) <= flush * float(frame.size[_DEPTH]):
        return None
    return before > behind
