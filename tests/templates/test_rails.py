"""The geometric contract of rails (`templates/rails.py`), on both built-ins at ordinary and extreme sizes."""

import fcl
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.errors import TemplateError
from grafu.geometry.transform import translation
from grafu.templates.gallery import builtin_gallery
from grafu.templates.rails import shelf_of
from grafu.templates.template import RailSize
from grafu.vocabulary import MechanismClass

RAILS = builtin_gallery().rails
SIZES = (
    RailSize(0.45, 0.045, 0.0127),
    RailSize(0.03, 0.01, 0.001),
    RailSize(2.0, 0.05, 0.04),
    RailSize(0.3, 0.02, 0.04),
    RailSize(0.3, 0.1, 0.002),
)
every_case = pytest.mark.parametrize(("model", "size"), [(m, s) for m in RAILS for s in SIZES])


def bvh(mesh):
    model = fcl.BVHModel()
    model.beginModel(len(mesh.vertices), len(mesh.faces))
    model.addSubModel(mesh.vertices, mesh.faces)
    model.endModel()
    return model


def closest_while_sliding(template, count=7, aside=0.0):
    static, moving = fcl.CollisionObject(bvh(template.static.mesh)), bvh(template.dynamic.mesh)
    found = []
    for travel in np.linspace(0, template.range, count):
        T = translation(np.array([aside, -travel, 0.0]))
        posed = fcl.CollisionObject(moving, fcl.Transform(T[:3, :3], T[:3, 3]))
        hits = fcl.collide(static, posed, fcl.CollisionRequest(), fcl.CollisionResult())
        found.append(-1.0 if hits else fcl.distance(static, posed, fcl.DistanceRequest(), fcl.DistanceResult()))
    return np.array(found)


@every_case
def test_ends_never_meet_and_stay_within_half_a_millimetre_while_sliding(model, size):
    gaps = closest_while_sliding(model.build(size))
    assert gaps.min() > 1e-6
    assert gaps.max() < 5e-4


@every_case
def test_pushed_against_the_wall_the_ends_do_meet(model, size):  # the sweep above can fail
    assert closest_while_sliding(model.build(size), 2, aside=-0.2 * size.thickness).min() <= 0


@every_case
def test_a_rail_fills_exactly_its_size(model, size):
    template = model.build(size)
    box = template.static.mesh.box.union(template.dynamic.mesh.box)
    low, high = (
        np.array([0, -size.length / 2, -size.height / 2]),
        np.array([size.thickness, size.length / 2, size.height / 2]),
    )
    if model.mechanism is MechanismClass.CORNER:
        width, depth = shelf_of(size)
        low[2] -= depth
        high[0] += width
    np.testing.assert_allclose(box.low, low, atol=1e-9)
    np.testing.assert_allclose(box.high, high, atol=1e-9)
    assert template.static.mesh.box.high[0] <= 0.56 * size.thickness


@every_case
def test_every_surface_is_a_closed_outward_solid(model, size):
    template = model.build(size)
    for surface in (*template.static.surfaces, *template.dynamic.surfaces):
        assert surface.mesh.is_watertight
        assert surface.mesh.to_trimesh().volume > 0


@every_case
def test_snap_planes_lie_on_wall_and_flank(model, size):
    template = model.build(size)
    np.testing.assert_array_equal(template.static.snap.center, [0, 0, 0])
    np.testing.assert_array_equal(template.static.snap.normal, [-1, 0, 0])
    np.testing.assert_allclose(template.dynamic.snap.center, [size.thickness, 0, 0])
    np.testing.assert_array_equal(template.dynamic.snap.normal, [1, 0, 0])
    assert template.range == pytest.approx(0.85 * size.length)


def test_the_corner_mount_carries_the_drawer_on_its_shelf():
    model = next(r for r in RAILS if r.mechanism is MechanismClass.CORNER)
    template = model.build(model.natural)
    assert template.support is not None
    np.testing.assert_array_equal(template.support.normal, [0, 0, 1])
    assert template.support.center[2] == pytest.approx(-model.natural.height / 2)
    shelf = template.dynamic.mesh.vertices
    beyond = shelf[shelf[:, 0] > model.natural.thickness + 1e-6]
    assert beyond[:, 2].max() == pytest.approx(-model.natural.height / 2)  # nothing stands in the drawer's place


def test_the_centre_mount_carries_nothing_from_below():
    model = next(r for r in RAILS if r.mechanism is MechanismClass.CENTRE)
    assert model.build(model.natural).support is None


@settings(max_examples=20, deadline=None)
@given(st.sampled_from(RAILS), st.floats(0.03, 2.0), st.floats(0.008, 0.1), st.floats(0.001, 0.04))
def test_any_proportions_slide_freely(model, length, height, thickness):
    gaps = closest_while_sliding(model.build(RailSize(length, height, thickness)), 3)
    assert gaps.min() > 0
    assert gaps.max() < 5e-4


def test_a_rail_without_thickness_is_refused():
    with pytest.raises(TemplateError, match="positive sizes"):
        RAILS[0].build(RailSize(0.4, 0.04, 0.0))
