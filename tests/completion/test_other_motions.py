"""Parts that are neither doors nor drawers: a network's slides and turns of them, in the graph and in the plan."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Link
from grafu.asset.part import Asset
from grafu.completion.decode_config import DecodeConfig
from grafu.completion.features import FeatureConfig
from grafu.completion.network import complete_by_network
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Contact, Slide, Turn
from grafu.graph.parse import parse_graph
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_completion
from grafu.pipeline.built_graph import with_joints
from grafu.pipeline.shown_by_shape import shown_by_shape
from grafu.vocabulary import EdgeKind, PartLabel
from network_answers import SURE, Answers
from small_scenes import BASE_CASE, box, scene

FEW = FeatureConfig(points=16, anchors=2, neighbours=2)
ONCE = DecodeConfig(mirror=False)
DOOR = box("door", (0.0, -0.02, 0.1), (0.6, -0.001, 0.8))
RACK = replace(box("rack", (0.04, 0.03, 0.4), (0.56, 0.45, 0.46)), label=PartLabel.SHELF)
BUTTON = replace(box("button", (0.1, -0.03, 0.7), (0.12, -0.02, 0.72)), label=PartLabel.MISC)
BASE = BASE_CASE[0].id


def piece() -> Asset:
    return scene(DOOR, *BASE_CASE, RACK, BUTTON)


def hung(**kinds: EdgeKind | dict[EdgeKind, float]) -> Answers:
    """A door that is hinged, and what is said of the rack on the case, and of the button on the door."""
    said = {("door", BASE): EdgeKind.HINGE}
    carriers = {"rack": BASE, "button": "door"}
    said |= {(name, carriers[name]): kind for name, kind in kinds.items()}
    return Answers(kinds=said, mounts={("door", BASE): SURE}, hinges={"door": (0, 1)}, slides={"rack": 2, "button": 3})


def completed(said: Answers, config: DecodeConfig = ONCE) -> GraphCompletion:
    graph = parse_graph(piece())
    return complete_by_network(graph, said.about(graph), FEW, config)


def test_racks_slide_and_buttons_turn_where_the_network_predicts_it() -> None:
    found = completed(hung(rack=EdgeKind.SLIDE, button=EdgeKind.TURN))
    assert Slide(BASE, "rack", 2) in found.completed.edges
    assert Turn("door", "button", 3) in found.completed.edges
    for part, question, code in (("rack", "slide", "2"), ("button", "turn", "3")):
        decision = found.decision(part, question)
        assert decision is not None
        assert decision.choice == code
        assert decision.score > 0.9


@pytest.mark.parametrize("said", [{}, {"rack": {EdgeKind.SLIDE: 0.0}}], ids=["nothing", "unlikely"])
def test_what_is_unlikely_stays(said: dict[str, dict[EdgeKind, float]]) -> None:
    found = completed(hung(**said))
    assert found.completed.moving == {"door"}


def test_the_larger_of_two_parts_never_moves_on_the_smaller() -> None:
    said = hung()
    said.kinds |= {("rack", "button"): EdgeKind.SLIDE}
    assert completed(said).completed.moving == {"door", "button"}


def test_what_carries_a_door_does_not_move() -> None:
    said = hung()
    said.kinds |= {(BASE, other.id): EdgeKind.TURN for other in BASE_CASE if other.id != BASE}
    moving = completed(said).completed.moving
    assert "door" in moving
    assert BASE not in moving


def test_a_panel_does_not_move_on_a_door() -> None:
    said = hung()
    said.kinds |= {("rack", "door"): EdgeKind.SLIDE}
    assert "rack" not in completed(said).completed.moving


def test_a_track_does_not_slide_on_the_door_that_slides_on_it() -> None:
    kinds = {("door", "floor"): {EdgeKind.SLIDE: 2 * SURE}, ("button", "door"): {EdgeKind.SLIDE: 2 * SURE}}
    found = completed(Answers(kinds=kinds, slides={"door": 1, "button": 3})).completed
    assert [slide.child for slide in found.slides] == ["door"]


def test_a_rack_is_planned_and_what_is_small_rides_with_the_door() -> None:
    found = completed(hung(rack=EdgeKind.SLIDE, button=EdgeKind.TURN))
    asset = piece()
    plan, _ = shown_by_shape(plan_from_completion(found, asset), asset, found.completed, RealizationConfig())
    requests = {request.moving: request for request in plan.joints}
    assert requests.keys() == {"door", "rack"}
    assert np.allclose(requests["rack"].axis.direction, (0.0, -1.0, 0.0))
    assert "button" in requests["door"].attached


def test_what_the_user_states_is_planned_however_small() -> None:
    found = completed(hung(button=EdgeKind.TURN))
    asset = piece()
    plan, _ = shown_by_shape(
        plan_from_completion(found, asset), asset, found.completed, RealizationConfig(), ("button",)
    )
    assert {request.moving for request in plan.joints} == {"door", "button"}


def test_what_got_no_joint_does_not_move_in_the_graph_as_built() -> None:
    found = completed(hung(rack=EdgeKind.SLIDE, button=EdgeKind.TURN))
    still = ArticulatedObject("piece", "body", (Link("body", ()),), ())
    built = with_joints(found, still, {})
    assert built.completed.moving == {"door"}
    assert Contact(BASE, "rack") in built.completed.edges or Contact("rack", BASE) in built.completed.edges
