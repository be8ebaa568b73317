"""Hardware that turns on its own pin in Blender: by a driver, in the animation and by hand."""

import lids_and_flaps
import numpy as np
import pytest
from test_swings import SWING, expected, with_bar

from grafu.articulation.kinematics import link_origins
from grafu.geometry.transform import from_rotation, transform_points
from grafu.render.gallery import concealed_as_articulated
from grafu.templates.gallery import builtin_gallery


@pytest.fixture(scope="module", params=["body", "lid"])
def opened(request, reopened):
    made = with_bar(request.param)
    return request.param, made, reopened(made)


@pytest.mark.parametrize("frame", [0, 12, 25, 50, 75, 100])
def test_it_turns_with_the_animation(opened, frame):
    on, made, found = opened
    lid = found["frames"][frame]["lid_link"][:3, :3]
    value = float(np.arctan2(-lid[2, 1], lid[1, 1]))

    require_posed(made, on, found, found["frames"][frame], value)


def test_it_turns_when_the_joint_is_set_by_hand(opened):
    on, made, found = opened
    ratio, poses = found["alone"]["lid"]

    assert ratio == pytest.approx(0.4)
    require_posed(made, on, found, poses, 0.4 * made.joints[0].limits.upper)


def require_posed(made, on, found, poses, value):
    corners = found["objects"]["hinge_lid_bar"]["triangles"].reshape(-1, 3)
    at_pin = transform_points(poses["hinge_lid_bar"], corners)
    wanted = expected(made, on, value)

    assert lids_and_flaps.chest().joints[0].limits.upper < SWING.values[-1]
    assert np.abs(at_pin[:, None] - wanted[None]).max(axis=2).min(axis=1).max() < 1e-4


@pytest.mark.parametrize("frame", [0, 12, 25, 50])
def test_a_door_on_concealed_hinges_turns_and_shifts(reopened_hinge, frame):
    hinge, found = reopened_hinge
    (joint,) = hinge.joints
    poses = found["frames"][frame]
    turned = poses["dynamic_link"][:3, :3]
    value = abs(float(np.arctan2(turned[1, 0], turned[0, 0])))

    expected = joint.shown_motion(value) @ from_rotation(np.eye(3), link_origins(hinge)["dynamic"])
    assert np.allclose(poses["dynamic_link"], expected, atol=1e-4)


@pytest.fixture(scope="module")
def reopened_hinge(reopened):
    hinge = concealed_as_articulated(builtin_gallery().concealed[0])
    return hinge, reopened(hinge)
