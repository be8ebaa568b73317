"""The graph as it was built: added parts instead of expected nodes, and what was decided about them."""

from dataclasses import replace

import numpy as np

from grafu.additions.step import Addition, added_part
from grafu.asset.part import Asset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Contact, Hinge
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.parse import parse_graph
from grafu.pipeline.built_graph import as_built
from grafu.refusal import Reason, Refusal
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Door
from grafu.vocabulary import PartLabel


def asset() -> Asset:
    return make_cabinet(Cabinet("made", layout=Door(handle="none")))


def door_of(model: Asset) -> str:
    return next(part.id for part in model.parts if part.label is PartLabel.DOOR)


def expected(model: Asset, *nodes: PartNode) -> GraphCompletion:
    """Returns the contacts of a model and nodes that are expected, handles on the door."""
    graph = parse_graph(model)
    larger = FunctionalGraph(graph.model_id, (*graph.nodes, *nodes), graph.edges)
    handles = [Attached(door_of(model), n.id) for n in nodes if n.label is PartLabel.HANDLE]
    decisions = tuple(Decision(n.id, "exists", "yes", 0.75) for n in nodes)
    refused = (Refusal(door_of(model), Reason.NO_MOTION, "it was not asked"),)
    return GraphCompletion(
        graph, with_edges(larger, handles), "network", tuple(n.id for n in nodes), decisions, refused
    )


def node(name: str, label: PartLabel, center: Vec3) -> PartNode:
    return PartNode(name, label, Box.from_center(center, vec3(0.02, 0.02, 0.02)))


def addition(name: str, label: PartLabel, center: Vec3, carried_by: str | None = None) -> Addition:
    mesh = TriangleMesh.box_mesh(Box.from_center(center, vec3(0.03, 0.02, 0.01)))
    return Addition(added_part(name, label, [Surface(mesh)], carried_by), "it was missing")


def on_the_door(model: Asset, z: float = 0.0) -> Vec3:
    face = model.part(door_of(model)).box.face_center(2)
    return np.asarray(face + vec3(0.0, -0.02, z))


def test_a_built_handle_takes_the_place_of_the_expected_one() -> None:
    model = asset()
    completion = expected(model, node("expected", PartLabel.HANDLE, on_the_door(model)))
    handle = addition("handle_door", PartLabel.HANDLE, on_the_door(model, 0.1), door_of(model))
    built = as_built(completion, model, [handle])

    assert built.added == ("handle_door",)
    assert "expected" not in built.completed
    assert built.completed.node("handle_door").box == handle.part.box
    assert built.completed.attachments == (Attached(door_of(model), "handle_door"),)
    assert built.decision("handle_door", "exists") == Decision("handle_door", "exists", "yes", 0.75)


def test_each_of_several_takes_the_nearest() -> None:
    model = asset()
    nodes = (node("low", PartLabel.SHELF, vec3(0.0, 0.0, 0.2)), node("high", PartLabel.SHELF, vec3(0.0, 0.0, 0.5)))
    shelves = [
        addition("shelf_1", PartLabel.SHELF, vec3(0.0, 0.0, 0.52)),
        addition("shelf_2", PartLabel.SHELF, vec3(0.0, 0.0, 0.21)),
    ]
    built = as_built(expected(model, *nodes), model, shelves)
    assert [d.part for d in built.decisions] == ["shelf_2", "shelf_1"]


def test_what_was_expected_and_not_built_is_gone_with_all_that_was_said_of_it() -> None:
    model = asset()
    built = as_built(expected(model, node("expected", PartLabel.TOP_PANEL, vec3(0.0, 0.0, 2.0))), model, [])
    assert built.added == ()
    assert built.completed == built.input
    assert built.decisions == ()
    assert built.refused == (Refusal(door_of(model), Reason.NO_MOTION, "it was not asked"),)


def test_what_was_added_and_not_expected_has_no_decisions() -> None:
    model = asset()
    built = as_built(expected(model), model, [addition("shelf", PartLabel.SHELF, vec3(0.0, 0.0, 0.4))])
    assert built.added == ("shelf",)
    assert built.decisions == ()


def test_a_door_that_hung_on_what_was_not_built_is_refused() -> None:
    model = asset()
    door = model.part(door_of(model)).box
    side = node("expected", PartLabel.SIDE_PANEL, vec3(float(door.low[0]) - 0.02, 0.0, float(door.center[2])))
    completion = expected(model, side)
    hinged = with_edges(completion.completed, [Hinge("expected", door_of(model), 0, 0)])
    completion = replace(completion, completed=hinged, refused=())
    built = as_built(completion, model, [])

    assert [(one.part, one.reason) for one in built.refused] == [(door_of(model), Reason.NO_MOTION)]
    assert built.completed.moving == frozenset()


def test_added_parts_touch_what_they_touch() -> None:
    model = asset()
    side = next(part for part in model.parts if part.label is PartLabel.SIDE_PANEL)
    beside = np.asarray(side.box.face_center(1) + vec3(0.03, 0.0, 0.0))
    built = as_built(expected(model), model, [addition("shelf", PartLabel.SHELF, beside)])
    assert [edge for edge in built.completed.edges if isinstance(edge, Contact) and "shelf" in (edge.a, edge.b)] == [
        Contact(side.id, "shelf")
    ]


def test_a_handle_on_what_is_neither_door_nor_drawer_only_touches_it() -> None:
    model = asset()
    board = next(part.id for part in model.parts if part.label is PartLabel.SIDE_PANEL)
    middle = np.asarray(model.part(board).box.face_center(0))
    built = as_built(expected(model), model, [addition("handle_1", PartLabel.HANDLE, middle, board)]).completed
    assert [edge for edge in built.edges if isinstance(edge, Attached)] == []
    assert "handle_1" in built.neighbours[board]
