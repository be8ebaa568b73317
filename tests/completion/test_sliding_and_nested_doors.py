"""Doors that slide in their own plane, and doors that hang on doors, where a network predicts them."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.completion.decode_config import DecodeConfig
from grafu.completion.features import FeatureConfig
from grafu.completion.network import complete_by_network
from grafu.geometry.box import Box
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge, Slide
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import EdgeKind, PartLabel
from network_answers import SURE, Answers

FEW = FeatureConfig(points=16, anchors=2, neighbours=2)
ONCE = DecodeConfig(mirror=False)
DOOR, PANEL = PartLabel.DOOR, PartLabel.SIDE_PANEL


def part(name: str, label: PartLabel, low: tuple[float, float, float], high: tuple[float, float, float]) -> PartNode:
    return PartNode(name, label, Box(np.array(low), np.array(high)))


WARDROBE = FunctionalGraph(
    "wardrobe",
    (
        part("left", PANEL, (0.0, 0.0, 0.0), (0.02, 0.5, 1.0)),
        part("right", PANEL, (0.98, 0.0, 0.0), (1.0, 0.5, 1.0)),
        part("top", PartLabel.TOP_PANEL, (0.02, 0.0, 0.98), (0.98, 0.5, 1.0)),
        part("outer", DOOR, (0.0, -0.02, 0.0), (0.499, 0.0, 0.98)),
        part("inner", DOOR, (0.501, -0.02, 0.0), (1.0, 0.0, 0.98)),
    ),
)


def complete(said: Answers, config: DecodeConfig = ONCE) -> GraphCompletion:
    return complete_by_network(WARDROBE, said.about(WARDROBE), FEW, config)


def sliding(slide: float) -> Answers:
    return Answers(
        kinds={("outer", "top"): {EdgeKind.SLIDE: slide}, ("inner", "right"): EdgeKind.HINGE},
        mounts={("inner", "right"): SURE},
        hinges={"inner": (1, 1)},
        slides={"outer": 1},
    )


def test_a_door_slides_where_the_network_predicts_it() -> None:
    completion = complete(sliding(2 * SURE))
    assert Slide("top", "outer", 1) in completion.completed.edges
    assert Hinge("right", "inner", 1, 1) in completion.completed.edges
    assert (completion.decision("outer", "slide").choice, completion.decision("outer", "mount").choice) == ("1", "top")
    assert completion.decision("outer", "slide").score > 0.9


def test_an_unlikely_slide_is_a_hinge() -> None:
    unlikely = replace(sliding(SURE - 1.0), kinds=sliding(SURE - 1.0).kinds | {("outer", "left"): EdgeKind.HINGE})
    assert complete(unlikely).completed.slides == ()
    assert complete(sliding(2 * SURE), replace(ONCE, slides=1.0)).completed.slides == ()


def test_a_door_never_slides_across_its_own_plane() -> None:
    said = sliding(2 * SURE)
    said.slides = {"outer": 2}
    (slide,) = complete(said).completed.slides
    assert slide.axis // 2 != 1


def folding() -> Answers:
    return Answers(
        kinds={("outer", "left"): EdgeKind.HINGE, ("inner", "outer"): EdgeKind.HINGE},
        mounts={("outer", "left"): SURE, ("inner", "outer"): SURE, ("outer", "inner"): 2 * SURE},
        hinges={"outer": (0, 0), "inner": (0, 1)},
    )


def test_a_door_hangs_on_the_door_that_the_case_carries() -> None:
    completion = complete(folding())
    assert set(completion.completed.hinges) == {Hinge("left", "outer", 0, 0), Hinge("outer", "inner", 0, 1)}
    assert completion.refused == ()


@pytest.mark.parametrize("logit", [SURE, 2 * SURE])
def test_two_doors_never_carry_one_another(logit: float) -> None:
    said = folding()
    said.kinds = {("inner", "outer"): {EdgeKind.HINGE: logit}}
    parents = {hinge.child: hinge.parent for hinge in complete(said).completed.hinges}
    assert not (parents.get("inner") == "outer" and parents.get("outer") == "inner")


def test_a_door_does_not_hang_on_one_that_nothing_carries() -> None:
    said = Answers(
        kinds={
            ("outer", "left"): {EdgeKind.HINGE: -1.0},
            ("inner", "outer"): EdgeKind.HINGE,
            ("inner", "right"): {EdgeKind.HINGE: -2.0},
        },
        mounts={("inner", "outer"): SURE},
    )
    no_rule = replace(ONCE, sure=0.0, least_edge=0.5)
    completion = complete(said, no_rule)
    assert completion.completed.hinges == ()
    assert {refusal.part for refusal in completion.refused} == {"outer", "inner"}
