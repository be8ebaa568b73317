"""Boards level with a table's top, with nothing below them, swing down; planks, ends and shelves stay."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.joints.plan import RealizationPlan
from grafu.joints.raised_leaves import SOURCE, RaisedLeafConfig, with_raised_leaves
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.render.picture import posed_visuals
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from small_scenes import box, scene

TOP = box("top", (-0.3, -0.4, 0.72), (0.3, 0.4, 0.74))
LEGS = [
    box(f"leg_{k}", (x - 0.03, y - 0.03, 0.0), (x + 0.03, y + 0.03, 0.72))
    for k, (x, y) in enumerate((x, y) for x in (-0.24, 0.24) for y in (-0.34, 0.34))
]


def leaf(wide: float = 0.35, low: float = 0.72, gap: float = 0.002, aside: float = 0.4):
    return box("leaf", (0.3 + gap, -aside, low), (0.3 + gap + wide, aside, low + 0.02))


LEAF = leaf()


def found(*parts, **changes):
    plan = with_raised_leaves(RealizationPlan((), ()), scene(*parts), replace(RaisedLeafConfig(), **changes))
    assert {request.source for request in plan.joints} <= {SOURCE}
    return {request.moving for request in plan.joints}


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_raised_leaf_swings_down_until_it_hangs(sign):
    board = LEAF if sign > 0 else box("leaf", (-0.652, -0.4, 0.72), (-0.302, 0.4, 0.74))
    made = functionalize(scene(TOP, *LEGS, board), MotionSource.RULE, builtin_gallery()).object
    (joint,) = made.joints
    assert joint.limits.upper >= np.pi / 2
    hanging = posed_visuals(made, {joint.id: np.pi / 2})
    part = next(visual for visual in hanging if visual.name == "leaf").mesh.box
    assert part.size[0] == pytest.approx(0.02, abs=2e-3)
    assert part.low[2] == pytest.approx(0.72 - 0.35, abs=0.03)
    assert sign * part.center[0] == pytest.approx(0.3, abs=0.04)


@pytest.mark.parametrize(
    "parts",
    [
        (LEAF, box("leg", (0.55, -0.03, 0.0), (0.6, 0.03, 0.72))),
        (LEAF, box("rail", (0.4, -0.38, 0.66), (0.44, 0.38, 0.72))),
        (LEAF, box("vase", (0.45, -0.03, 0.74), (0.5, 0.03, 0.9))),
        (leaf(wide=0.1),),
        (leaf(wide=0.7),),
        (leaf(low=0.69),),
        (leaf(gap=0.05),),
        (leaf(aside=0.2),),
        (replace(LEAF, label=PartLabel.DRAWER),),
    ],
    ids=[
        "on a leg",
        "on a rail",
        "something on it",
        "an edge",
        "too wide to hang",
        "lower",
        "apart",
        "short",
        "a drawer",
    ],
)
def test_what_looks_like_a_leaf_stays(parts):
    assert found(TOP, *LEGS, *parts) == set()


def test_a_top_without_legs_has_no_leaves_and_a_gate_leg_below_one_is_its_support():
    assert found(TOP, LEGS[0], LEAF) == set()
    assert found(TOP, *LEGS, LEAF) == {"leaf"}
    assert found(TOP, *LEGS, LEAF, box("gate_leg", (0.5, 0.0, 0.0), (0.54, 0.04, 0.72))) == {"leaf"}


@pytest.mark.parametrize(
    ("change", "limit"),
    [("gap", 0.001), ("thin", 0.01), ("wide", (0.2, 0.3)), ("bearing", 0.02), ("legs", 5)],
)
def test_each_threshold_decides(change, limit):
    frame = box("frame", (-0.2, -0.38, 0.66), (0.32, 0.38, 0.72))  # reaches a little below the leaf
    assert found(TOP, *LEGS, LEAF, frame, thin=0.1) == {"leaf"}
    assert found(TOP, *LEGS, LEAF, *([frame] if change == "bearing" else []), **{change: limit}) == set()


def test_limits_are_checked():
    with pytest.raises(ValueError, match="wide"):
        RaisedLeafConfig(wide=(0.5, 0.2))
