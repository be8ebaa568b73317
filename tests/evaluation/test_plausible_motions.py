"""What people could have meant is reported from what leads inwards, hangs on nothing, jams or cannot be pulled."""

from dataclasses import replace

import pytest
from measured_cabinets import DOOR, DRAWER, cabinet, carcass, sliding, turning

from grafu.asset.part import Asset
from grafu.evaluation.moving_parts import counted_parts, raw_object
from grafu.evaluation.plausible import Plausibility, judge_motion
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import RealizationPlan
from grafu.vocabulary import PartLabel
from sketches import door, handle, sketch


def judged(asset, plan, part: str = DOOR) -> Plausibility:
    (counted,) = [p for p in counted_parts(asset) if p.id == part]
    return judge_motion(raw_object(asset, plan), asset, counted)


def middled() -> Asset:
    """Returns a cabinet whose door can be pulled from either side, and states nothing of which."""
    return cabinet("left", handle_at=0.0)


def test_the_annotation_is_plausible() -> None:
    asset = cabinet()
    for part in (DOOR, DRAWER):
        assert judged(asset, plan_from_annotation(asset), part) == Plausibility(True)


def test_the_other_border_is_plausible_too() -> None:
    assert judged(middled(), turning(0.5, -0.271, 1.0)).plausible


@pytest.mark.parametrize(
    ("plan", "why"),
    [
        (turning(-0.5, -0.271, 1.0), "into the body"),
        (turning(0.0, -0.271, 1.0), "hinge line"),
        (turning(-0.5, -0.5, -1.0), "hinge line"),
        (sliding((0.0, -1.0, 0.0), DOOR), "a door that is prismatic"),
        (RealizationPlan(), "is static"),
    ],
)
def test_what_speaks_against_a_door(plan: RealizationPlan, why: str) -> None:
    found = judged(middled(), plan)
    assert not found.plausible
    assert why in found.why


def test_a_drawer_goes_out_and_not_in() -> None:
    assert judged(cabinet(), sliding((0.0, -1.0, 0.0)), DRAWER).plausible
    assert not judged(cabinet(), sliding((0.0, 1.0, 0.0)), DRAWER).plausible


def test_a_handle_beside_the_pin_opens_nothing() -> None:
    assert "handle" in judged(cabinet("left", handle_at=0.42), turning(0.5, -0.271, 1.0)).why


def test_a_door_that_jams_is_not_plausible() -> None:
    asset = cabinet("left", handle_at=0.0)
    wall = sketch(
        *carcass(),
        door(DOOR, (-0.5, -0.271, 0.0), (0.5, -0.251, 0.6), "left"),
        handle("handle", DOOR, (0.0, -0.291, 0.3)),
        replace(door("post", (0.45, -0.6, 0.0), (0.5, -0.28, 0.5), "left"), joint=None),
    )
    blocked = replace(wall, parts=tuple(replace(p, label=PartLabel.LEG) if p.id == "post" else p for p in wall.parts))
    assert judged(asset, turning(-0.5, -0.271, -1.0)).plausible
    assert not judged(blocked, turning(-0.5, -0.271, -1.0)).plausible
