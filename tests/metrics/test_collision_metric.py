"""A door and a drawer of boxes: known fractions of colliding poses, known gaps."""

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.geometry.appearance import Surface
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.metrics.collision import (
    STRICT,
    TOLERANT,
    CollisionConfig,
    ConnectivityConfig,
    collision_shares,
    connected_joints,
    connectivity,
    first_collisions,
    largest_gaps,
    mean_collision,
)
from grafu.vocabulary import JointType


def visual(name, low, high, role=VisualRole.PART) -> Visual:
    mesh = TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))
    return Visual(name, (Surface(mesh),), role)


# A case of one metre, open to -Y; a block that starts 2 cm in front of it and slides.
CASE = Link("case", (visual("left", [0, 0, 0], [0.02, 1, 1]), visual("back", [0, 0.98, 0], [1, 1, 1])))

OUT = Axis(np.zeros(3), np.array([0.0, -1.0, 0.0]))


def slider(low, high, direction, travel, extra=()) -> ArticulatedObject:
    block = Link("block", (visual("block", low, high), *extra))
    axis = Axis(np.zeros(3), np.array(direction, float))
    joint = Joint("slide", JointType.PRISMATIC, "case", "block", axis, JointLimits(0.0, travel))
    return ArticulatedObject("box", "case", (CASE, block), (joint,))


def test_a_free_drawer_never_collides():
    free = slider([0.3, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5)
    assert mean_collision(free) == 0.0
    assert mean_collision(free, TOLERANT) == 0.0


def test_a_block_pushed_into_the_back_collides_for_the_fraction_of_its_way():
    # Its front reaches the back's near face (0.98) at 0.5 and its rear leaves the far face (1.0) at 0.7 of the way.
    pushed = slider([0.3, 0.3, 0.3], [0.6, 0.48, 0.6], [0, 1, 0], 1.0)
    ratio = collision_shares(pushed, CollisionConfig(poses=101))["slide"]
    assert ratio == pytest.approx(21 / 101, abs=0.011)


def test_the_first_collision_is_where_the_block_meets_the_back():
    pushed = slider([0.3, 0.3, 0.3], [0.6, 0.48, 0.6], [0, 1, 0], 1.0)
    first = first_collisions(pushed, ["slide"], CollisionConfig(poses=101))["slide"]
    assert first.value == pytest.approx(0.5, abs=0.011)
    assert first.others == ("back",)
    assert first_collisions(pushed, []) == {}
    assert first_collisions(slider([0.3, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5), ["slide"]) == {}


def test_poses_are_evenly_spaced_and_both_ends_count():
    touching_at_the_end = slider([0.3, 0.1, 0.3], [0.6, 0.9, 0.6], [0, 1, 0], 0.081)
    assert collision_shares(touching_at_the_end, CollisionConfig(poses=2))["slide"] == 0.5


def test_lying_flush_collides_strictly_and_not_with_a_tolerance():
    flush = slider([0.02, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5)
    assert mean_collision(flush, STRICT) == 1.0
    assert mean_collision(flush, TOLERANT) == 0.0


def test_the_tolerance_is_a_fraction_of_the_largest_side():
    deep = slider([0.005, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5)
    assert mean_collision(deep, CollisionConfig(tolerance=0.002)) > 0.5
    assert mean_collision(deep, CollisionConfig(tolerance=0.02)) == 0.0


@pytest.mark.parametrize(("cut", "collides"), [(0.0004, 0.0), (0.002, 1.0)])
def test_the_tolerant_figure_allows_half_a_millimetre_in_a_unit_cube(cut, collides):
    pressed = slider([0.02 - cut, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.05)
    assert mean_collision(pressed, TOLERANT) == collides


@pytest.mark.parametrize(("sides", "collides"), [(["left"], 0.0), (["left", "right"], 1.0)])
def test_a_thin_body_wedged_between_two_obstacles_collides(sides, collides):
    sheet = slider([0.3, 0.1, 0.3], [0.301, 0.9, 0.6], [0, -1, 0], 0.05)
    boxes = {"left": ([0.28, 0, 0], [0.3006, 0.9, 0.5]), "right": ([0.3004, 0, 0], [0.32, 0.9, 0.5])}
    links = [Link(name, (visual(name, *boxes[name]),)) for name in sides]
    joints = [Joint(f"j_{name}", JointType.PRISMATIC, "case", name, OUT, JointLimits(0.0, 0.05)) for name in sides]
    clamped = ArticulatedObject("box", "case", (*sheet.links, *links), (*sheet.joints, *joints))
    assert collision_shares(clamped, CollisionConfig(tolerance=0.001, moving_bodies=True))["slide"] == collides


def test_hardware_counts_where_asked():
    rail = visual("rail_1", [0.01, 0.2, 0.4], [0.3, 0.8, 0.42], VisualRole.HARDWARE)
    free = slider([0.3, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.1, (rail,))
    assert mean_collision(free) == 0.0
    assert mean_collision(free, CollisionConfig(hardware=True)) == 1.0


def test_other_bodies_count_where_asked():
    free = slider([0.3, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5)
    other = Link("other", (visual("other", [0.3, -0.2, 0.3], [0.6, -0.1, 0.6]),))
    axis = Axis(np.zeros(3), np.array([1.0, 0.0, 0.0]))
    joint = Joint("aside", JointType.PRISMATIC, "case", "other", axis, JointLimits(0.0, 0.5))
    both = ArticulatedObject("box", "case", (*free.links, other), (*free.joints, joint))
    assert collision_shares(both)["slide"] == 0.0
    assert collision_shares(both, CollisionConfig(moving_bodies=True))["slide"] > 0.3


def test_a_joint_that_waits_starts_where_the_other_is_open():
    free = slider([0.3, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5)
    other = Link("other", (visual("other", [0.3, -0.2, 0.3], [0.6, -0.1, 0.6]),))
    aside = Axis(np.zeros(3), np.array([1.0, 0.0, 0.0]))
    joint = Joint("aside", JointType.PRISMATIC, "case", "other", aside, JointLimits(0.0, 0.5))
    slide = free.joints[0]
    waiting = Joint(slide.id, slide.type, "case", "block", slide.axis, slide.limits, ("aside",))
    both = ArticulatedObject("box", "case", (*free.links, other), (waiting, joint))
    assert collision_shares(both, CollisionConfig(moving_bodies=True))["slide"] == 0.0


def test_a_handle_fixed_to_a_drawer_moves_with_it():
    free = slider([0.3, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5)
    bar = Link("bar", (visual("bar", [0.0, 0.4, 0.4], [0.3, 0.42, 0.42]),))
    fixed = Joint("held", JointType.FIXED, "block", "bar", free.joints[0].axis, JointLimits(0.0, 0.0))
    assert mean_collision(ArticulatedObject("box", "case", (*free.links, bar), (*free.joints, fixed))) > 0.5


def test_an_object_without_joints_neither_collides_nor_comes_loose():
    still = ArticulatedObject("box", "case", (CASE,))
    assert mean_collision(still) == 0.0
    assert connectivity(still) == 1.0
    assert collision_shares(still) == {}


def test_the_largest_gap_is_measured_over_the_whole_motion():
    leaving = slider([0.022, 0.1, 0.3], [0.6, 0.9, 0.6], [1, 0, 0], 0.3)
    assert largest_gaps(leaving)["slide"] == pytest.approx(0.08, abs=1e-6)  # to the back, 8 cm behind it
    assert connectivity(leaving) == 0.0


def test_a_drawer_that_stays_by_its_wall_is_connected():
    assert connected_joints(slider([0.024, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5)) == {"slide": True}
    assert connected_joints(slider([0.026, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.5)) == {"slide": False}


@pytest.mark.parametrize(("start", "held"), [(0.02, True), (0.024, True), (0.08, False)])
def test_hardware_bridges_a_gap_only_where_it_is_anchored(start, held):
    free = [[0.3, 0.1, 0.3], [0.6, 0.9, 0.6]]
    rail = visual("rail_1", [0.0201, 0.1, 0.4], [0.3 - start + 0.02, 0.9, 0.42], VisualRole.HARDWARE)
    loose = slider(*free, [0, -1, 0], 0.4, (rail,))
    assert connected_joints(loose)["slide"] is held


def test_hardware_may_hang_on_anchored_hardware():
    inner = visual("rail_in", [0.15, 0.1, 0.4], [0.3, 0.9, 0.42], VisualRole.HARDWARE)
    outer = visual("rail_out", [0.0201, 0.1, 0.4], [0.15, 0.9, 0.42], VisualRole.HARDWARE)
    assert connectivity(slider([0.3, 0.1, 0.3], [0.6, 0.9, 0.6], [0, -1, 0], 0.4, (outer, inner))) == 1.0


def test_a_static_body_without_faces_holds_nothing():
    block = Link("block", (visual("block", [0, 0, 0], [1, 1, 1]),))
    axis = Axis(np.zeros(3), np.array([1.0, 0.0, 0.0]))
    joint = Joint("slide", JointType.PRISMATIC, "nothing", "block", axis, JointLimits(0.0, 1.0))
    lone = ArticulatedObject("box", "nothing", (Link("nothing", ()), block), (joint,))
    assert largest_gaps(lone) == {"slide": np.inf}
    assert mean_collision(lone) == 0.0


def test_settings_are_checked():
    with pytest.raises(ValueError, match="poses"):
        CollisionConfig(poses=0)
    with pytest.raises(ValueError, match="tolerance"):
        ConnectivityConfig(tolerance=-1.0)
