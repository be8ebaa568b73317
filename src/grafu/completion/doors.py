"""How a door hangs: its front, the border of its hinge, and its mount (the rule-based baseline, on boxes).

The handle decides where it sits clearly off-centre: the hinge is opposite. Else doors of a pair hang on their outer
sides, a wide flap on its top or bottom, a lid on its back, a single door on the side nearer to the body's end. Every
rule is a vote; the weights were set by hand on real cabinets.
"""

from typing import cast

import numpy as np

from grafu.completion.answers import MotionAnswer, decision_of
from grafu.completion.rows import across_axis, pair_side, row_size
from grafu.completion.rule_scene import CARRIES, RuleScene, offset_ratio
from grafu.completion.votes import Ranking, Votes
from grafu.geometry.box import Box
from grafu.graph.completion import Decision
from grafu.graph.edges import Hinge, HingeBorder, SignedAxis, Slide
from grafu.graph.functional_graph import PartNode
from grafu.graph.motion import (
    border_to_face,
    code_to_direction,
    face_to_border,
    plane_axes,
    sign_for_opening,
    signed_axis,
)
from grafu.refusal import Reason, Refusal


def hang_door(door: PartNode, scene: RuleScene) -> MotionAnswer:
    """Returns the hinge of a door with the confidence of each choice, or why it gets none."""
    if not scene.supports:
        return Refusal(door.id, Reason.NO_MOTION, "there is no static part to hang it on: label the static parts")
    thin = door.box.thin_axis
    front, border = vote_front(door, scene), vote_border(door, scene)
    mount = vote_mount(door, border.choice, scene)
    if mount is None:
        return Refusal(
            door.id, Reason.NO_MOTION, "no static part is near enough to any of its borders to carry a hinge"
        )
    sign = sign_for_opening(thin, border.choice, front.choice)
    flipped = "" if front.runner_up is None else str(1 - sign)
    decisions = (
        decision_of(door.id, "border", border),
        Decision(door.id, "sign", str(sign), front.score, flipped, front.runner_up_score),
        decision_of(door.id, "mount", mount),
    )
    return (Hinge(mount.choice, door.id, border.choice, sign),), decisions


def slide_door(door: PartNode, other: PartNode, scene: RuleScene) -> MotionAnswer:
    """Returns the slide of a door past another that it laps, on what stands below or above it; or why it gets none."""
    across = across_axis(door)
    mounts = (vote_mount(door, _border(door, 2, high), scene) for high in (False, True))
    mount = next((found for found in mounts if found is not None), None)
    if mount is None:
        return Refusal(door.id, Reason.NO_MOTION, f"it laps {other.id}, so it slides, but nothing near carries a track")
    towards = bool(other.box.center[across] > door.box.center[across])
    votes: Votes[SignedAxis] = Votes((signed_axis(across, False), signed_axis(across, True)))
    votes.add(signed_axis(across, towards), 3.0)
    slide = votes.ranking()
    decisions = (decision_of(door.id, "slide", slide), decision_of(door.id, "mount", mount))
    return (Slide(mount.choice, door.id, slide.choice),), decisions


def vote_front(door: PartNode, scene: RuleScene) -> Ranking[SignedAxis]:
    """Returns the broad face that looks away from the body: handles sit there, and the body's middle is behind it."""
    thin, box = door.box.thin_axis, door.box
    low, high = signed_axis(thin, False), signed_axis(thin, True)
    votes: Votes[SignedAxis] = Votes((low, high))
    for handle in scene.handles_of(door):
        above = max(float(handle.box.high[thin] - box.high[thin]), 0.0)
        below = max(float(box.low[thin] - handle.box.low[thin]), 0.0)
        if abs(above - below) > scene.config.doors.stands_out * float(handle.box.size[thin]):
            votes.add(high if above > below else low, 4.0)
    place = offset_ratio(scene.body, box.center, thin)
    votes.add(high if place > 0 else low, 3.0 * min(abs(place), 1.0))
    votes.add(2, 0.5)  # the frame's front is -Y,
    votes.add(5, 0.5)  # and a lid opens upwards
    return votes.ranking()


def vote_border(door: PartNode, scene: RuleScene) -> Ranking[HingeBorder]:
    """Returns the border that the hinge is on."""
    thin = door.box.thin_axis
    votes: Votes[HingeBorder] = Votes((0, 1, 2, 3))
    if thin == 2:
        _vote_lid(door, scene, votes)
    else:
        _vote_upright(door, scene, votes)
    for border in cast(tuple[HingeBorder, ...], (0, 1, 2, 3)):
        carriers = [score for _, score in _carriers(door, border, scene)]
        votes.add(border, 0.7 * max(carriers, default=0.0) if carriers else -2.0)
    return votes.ranking()


def plain_flap(door: PartNode, scene: RuleScene) -> HingeBorder | None:
    """Returns the border of a door that can only be a flap, None of any other.

    Half as wide again as high, and its handle in the middle of its upper or lower edge: no hinged door is pulled there
    that swings sideways.
    """
    config = scene.config.doors
    if door.box.thin_axis == 2 or _aspect(door) < config.plain:
        return None
    offsets = _handle_offsets(door, scene)
    aside, aloft = offsets.get(across_axis(door), 1.0), offsets.get(2, 0.0)
    is_flap = abs(aside) <= config.slight and abs(aloft) > config.clear
    return _border(door, 2, aloft < 0) if is_flap else None


def vote_mount(door: PartNode, border: HingeBorder, scene: RuleScene) -> Ranking[str] | None:
    """Returns the static part that carries the door at a border, or None where none is near."""
    carriers = _carriers(door, border, scene)
    if not carriers:
        return None
    votes = Votes(tuple(node.id for node, _ in carriers))
    for node, score in carriers:
        votes.add(node.id, 3.0 * score)
    return votes.ranking()


def _vote_lid(door: PartNode, scene: RuleScene, votes: Votes[HingeBorder]) -> None:
    for axis, offset in _handle_offsets(door, scene).items():
        if abs(offset) > scene.config.doors.clear:
            votes.add(_border(door, axis, offset < 0), 5.0 * min(abs(offset), 1.0))
    votes.add(_border(door, 1, True), 2.0)  # the back, where the front is -Y


def _vote_upright(door: PartNode, scene: RuleScene, votes: Votes[HingeBorder]) -> None:
    across = across_axis(door)
    paired = pair_side(door, scene)
    sideways, upwards = _vote_handle(door, scene, votes)
    if not (sideways or upwards):
        _vote_flap(door, scene, votes)
    if paired != "none":
        votes.add(_border(door, across, paired == "high"), 2.5)
    elif not upwards:
        _vote_outer_side(door, scene, votes)


def _vote_handle(door: PartNode, scene: RuleScene, votes: Votes[HingeBorder]) -> tuple[bool, bool]:
    """Votes for the border opposite the handle; returns whether it spoke for a side and for top or bottom."""
    across, config = across_axis(door), scene.config.doors
    offsets = _handle_offsets(door, scene)
    if not offsets:
        return False, False
    aside, aloft = offsets[across], offsets[2]
    if abs(aside) > config.slight:
        weight = 6.0 * min(abs(aside), 1.0) if abs(aside) > config.clear else 1.5
        votes.add(_border(door, across, aside < 0), weight)
        return abs(aside) > config.clear, False
    if abs(aloft) > config.clear and _aspect(door) >= _least_flap_aspect(door, scene, aloft):
        votes.add(_border(door, 2, aloft < 0), 5.0 * min(abs(aloft), 1.0))
        return False, True
    return False, False


def _least_flap_aspect(door: PartNode, scene: RuleScene, aloft: float) -> float:
    """Returns from which width to height on a handle in the middle states flap; doors of a row often have it there."""
    config = scene.config.doors
    if row_size(door, scene) > 1:
        return config.wide_in_row
    return config.upright if abs(aloft) > config.edge else config.wide


def _vote_flap(door: PartNode, scene: RuleScene, votes: Votes[HingeBorder]) -> None:
    """Votes for the top of a high and the bottom of a low flap, where it is too wide to swing sideways."""
    if _aspect(door) >= scene.config.doors.very_wide:
        high = offset_ratio(scene.body, door.box.center, 2) >= 0
        votes.add(_border(door, 2, high), 3.0)


def _vote_outer_side(door: PartNode, scene: RuleScene, votes: Votes[HingeBorder]) -> None:
    across = across_axis(door)
    to_low = abs(float(door.box.low[across] - scene.body.low[across]))
    to_high = abs(float(door.box.high[across] - scene.body.high[across]))
    if abs(to_low - to_high) > scene.config.doors.nearer_end * float(door.box.size[across]):
        votes.add(_border(door, across, to_high < to_low), 1.5)
    else:
        # Nothing decides: hung on the right as one stands before it, so that turning the object changes nothing.
        right = np.cross([0.0, 0.0, 1.0], code_to_direction(vote_front(door, scene).choice))
        votes.add(_border(door, across, bool(right[across] > 0)), 0.2)


def _handle_offsets(door: PartNode, scene: RuleScene) -> dict[int, float]:
    """Returns where the handles sit in the door's plane on average: -1..1 along each of its two axes."""
    handles = scene.handles_of(door)
    if not handles:
        return {}
    middle = np.mean([h.box.center for h in handles], axis=0)
    return {axis: offset_ratio(door.box, middle, axis) for axis in plane_axes(door.box.thin_axis)}


def _aspect(door: PartNode) -> float:
    return float(door.box.size[across_axis(door)] / max(float(door.box.size[2]), 1e-9))


def _border(door: PartNode, axis: int, high: bool) -> HingeBorder:
    return face_to_border(door.box.thin_axis, signed_axis(axis, high))


def _carriers(door: PartNode, border: HingeBorder, scene: RuleScene) -> list[tuple[PartNode, float]]:
    """Returns the parts near a border with a score each, 0..1: near, alongside, of a label that carries."""
    edge = _border_box(door.box, border)
    along = next(a for a in plane_axes(door.box.thin_axis) if a != border_to_face(door.box.thin_axis, border) // 2)
    gaps = scene.support_boxes.gaps(edge) / scene.extent
    alongside = scene.support_boxes.overlap_ratios(edge)[:, along]
    found = []
    for k in np.flatnonzero(gaps <= scene.config.doors.reach):
        node = scene.supports[k]
        nearness = float(np.exp(-gaps[k] / scene.config.doors.near)) * (1.0 if scene.touch(door, node) else 0.8)
        found.append((node, nearness * (0.1 + 0.9 * float(alongside[k])) * CARRIES[node.label]))
    return found


def _border_box(box: Box, border: HingeBorder) -> Box:
    """Returns the face of a box that a border names, as a flat box."""
    face = border_to_face(box.thin_axis, border)
    low, high = box.low.copy(), box.high.copy()
    low[face // 2] = high[face // 2] = box.face_center(face)[face // 2]
    return Box(low, high)
