"""Exclusive choices from probabilities: a mount for a door, two rails for a drawer, a parent for a handle.

A motion is a property of the part, while the network answers for each pair: answers are averaged over the parts that
may carry it, each by how likely it does. A score is the network's own, or its decision states that it is a rule's. What
moves ends with its edges or with the reason why not.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from grafu.completion.answers import MotionAnswer, decision_of
from grafu.completion.doors import hang_door, plain_flap, vote_border, vote_mount
from grafu.completion.drawers import run_drawer
from grafu.completion.handles import sits_on_static, stands_apart
from grafu.completion.probabilities import softmax
from grafu.completion.rule_scene import RuleScene
from grafu.completion.view import GraphView
from grafu.completion.votes import Ranking, chosen_of, ranking_of
from grafu.geometry.arrays import Indices, Scalars
from grafu.graph.arrays import ATTACHED, HINGE, RAIL, SLIDE
from grafu.graph.completion import BY_BOTH, BY_RULE, Decision
from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS, Attached, Hinge, HingeBorder, Rail, SignedAxis, Slide
from grafu.graph.functional_graph import PartNode
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_NO_SUPPORT = "there is no static part that could carry it: label the static parts"
_NO_PARENT = "this handle sits on no door or drawer: label the part behind it, or leave it as decoration"


def choose_parent(handle: PartNode, view: GraphView) -> tuple[Attached, Decision] | Refusal:
    """Returns the door or drawer that a handle is fixed to, or why there is none."""
    if not len(view.moving_bodies):
        return Refusal(handle.id, Reason.NO_MOTION, _NO_PARENT)
    near = view.gaps(handle, view.moving_bodies) <= view.config.grasp * view.extent
    slots = np.array([k for k in view.moving_bodies[near] if _may_hold(handle, view.graph.nodes[k], view)], int)
    if not len(slots) or sits_on_static(handle, view.graph):
        return Refusal(handle.id, Reason.NO_MOTION, _NO_PARENT)
    ratios, none = parent_ratios(view.place[handle.id], slots, view)
    attached = view.probabilities.edge[view.place[handle.id], slots, ATTACHED]
    if none >= view.config.no_parent and attached.max() < 0.5:
        return Refusal(
            handle.id, Reason.NO_MOTION, f"the network takes it for decoration ({none:.2f}): it is on no door or drawer"
        )
    ranking = ranking_of(view.ids(slots), ratios)
    return Attached(ranking.choice, handle.id), decision_of(handle.id, "parent", ranking)


def _may_hold(handle: PartNode, part: PartNode, view: GraphView) -> bool:
    """Whether a handle, seen from where it stands, may be that of a door or drawer."""
    reach = view.config.slack * view.extent
    return not _is_behind(handle, part, view) and not stands_apart(handle.box, part, reach)


def _is_behind(handle: PartNode, door: PartNode, view: GraphView) -> bool:
    """Whether a handle lies inside the body, apart from a door at one of its sides: a bracket or a part of a rack."""
    if door.label is not PartLabel.DOOR or not len(view.supports):
        return False
    axis = door.box.thin_axis
    low, high = view.low[view.supports, axis].min(), view.high[view.supports, axis].max()
    out = float(door.box.center[axis] - (low + high) / 2)
    if abs(out) < view.config.at_side * (high - low):
        return False
    gap = door.box.low[axis] - handle.box.high[axis] if out > 0 else handle.box.low[axis] - door.box.high[axis]
    return bool(gap > view.config.slack * view.extent)


def parent_ratios(slot: int, slots: Indices, view: GraphView) -> tuple[Scalars, float]:
    """Returns how likely each of some doors and drawers is the parent of the handle in a slot, and none of them is.

    The choice among all is weighed by the edge of each pair, of which some chance always remains.
    """
    logits = np.append(view.probabilities.parent[slot, slots], view.probabilities.no_parent)
    chosen = softmax(logits)
    return chosen[:-1] * (view.config.some_parent + view.probabilities.edge[slot, slots, ATTACHED]), float(chosen[-1])


def borders_of(door: PartNode, view: GraphView) -> Scalars:
    """Returns what a door's choice among its four borders weighs, seen for itself; all 0 without supports."""
    if not len(view.supports):
        return np.zeros(len(BORDERS))
    return np.asarray(np.einsum("k,kbs->b", *_hinges(door, _carriers(door, view), view)))


def borders_without_handle(view: GraphView) -> dict[str, Scalars]:
    """Returns what the network states of the borders of each door of the input on which the input shows no handle."""
    held = {edge.parent for edge in view.graph.attachments if edge.child in view.given}
    doors = [n for n in view.graph.labelled(PartLabel.DOOR) if n.id in view.given - held] if len(view.supports) else []
    return {door.id: np.einsum("k,kbs->b", *_hinges(door, _carriers(door, view), view)) for door in doors}


def _carriers(door: PartNode, view: GraphView) -> Indices:
    """Returns the slots of what may carry a door: supports within reach, and doors that it likely hangs on."""
    return np.concatenate([view.within_reach(door, view.supports), view.hinged_doors(door)])


def _hinges(door: PartNode, slots: Indices, view: GraphView) -> tuple[Scalars, np.ndarray]:
    """Returns how likely each slot carries a door, and on each the table of border and sign (k, 4, 2)."""
    slot = view.place[door.id]
    mounts = softmax(view.probabilities.mount[slot, slots]) * view.probabilities.edge[slot, slots, HINGE]
    return mounts, view.probabilities.hinge[slot, slots]


def choose_hinge(door: PartNode, view: GraphView, scene: RuleScene, agreed: Scalars | float = 1.0) -> MotionAnswer:
    """Returns the hinge of a door, or its slide, with the confidence of each choice, or why it gets none.

    The network decides, but for flaps that are plain to see, and for doors that it sees nothing carry: with their side
    missing it never saw any, and the rule hangs them on what there is. `scene` is the same graph with its handles
    attached. `agreed` is 0 for a border that a door of a column does not take, see `agreed_borders`.
    """
    if not len(view.supports):
        return Refusal(door.id, Reason.NO_MOTION, _NO_SUPPORT)
    slot, slots = view.place[door.id], _carriers(door, view)
    hinged, slid = (view.probabilities.edge[slot, slots, kind] for kind in (HINGE, SLIDE))
    if slid.max() >= view.config.slides and slid.max() > hinged.max():
        return _choose_slide(door, slots, slid, view)
    if hinged.max() < view.config.sure and (answer := _on_given(hang_door(door, scene), view)) is not None:
        return answer
    if hinged.max() < view.config.least_edge:
        return Refusal(
            door.id, Reason.NO_MOTION, f"the network sees no part that carries it: hinges at most {hinged.max():.2f}"
        )
    mounts, motions = _hinges(door, slots, view)
    motion = np.einsum("k,kbs->bs", mounts, motions)
    weights = motion.sum(axis=1) * agreed
    before = view.borders.get(door.id, motion.sum(axis=1))
    if door.id in view.borders:
        weights = np.where(before >= view.config.unseen * before.max(), weights, 0.0)
    own = chosen_of(BORDERS, motion.sum(axis=1), weights)
    flap = _plain_flap(door, own.choice, scene)
    border = flap or chosen_of(BORDERS, before, weights)
    sign = chosen_of(SIGNS, motion[border.choice])
    on = None if flap is None else _flap_mount(door, flap.choice, view, scene)
    mount = on or ranking_of(view.ids(slots), mounts * motions[:, border.choice, sign.choice])
    edge = Hinge(mount.choice, door.id, border.choice, sign.choice)
    decisions = (
        decision_of(door.id, "border", border, _by(own) if flap is None else BY_RULE),
        decision_of(door.id, "sign", sign),
        decision_of(door.id, "mount", mount, "" if on is None else BY_RULE),
    )
    return (edge,), decisions


def _choose_slide(door: PartNode, slots: Indices, slid: Scalars, view: GraphView) -> MotionAnswer:
    """Returns the slide of a door within its own plane, on the part that most likely carries its track."""
    slot, thin = view.place[door.id], door.box.thin_axis
    within = tuple(code for code in SIGNED_AXES if code // 2 != thin)
    slide = ranking_of(within, (slid @ view.probabilities.slide[slot, slots])[list(within)])
    mount = ranking_of(view.ids(slots), slid)
    decisions = (decision_of(door.id, "slide", slide), decision_of(door.id, "mount", mount))
    return (Slide(mount.choice, door.id, slide.choice),), decisions


def choose_rails(drawer: PartNode, view: GraphView, scene: RuleScene) -> MotionAnswer:
    """Returns the rails of a drawer, on two flanks where two parts carry it, or why it gets none."""
    if not len(view.supports):
        return Refusal(drawer.id, Reason.NO_MOTION, _NO_SUPPORT)
    slot, slots = view.place[drawer.id], view.within_reach(drawer, view.supports)
    railed = view.probabilities.edge[slot, slots, RAIL]
    if railed.max() < view.config.least_edge:
        answer = _on_given(run_drawer(drawer, scene), view)
        why = f"the network sees no part that carries it: rails at most {railed.max():.2f}"
        return Refusal(drawer.id, Reason.NO_MOTION, why) if answer is None else answer
    ratios = railed @ view.probabilities.slide[slot, slots]
    slide = chosen_of(SIGNED_AXES, ratios)
    groups = _by_flank(drawer, slide.choice, slots, railed, view)
    rails = tuple(Rail(view.ids(group)[0], drawer.id, slide.choice) for group in groups)
    mounts = (
        decision_of(drawer.id, "mount", ranking_of(view.ids(group), view.probabilities.edge[slot, group, RAIL]))
        for group in groups
    )
    return rails, (decision_of(drawer.id, "slide", slide), *mounts)


def _by(ranking: Ranking[Any]) -> str:
    """Returns who chose: a rule as well where the network itself prefers the runner-up."""
    return BY_BOTH if ranking.runner_up_score > ranking.score else ""


def _on_given(answer: MotionAnswer, view: GraphView) -> MotionAnswer | None:
    """Returns the rule's answer without what hangs on parts that the input lacks; None where nothing is left."""
    if isinstance(answer, Refusal):
        return None
    edges, decisions = answer
    kept = tuple(edge for edge in edges if isinstance(edge, Hinge | Rail) and edge.parent in view.given)
    said = tuple(replace(d, by=BY_RULE) for d in decisions if d.question != "mount" or d.choice in view.given)
    return (kept, said) if kept else None


def _plain_flap(door: PartNode, said: HingeBorder, scene: RuleScene) -> Ranking[HingeBorder] | None:
    """Returns the rule's border of a door that is plainly a flap where the network states another one, else None."""
    flap = plain_flap(door, scene)
    if flap is None or flap == said:
        return None
    ranking = vote_border(door, scene)
    return ranking if ranking.choice == flap else None


def _flap_mount(door: PartNode, flap: HingeBorder, view: GraphView, scene: RuleScene) -> Ranking[str] | None:
    """Returns what the rule hangs a plain flap on; None where that is nothing that the input has."""
    mount = vote_mount(door, flap, scene)
    return mount if mount is not None and mount.choice in view.given else None


def _by_flank(drawer: PartNode, axis: SignedAxis, slots: Indices, railed: Scalars, view: GraphView) -> list[np.ndarray]:
    """Returns the slots in one or two groups, the chosen rail of each first, the rest as runners-up.

    The likeliest part comes first; beside it stands the likeliest one on another flank, if it is likely enough.
    """
    order = np.argsort(-railed, kind="stable")
    flanks = _flanks(drawer, axis, slots, view)
    first = order[0]
    beyond = flanks != flanks[first]
    likely = railed >= view.config.second_rail
    if not (beyond & likely).any():
        return [slots[order]]
    same, other = order[~beyond[order]], order[beyond[order]]
    return [slots[same], slots[other]]


def _flanks(drawer: PartNode, axis: SignedAxis, slots: Indices, view: GraphView) -> Indices:
    """Returns for each slot the side of the drawer that it stands on: -1 low, 1 high, 0 on both or on neither."""
    across = 0 if axis // 2 == 1 else 1
    box = drawer.box
    slack = view.config.flank * float(box.size[across])
    middle = float(box.center[across])
    low, high = view.low[slots, across], view.high[slots, across]
    is_low = (high <= middle) & (low <= float(box.low[across]) + slack)
    is_high = (low >= middle) & (high >= float(box.high[across]) - slack)
    return is_high.astype(np.int64) - is_low.astype(np.int64)
