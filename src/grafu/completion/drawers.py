"""How a drawer runs: the direction it opens in and the parts that its rails are on (the rule-based baseline, on boxes).

A drawer opens towards its handle, away from what blocks it, towards the nearer outer face of the body. It runs
between two flanks where there are two, else on whatever is near.
"""

import numpy as np

from grafu.completion.answers import MotionAnswer, decision_of
from grafu.completion.rule_scene import CARRIES, RuleScene
from grafu.completion.votes import Ranking, Votes
from grafu.geometry.box import Box
from grafu.graph.edges import Rail, SignedAxis
from grafu.graph.functional_graph import PartNode
from grafu.graph.motion import code_to_direction, opposite, signed_axis
from grafu.refusal import Reason, Refusal

_DIRECTIONS: tuple[SignedAxis, ...] = (2, 3, 0, 1)  # -Y first: the frame's front


def run_drawer(drawer: PartNode, scene: RuleScene) -> MotionAnswer:
    """Returns the rails of a drawer with the confidence of each choice, or why it gets none."""
    if not scene.supports:
        return Refusal(drawer.id, Reason.NO_MOTION, "there is no static part to run it on: label the static parts")
    direction = vote_direction(drawer, scene)
    mounts = _flanks(drawer, direction.choice, scene) or _nearest(drawer, scene)
    if not mounts:
        return Refusal(drawer.id, Reason.NO_MOTION, "no static part is near enough to carry a rail")
    rails = tuple(Rail(mount.choice, drawer.id, direction.choice) for mount in mounts)
    decisions = (decision_of(drawer.id, "mount", mount) for mount in mounts)
    return rails, (decision_of(drawer.id, "slide", direction), *decisions)


def vote_direction(drawer: PartNode, scene: RuleScene) -> Ranking[SignedAxis]:
    """Returns the signed axis along which the drawer opens."""
    votes: Votes[SignedAxis] = Votes(_DIRECTIONS)
    votes.add(2, 0.6)
    for handle in scene.handles_of(drawer):
        for direction in _DIRECTIONS:
            votes.add(direction, 5.0 * _sits_on(handle.box, drawer.box, direction))
    blocked = _blocked_ratios(drawer, scene)
    for direction in _DIRECTIONS:
        inside = max(_depth_inside(drawer.box, scene.body, direction) / scene.extent, 0.0)
        votes.add(direction, 1.5 * float(np.exp(-inside / scene.config.drawers.inside)))
        votes.add(direction, -4.0 * blocked[direction])
    return votes.ranking()


def _sits_on(handle: Box, drawer: Box, direction: SignedAxis) -> bool:
    """Whether the handle's middle lies in front of a face of the drawer, or within a handle's size behind it."""
    axis, sense = direction // 2, float(code_to_direction(direction)[direction // 2])
    ahead = sense * float(handle.center[axis] - drawer.face_center(direction)[axis])
    others = [a for a in range(3) if a != axis]
    in_front = all(drawer.low[a] <= handle.center[a] <= drawer.high[a] for a in others)
    return in_front and ahead > -float(handle.size[axis])


def _depth_inside(box: Box, body: Box, direction: SignedAxis) -> float:
    """Returns how far behind the body's face a box's face lies, metres; negative where it stands out."""
    return float((body.face_center(direction) - box.face_center(direction)) @ code_to_direction(direction))


def _blocked_ratios(drawer: PartNode, scene: RuleScene) -> dict[SignedAxis, float]:
    """Returns for each direction the fraction of the drawer's section that parts in its path cover, 0..1.

    A part that lies within the drawer's box close to its face counts half: it may be the panel that an overlaid front
    covers. Face frames leave the drawer its opening.
    """
    ratios = scene.blocker_boxes.overlap_ratios(drawer.box)
    places = scene.blocker_boxes.offset_ratios(drawer.box)
    found: dict[SignedAxis, float] = {}
    for direction in _DIRECTIONS:
        place = places[:, direction // 2] * code_to_direction(direction)[direction // 2]
        weight = np.where(place > 1.0, 1.0, np.where(place > scene.config.drawers.face, 0.5, 0.0))
        section = np.delete(ratios, direction // 2, axis=1).prod(axis=1)
        found[direction] = min(float((weight * section).sum()), 1.0)
    return found


def _flanks(drawer: PartNode, direction: SignedAxis, scene: RuleScene) -> list[Ranking[str]]:
    """Returns the best carrier on each side of the drawer; one part around both sides comes once."""
    across = 1 - direction // 2
    sides = (_best_flank(drawer, signed_axis(across, high), direction // 2, scene) for high in (False, True))
    return list({side.choice: side for side in sides if side is not None}.values())


def _best_flank(drawer: PartNode, side: SignedAxis, slide: int, scene: RuleScene) -> Ranking[str] | None:
    ratios = scene.support_boxes.overlap_ratios(drawer.box)
    alongside, least = ratios[:, 2] * ratios[:, slide], scene.config.drawers.least_flank
    scored = {
        node.id: alongside[k] * CARRIES[node.label] * _nearness(drawer, node, side, scene)
        for k, node in enumerate(scene.supports)
        if alongside[k] > least
    }
    return _elect({node_id: float(score) for node_id, score in scored.items() if score > least})


def _nearness(drawer: PartNode, node: PartNode, side: SignedAxis, scene: RuleScene) -> float:
    """Returns how near a part is to one flank of the drawer, 0..1.

    It may lie within the drawer's box, where an overlaid front is wider than the drawer.
    """
    config, outward, flank = scene.config.drawers, code_to_direction(side), drawer.box.face_center(side)
    inner = float((node.box.face_center(opposite(side)) - flank) @ outward)
    outer = float((node.box.face_center(side) - flank) @ outward)
    width = float(drawer.box.size[side // 2])
    if outer < -config.behind_front * width or inner > config.reach * scene.extent:
        return 0.0
    surrounds = outer > 0 and inner < -0.5 * width
    away = inner if inner > 0 else -0.3 * inner
    return 0.5 if surrounds else float(np.exp(-away / (config.near * scene.extent)))


def _nearest(drawer: PartNode, scene: RuleScene) -> list[Ranking[str]]:
    """Returns the one part that carries a drawer without flanks: a tray hangs under its top."""
    config = scene.config.drawers
    gaps = zip(scene.supports, scene.support_boxes.gaps(drawer.box) / scene.extent, strict=True)
    near = ((n, gap) for n, gap in gaps if gap <= config.reach)
    found = _elect({n.id: float(np.exp(-gap / config.near)) * CARRIES[n.label] for n, gap in near})
    return [] if found is None else [found]


def _elect(scores: dict[str, float]) -> Ranking[str] | None:
    if not scores:
        return None
    votes = Votes(tuple(scores))
    for node_id, score in scores.items():
        votes.add(node_id, 3.0 * score)
    return votes.ranking()
