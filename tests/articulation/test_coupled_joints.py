from dataclasses import replace

import numpy as np
import pytest

from bifold import CASE_HINGE, LEAF_HINGE, make_bifold
from grafu.articulation.articulated_object import Coupling, Joint, JointLimits
from grafu.articulation.kinematics import link_poses, with_coupled
from grafu.articulation.open_together import open_together
from grafu.articulation.physics import physics_of
from grafu.articulation.sweep import (
    all_open,
    cycle_tracks,
    opening_stages,
    rest_to_full,
    values_at,
    values_before,
)
from grafu.errors import ArticulationError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import transform_points
from grafu.vocabulary import JointType

BIFOLD = make_bifold()
FREE_EDGE = np.array([[0.4, -0.21, 0.4]])


def test_a_negative_multiplier_reverses_the_axis_so_that_values_stay_positive():
    assert LEAF_HINGE.coupling == Coupling("leaf_1_hinge", 2.0)
    assert np.array_equal(LEAF_HINGE.axis.direction, -CASE_HINGE.axis.direction)
    assert (LEAF_HINGE.limits.lower, LEAF_HINGE.limits.upper) == (0.0, 2.8)


def test_an_offset_may_close_what_its_leader_opens():
    closing = LEAF_HINGE.following(CASE_HINGE, multiplier=-1.0, offset=1.4)
    assert closing.coupling == Coupling("leaf_1_hinge", -1.0, 1.4)
    assert np.array_equal(closing.axis.direction, LEAF_HINGE.axis.direction)
    made = replace(BIFOLD, joints=(CASE_HINGE, closing))
    assert values_before(made, "leaf_1_hinge") == {"leaf_1_hinge": 0.0, "leaf_2_hinge": 1.4}
    assert all_open(made) == pytest.approx({"leaf_1_hinge": 1.4, "leaf_2_hinge": 0.0})
    track = cycle_tracks(made)[1]
    assert (track.values[0], track.values.min()) == pytest.approx((1.4, 0.0))


@pytest.mark.parametrize("angle", [0.0, 0.5, 1.4])
def test_leaves_fold_and_the_free_edge_stays_in_the_plane_of_the_front(angle):
    poses = link_poses(BIFOLD, {"leaf_1_hinge": angle})
    edge = transform_points(poses["leaf_2"], FREE_EDGE)[0]
    fold = transform_points(poses["leaf_1"], np.array([[0.0, -0.2, 0.4]]))[0]

    assert edge[1] == pytest.approx(-0.22 + 0.01 * np.cos(angle))
    assert np.allclose(poses["leaf_2"][:3, :3], poses["leaf_1"][:3, :3].T)
    assert fold[1] == pytest.approx(-0.22 - 0.4 * np.sin(angle) + 0.02 * np.cos(angle))


def test_a_value_of_a_coupled_joint_must_fit_its_leaders():
    assert with_coupled(BIFOLD, {"leaf_1_hinge": 0.5}) == {"leaf_1_hinge": 0.5, "leaf_2_hinge": 1.0}
    link_poses(BIFOLD, {"leaf_1_hinge": 0.5, "leaf_2_hinge": 1.0})
    with pytest.raises(ArticulationError, match=r"`leaf_2_hinge` follows `leaf_1_hinge`: it is at 1.0, got 0.2"):
        link_poses(BIFOLD, {"leaf_1_hinge": 0.5, "leaf_2_hinge": 0.2})
    assert CASE_HINGE.limits.upper == LEAF_HINGE.coupling.leader_value(LEAF_HINGE.limits.upper)


def test_coupled_joints_move_in_step():
    assert opening_stages(BIFOLD) == (("leaf_1_hinge", "leaf_2_hinge"),)
    assert rest_to_full(BIFOLD, "leaf_2_hinge", 3) == rest_to_full(BIFOLD, "leaf_1_hinge", 3)
    tracks = cycle_tracks(BIFOLD)
    for time in np.linspace(0.0, float(tracks[0].times[-1]), 9):
        values = values_at(tracks, float(time))
        assert values["leaf_2_hinge"] == pytest.approx(2 * values["leaf_1_hinge"])


def test_what_waits_for_a_coupled_joint_waits_for_its_leader():
    shelf = Joint(
        "shelf_rail",
        JointType.PRISMATIC,
        "case",
        "shelf",
        Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)),
        JointLimits(0.0, 0.2),
        ("leaf_2_hinge",),
    )
    made = replace(BIFOLD, links=(*BIFOLD.links, replace(BIFOLD.links[0], id="shelf")), joints=(shelf, *BIFOLD.joints))
    assert opening_stages(made) == (("leaf_1_hinge", "leaf_2_hinge"), ("shelf_rail",))
    assert values_before(made, "shelf_rail") == {"shelf_rail": 0.0, "leaf_1_hinge": 1.4, "leaf_2_hinge": 2.8}


def test_a_chain_of_couplings_has_one_leader():
    third = replace(LEAF_HINGE, id="third", parent="leaf_2", child="leaf_3").following(LEAF_HINGE, 0.5)
    links = (*BIFOLD.links, replace(BIFOLD.links[2], id="leaf_3"))
    made = replace(BIFOLD, links=links, joints=(third, LEAF_HINGE, CASE_HINGE))
    assert made.leader_of(third) is CASE_HINGE
    assert made.free_joints == (CASE_HINGE,)
    assert with_coupled(made, {"leaf_1_hinge": 0.3}) == pytest.approx(
        {"leaf_1_hinge": 0.3, "leaf_2_hinge": 0.6, "third": 0.3}
    )


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"coupling": Coupling("lid_hinge")}, "must follow a joint that moves: got `lid_hinge`"),
        ({"coupling": Coupling("leaf_2_hinge")}, "must not follow one another in a circle"),
        ({"limits": JointLimits(0.0, 2.0)}, r"limits of `leaf_2_hinge` must follow from `leaf_1_hinge`"),
        ({"after": ("leaf_1_hinge",)}, "cannot wait for"),
        ({"type": JointType.FIXED}, "must follow a joint that moves"),
    ],
)
def test_a_coupling_that_cannot_be_is_refused(change, why):
    with pytest.raises(ArticulationError, match=why):
        replace(BIFOLD, joints=(CASE_HINGE, replace(LEAF_HINGE, **change)))


@pytest.mark.parametrize("numbers", [(0.0, 0.0), (float("nan"), 0.0), (1.0, float("inf"))])
def test_the_numbers_of_a_coupling_are_finite(numbers):
    with pytest.raises(ArticulationError, match="a coupling needs finite numbers"):
        Coupling("leaf_1_hinge", *numbers)


def test_limits_on_both_sides_of_closed_are_refused():
    with pytest.raises(ArticulationError, match="0 <= lower <= upper"):
        LEAF_HINGE.following(CASE_HINGE, multiplier=2.0, offset=-1.0)


def test_collision_shapes_give_way_along_the_common_path():
    shapes = physics_of(BIFOLD).shapes
    assert all(shapes[link.id] for link in BIFOLD.links)
    assert open_together(BIFOLD, shapes) == pytest.approx({"leaf_1_hinge": 1.4, "leaf_2_hinge": 2.8})
