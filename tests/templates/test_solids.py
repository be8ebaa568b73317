import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry import Polygon, box

from grafu.geometry.arrays import vec3
from grafu.templates.solids import STEEL, disc, extrude, finished, placed, rectangle, tube, turned


def volume(mesh):
    return float(mesh.to_trimesh().volume)


@given(st.floats(0.01, 5), st.floats(0.01, 5), st.floats(0.01, 5))
def test_an_extruded_rectangle_is_a_closed_box_of_its_volume(width, height, depth):
    mesh = extrude(box(0, 0, width, height), 1.0, 1.0 + depth)
    assert mesh.is_watertight
    assert volume(mesh) == pytest.approx(width * height * depth, rel=1e-9)


def test_an_extruded_plate_keeps_its_hole():
    plate = box(-1, -1, 1, 1).difference(disc((0.0, 0.0), 0.5, 24))
    mesh = extrude(plate, 0.0, 0.1)
    assert mesh.is_watertight
    assert volume(mesh) == pytest.approx(plate.area * 0.1)


def test_points_on_straight_sides_do_not_open_a_plate():
    assert extrude(Polygon([(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]), 0.0, 1.0).is_watertight


def test_two_islands_become_two_solids():
    mesh = extrude(box(0, 0, 1, 1).union(box(2, 0, 3, 1)), 0.0, 1.0)
    assert len(mesh.to_trimesh().split(only_watertight=True)) == 2


def test_a_turned_profile_is_closed_and_outward_in_either_order():
    profile = [(0.0, 0.0), (1.0, 0.0), (0.5, 1.0), (0.0, 1.5)]
    for order in (profile, profile[::-1]):
        mesh = turned(order, 24)
        assert mesh.is_watertight
        assert volume(mesh) > 0


def test_a_tube_has_the_volume_of_its_polygonal_ring():
    mesh = tube(1.0, 2.0, (0.0, 3.0), segments=12)
    ring = 12 / 2 * np.sin(2 * np.pi / 12) * (4 - 1)
    assert mesh.is_watertight
    assert volume(mesh) == pytest.approx(3 * ring)


def test_a_chamfer_takes_material_off_a_tube_and_leaves_it_closed():
    mesh = tube(0.0, 2.0, (0.0, 3.0), chamfer=0.3)
    assert mesh.is_watertight
    assert volume(mesh) < volume(tube(0.0, 2.0, (0.0, 3.0)))


def test_a_chamfer_never_eats_the_whole_rectangle():
    assert rectangle((0.0, 1.0), (0.0, 1.0), chamfer=9.0).area > 0.5


def test_placing_in_a_left_handed_frame_keeps_solids_outward():
    mesh = placed(extrude(box(0, 0, 1, 2), 0.0, 3.0), vec3(-1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(0.0, -1.0, 0.0))
    assert mesh.is_watertight
    assert volume(mesh) == pytest.approx(6.0)
    np.testing.assert_allclose(mesh.box.low, [-1, -3, 0], atol=1e-12)


def test_finishing_smooths_curves_and_keeps_edges():
    surface = finished(tube(0.0, 1.0, (0.0, 1.0), segments=12), STEEL)
    assert surface.normals is not None
    assert surface.mesh.is_watertight
    flat = np.abs(surface.normals[:, 2])
    assert np.all((flat < 1e-6) | (flat > 1 - 1e-6))  # the side's normals never lean towards the caps
    side = surface.normals[flat < 1e-6]
    radial = surface.mesh.vertices[flat < 1e-6][:, :2]
    np.testing.assert_allclose(np.sum(side[:, :2] * radial, axis=1), 1.0, atol=1e-3)
