"""How a drawer runs: the way it opens and the parts that its rails are on (carpenters' rules on boxes).

A drawer opens towards its handle, away from what stands in its way, towards the nearer outer face of the body. It runs
between two flanks where there are two, else on whatever is near.
"""

import numpy as np

from grafu.completion.ballot import Ballot, Verdict
from grafu.completion.scene import CARRIES, Scene, overlap_share
from grafu.geometry.box import Box
from grafu.graph.completion import Decision, RefusedMotion
from grafu.graph.edges import Rail, SignedAxis
from grafu.graph.functional_graph import PartNode
from grafu.graph.motion import code_to_direction, opposite, signed_axis
from grafu.vocabulary import PartLabel

_WAYS: tuple[SignedAxis, ...] = (2, 3, 0, 1)  # -Y first: the frame's front
_NEAR = 0.03  # shares of the object
_REACH = 0.15


def run_drawer(drawer: PartNode, scene: Scene) -> tuple[tuple[Rail, ...], tuple[Decision, ...]] | RefusedMotion:
    """Returns the rails of a drawer with how sure each choice is, or why it gets none."""
    if not scene.supports:
        return RefusedMotion(drawer.id, "there is no static part to run it on: label the parts that stand still")
    way = vote_way(drawer, scene)
    mounts = _flanks(drawer, way.choice, scene) or _nearest(drawer, scene)
    if not mounts:
        return RefusedMotion(drawer.id, "no static part is near enough to carry a rail")
    rails = tuple(Rail(node_id, drawer.id, way.choice) for node_id, _ in mounts)
    runner_up = "" if way.runner_up is None else str(way.runner_up)
    slide = Decision(drawer.id, "slide", str(way.choice), way.score, runner_up, way.runner_up_score)
    return rails, (slide, *(Decision(drawer.id, "mount", node_id, score) for node_id, score in mounts))


def vote_way(drawer: PartNode, scene: Scene) -> Verdict[SignedAxis]:
    """Returns the signed axis along which the drawer opens."""
    ballot: Ballot[SignedAxis] = Ballot(_WAYS)
    ballot.vote(2, 0.6)
    for handle in scene.handles_of(drawer):
        for way in _WAYS:
            ballot.vote(way, 5.0 * _sits_on(handle.box, drawer.box, way))
    for way in _WAYS:
        inside = max(_depth_inside(drawer.box, scene.body, way) / scene.unit, 0.0)
        ballot.vote(way, 1.5 * float(np.exp(-inside / 0.05)))
        ballot.vote(way, -4.0 * _blocked_share(drawer, way, scene))
    return ballot.verdict()


def _sits_on(handle: Box, drawer: Box, way: SignedAxis) -> bool:
    """Whether the handle's middle lies in front of a face of the drawer, or within a handle's size behind it."""
    axis, sense = way // 2, float(code_to_direction(way)[way // 2])
    ahead = sense * float(handle.center[axis] - drawer.face_center(way)[axis])
    others = [a for a in range(3) if a != axis]
    in_front = all(drawer.low[a] <= handle.center[a] <= drawer.high[a] for a in others)
    return in_front and ahead > -float(handle.size[axis])


def _depth_inside(box: Box, body: Box, way: SignedAxis) -> float:
    """Returns how far behind the body's face a box's face lies, metres; negative where it stands out."""
    return float((body.face_center(way) - box.face_center(way)) @ code_to_direction(way))


def _blocked_share(drawer: PartNode, way: SignedAxis, scene: Scene) -> float:
    """Returns the share of the drawer's section that static parts and other drawers cover ahead of it, 0..1."""
    axis, sense = way // 2, float(code_to_direction(way)[way // 2])
    face = float(drawer.box.face_center(way)[axis])
    covered = 0.0
    for node in scene.graph.nodes:
        if node.id == drawer.id or not (node.label.is_support or node.label is PartLabel.DRAWER):
            continue
        if sense * (float(node.box.center[axis]) - face) > 0:
            others = [a for a in range(3) if a != axis]
            covered += float(np.prod([overlap_share(drawer.box, node.box, a) for a in others]))
    return min(covered, 1.0)


def _flanks(drawer: PartNode, way: SignedAxis, scene: Scene) -> list[tuple[str, float]]:
    """Returns the best carrier on each side of the drawer with its score; one part around both sides comes once."""
    across = 1 - way // 2
    low = _best_flank(drawer, signed_axis(across, False), way // 2, scene)
    high = _best_flank(drawer, signed_axis(across, True), way // 2, scene)
    found: dict[str, float] = {}
    for flank in (low, high):
        if flank is not None:
            found[flank[0]] = max(flank[1], found.get(flank[0], 0.0))
    return list(found.items())


def _best_flank(drawer: PartNode, side: SignedAxis, slide: int, scene: Scene) -> tuple[str, float] | None:
    scored = [(node.id, _flank_score(drawer, node, side, slide, scene)) for node in scene.supports]
    best = max(scored, key=lambda item: item[1], default=None)
    return best if best is not None and best[1] > 0.05 else None


def _flank_score(drawer: PartNode, node: PartNode, side: SignedAxis, slide: int, scene: Scene) -> float:
    """Returns how well a part carries a rail on one side of the drawer, 0..1: near its flank and alongside it."""
    across = side // 2
    inner = float((node.box.face_center(opposite(side)) - drawer.box.face_center(side)) @ code_to_direction(side))
    outer = float((node.box.face_center(side) - drawer.box.face_center(side)) @ code_to_direction(side))
    if outer < -0.25 * float(drawer.box.size[across]) or inner > _REACH * scene.unit:
        return 0.0
    surrounds = outer > 0 and inner < -0.5 * float(drawer.box.size[across])
    near = 0.5 if surrounds else float(np.exp(-abs(inner) / (_NEAR * scene.unit)))
    alongside = overlap_share(drawer.box, node.box, 2) * overlap_share(drawer.box, node.box, slide)
    return near * alongside * CARRIES[node.label]


def _nearest(drawer: PartNode, scene: Scene) -> list[tuple[str, float]]:
    """Returns the one part that carries a drawer without flanks: a tray hangs under its top."""
    gaps = [(drawer.box.gap(node.box) / scene.unit, node) for node in scene.supports]
    scored = [(node.id, float(np.exp(-gap / _NEAR)) * CARRIES[node.label]) for gap, node in gaps if gap <= _REACH]
    return [max(scored, key=lambda item: item[1])] if scored else []
