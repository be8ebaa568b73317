import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.collision_clearance import ShapeClearanceConfig, cleared
from grafu.articulation.collision_shapes import CollisionShape, corners_of
from grafu.articulation.sweep import ratios_of_range
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.solids import ConvexSolid
from grafu.vocabulary import JointType

OUT = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0))


def box(*bounds: float) -> OrientedBox:
    low, high = np.array(bounds[:3], dtype=float), np.array(bounds[3:], dtype=float)
    return OrientedBox((low + high) / 2, (high - low) / 2, np.eye(3))


def made(
    kind: JointType = JointType.PRISMATIC, axis: Axis = OUT, upper: float = 0.4, after: tuple[str, ...] = ()
) -> ArticulatedObject:
    joint = Joint("slide", kind, "body", "drawer", axis, JointLimits(0.0, upper), after)
    return ArticulatedObject("o", "body", (Link("body", ()), Link("drawer", ())), (joint,))


def bounds(shape: CollisionShape) -> list[list[float]]:
    around = Box.around(corners_of(shape))
    return np.round([around.low, around.high], 4).tolist()


SIDE = box(0.3, -0.3, 0, 0.318, 0.3, 0.5)


def test_what_does_not_meet_stays_as_it_is():
    shapes = {"body": (SIDE,), "drawer": (box(0, -0.3, 0.1, 0.299, 0.2, 0.3),)}

    assert cleared(made(), shapes) == shapes


def test_a_drawer_box_that_cuts_into_a_side_is_trimmed():
    shapes = {"body": (SIDE,), "drawer": (box(0, -0.3, 0.1, 0.304, 0.2, 0.3),)}

    result = cleared(made(), shapes)

    assert result["body"] == (SIDE,)
    assert bounds(result["drawer"][0]) == [[0, -0.3, 0.1], [0.2995, 0.2, 0.3]]


def test_what_stands_in_the_path_alone_is_cut_too():
    sill = box(0, -0.5, 0, 0.3, -0.45, 0.105)  # met only when the drawer is out

    (lower,) = cleared(made(), {"body": (sill,), "drawer": (box(0, -0.3, 0.1, 0.3, 0.2, 0.3),)})["body"]

    assert bounds(lower)[1][2] == pytest.approx(0.0995)


def test_a_hull_is_cut_by_a_plane():
    points = np.array([[0, -0.3, 0.1], [0.31, -0.3, 0.1], [0, 0.2, 0.1], [0.31, 0.2, 0.1], [0.15, 0, 0.4]])
    shapes = {"body": (SIDE,), "drawer": (ConvexSolid.around(points),)}

    (drawer,) = cleared(made(), shapes)["drawer"]

    assert isinstance(drawer, ConvexSolid)
    assert bounds(drawer)[1][0] == pytest.approx(0.2995)


def test_a_door_that_swings_through_its_stop_keeps_clear():
    door = box(0, -0.02, 0, 0.4, 0.0, 0.6)
    stop = box(-0.02, -0.05, 0, 0.003, -0.021, 0.6)
    swing = made(JointType.REVOLUTE, Axis(vec3(0.0, -0.02, 0.0), vec3(0.0, 0.0, -1.0)), 1.5)

    result = cleared(swing, {"body": (stop,), "drawer": (door,)})

    assert cleared(swing, result) == result


def test_the_frame_goes_before_the_drawer():
    block = box(0.05, -0.6, 0.08, 0.25, 0.3, 0.32)  # a stand-in that fills the opening

    result = cleared(made(), {"body": (SIDE, block), "drawer": (box(0, -0.3, 0.1, 0.299, 0.2, 0.3),)})

    assert result["body"] == (SIDE,)
    assert len(result["drawer"]) == 1


def test_of_two_moving_shapes_the_smaller_goes():
    joints = tuple(Joint(f"j{n}", JointType.PRISMATIC, "body", n, OUT, JointLimits(0.0, 0.01)) for n in ("a", "b"))
    both = ArticulatedObject("o", "body", (Link("body", ()), Link("a", ()), Link("b", ())), joints)
    large, small = box(0, 0, 0, 1, 1, 1), box(0.2, 0.2, 0.2, 0.5, 0.5, 0.5)

    assert cleared(both, {"body": (), "a": (large,), "b": (small,)}) == {"body": (), "a": (large,), "b": ()}


def test_shapes_of_one_link_may_overlap():
    shapes = {"body": (), "drawer": (box(0, 0, 0, 1, 1, 1), box(0.5, 0, 0, 2, 1, 1))}

    assert cleared(made(), shapes) == shapes


def test_no_motion_needs_no_clearance():
    static = ArticulatedObject("o", "body", (Link("body", (Visual("a", ()),)),))

    assert cleared(static, {"body": (SIDE,)}, ShapeClearanceConfig()) == {"body": (SIDE,)}


@pytest.mark.parametrize("way", [0.003, 0.01, 0.03, 0.08, 0.2, 0.35])
def test_what_is_met_for_a_short_part_of_the_way_gives_way(way):
    front = box(0, -0.31, 0.1, 0.3, -0.3, 0.3)
    stop = box(0.298, -0.3105 - way - 0.02, 0.1, 0.33, -0.3105 - way, 0.3)  # ahead of the front by `way`, 2 mm into it

    result = cleared(made(), {"body": (stop,), "drawer": (front,)})

    (drawer,), body = result["drawer"], result["body"]
    assert all(bounds(drawer)[1][0] < bounds(other)[0][0] for other in body)


def test_poses_lie_closer_near_rest():
    config = ShapeClearanceConfig()
    ratios = ratios_of_range(config.poses, config.crowding)

    assert ratios[[0, -1]].tolist() == [0.0, 1.0]
    assert ratios[1] * 0.5 < 0.001  # of a drawer of half a metre, the first step is less than a millimetre
    assert np.all(np.diff(ratios, 2) > 0)
    assert np.diff(ratios).max() < 0.09


def test_the_bottom_of_a_drawer_stays_where_a_hull_around_the_case_is_in_its_way():
    bottom = box(0, -0.3, 0.1, 0.6, 0.3, 0.17)
    case = box(0.16, -0.3, 0.0, 1.5, 0.3, 0.7)  # stands for sheets around the drawer's place

    result = cleared(made(), {"body": (case,), "drawer": (bottom,)})

    assert bounds(result["drawer"][0]) == bounds(bottom)


@pytest.mark.parametrize("name", ["poses", "crowding", "margin", "moving_ratio", "moving_counts", "rounds"])
def test_a_setting_that_is_not_above_0_is_refused(name):
    with pytest.raises(ValueError, match=f"`ShapeClearanceConfig.{name}` must be above 0"):
        ShapeClearanceConfig(**{name: type(getattr(ShapeClearanceConfig(), name))(0)})
