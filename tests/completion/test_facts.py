"""What the network states of the whole piece: its kind, what is drawn ajar, what rides on what moves."""

from dataclasses import replace

import pytest

from grafu.completion.features import FeatureConfig
from grafu.completion.network import complete_by_network
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Contact, Hinge
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.joints.make_plan import plan_from_completion
from grafu.pipeline.built_graph import without_removed
from grafu.refusal import Reason, Refusal
from grafu.synth.samples import wardrobe
from grafu.vocabulary import EdgeKind, PartLabel, PieceKind
from network_answers import Answers

Corner = tuple[float, float, float]
FEW = FeatureConfig(points=16, anchors=2, neighbours=2)


def node(name: str, label: PartLabel, low: Corner, high: Corner) -> PartNode:
    return PartNode(name, label, Box(vec3(*low), vec3(*high)))


def piece() -> FunctionalGraph:
    """A side panel; a door with a badge and a screw in that; a barrel that touches both, and its cap; a lamp."""
    nodes = (
        node("side", PartLabel.SIDE_PANEL, (-0.3, -0.25, 0.0), (-0.28, 0.25, 0.8)),
        node("door", PartLabel.DOOR, (-0.3, -0.27, 0.0), (0.3, -0.25, 0.8)),
        node("barrel", PartLabel.MISC, (-0.31, -0.28, 0.1), (-0.29, -0.26, 0.2)),
        node("cap", PartLabel.MISC, (-0.32, -0.29, 0.1), (-0.31, -0.28, 0.11)),
        node("badge", PartLabel.MISC, (0.1, -0.28, 0.5), (0.2, -0.27, 0.55)),
        node("screw", PartLabel.MISC, (0.14, -0.29, 0.51), (0.16, -0.28, 0.53)),
        node("lamp", PartLabel.MISC, (0.5, 0.0, 0.9), (0.6, 0.1, 1.0)),
    )
    touching = (("side", "door"), ("side", "barrel"), ("door", "barrel"), ("barrel", "cap"), ("door", "badge"))
    touching = (*touching, ("badge", "screw"))
    return FunctionalGraph("piece", nodes, tuple(Contact(a, b) for a, b in touching))


def completed(**said: object) -> GraphCompletion:
    graph = piece()
    answers = Answers(
        kinds={("door", "side"): EdgeKind.HINGE},
        mounts={("door", "side"): 6.0},
        hinges={"door": (0, 0)},
        **said,  # type: ignore[arg-type]
    )
    return complete_by_network(graph, answers.about(graph), FEW)


def test_what_the_network_is_sure_to_move_as_one_rides_if_it_touches() -> None:
    sure = {(name, "door"): 6.0 for name in ("badge", "screw", "lamp")}
    found = completed(bodies=sure)
    assert found.completed.moving == {"door"}
    assert set(found.rides) == {("door", "badge"), ("door", "screw")}  # the lamp touches nothing that moves


def test_what_touches_what_stays_too_does_not_ride_nor_what_holds_on_to_it() -> None:
    sure = {(name, "door"): 6.0 for name in ("barrel", "cap", "badge")}
    assert completed(bodies=sure).rides == (("door", "badge"),)  # half of a drawn hinge stays with the case


def test_what_it_is_not_sure_of_does_not_ride() -> None:
    assert completed(bodies={("badge", "door"): 2.0}).rides == ()
    assert completed().rides == ()


def test_a_panel_never_rides() -> None:
    assert completed(bodies={("side", "door"): 6.0}).rides == ()


def test_what_is_drawn_ajar_is_a_decision_of_what_moves() -> None:
    found = completed(ajar={"door": 3.0, "side": 3.0})
    ajar = [decision for decision in found.decisions if decision.question == "ajar"]
    assert [(decision.part, decision.choice) for decision in ajar] == [("door", "open")]
    assert ajar[0].score == pytest.approx(0.953, abs=1e-3)
    assert not [d for d in completed(ajar={"door": 1.0}).decisions if d.question == "ajar"]


def test_the_kind_of_the_piece_is_stated_where_it_is_likely() -> None:
    found = completed(piece={PieceKind.WARDROBE: 6.0, PieceKind.CABINET: 3.0}).piece
    assert found is not None
    assert (found.kind, found.runner_up) == (PieceKind.WARDROBE, PieceKind.CABINET)
    assert found.score > 0.9 > found.runner_up_score
    assert completed().piece is None


def test_what_rides_is_built_with_its_door() -> None:
    """What a completion states to ride is attached in the plan, unless the input states what carries it."""
    asset = wardrobe()
    door = next(part.id for part in asset.parts if part.label is PartLabel.DOOR)
    rod = next(part.id for part in asset.parts if part.label is PartLabel.SHELF)
    kept = tuple(p for p in asset.parts if p.id == door or (not p.label.is_movable and p.label is not PartLabel.HANDLE))
    bare = replace(asset, parts=tuple(replace(p, carried_by=None) for p in kept), joints=())
    graph = FunctionalGraph(asset.name, tuple(PartNode(p.id, p.label, p.box) for p in kept))
    mount = next(part.id for part in kept if part.label is PartLabel.SIDE_PANEL)
    moved = with_edges(graph, [Hinge(mount, door, 0, 0)])
    plan = plan_from_completion(GraphCompletion(graph, moved, "network", rides=((door, rod),)), bare)
    assert plan.joints[0].attached == (rod,)
    assert plan_from_completion(GraphCompletion(graph, moved, "network"), bare).joints[0].attached == ()


def test_what_is_replaced_rides_no_more() -> None:
    found = completed(bodies={("badge", "door"): 6.0, ("screw", "door"): 6.0})
    left = without_removed(found, frozenset({"badge"}))
    assert left.rides == (("door", "screw"),)
    assert "badge" not in left.completed


def test_what_rides_on_a_door_that_does_not_turn_is_static() -> None:
    found = completed(bodies={("badge", "door"): 6.0})
    still = FunctionalGraph("piece", found.completed.nodes, tuple(piece().edges))
    refused = (Refusal("door", Reason.REJECTED, ""),)
    fixed = replace(found, completed=still, decisions=(), refused=refused)
    names = [node.id for node in piece().nodes]
    parts = (replace(p, id=name, carried_by=None) for p, name in zip(wardrobe().parts, names, strict=False))
    asset = replace(wardrobe(), parts=tuple(parts), joints=())
    plan = plan_from_completion(fixed, asset)
    assert plan.joints == ()
    assert [refusal.part for refusal in plan.refused] == ["door"]
