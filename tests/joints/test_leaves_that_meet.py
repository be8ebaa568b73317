"""Two leaves that are thick and meet without a gap open both; thin ones, and those with a gap, stay as they are."""

import pytest

from building_scenes import frame, knob
from grafu.metrics.collision import CollisionConfig, collision_shares
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from small_scenes import box, scene

ALL = CollisionConfig(poses=40, tolerance=0.0005, hardware=True, moving_bodies=True)


def double(thick: float, gap: float, y: float = -0.07, config: PipelineConfig = PipelineConfig()):
    """A double door of 1.4 m whose leaves begin at the depth y, made to work; the handles are before them."""
    leaves = [
        box("one", (0.053, y, 0.005), (0.7 - gap / 2, y + thick, 2.045)),
        box("other", (0.7 + gap / 2, y, 0.005), (1.347, y + thick, 2.045)),
    ]
    grips = [knob(x, (y - 0.04, y), f"grip_{k}") for k, x in enumerate((0.64, 0.76))]
    return functionalize(scene(frame(0.14, 1.4), *leaves, *grips), MotionSource.NETWORK, builtin_gallery(), config)


def trimmed(made) -> dict[str, float]:
    found = (outcome for outcome in made.report.installed)
    return {c.part: c.amount for outcome in found for c in outcome.clearances if "which it meets" in c.why}


@pytest.mark.parametrize(("thick", "gap"), [(0.045, 0.0), (0.06, 0.0), (0.06, 0.002)])
def test_thick_leaves_that_meet_open_past_each_other(thick, gap):
    made = double(thick, gap)
    assert {joint.child for joint in made.object.joints if joint.limits.upper > 1.5} == {"one", "other"}
    assert collision_shares(made.object, ALL) == {joint.id: 0.0 for joint in made.object.joints}
    assert trimmed(made)
    assert max(trimmed(made).values()) < 0.006


@pytest.mark.parametrize(("thick", "gap"), [(0.02, 0.0), (0.04, 0.004), (0.06, 0.02), (0.06, 0.003)])
def test_thin_leaves_and_those_with_a_gap_stay_whole(thick, gap):
    assert trimmed(double(thick, gap)) == {}


def test_nothing_is_taken_where_that_is_not_wanted():
    made = double(0.06, 0.0, config=PipelineConfig(Settings(trim=False)))
    assert trimmed(made) == {}
