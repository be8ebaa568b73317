import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.asset.edit import as_static_object, centred, mirrored, moved, scaled, yawed
from grafu.geometry.transform import from_rotation, reflection, rotation_about, transform_points
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import CellRow, Door, Drawer
from grafu.vocabulary import JointType
from strategies import furniture_specs, made, yaws
from sweeping import joint_motion

ASSET = make_cabinet(Cabinet(layout=CellRow((Door(), Drawer()))))
few = settings(max_examples=15)


def similarities():
    def similarity(yaw, factor, mirror):
        T = rotation_about(np.array([0.1, 0.2, 0.0]), np.array([0.0, 0.0, 1.0]), yaw)
        T = T @ reflection(np.zeros(3), np.array([1.0, 0.0, 0.0])) if mirror else T
        return T @ from_rotation(np.eye(3) * factor)

    return st.builds(similarity, yaws, st.floats(0.1, 10), st.booleans())


@few
@given(furniture_specs, similarities())
def test_moving_an_asset_commutes_with_opening_it(spec, T):
    asset = made(spec)
    for before, after in zip(asset.joints, moved(asset, T).joints, strict=True):
        points = asset.part(before.part).mesh.vertices
        opened = transform_points(T, transform_points(joint_motion(before, before.upper), points))
        image = transform_points(joint_motion(after, after.upper), transform_points(T, points))
        assert np.allclose(opened, image, atol=1e-9 * max(1.0, float(np.abs(opened).max())))


@given(yaws)
def test_yaw_there_and_back_is_nothing(angle):
    back = yawed(yawed(ASSET, angle), -angle)
    assert np.allclose(back.part("door").mesh.vertices, ASSET.part("door").mesh.vertices)
    assert np.allclose(back.joints[0].axis.point, ASSET.joints[0].axis.point)


@pytest.mark.parametrize("axis", ["x", "y"])
def test_two_mirror_images_are_nothing_and_solids_stay_outward(axis):
    once = mirrored(ASSET, axis)
    assert once.part("door").mesh.to_trimesh().volume > 0
    twice = mirrored(once, axis)
    assert np.allclose(twice.part("door").mesh.vertices, ASSET.part("door").mesh.vertices)
    assert np.allclose(twice.joints[0].axis.direction, ASSET.joints[0].axis.direction)


def test_a_mirror_image_swaps_the_hinge_side():
    joint = mirrored(ASSET, "x").joints[0]
    assert joint.axis.direction == pytest.approx(-ASSET.joints[0].axis.direction)
    assert joint.axis.point[0] == pytest.approx(-ASSET.joints[0].axis.point[0])


def test_scaling_scales_travel_but_not_angles():
    for joint, larger in zip(ASSET.joints, scaled(ASSET, 3.0).joints, strict=True):
        factor = 3.0 if joint.type is JointType.PRISMATIC else 1.0
        assert larger.upper == pytest.approx(factor * joint.upper)


def test_the_frame_keeps_the_way_from_the_input():
    turned = scaled(yawed(ASSET, 0.5), 2.0)
    vertices = transform_points(np.asarray(turned.frame.input_to_output), ASSET.part("door").mesh.vertices)
    assert np.allclose(vertices, turned.part("door").mesh.vertices)
    assert turned.frame.scale == pytest.approx(2.0)


def test_centred_undoes_a_shift():
    shifted = moved(ASSET, from_rotation(np.eye(3), np.array([1.0, -2.0, 3.0])))
    assert np.allclose(centred(shifted).box.low, ASSET.box.low)


@pytest.mark.parametrize("linear", [np.diag([1.0, 1.0, 2.0]), np.zeros((3, 3)), np.diag([1.0, 1.0, 0.0])])
def test_what_is_no_similarity_is_refused(linear):
    with pytest.raises(ValueError, match="must be a similarity"):
        moved(ASSET, from_rotation(linear))


@pytest.mark.parametrize("factor", [0.0, -1.0, float("nan")])
def test_a_scale_must_be_positive(factor):
    with pytest.raises(ValueError, match="must be above 0"):
        scaled(ASSET, factor)


def test_a_static_object_holds_each_part_and_no_joint():
    static = as_static_object(ASSET)
    assert static.joints == ()
    assert [v.name for v in static.links[0].visuals] == [p.id for p in ASSET.parts]
