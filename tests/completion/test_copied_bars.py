"""Doors side by side with level bars that are copies of each other drop or lift; mirrored bars state nothing new."""

from dataclasses import replace

import pytest

from grafu.articulation.joint_values import Coupling
from grafu.asset.part import Asset
from grafu.completion.copied_bars import CopiedBarsConfig, with_copied_bars
from grafu.graph.completion import BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, face_to_border, opening_face, sign_for_opening
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

LEFT, RIGHT, FRONT, BOTTOM, TOP = 0, 1, 2, 4, 5  # faces
BODY = replace(box("body", (-0.42, 0.0, 0.0), (0.42, 0.4, 1.0)), label=PartLabel.SIDE_PANEL)
LOW, HIGH = (0.05, 0.45), (0.47, 0.87)


def door(name: str, x: tuple[float, float], z: tuple[float, float] = LOW, front: float = 0.0):
    return replace(box(name, (x[0], front - 0.02, z[0]), (x[1], front, z[1])), label=PartLabel.DOOR)


def bar(name: str, x: float, z: float, half: tuple[float, float] = (0.12, 0.005)):
    low, high = (x - half[0], -0.05, z - half[1]), (x + half[0], -0.02, z + half[1])
    return replace(box(name, low, high), label=PartLabel.HANDLE)


def hung(doors, bars, *, face_of=(LEFT, RIGHT), given=True, coupling=None):
    """Returns the completion of two doors that hang on these faces of their boxes, before and after."""
    graph = parse_graph(Asset("made", "", "made", (BODY, *doors, *bars)))
    edges, decisions = [], []
    for one, handle, face in zip(doors, bars, face_of, strict=True):
        border = face_to_border(1, face)
        sign = sign_for_opening(1, border, FRONT)
        edges += [
            Hinge("body", one.id, border, sign, coupling if one is doors[1] else None),
            Attached(one.id, handle.id),
        ]
        others = tuple((str(code), 0.1) for code in range(4) if code != border)
        decisions += [
            Decision(one.id, "border", str(border), 0.7, *others[0], others=others),
            Decision(one.id, "sign", str(sign), 0.9, str(1 - sign), 0.1),
        ]
    completion = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=tuple(decisions))
    return completion, with_copied_bars(completion, Asset("made", "", "made", (BODY, *doors, *(bars if given else ()))))


@pytest.mark.parametrize(("z", "at", "face"), [(LOW, 0.42, BOTTOM), (HIGH, 0.5, TOP)], ids=["drop", "lift"])
@pytest.mark.parametrize("off", [-0.05, 0.05])
def test_doors_whose_bars_are_copies_turn_about_the_border_away_from_them(z, at, face, off):
    doors = (door("a", (-0.4, -0.002), z), door("b", (0.002, 0.4), z))
    before, after = hung(doors, (bar("a_bar", -0.2 + off, at), bar("b_bar", 0.2 + off, at)))
    assert [h.border for h in before.completed.hinges] == [face_to_border(1, LEFT), face_to_border(1, RIGHT)]
    for hinge in after.completed.hinges:
        assert border_to_face(1, hinge.border) == face
        assert opening_face(1, hinge.border, hinge.sign) == FRONT
        told = after.decision(hinge.child, "border")
        assert (told.choice, told.score, told.by, told.runner_up_score) == (str(hinge.border), 0.75, BY_RULE, 0.25)


PAIR = (door("a", (-0.4, -0.002)), door("b", (0.002, 0.4)))
COPIES = (bar("a_bar", -0.25, 0.42), bar("b_bar", 0.15, 0.42))


@pytest.mark.parametrize(
    ("doors", "bars", "how"),
    [
        (PAIR, (bar("a_bar", -0.15, 0.42), bar("b_bar", 0.15, 0.42)), {}),
        (PAIR, (bar("a_bar", -0.2, 0.42), bar("b_bar", 0.2, 0.42)), {}),
        (PAIR, (bar("a_bar", -0.3, 0.42, (0.06, 0.005)), bar("b_bar", 0.1, 0.42, (0.06, 0.005))), {}),
        (PAIR, (bar("a_bar", -0.25, 0.25), bar("b_bar", 0.15, 0.25)), {}),
        (PAIR, (bar("a_bar", -0.25, 0.42, (0.01, 0.02)), bar("b_bar", 0.15, 0.42, (0.01, 0.02))), {}),
        (PAIR, (COPIES[0], bar("b_bar", 0.15, 0.36)), {}),
        ((door("a", (-0.4, -0.1)), door("b", (0.1, 0.4))), (bar("a_bar", -0.28, 0.42), bar("b_bar", 0.22, 0.42)), {}),
        ((PAIR[0], door("b", (0.002, 0.4), front=-0.05)), COPIES, {}),
        ((door("a", (-0.4, -0.002), (0.05, 0.65)), door("b", (0.002, 0.4), (0.05, 0.65))),
         (bar("a_bar", -0.25, 0.6), bar("b_bar", 0.15, 0.6)), {}),
        (PAIR, COPIES, {"given": False}),
        (PAIR, COPIES, {"coupling": Coupling("a", 2.0)}),
        (PAIR, COPIES, {"face_of": (TOP, TOP)}),
    ],
    ids=[
        "mirror images",
        "in the middle",
        "at the sides",
        "at half height",
        "upright",
        "at different heights",
        "far apart",
        "in two planes",
        "high doors",
        "added bars",
        "leaves that fold",
        "flaps already",
    ],
)  # fmt: skip
def test_other_doors_stay_as_they_are_predicted(doors, bars, how):
    before, after = hung(doors, bars, **how)
    assert after is before


def test_numbers_are_above_nothing():
    with pytest.raises(ValueError, match="off"):
        CopiedBarsConfig(off=0.0)
