"""Two panes that lap in two planes in front of a case are sliding doors; fixed ones and double glazing are none."""

from dataclasses import replace

import pytest

from grafu.joints.sliding_panes import with_pane_labels
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, scene

CASE = [
    box("side_left", (-0.6, -0.2, 0.0), (-0.58, 0.2, 0.8)),
    box("side_right", (0.58, -0.2, 0.0), (0.6, 0.2, 0.8)),
    box("bottom", (-0.58, -0.2, 0.0), (0.58, 0.2, 0.02)),
    box("top", (-0.58, -0.2, 0.78), (0.58, 0.2, 0.8)),
    box("back", (-0.58, 0.18, 0.02), (0.58, 0.2, 0.78)),
]


def pane(name, left, right, y=-0.19, high=0.778):
    return replace(box(name, (left, y, 0.022), (right, y + 0.006, high)), label=PartLabel.MISC)


FIRST, SECOND = pane("glass_1", -0.578, 0.02), pane("glass_2", -0.02, 0.578, y=-0.178)


def doors(*parts):
    return {part.id for part in with_pane_labels(scene(*CASE, *parts)).parts if part.label is PartLabel.DOOR}


def test_panes_that_lap_slide_past_one_another():
    assert doors(FIRST, SECOND) == {"glass_1", "glass_2"}
    joints = functionalize(scene(*CASE, FIRST, SECOND), MotionSource.NETWORK, builtin_gallery()).object.joint_of
    assert {name: (j.type, round(float(j.axis.direction[0]))) for name, j in joints.items()} == {
        "glass_1": (JointType.PRISMATIC, 1),
        "glass_2": (JointType.PRISMATIC, -1),
    }


OTHERS = {
    "in one plane": (pane("a", -0.578, -0.001), pane("b", 0.001, 0.578)),
    "double glazing": (pane("a", -0.578, 0.578), pane("b", -0.578, 0.578, y=-0.178)),
    "of different height": (FIRST, pane("b", -0.02, 0.578, y=-0.178, high=0.5)),
    "far apart": (FIRST, pane("b", -0.02, 0.578, y=0.1)),
    "beside a door": (FIRST, SECOND, replace(box("flap", (-0.5, -0.21, 0.8), (0.5, -0.2, 0.9)), label=PartLabel.DOOR)),
    "narrow": (pane("a", -0.1, 0.02), pane("b", -0.02, 0.1, y=-0.178)),
}


@pytest.mark.parametrize("what", OTHERS)
def test_other_panes_stay(what):
    assert not doors(*OTHERS[what]) & {"a", "b", "glass_1", "glass_2"}
