"""Hardware that turns on its own pin in Blender: by a driver, in the animation and by hand."""

import lids_and_flaps
import numpy as np
import pytest
from test_swings import SWING, expected, with_bar

from grafu.geometry.transform import transform_points


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
