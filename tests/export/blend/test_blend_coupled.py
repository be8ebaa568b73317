"""A coupled joint in Blender: it follows its leader by a driver, in the animation and by hand."""

import numpy as np
import pytest

from bifold import make_bifold
from grafu.articulation.kinematics import link_origins, link_poses
from grafu.export.blend.layout import cycle_keys
from grafu.geometry.transform import from_rotation


@pytest.fixture(scope="module")
def bifold():
    return make_bifold()


@pytest.fixture(scope="module")
def found(reopened, bifold):
    return reopened(bifold)


def require_poses(bifold, poses, angle):
    expected, origins = link_poses(bifold, {"leaf_1_hinge": angle}), link_origins(bifold)
    for link in bifold.links:
        T = expected[link.id] @ from_rotation(np.eye(3), origins[link.id])
        assert np.allclose(poses[f"{link.id}_link"], T, atol=1e-5), link.id


def test_only_the_leader_has_keys(bifold):
    assert set(cycle_keys(bifold)) == {"leaf_1_hinge"}


@pytest.mark.parametrize(("frame", "ratio"), [(0, 0.0), (50, 1.0), (100, 0.0)])
def test_the_animation_moves_both_leaves(found, bifold, frame, ratio):
    require_poses(bifold, found["frames"][frame], 1.4 * ratio)


def test_both_leaves_follow_one_property(found, bifold):
    ratio, poses = found["alone"]["leaf_1_hinge"]
    assert set(found["alone"]) == {"leaf_1_hinge"}
    require_poses(bifold, poses, 1.4 * ratio)


def test_the_empty_says_what_it_follows(found):
    said = found["objects"]["leaf_2_hinge_joint"]["properties"]
    assert (said["leader"], said["multiplier"], said["offset"]) == ("leaf_1_hinge", 2.0, 0.0)
