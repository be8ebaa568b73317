import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link
from grafu.articulation.kinematics import all_before, link_poses
from grafu.errors import ArticulationError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import transform_points
from grafu.vocabulary import JointType

DOOR = Joint(
    "door_joint",
    JointType.REVOLUTE,
    "body",
    "door",
    Axis(vec3(-0.5, 0.0, 0.0), vec3(0.0, 0.0, -1.0)),
    JointLimits(0.0, 2.0),
)
BOX = Joint(
    "box_joint",
    JointType.PRISMATIC,
    "door",
    "box",
    Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)),
    JointLimits(0.0, 0.3),
)
# children stand before their parents here: the order of the lists must not matter
CHAIN = ArticulatedObject("chain", "body", (Link("box", ()), Link("door", ()), Link("body", ())), (BOX, DOOR))


def test_rest_is_no_motion():
    poses = link_poses(CHAIN, {})

    assert set(poses) == {"body", "door", "box"}
    assert all(np.array_equal(pose, np.eye(4)) for pose in poses.values())


def test_a_left_hinged_door_swings_to_the_front():
    edge = transform_points(link_poses(CHAIN, {"door_joint": np.pi / 2})["door"], np.array([[0.5, 0.0, 0.0]]))

    assert np.allclose(edge, [[-0.5, -1.0, 0.0]])


def test_a_child_is_carried_by_its_parent():
    poses = link_poses(CHAIN, {"door_joint": np.pi / 2, "box_joint": 0.3})

    assert np.allclose(poses["box"][:3, 3] - poses["door"][:3, 3], [-0.3, 0, 0])


@given(st.floats(-3, 3), st.floats(-1, 1))
def test_poses_stay_rigid(angle, shift):
    for pose in link_poses(CHAIN, {"door_joint": angle, "box_joint": shift}).values():
        assert np.allclose(pose[:3, :3] @ pose[:3, :3].T, np.eye(3))
        assert np.linalg.det(pose[:3, :3]) == pytest.approx(1)


def test_an_unknown_joint_is_named():
    with pytest.raises(ArticulationError, match=r"lid_joint.*door_joint"):
        link_poses(CHAIN, {"lid_joint": 1.0})


def test_what_waits_for_what_waits() -> None:
    waits = {"drawer": ("door",), "door": ("flap", "leaf"), "leaf": ()}
    assert all_before("drawer", waits) == {"door", "flap", "leaf"}
    assert all_before("flap", waits) == set()


def test_a_circle_comes_to_an_end() -> None:
    assert all_before("a", {"a": {"b"}, "b": {"a"}}) == {"a", "b"}
