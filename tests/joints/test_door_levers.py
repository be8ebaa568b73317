"""A lever on a building's door turns about its stem, downwards, and takes the bolt of its latch along."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from building_scenes import frame, knob, leaf
from grafu.articulation.kinematics import link_poses
from grafu.asset.part import AnnotatedJoint
from grafu.export.urdf import export_urdf
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType
from small_scenes import box, hinged, scene

FACE = -0.02
UPRIGHT = vec3(0.0, 0.0, 1.0)


def joined(name, *pieces):
    return replace(pieces[0], id=name, surfaces=tuple(s for p in pieces for s in p.surfaces))


def lever(name="grip", x=0.79, long=0.13, towards=-1.0, y=FACE, out=-1.0, ends=1):
    """A bar across the door, 50 mm off its face, on one stem at `x` or on one at each end."""
    ends_x = sorted((x - 0.01 * towards, x + towards * (long - 0.01)))
    near, far = sorted((y + out * 0.04, y + out * 0.055))
    bar = box("bar", (ends_x[0], near, 0.99), (ends_x[1], far, 1.01))
    stems = [x, x + towards * (long - 0.02)][:ends]
    low, high = sorted((y, y + out * 0.045))
    return joined(name, bar, *(box("stem", (at - 0.009, low, 0.991), (at + 0.009, high, 1.009)) for at in stems))


def built(*parts, source=MotionSource.NETWORK, **settings):
    config = PipelineConfig(Settings(**settings))
    return functionalize(scene(*parts), source, builtin_gallery(), config)


def small(made):
    return {joint.child: joint for joint in made.object.joints if joint.child != "panel"}


@pytest.mark.parametrize(("x", "towards"), [(0.79, -1.0), (0.11, 1.0)])
def test_a_lever_turns_about_its_stem_so_that_its_end_goes_down(x, towards):
    made = built(frame(), leaf((-0.02, 0.02)), lever(x=x, towards=towards))
    joint = small(made)["grip"]
    assert joint.type is JointType.REVOLUTE
    assert made.object.joint_of["grip"].parent == "panel"
    assert joint.limits.upper == pytest.approx(radians(45))
    assert joint.axis.point[[0, 2]] == pytest.approx([x, 1.0], abs=1e-3)
    end = np.array([x + 0.12 * towards, FACE - 0.05, 1.0, 1.0])
    assert (link_poses(made.object, {joint.id: joint.limits.upper})["grip"] @ end)[2] < 0.93


def test_levers_on_both_faces_turn_together():
    made = built(frame(), leaf((-0.02, 0.02)), lever(), lever("other", y=0.02, out=1.0))
    assert set(small(made)) == {"grip"}
    assert {visual.name for visual in made.object.link("grip").visuals} == {"grip", "other"}


@pytest.mark.parametrize(
    "handle",
    [lever(ends=2), knob(0.79, (-0.06, -0.02)), lever(x=0.45), lever(long=0.04), lever(y=-0.06)],
    ids=["a pull", "a round knob", "in the middle", "too short", "not on the door"],
)
def test_other_handles_do_not_turn(handle):
    assert small(built(frame(), leaf((-0.02, 0.02)), handle)) == {}


def test_the_bolt_moves_into_the_door_as_the_lever_turns():
    bolt = box("bolt", (0.8, -0.008, 0.99), (0.8495, 0.008, 1.01))
    made = built(frame(), leaf((-0.02, 0.02)), lever(), bolt)
    joint = small(made)["bolt"]
    assert joint.type is JointType.PRISMATIC
    assert joint.coupling.leader == "grip_joint"
    assert joint.limits.upper == pytest.approx(0.0025)
    assert joint.axis.direction[0] == pytest.approx(-1.0)
    assert b'<mimic joint="grip_joint"' in export_urdf(made.object).contents["model.urdf"]


def test_no_small_parts_leaves_the_lever_on_the_door():
    assert small(built(frame(), leaf((-0.02, 0.02)), lever(), small_parts=False)) == {}


def test_a_stated_lever_turns_about_where_it_is_once_its_door_is_closed():
    """The door is drawn open by 30 degrees, with a lever on each face; nothing of them is pressed."""
    pin = Axis(vec3(0.053, -0.02, 0.0), -UPRIGHT)
    both = joined("handle", lever(), lever(y=0.02, out=1.0), box("pin", (0.782, -0.03, 0.992), (0.798, 0.03, 1.008)))
    T = np.asarray(hinged(axis=pin).axis.rotation(radians(30)))
    parts = [replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in (leaf((-0.02, 0.02)), both)]
    parts[1] = replace(parts[1], carried_by="panel")
    about = Axis(vec3(0.79, 0.0, 1.0), vec3(0.0, -1.0, 0.0)).transformed(T)
    stated = AnnotatedJoint("panel", JointType.REVOLUTE, pin, radians(-30), radians(60))
    asset = replace(
        scene(frame(), *parts, joints=(stated,)),
        small_joints=(AnnotatedJoint("handle", JointType.REVOLUTE, about, 0.0, radians(45)),),
    )
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery())
    joint = small(made)["handle"]
    assert joint.axis.point[[0, 2]] == pytest.approx([0.79, 1.0], abs=2e-3)
    assert abs(joint.axis.direction[1]) == pytest.approx(1.0, abs=1e-6)
    assert made.object.link("handle").visuals[0].mesh.box.size[1] == pytest.approx(0.15, abs=1e-3)
