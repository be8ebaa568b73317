"""The panels of a folding screen turn about their seams; pairs of doors, walls and cases are none."""

from dataclasses import replace

import pytest

from grafu.joints.screens import screen_of
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, scene


def panel(name, left, width=0.5, high=1.7, low=0.0, y=0.0):
    part = box(name, (left, y - 0.015, low), (left + width, y + 0.015, high))
    return replace(part, label=PartLabel.UNKNOWN)


def screen(count=3, gap=0.003, width=0.5, **own):
    return [panel(f"p{k}", k * (width + gap), width, **own) for k in range(count)]


@pytest.mark.parametrize("count", [3, 4])
def test_panels_turn_about_their_seams_and_the_middle_one_stays(count):
    made = functionalize(scene(*screen(count)), MotionSource.NETWORK, builtin_gallery()).object
    joints = made.joint_of
    assert {name: joint.type for name, joint in joints.items()} == {
        f"p{k}": JointType.REVOLUTE for k in range(count) if k != count // 2
    }
    assert all(abs(float(joint.axis.direction[2])) > 0.99 for joint in joints.values())
    assert all(joint.limits.upper > 1.0 for joint in joints.values())
    assert joints["p0"].parent == ("p1" if count == 4 else made.root)


SHELF = replace(box("shelf", (0.0, 0.0, 0.8), (1.5, 0.4, 0.83)), label=PartLabel.UNKNOWN)
OTHERS = {
    "a pair of doors": screen(2),
    "of different height": [*screen(2), panel("p2", 1.006, high=1.2)],
    "one behind another": [*screen(2), panel("p2", 1.006, y=0.3)],
    "apart": screen(3, gap=0.1),
    "low panels, as of a fence": screen(3, width=1.5),
    "with a shelf": [*screen(3), SHELF],
}


@pytest.mark.parametrize("what", OTHERS)
def test_others_are_no_screen(what):
    assert screen_of(scene(*OTHERS[what])) == ()
