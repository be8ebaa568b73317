"""What carving takes of a part: of what is seen of it and of its volume, each known from geometry, the larger told."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid, clip_by_faces
from grafu.joints.clearance.loss import Loss, lost_volume, measured_loss
from judging import installed, realized
from small_scenes import box, drawer

RATIOS = st.floats(0.02, 0.98)


def solid(low, high) -> ConvexSolid:
    found = ConvexSolid.around(Box(np.array(low, float), np.array(high, float)).corners())
    assert found is not None
    return found


def loss_of(part: Part, solids: list[ConvexSolid]) -> Loss:
    lost = [clip_by_faces(surface, solids)[1] for surface in part.surfaces]
    return measured_loss(part, solids, np.concatenate(lost))


def hollow_box(name: str = "shell") -> Part:
    """The six sides of a unit cube as one closed sheet: its hull is the whole cube, of which nothing is filled."""
    return box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))


def with_cavity() -> Part:
    """The same with an inner cube that no one sees: a wall of a tenth of a metre all round."""
    shell, inner = hollow_box(), box("inner", (0.1, 0.1, 0.1), (0.9, 0.9, 0.9))
    return replace(shell, surfaces=(*shell.surfaces, *(Surface(s.mesh) for s in inner.surfaces)))


@pytest.mark.parametrize("part", [hollow_box(), with_cavity()], ids=["sheet", "thick wall"])
@given(RATIOS, RATIOS, st.floats(0.001, 0.05))
def test_a_hollow_box_loses_what_is_seen_of_its_front(part, width, height, depth):
    """A recess in the front: of the cube's six faces it takes width x height, of its hull next to nothing."""
    low, high = (0.5 - width / 2, -0.1, 0.5 - height / 2), (0.5 + width / 2, depth, 0.5 + height / 2)
    loss = loss_of(part, [solid(low, high)])

    assert loss.surface == pytest.approx(width * height / 6, abs=1e-6)
    volume = width * height * depth
    if len(part.surfaces) == 1:
        assert loss.volume == pytest.approx(volume, abs=1e-5)
    assert loss.ratio == loss.surface > 3 * volume  # what the volume alone would say


def test_a_wall_inside_is_no_loss_that_is_seen():
    assert loss_of(with_cavity(), [solid((0.05, 0.05, 0.05), (0.95, 0.95, 0.95))]).surface == 0.0


def test_of_a_solid_bar_the_volume_counts_where_it_is_more():
    bar = box("bar", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    loss = loss_of(bar, [solid((0.2, 0.2, -1.0), (0.8, 0.8, 2.0))])  # a shaft through it

    assert loss.volume == pytest.approx(0.36, abs=1e-5)
    assert loss.surface == pytest.approx(2 * 0.36 / 6, abs=1e-6)
    assert loss.ratio == loss.volume


def test_solids_that_overlap_take_nothing_twice():
    one = solid((0.2, -0.1, 0.2), (0.6, 0.02, 0.8))
    two = solid((0.4, -0.1, 0.2), (0.8, 0.02, 0.8))

    assert loss_of(hollow_box(), [one, two]).surface == pytest.approx(0.36 / 6, abs=1e-6)


def test_nothing_is_lost_where_nothing_is_cut():
    assert loss_of(hollow_box(), []).ratio == 0.0
    assert loss_of(hollow_box(), [solid((2, 2, 2), (3, 3, 3))]).ratio == 0.0


def blind() -> Part:
    """A sheet across a drawer's mouth that hangs on two thin straps from far above: its hull is mostly air."""
    corners = [(-0.2, -0.25, 0.02), (0.2, -0.25, 0.02), (0.2, -0.25, 0.17), (-0.2, -0.25, 0.17)]
    corners += [(0.01, -0.25, 0.17), (-0.01, -0.25, 0.17), (0.0, -0.25, 1.2), (0.0, 0.8, 1.2)]
    faces = np.array([(0, 1, 4), (1, 2, 4), (0, 4, 5), (0, 5, 3), (5, 4, 6), (5, 4, 7)])
    return replace(hollow_box("blind"), surfaces=(Surface(TriangleMesh(np.array(corners), faces)),))


def test_the_report_tells_the_surface_that_a_viewer_misses_and_both_figures():
    asset, before = drawer(), blind()
    result = realized(replace(asset, parts=(*asset.parts, before)))
    [cut] = [c for c in installed(result)["drawer"].clearances if c.kind == "carved"]
    after = next(v.mesh for link in result.object.links for v in link.visuals if v.name == "blind")
    gone = before.mesh.area - after.area  # an open sheet is clipped, no cut face is made

    assert cut.surface_share == pytest.approx(gone / before.mesh.area, abs=1e-6)
    assert 0 < cut.volume_share < 0.05 < 0.5 < cut.surface_share
    assert cut.share == cut.surface_share
    assert cut.amount == pytest.approx(gone**0.5, rel=1e-6)


@pytest.mark.parametrize("count", [50, 200])
def test_what_many_solids_take_together_is_counted_once(count):
    bar = box("bar", (0.0, 0.0, 0.0), (2.0, 1.0, 0.5))
    starts = np.linspace(0.2, 0.7, count)
    slices = [solid((x, 0.25, -1.0), (x + 0.5, 0.75, 1.0)) for x in starts]  # each covers most of the next

    assert lost_volume(bar, slices) == pytest.approx(0.5 * 0.5, abs=2e-3)


@pytest.mark.parametrize("width", [0.01, 0.04, 0.06, 0.2, 0.5, 0.59, 0.61, 0.8])
def test_a_first_look_tells_on_which_side_of_the_limits_the_loss_lies(width):
    bar = box("bar", (0.0, 0.0, 0.0), (1.0, 1.0, 0.5))
    starts = np.linspace(0.1, 0.1 + width / 2, 200)
    slices = [solid((x, -1.0, -1.0), (x + width / 2, 2.0, 1.0)) for x in starts]

    exact, told = lost_volume(bar, slices), lost_volume(bar, slices, (0.05, 0.6))
    assert exact == pytest.approx(width, abs=2e-3)
    assert told == pytest.approx(exact, abs=0.02)
    assert (told < 0.05, told < 0.6) == (exact < 0.05, exact < 0.6)


def test_near_a_limit_the_loss_is_counted_as_finely_as_without_one():
    bar = box("bar", (0.0, 0.0, 0.0), (1.0, 1.0, 0.5))
    slices = [solid((x, -1.0, -1.0), (x + 0.3, 2.0, 1.0)) for x in np.linspace(0.1, 0.4, 200)]
    assert lost_volume(bar, slices, (0.59,)) == lost_volume(bar, slices) != lost_volume(bar, slices, (0.3,))
