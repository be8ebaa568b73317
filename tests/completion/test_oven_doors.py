"""A guessed drawer below a panel with knobs drops as an oven's door, and the panel stays; drawers of a chest do not."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part, PartSource
from grafu.completion.oven_doors import OvenDoorConfig, with_oven_doors
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, opening_face
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT, BOTTOM_FACE = 2, 4
BODY = replace(box("body", (-0.3, 0.0, 0.0), (0.3, 0.5, 0.6)), label=PartLabel.SIDE_PANEL)
DOOR = box("front", (-0.3, -0.02, 0.02), (0.3, 0.0, 0.46))
PANEL = box("panel", (-0.3, -0.02, 0.47), (0.3, 0.0, 0.6))


def knobs(*places: float, width: float = 0.04, z: float = 0.53) -> list[Part]:
    return [box(f"knob_{k}", (x, -0.05, z - 0.02), (x + width, -0.02, z + 0.02)) for k, x in enumerate(places)]


KNOBS = knobs(-0.25, -0.1, 0.0, 0.15)


def completed(
    front: Part = DOOR, panel: Part = PANEL, on_it: list[Part] = KNOBS, *, slides: bool = False, guessed: bool = True
) -> tuple[GraphCompletion, GraphCompletion]:
    """Returns the completion before and after, in which the front was to slide, and the panel, too, if it `slides`."""
    panel_label = PartLabel.DRAWER if slides else PartLabel.MISC
    parts = (BODY, replace(front, label=PartLabel.DRAWER), replace(panel, label=panel_label), *on_it)
    graph = parse_graph(Asset("made", "", "made", parts))
    edges = [Rail("body", name, FRONT) for name in ("front", *(["panel"] if slides else []))]
    moving = [edge.child for edge in edges]
    labels = tuple(Decision(name, "label", "drawer", 0.9, "door", 0.1) for name in moving if guessed)
    slide = tuple(Decision(name, "slide", str(FRONT), 0.8) for name in moving)
    before = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=(*labels, *slide))
    return before, with_oven_doors(before)


@pytest.mark.parametrize("slides", [False, True])
def test_the_front_below_a_panel_with_knobs_drops_and_the_panel_stays(slides):
    _, after = completed(slides=slides)
    (door,) = after.completed.motions
    assert isinstance(door, Hinge)
    assert door.child == "front"
    assert border_to_face(1, door.border) == BOTTOM_FACE
    assert opening_face(1, door.border, door.sign) == FRONT
    assert [refusal.part for refusal in after.refused] == (["panel"] if slides else [])


@pytest.mark.parametrize(
    "case",
    [
        {"on_it": knobs(-0.1, 0.1)},
        {"on_it": knobs(-0.28, -0.1, 0.1, width=0.15)},
        {"on_it": knobs(-0.25, -0.1, 0.15, z=0.3)},
        {"panel": box("panel", (-0.3, -0.02, 0.47), (0.0, 0.0, 0.6))},
        {"panel": box("panel", (-0.3, 0.1, 0.47), (0.3, 0.12, 0.6))},
        {"panel": box("panel", (-0.3, -0.02, 0.47), (0.3, 0.0, 0.7))},
        {"front": box("front", (-0.3, -0.02, 0.28), (0.3, 0.0, 0.46))},
        {"front": box("front", (-0.3, -0.02, 0.02), (0.3, 0.4, 0.46))},
        {"guessed": False},
    ],
    ids=["two knobs", "wide things", "knobs below", "half a panel", "set back", "as high", "low", "a box", "labelled"],
)
def test_what_looks_like_it_slides_as_predicted(case):
    before, after = completed(**case)
    assert after is before


@pytest.mark.parametrize(("name", "is_fixed"), [("oven_door", True), ("door", False)])
def test_the_plate_above_the_door_of_an_oven_is_a_panel_without_knobs_too(name, is_fixed):
    door = replace(DOOR, label=PartLabel.DOOR, source=PartSource(name))
    graph = parse_graph(Asset("made", "", "made", (BODY, door, replace(PANEL, label=PartLabel.DRAWER))))
    edges = [Hinge("body", "front", 2, 0), Rail("body", "panel", FRONT)]
    guess = Decision("panel", "label", "drawer", 0.9, "door", 0.1)
    after = with_oven_doors(GraphCompletion(graph, with_edges(graph, edges), "network", decisions=(guess,)))
    assert {edge.child for edge in after.completed.motions} == ({"front"} if is_fixed else {"front", "panel"})


def test_fractions_are_checked():
    with pytest.raises(ValueError, match="knob"):
        OvenDoorConfig(knob=1.2)
