"""Round doors hang on a side, the likelier one; square ones, and round lids, stay as they are predicted."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.completion.round_doors import RoundDoorConfig, is_round, with_round_doors
from grafu.graph.completion import BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import Hinge
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, face_to_border, opening_face, sign_for_opening
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box, cylinder

LEFT, RIGHT, FRONT, BOTTOM, TOP = 0, 1, 2, 4, 5  # faces
BODY = replace(box("body", (-0.3, 0.0, 0.0), (0.3, 0.6, 0.85)), label=PartLabel.SIDE_PANEL)
ROUND = replace(cylinder("door", ((0.0, -0.03, 0.45), (0.0, 0.0, 0.45)), 0.19), label=PartLabel.DOOR)
SQUARE = replace(box("door", (-0.19, -0.03, 0.26), (0.19, 0.0, 0.64)), label=PartLabel.DOOR)
LID = replace(cylinder("door", ((0.0, 0.3, 0.85), (0.0, 0.3, 0.88)), 0.19), label=PartLabel.DOOR)


def predicted(door, face: int, scores: dict[int, float], thin: int = 1, front: int = FRONT):
    """Returns a completion in which the door hangs on a face of its box, and its asset."""
    asset = Asset("made", "", "made", (BODY, door))
    border = {side: face_to_border(thin, side) for side in scores}
    sign = sign_for_opening(thin, border[face], front)
    others = tuple((str(border[side]), score) for side, score in scores.items() if side != face)
    decisions = (
        Decision("door", "border", str(border[face]), scores[face], *others[0], others=others),
        Decision("door", "sign", str(sign), 0.9, str(1 - sign), 0.1),
    )
    graph = parse_graph(asset)
    completed = with_edges(graph, [Hinge("body", "door", border[face], sign)])
    return GraphCompletion(graph, completed, "network", decisions=decisions), asset


@pytest.mark.parametrize("face", [BOTTOM, TOP])
@pytest.mark.parametrize(("side", "scores"), [(LEFT, (0.04, 0.01)), (RIGHT, (0.01, 0.04))])
def test_a_round_door_hangs_on_the_likelier_side_and_opens_to_the_same_face(face, side, scores):
    completion, asset = predicted(ROUND, face, {face: 0.95, LEFT: scores[0], RIGHT: scores[1]})
    found = with_round_doors(completion, asset)
    (hinge,) = found.completed.hinges
    assert border_to_face(1, hinge.border) == side
    assert opening_face(1, hinge.border, hinge.sign) == FRONT
    told = found.decision("door", "border")
    assert (told.choice, told.score, told.by) == (str(hinge.border), pytest.approx(0.75 * 0.8), BY_RULE)
    assert (told.runner_up, told.runner_up_score) == (str(face_to_border(1, face)), pytest.approx(1 - 0.75 * 0.8))
    assert found.decision("door", "sign").choice == str(hinge.sign)


@pytest.mark.parametrize(
    ("door", "face", "thin", "front"),
    [(SQUARE, BOTTOM, 1, FRONT), (ROUND, RIGHT, 1, FRONT), (LID, 3, 2, TOP)],
    ids=["a square flap", "a round door on its side", "a round lid"],
)
def test_other_doors_stay_as_they_are_predicted(door, face, thin, front):
    completion, asset = predicted(door, face, {face: 0.95, LEFT: 0.04}, thin, front)
    assert with_round_doors(completion, asset) is completion


def test_circles_are_round_and_ellipses_and_squares_are_not():
    assert is_round(ROUND)
    flat = cylinder("door", ((0.0, -0.03, 0.0), (0.0, 0.0, 0.0)), 0.19)
    stretched = replace(flat, surfaces=tuple(s.transformed(np.diag([1.0, 1.0, 0.8, 1.0])) for s in flat.surfaces))
    assert not is_round(stretched)
    assert is_round(stretched, RoundDoorConfig(square=0.75))
    assert not is_round(SQUARE)
    assert is_round(SQUARE, RoundDoorConfig(corner=2.01))
