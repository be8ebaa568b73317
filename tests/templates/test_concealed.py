import numpy as np
import pytest

from grafu.errors import TemplateError
from grafu.geometry.transform import from_rotation, rotation_matrix, transform_points
from grafu.render.gallery import concealed_as_articulated, natural_object
from grafu.render.picture import posed_visuals
from grafu.templates.concealed import ConcealedModel
from grafu.templates.gallery import builtin_gallery

MODEL = ConcealedModel("cup", "Concealed cup hinge")


def test_the_gallery_has_it_apart_from_the_classes():
    gallery = builtin_gallery()

    assert [model.id for model in gallery.concealed] == ["cup"]
    assert "cup" not in [model.id for model in gallery.hinges]


@pytest.mark.parametrize("side", [0.02, 0.016, 0.009, -0.002])
def test_the_plate_stands_on_the_side_and_the_cup_in_the_door(side):
    hinge = MODEL.build(side, 0.0115)
    plate = np.vstack([surface.mesh.vertices for surface in hinge.static])
    cup = np.vstack([surface.mesh.vertices for surface in hinge.dynamic])

    assert plate[:, 0].min() == pytest.approx(side)
    assert plate[:, 1].max() < -0.005  # behind the door
    assert cup[:, 1].max() == pytest.approx(0.0115)
    assert np.ptp(cup[:, 0]) == pytest.approx(0.035, abs=2e-4)
    solids = [*hinge.static, *hinge.dynamic, *(surface for arm in hinge.arms for surface in arm.surfaces)]
    assert all(surface.mesh.is_watertight for surface in solids)


def test_links_end_on_the_cup_in_every_pose():
    hinge = MODEL.natural
    shifts = hinge.linkage.shifts(hinge.angles)
    for k, arm in enumerate(hinge.arms[1:]):
        for angle, turn, shift in zip(hinge.angles, arm.turns, shifts, strict=True):
            pivot, moving = np.array([*arm.pivot, 0.0]), np.array([*hinge.linkage.moving[k], 0.0])
            turned = rotation_matrix(np.array([0.0, 0.0, 1.0]), float(turn)) @ (moving - pivot) + pivot
            with_door = rotation_matrix(np.array([0.0, 0.0, 1.0]), float(angle)) @ moving + [*shift, 0.0]
            assert np.allclose(turned, with_door, atol=1e-12)


def test_the_object_of_the_gallery_shows_links_that_stay_on_the_cup():
    made = concealed_as_articulated(MODEL)
    assert natural_object(MODEL).name == "cup"
    for value in (0.4, 1.2, MODEL.range):
        shown = {visual.name: visual.mesh for visual in posed_visuals(made, {"cup_joint": value})}
        cup = shown["hinge_cup_dynamic"].box.grown(1e-4)
        for name in ("hinge_cup_link_0", "hinge_cup_link_1"):
            inside = np.all((shown[name].vertices >= cup.low) & (shown[name].vertices <= cup.high), axis=1)
            assert inside.any(), (name, value)


def test_in_another_scale_all_of_it_is_in_scale():
    small, T = MODEL.at_scale(0.1).build(0.0016, 0.00115), from_rotation(0.1 * np.eye(3))
    for one, other in zip(small.static, MODEL.build(0.016, 0.0115).static, strict=True):
        assert np.allclose(one.mesh.vertices, transform_points(T, other.mesh.vertices))


@pytest.mark.parametrize(("side", "depth"), [(0.03, 0.0115), (0.016, 0.0)])
def test_what_leaves_the_arm_or_the_cup_no_room_is_refused(side, depth):
    with pytest.raises(TemplateError, match="a cup with a depth and room for its arm"):
        MODEL.build(side, depth)
