"""A mirror between two posts swivels between them; mirrors that stand, hang or are framed by more stay."""

from dataclasses import replace
from math import radians

import pytest

from grafu.joints.swivel_mirrors import swivel_mirrors
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from judging import swept_collisions
from small_scenes import box, scene

TOP = replace(box("top", (-0.5, -0.25, 0.7), (0.5, 0.25, 0.72)), label=PartLabel.TOP_PANEL)
LEGS = [
    box(f"leg_{k}", (x - 0.02, y - 0.02, 0.0), (x + 0.02, y + 0.02, 0.7))
    for k, (x, y) in enumerate((x, y) for x in (-0.45, 0.45) for y in (-0.2, 0.2))
]
POSTS = [
    box("post_left", (-0.34, 0.13, 0.72), (-0.31, 0.16, 1.1)),
    box("post_right", (0.31, 0.13, 0.72), (0.34, 0.16, 1.1)),
]
MIRROR = box("mirror", (-0.305, 0.135, 0.76), (0.305, 0.155, 1.26))
VANITY = (TOP, *LEGS, *POSTS)


def made(*parts, small=None):
    config = PipelineConfig(Settings(small_parts=small))
    return functionalize(scene(*parts), MotionSource.RULE, builtin_gallery(), config).object


def test_it_turns_about_the_line_between_its_posts_and_takes_its_frame_along():
    frame = box("mirror_frame", (-0.307, 0.13, 0.755), (0.307, 0.136, 1.265))
    result = made(*VANITY, MIRROR, frame)
    (joint,) = [joint for joint in result.joints if "mirror" in joint.child]
    assert joint.type is JointType.REVOLUTE
    assert abs(float(joint.axis.direction[0])) == pytest.approx(1.0)
    assert joint.axis.point[2] == pytest.approx(1.01, abs=0.01)
    assert joint.limits.upper == pytest.approx(radians(25), abs=0.01)
    assert {visual.name for visual in result.link(joint.child).visuals} == {"mirror", "mirror_frame"}
    assert swept_collisions(result, joint, 12) == {}


def test_without_small_parts_it_stays():
    assert not made(*VANITY, MIRROR, small=False).joints


OTHERS = {
    "on one post": (TOP, *LEGS, POSTS[0], MIRROR),
    "beside low posts": (TOP, *LEGS, *(box(p.id, tuple(p.box.low), (*p.box.high[:2], 0.8)) for p in POSTS), MIRROR),
    "away from the posts": (*VANITY, box("mirror", (-0.2, 0.135, 0.76), (0.2, 0.155, 1.26))),
    "before the posts": (*VANITY, box("mirror", (-0.3, 0.0, 0.76), (0.3, 0.02, 1.26))),
    "a board": (*VANITY, box("board", tuple(MIRROR.box.low), tuple(MIRROR.box.high))),
    "a level plate": (*VANITY, box("mirror", (-0.3, -0.1, 0.9), (0.3, 0.155, 0.91))),
}


@pytest.mark.parametrize("what", OTHERS)
def test_other_mirrors_stay(what):
    assert swivel_mirrors(scene(*OTHERS[what])) == frozenset()


@pytest.mark.parametrize("scale", [0.01, 39.37])
def test_it_is_found_at_any_scale(scale):
    parts = [box(p.id, tuple(scale * p.box.low), tuple(scale * p.box.high)) for p in (*VANITY, MIRROR)]
    assert swivel_mirrors(scene(*parts)) == {"mirror"}
