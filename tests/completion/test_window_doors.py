"""A front with a window and a long level bar along its upper edge drops, whatever it was taken for; others stay."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part
from grafu.completion.window_doors import WindowDoorConfig, with_window_doors
from grafu.geometry.mesh import merge_meshes
from grafu.graph.completion import BY_BOTH, BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, face_to_border, opening_face, sign_for_opening
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

RIGHT, FRONT, BOTTOM = 1, 2, 4  # faces
BODY = replace(box("body", (-0.32, 0.0, 0.0), (0.32, 0.5, 0.6)), label=PartLabel.SIDE_PANEL)


def framed(width: float = 0.6, height: float = 0.5, depth: float = 0.03) -> Part:
    """A front of four bars around a window."""
    x, b = width / 2, 0.08
    bars = [
        box("a", (-x, -depth, 0.05), (-x + b, 0.0, 0.05 + height)),
        box("b", (x - b, -depth, 0.05), (x, 0.0, 0.05 + height)),
        box("c", (-x + b, -depth, 0.05), (x - b, 0.0, 0.05 + b)),
        box("d", (-x + b, -depth, 0.05 + height - b), (x - b, 0.0, 0.05 + height)),
    ]
    mesh = merge_meshes([part.mesh for part in bars])
    return replace(bars[0], id="front", surfaces=(replace(bars[0].surfaces[0], mesh=mesh),))


PANE = box("pane", (-0.23, -0.02, 0.12), (0.23, -0.015, 0.48))
BAR = box("handle", (-0.25, -0.08, 0.5), (0.25, -0.06, 0.52))


def completed(front: Part, bar: Part = BAR, *others: Part, as_drawer: bool, guessed: bool = True) -> GraphCompletion:
    """The completion in the end, in which a front was to slide, or to hang on its right side."""
    label = PartLabel.DRAWER if as_drawer else PartLabel.DOOR
    parts = (BODY, replace(front, label=label), replace(bar, label=PartLabel.HANDLE), *others)
    asset = Asset("made", "", "made", parts)
    side = face_to_border(1, RIGHT)
    hinge = Hinge("body", "front", side, sign_for_opening(1, side, FRONT))
    motion = Rail("body", "front", FRONT) if as_drawer else hinge
    asked = ("slide", str(FRONT)) if as_drawer else ("border", str(side))
    decisions = [Decision("front", asked[0], asked[1], 0.9)]
    decisions += [Decision("front", "label", label.value, 0.9, "door", 0.1)] if guessed else []
    graph = parse_graph(asset)
    made = with_edges(graph, [motion, Attached("front", "handle")])
    return with_window_doors(GraphCompletion(graph, made, "network", decisions=tuple(decisions)), asset)


@pytest.mark.parametrize("as_drawer", [False, True])
def test_the_door_of_an_oven_drops_to_the_front(as_drawer):
    after = completed(framed(), BAR, PANE, as_drawer=as_drawer)
    (door,) = after.completed.motions

    assert isinstance(door, Hinge)
    assert border_to_face(1, door.border) == BOTTOM
    assert opening_face(1, door.border, door.sign) == FRONT
    assert after.decision("front", "border").by == (BY_BOTH if as_drawer else BY_RULE)


LOOK_ALIKES = {
    "no window": (box("front", (-0.3, -0.03, 0.05), (0.3, 0.0, 0.55)), BAR, PANE),
    "no pane": (framed(), BAR),
    "a pane far behind": (framed(), BAR, box("pane", (-0.23, 0.2, 0.12), (0.23, 0.205, 0.48))),
    "half a pane": (framed(), BAR, box("pane", (-0.23, -0.02, 0.12), (0.0, -0.015, 0.48))),
    "a bar in the middle": (framed(), box("handle", (-0.25, -0.08, 0.29), (0.25, -0.06, 0.31)), PANE),
    "a short bar": (framed(), box("handle", (-0.05, -0.08, 0.5), (0.05, -0.06, 0.52)), PANE),
    "an upright bar": (framed(), box("handle", (-0.27, -0.08, 0.1), (-0.25, -0.06, 0.5)), PANE),
    "higher than wide": (
        framed(0.35, 0.5),
        box("handle", (-0.12, -0.08, 0.5), (0.12, -0.06, 0.52)),
        box("pane", (-0.1, -0.02, 0.12), (0.1, -0.015, 0.48)),
    ),
    "as deep as a drawer": (framed(depth=0.3), BAR, PANE),
}


@pytest.mark.parametrize("as_drawer", [False, True])
@pytest.mark.parametrize("what", LOOK_ALIKES)
def test_other_fronts_move_as_they_are_predicted(what, as_drawer):
    front, bar, *others = LOOK_ALIKES[what]
    (motion,) = completed(front, bar, *others, as_drawer=as_drawer).completed.motions

    assert isinstance(motion, Rail) if as_drawer else border_to_face(1, motion.border) == RIGHT


def test_what_is_called_a_drawer_stays_one():
    (motion,) = completed(framed(), BAR, PANE, as_drawer=True, guessed=False).completed.motions

    assert isinstance(motion, Rail)


def test_a_fraction_is_between_0_and_1():
    with pytest.raises(ValueError, match="bar"):
        WindowDoorConfig(bar=1.5)
