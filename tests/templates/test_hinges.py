"""The geometric contract of hinges (`templates/hinges.py`), on every built-in at ordinary and extreme sizes."""

from dataclasses import replace

import fcl
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.errors import TemplateError
from grafu.geometry.transform import rotation_about
from grafu.templates.gallery import builtin_gallery
from grafu.templates.hinges import KNUCKLE_GAP, SEAM_GAP
from grafu.templates.template import HingeSize
from grafu.vocabulary import MechanismClass

HINGES = builtin_gallery().hinges
EXTREMES = (
    HingeSize(0.010, 0.006, 0.0005, 0.001),
    HingeSize(0.030, 0.060, 0.003, 0.003),
    HingeSize(0.300, 0.012, 0.002, 0.005),
)
every_hinge = pytest.mark.parametrize("model", HINGES, ids=lambda m: m.id)


def bvh(mesh):
    model = fcl.BVHModel()
    model.beginModel(len(mesh.vertices), len(mesh.faces))
    model.addSubModel(mesh.vertices, mesh.faces)
    model.endModel()
    return model


def closest_in_each_pose(template, motions):
    """The distance between the two ends in each pose; 0 or less where they intersect."""
    static, moving = fcl.CollisionObject(bvh(template.static.mesh)), bvh(template.dynamic.mesh)
    found = []
    for T in motions:
        posed = fcl.CollisionObject(moving, fcl.Transform(T[:3, :3], T[:3, 3]))
        hits = fcl.collide(static, posed, fcl.CollisionRequest(), fcl.CollisionResult())
        found.append(-1.0 if hits else fcl.distance(static, posed, fcl.DistanceRequest(), fcl.DistanceResult()))
    return np.array(found)


def turns(template, count=9):
    return [rotation_about(np.zeros(3), np.array([0.0, 0, 1]), a) for a in np.linspace(0, template.range, count)]


@every_hinge
def test_ends_never_meet_and_stay_within_half_a_millimetre(model):
    for size in (model.natural, *EXTREMES):
        gaps = closest_in_each_pose(model.build(size), turns(model.build(size)))
        assert gaps.min() > 1e-6, size
        assert gaps.max() < 5e-4, size


@every_hinge
def test_turned_where_the_leaves_overlap_the_ends_do_meet(model):  # the sweep above can fail
    angle = {MechanismClass.C: -5, MechanismClass.F: 200, MechanismClass.P: 120}[model.mechanism]
    beyond = rotation_about(np.zeros(3), np.array([0.0, 0, 1]), float(np.radians(angle)))
    assert closest_in_each_pose(model.build(model.natural), [beyond])[0] <= 0


@every_hinge
def test_every_surface_is_a_closed_outward_solid_with_normals(model):
    for size in (model.natural, *EXTREMES):
        template = model.build(size)
        for surface in (*template.static.surfaces, *template.dynamic.surfaces):
            assert surface.mesh.is_watertight
            assert surface.mesh.to_trimesh().volume > 0
            assert surface.normals is not None


@every_hinge
def test_all_geometry_is_near_the_pin_or_on_the_leaf_side(model):
    for size in (model.natural, *EXTREMES):
        template = model.build(size)
        for end in (template.static, template.dynamic):
            points = end.mesh.vertices
            assert np.abs(points[:, 2]).max() <= size.length / 2 + 1e-9
            far = points[np.hypot(points[:, 0], points[:, 1]) > size.radius * (1 + 1e-9)]
            depth = far @ end.snap.normal
            plane = end.snap.center @ end.snap.normal
            assert depth.max() <= plane + 1e-9
            assert depth.min() >= plane - size.thickness - 1e-9
            along = far @ (end.snap.u / np.linalg.norm(end.snap.u))
            assert along.max() <= size.leaf + 1e-9
            assert along.min() >= -1e-9


@every_hinge
def test_the_snap_planes_are_where_the_class_says(model):
    s = model.natural
    template = model.build(s)
    expected = {
        MechanismClass.C: ([-s.thickness, -s.leaf / 2, 0], [s.thickness, -s.leaf / 2, 0], [-1, 0, 0], [1, 0, 0]),
        MechanismClass.F: ([-s.leaf / 2, -s.radius, 0], [s.leaf / 2, -s.radius, 0], [0, -1, 0], [0, -1, 0]),
        MechanismClass.P: ([-s.radius, s.leaf / 2, 0], [s.leaf / 2, -s.radius, 0], [-1, 0, 0], [0, -1, 0]),
    }[model.mechanism]
    found = (template.static.snap.center, template.dynamic.snap.center)
    np.testing.assert_allclose(found, expected[:2], atol=1e-12)
    np.testing.assert_array_equal((template.static.snap.normal, template.dynamic.snap.normal), expected[2:])


@every_hinge
def test_both_leaves_reach_their_far_edge(model):
    template = model.build(model.natural)
    for end in (template.static, template.dynamic):
        reach = (end.mesh.vertices @ (end.snap.u / np.linalg.norm(end.snap.u))).max()
        assert reach == pytest.approx(model.natural.leaf, rel=1e-3)


@every_hinge
def test_leaves_of_class_c_leave_the_seam_open(model):
    if model.mechanism is MechanismClass.C:
        template, gap = model.build(model.natural), min(SEAM_GAP, 0.05 * model.natural.thickness)
        assert template.static.surfaces[0].mesh.box.high[0] == pytest.approx(-gap)
        assert template.dynamic.surfaces[0].mesh.box.low[0] == pytest.approx(gap)


@every_hinge
def test_hardware_is_light_and_metallic(model):
    template = model.build(model.natural)
    count = len(template.static.mesh.faces) + len(template.dynamic.mesh.faces)
    assert 300 <= count <= 2400
    assert all(s.material.metallic >= 0.5 for s in template.static.surfaces)


@settings(max_examples=25, deadline=None)
@given(
    st.sampled_from(HINGES),
    st.floats(0.01, 2.0),
    st.floats(0.006, 0.06),
    st.floats(0.05, 1.0),
    st.floats(0.02, 0.8),
)
def test_any_proportions_build_closed_leaves_that_stay_apart(model, length, leaf, flatness, slimness):
    radius = max(slimness * leaf, 6e-4)
    size = HingeSize(length, leaf, flatness * radius, radius)
    template = model.build(size)
    assert all(s.mesh.is_watertight for s in (*template.static.surfaces, *template.dynamic.surfaces))
    assert closest_in_each_pose(template, turns(template, 3)).min() > 0


def test_a_long_piano_hinge_has_many_knuckles():
    piano = next(h for h in HINGES if h.id == "piano")
    short, long = (piano.build(replace(piano.natural, length=length)) for length in (0.3, 2.0))
    assert len(long.dynamic.mesh.faces) > 3 * len(short.dynamic.mesh.faces)


def test_class_p_opens_less_where_leaves_would_meet():
    angle = next(h for h in HINGES if h.id == "angle")
    thick = angle.build(HingeSize(0.06, 0.03, 0.004, 0.004))
    assert thick.range < np.radians(90) < angle.build(angle.natural).range


def test_building_the_same_size_again_is_free():
    model = HINGES[0]
    assert model.build(model.natural) is model.build(replace(model.natural))


@pytest.mark.parametrize(
    ("size", "said"),
    [
        (HingeSize(0.0, 0.02, 0.001, 0.003), "positive sizes"),
        (HingeSize(0.06, 0.02, 0.004, 0.003), "thickness <= radius"),
        (HingeSize(0.06, 0.003, 0.001, 0.003), "leaf > 1.15 radius"),
    ],
)
def test_a_size_that_cannot_be_built_is_refused(size, said):
    with pytest.raises(TemplateError, match=said):
        HINGES[0].build(size)


def test_the_knuckle_gap_is_the_widest_distance_along_the_pin():
    assert KNUCKLE_GAP <= 5e-4
