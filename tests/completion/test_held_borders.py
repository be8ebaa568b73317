"""A door that stands out of its case hangs on the border that is near the case; others hang as they are predicted."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part
from grafu.completion.held_borders import HeldBorderConfig, with_held_borders
from grafu.graph.completion import BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, face_to_border, opening_face
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

LEFT, FRONT, BACK = 0, 2, 3  # faces
BODY = replace(box("body", (-0.3, 0.0, 0.0), (0.3, 0.5, 0.8)), label=PartLabel.SIDE_PANEL)
OPEN = box("door", (-0.3, -0.5, 0.02), (-0.28, -0.005, 0.78))
PANE = box("pane", (-0.295, -0.45, 0.1), (-0.285, -0.05, 0.7))
HANDLE = replace(box("handle", (-0.33, -0.48, 0.3), (-0.3, -0.46, 0.5)), label=PartLabel.HANDLE)


def hung(*others: Part, asked: bool = True) -> GraphCompletion:
    """The completion in the end, in which a door that stands out of its case was to hang on its front border."""
    asset = Asset("made", "", "made", (BODY, replace(OPEN, label=PartLabel.DOOR), HANDLE, *others))
    side = face_to_border(0, FRONT)
    decision = Decision("door", "border", str(side), 0.6, str(face_to_border(0, BACK)), 0.4)
    graph = parse_graph(asset)
    made = with_edges(graph, [Hinge("body", "door", side, 0), Attached("door", "handle")])
    return with_held_borders(GraphCompletion(graph, made, "network", decisions=(decision,) if asked else ()))


@pytest.mark.parametrize("others", [(), (PANE,)], ids=["alone", "with a pane"])
def test_a_door_that_stands_open_hangs_on_the_border_near_its_case(others):
    after = hung(*others)
    (hinge,) = after.completed.hinges

    assert border_to_face(0, hinge.border) == BACK
    assert opening_face(0, hinge.border, hinge.sign) == opening_face(0, face_to_border(0, FRONT), 0)
    assert (after.decision("door", "border").by, after.decision("door", "border").score) == (BY_RULE, 0.75)


@pytest.mark.parametrize(
    ("others", "asked"),
    [((box("post", (-0.3, -0.53, 0.0), (-0.27, -0.505, 0.8)),), True), ((), False)],
    ids=["a post stands at its border", "the user said so"],
)
def test_other_doors_hang_as_they_are_predicted(others, asked):
    (hinge,) = hung(*others, asked=asked).completed.hinges

    assert border_to_face(0, hinge.border) == FRONT


def test_a_fraction_is_between_0_and_1():
    with pytest.raises(ValueError, match="far"):
        HeldBorderConfig(far=1.5)
