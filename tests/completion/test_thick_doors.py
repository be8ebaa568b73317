"""A guessed door that is too thick and as deep as a drawer is a drawer; thin ones, and what a label states, stay."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.completion.thick_doors import ThickDoorConfig, with_thick_doors
from grafu.graph.completion import BY_BOTH, Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT = 2  # the face that looks to -Y
BODY = replace(box("body", (-0.4, 0.0, 0.0), (0.4, 0.6, 1.0)), label=PartLabel.SIDE_PANEL)
DEEP = box("door", (-0.38, -0.02, 0.1), (0.38, 0.5, 0.6))
HANDLE = replace(box("handle", (-0.1, -0.06, 0.3), (0.1, -0.02, 0.32)), label=PartLabel.HANDLE)


def completed(door=DEEP, *, guessed=True):
    """Returns the completion in which the part hangs as a door, before and after."""
    parts = (BODY, replace(door, label=PartLabel.DOOR), HANDLE)
    graph = parse_graph(Asset("made", "", "made", parts))
    edges = [Hinge("body", "door", 0, 1), Attached("door", "handle")]
    label = (Decision("door", "label", "door", 0.7, "drawer", 0.3),) if guessed else ()
    others = (Decision("door", "border", "0", 1.0, "1", 0.0), Decision("door", "sign", "1", 0.9, "0", 0.1))
    mount = Decision("door", "mount", "body", 0.8)
    before = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=(*label, *others, mount))
    return before, with_thick_doors(before, Asset("made", "", "made", parts))


def test_a_guessed_door_as_deep_as_a_drawer_slides_to_the_front_with_its_handle():
    _, after = completed()
    assert after.completed.node("door").label is PartLabel.DRAWER
    assert after.completed.motions == (Rail("body", "door", FRONT),)
    assert after.completed.attachments == (Attached("door", "handle"),)
    assert after.decisions == (
        Decision("door", "label", "drawer", 0.3, "door", 0.7, BY_BOTH),
        Decision("door", "slide", str(FRONT), 0.9, by=BY_BOTH),
        Decision("door", "mount", "body", 0.8),
    )


def turned(part, degrees: float):
    """The part turned about its upright left edge, as a door that is drawn open."""
    angle, pin = np.radians(degrees), np.array([-0.38, 0.0, 0.0])
    c, s = np.cos(angle), np.sin(angle)
    T = np.eye(4)
    T[:3, :3] = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
    T[:3, 3] = pin - T[:3, :3] @ pin
    return replace(part, surfaces=tuple(surface.transformed(T) for surface in part.surfaces))


@pytest.mark.parametrize(
    ("door", "guessed"),
    [
        (DEEP, False),
        (box("door", (-0.38, -0.02, 0.1), (0.38, 0.1, 0.6)), True),
        (box("door", (-0.38, 0.2, 0.1), (0.38, 0.6, 0.6)), True),
        (turned(box("door", (-0.38, -0.02, 0.1), (0.38, 0.0, 0.6)), 50.0), True),
    ],
    ids=["by its label", "thin", "farther in", "drawn open"],
)
def test_other_doors_stay_doors(door, guessed):
    before, after = completed(door, guessed=guessed)
    assert after is before


def test_how_deep_it_is_at_least_is_a_choice():
    with pytest.raises(ValueError, match="deep"):
        ThickDoorConfig(deep=1.5)


def test_a_thick_door_on_which_another_hangs_stays_a_door():
    """No hinge is on a drawer: the other one would be left without a motion."""
    leaf = replace(box("leaf", (0.38, -0.02, 0.1), (0.5, 0.0, 0.6)), label=PartLabel.DOOR)
    parts = (BODY, replace(DEEP, label=PartLabel.DOOR), leaf)
    graph = parse_graph(Asset("made", "", "made", parts))
    edges = [Hinge("body", "door", 0, 1), Hinge("door", "leaf", 0, 1)]
    guess = Decision("door", "label", "door", 0.7, "drawer", 0.3)
    before = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=(guess,))
    assert with_thick_doors(before, Asset("made", "", "made", parts)) is before
