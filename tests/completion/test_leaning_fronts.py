"""A guessed drawer that is a plate at a slant drops; a thick one, an upright one and a named one stay."""

from dataclasses import replace
from math import radians

import pytest

from grafu.asset.part import Asset, Part
from grafu.completion.leaning_fronts import with_leaning_fronts
from grafu.geometry.arrays import vec3
from grafu.geometry.leaning import LeaningConfig
from grafu.geometry.transform import rotation_about
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, opening_face
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT, BOTTOM = 2, 4  # faces
BODY = replace(box("body", (-0.4, 0.0, 0.0), (0.4, 0.5, 0.9)), label=PartLabel.SIDE_PANEL)


def leaf(degrees: float, thick: float = 0.02) -> Part:
    """A front 0.4 m high that leans to the front (above 0) or to the back."""
    upright = box("front", (-0.38, -0.02, 0.4), (0.38, -0.02 + thick, 0.8))
    T = rotation_about(vec3(0.0, 0.0, 0.4), vec3(1.0, 0.0, 0.0), radians(degrees))
    return replace(upright, label=PartLabel.DRAWER, surfaces=tuple(s.transformed(T) for s in upright.surfaces))


def motion_of(front: Part, guessed: bool = True) -> Hinge | Rail:
    """The motion in the end of a front that was to slide."""
    asset = Asset("made", "", "made", (BODY, front))
    graph = parse_graph(asset)
    edges = [Rail("body", "front", FRONT)]
    decisions = [Decision("front", "slide", str(FRONT), 0.9)]
    decisions += [Decision("front", "label", "drawer", 0.9, "door", 0.1)] if guessed else []
    made = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=tuple(decisions))
    (motion,) = with_leaning_fronts(made, asset).completed.motions
    return motion


@pytest.mark.parametrize("degrees", [35.0, -30.0, 15.0])
def test_a_plate_that_leans_drops_to_the_front(degrees):
    door = motion_of(leaf(degrees))

    assert isinstance(door, Hinge)
    assert border_to_face(1, door.border) == BOTTOM
    assert opening_face(1, door.border, door.sign) == FRONT


@pytest.mark.parametrize(
    ("front", "guessed"),
    [(leaf(0.0), True), (leaf(5.0), True), (leaf(20.0, thick=0.15), True), (leaf(35.0), False)],
    ids=["upright", "sloping a little", "thick", "named"],
)
def test_other_fronts_stay_drawers(front, guessed):
    assert isinstance(motion_of(front, guessed), Rail)


def test_an_angle_is_above_0():
    with pytest.raises(ValueError, match="least"):
        LeaningConfig(least=0.0)
