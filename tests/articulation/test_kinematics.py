from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link
from grafu.articulation.kinematics import REST, all_before, link_poses, moved_poses
from grafu.errors import ArticulationError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import transform_points
from grafu.vocabulary import JointType

UP = vec3(0.0, 0.0, 1.0)
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


@given(st.lists(st.tuples(st.integers(0, 30), st.sampled_from([0.0, 0.0, 0.7, -1.2])), min_size=1, max_size=8))
def test_each_link_is_carried_by_all_joints_above_it(tree):
    """In any tree, few joints open or many, in whatever order links and joints are listed."""
    joints = tuple(
        replace(
            DOOR, id=f"j{k}", parent=f"l{above % (k + 1)}", child=f"l{k + 1}", axis=Axis(vec3(0.1 * k, 0.0, 0.0), UP)
        )
        for k, (above, _) in enumerate(tree)
    )
    links = tuple(Link(f"l{k}", ()) for k in range(len(tree) + 1))
    chain = ArticulatedObject("tree", "l0", links[::-1], joints[::-1])
    values = {f"j{k}": value for k, (_, value) in enumerate(tree)}
    poses = link_poses(chain, values)
    expected = {"l0": np.eye(4)}
    for joint in joints:
        expected[joint.child] = expected[joint.parent] @ joint.motion(values[joint.id])
    assert list(poses) == [link.id for link in chain.links_from_root]
    for link, pose in poses.items():
        np.testing.assert_allclose(pose, expected[link], atol=1e-12)
        assert (pose is REST) == np.array_equal(expected[link], np.eye(4))
    moved = moved_poses(chain, values)
    assert moved.keys() == {link for link, pose in poses.items() if pose is not REST}
    for link, pose in moved.items():
        np.testing.assert_array_equal(pose, poses[link])


def test_an_unknown_joint_is_named():
    with pytest.raises(ArticulationError, match=r"lid_joint.*door_joint"):
        link_poses(CHAIN, {"lid_joint": 1.0})


def test_what_waits_for_what_waits() -> None:
    waits = {"drawer": ("door",), "door": ("flap", "leaf"), "leaf": ()}
    assert all_before("drawer", waits) == {"door", "flap", "leaf"}
    assert all_before("flap", waits) == set()


def test_a_circle_comes_to_an_end() -> None:
    assert all_before("a", {"a": {"b"}, "b": {"a"}}) == {"a", "b"}
