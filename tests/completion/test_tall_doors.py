"""Doors that are much higher than wide hang on a side, the likelier one; flaps and lids stay as they are predicted."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset
from grafu.completion.tall_doors import with_tall_doors
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Hinge
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, face_to_border, opening_face, sign_for_opening
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

LEFT, RIGHT, FRONT, BOTTOM, TOP = 0, 1, 2, 4, 5  # faces
BODY = replace(box("body", (-0.3, 0.0, 0.0), (0.3, 0.6, 1.4)), label=PartLabel.SIDE_PANEL)
HIGH = replace(box("door", (-0.3, -0.03, 0.0), (0.3, 0.0, 0.95)), label=PartLabel.DOOR)
OF_DISHWASHER = replace(box("door", (-0.3, -0.03, 0.1), (0.3, 0.0, 0.85)), label=PartLabel.DOOR)
LID = replace(box("door", (-0.1, 0.0, 1.4), (0.1, 0.6, 1.43)), label=PartLabel.DOOR)


def found(door, face: int, scores: dict[int, float], thin: int = 1, front: int = FRONT, coupling=None):
    """Returns on which face of its box a door hangs that was predicted on `face`, and to which it opens."""
    border = {side: face_to_border(thin, side) for side in scores}
    sign = sign_for_opening(thin, border[face], front)
    others = tuple((str(border[side]), score) for side, score in scores.items() if side != face)
    decisions = (Decision("door", "border", str(border[face]), scores[face], *others[0], others=others),)
    asset = Asset("made", "", "made", (BODY, door))
    completed = with_edges(parse_graph(asset), [Hinge("body", "door", border[face], sign, coupling)])
    completion = GraphCompletion(parse_graph(asset), completed, "network", decisions=decisions)
    (hinge,) = with_tall_doors(completion, asset).completed.hinges
    return border_to_face(thin, hinge.border), opening_face(thin, hinge.border, hinge.sign)


@pytest.mark.parametrize("face", [BOTTOM, TOP])
@pytest.mark.parametrize(("side", "scores"), [(LEFT, (0.11, 0.08)), (RIGHT, (0.08, 0.11))])
def test_a_high_door_hangs_on_the_likelier_side_and_opens_to_the_same_face(face, side, scores):
    assert found(HIGH, face, {face: 0.8, LEFT: scores[0], RIGHT: scores[1]}) == (side, FRONT)


@pytest.mark.parametrize(
    ("door", "face", "thin", "front"),
    [(OF_DISHWASHER, BOTTOM, 1, FRONT), (HIGH, RIGHT, 1, FRONT), (LID, 3, 2, TOP)],
    ids=["that of a dishwasher", "one on its side", "a lid that is longer than wide"],
)
def test_other_doors_stay_as_they_are_predicted(door, face, thin, front):
    assert found(door, face, {face: 0.8, LEFT: 0.1}, thin, front) == (face, front)


@pytest.mark.parametrize(
    ("face", "score", "high", "stays"),
    [
        pytest.param(BOTTOM, 0.93, 0.82, True, id="a slim dishwasher"),
        pytest.param(BOTTOM, 0.8, 0.82, False, id="less sure"),
        pytest.param(TOP, 0.93, 0.82, False, id="it would lift"),
        pytest.param(BOTTOM, 0.93, 0.95, False, id="higher"),
    ],
)
def test_a_slim_door_drops_where_that_is_sure(face, score, high, stays):
    slim = replace(box("door", (-0.25, -0.03, 0.0), (0.25, 0.0, high)), label=PartLabel.DOOR)
    assert found(slim, face, {face: score, LEFT: 0.03, RIGHT: 0.02}) == (face if stays else LEFT, FRONT)
