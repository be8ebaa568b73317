"""The box of a drawer gives way behind its front, before what is seen of the case is cut."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.config import RealizationConfig
from judging import installed, realized
from small_scenes import box, drawer

NO_CARVING = RealizationConfig(max_carve=1e-6, max_carve_last=1e-6, max_carve_hidden=1e-6)


def solid_of(*boxes) -> TriangleMesh:
    return TriangleMesh.from_trimesh(trimesh.boolean.union([trimesh.creation.box(bounds=ends) for ends in boxes]))


def in_welded_case(tray: TriangleMesh, gap: float = 0.0125, back: float = 0.23, end: float = 0.25):
    """The drawer in a case of one mesh: two sides, and a back from y = `back` to `end`."""
    w, asset = 0.2 + gap, drawer()
    case = solid_of(
        [(-w - 0.02, -0.2, 0.0), (-w, end, 0.5)],
        [(w, -0.2, 0.0), (w + 0.02, end, 0.5)],
        [(-w - 0.01, back, 0.0), (w + 0.01, end, 0.5)],
    )
    part = replace(asset.part("drawer"), surfaces=(Surface(tray),))
    welded = replace(box("case", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(case),))
    return replace(asset, parts=(welded, part))


def mesh_of(result, name: str) -> TriangleMesh:
    return next(v.mesh for link in result.object.links for v in link.visuals if v.name == name)


@pytest.mark.parametrize("deep", [0.002, 0.009])
def test_a_drawer_that_ends_in_the_back_of_a_welded_case_becomes_less_deep(deep):
    tray = TriangleMesh.box_mesh(drawer().part("drawer").box)
    result = realized(in_welded_case(tray, back=0.2 - deep), NO_CARVING)
    outcome, made = installed(result)["drawer"], mesh_of(result, "drawer").box

    assert outcome.collision_share == 0.0
    assert [(c.part, c.kind) for c in outcome.clearances] == [("drawer", "trimmed")]
    assert made.low == pytest.approx(tray.box.low, abs=1e-9)
    assert made.size[[0, 2]] == pytest.approx(tray.box.size[[0, 2]], abs=1e-9)
    assert deep <= tray.box.size[1] - made.size[1] <= max(0.0033, 1.5 * deep)


def test_the_box_becomes_narrower_behind_a_front_that_keeps_its_size():
    """The front overlaps the walls; the box behind it reaches 4 mm into each of them."""
    tray = solid_of(
        [(-0.219, -0.219, 0.01), (0.219, -0.201, 0.18)],
        [(-0.204, -0.205, 0.02), (0.204, 0.2, 0.17)],
    )
    result = realized(in_welded_case(tray, gap=0.0), NO_CARVING)
    outcome, made = installed(result)["drawer"], mesh_of(result, "drawer")

    assert outcome.collision_share == 0.0
    assert {(c.part, c.kind) for c in outcome.clearances} == {("drawer", "trimmed")}
    assert made.box.size[[0, 2]] == pytest.approx(tray.box.size[[0, 2]], abs=1e-9)
    behind = made.vertices[made.vertices[:, 1] > -0.19]
    assert 0.187 <= np.abs(behind[:, 0]).max() < 0.2


def test_what_hidden_sides_may_lose_has_an_end():
    tray = TriangleMesh.box_mesh(drawer().part("drawer").box)
    result = realized(in_welded_case(tray, back=0.18), NO_CARVING)

    assert mesh_of(result, "drawer").box.size == pytest.approx(tray.box.size, abs=1e-9)


def test_the_back_of_the_case_stays_whole_while_the_rest_is_carved():
    """The drawer fills the width of the case, and reaches through most of its back."""
    tray = TriangleMesh.box_mesh(drawer().part("drawer").box)
    result = realized(in_welded_case(tray, gap=-0.001, back=0.195, end=0.2002), RealizationConfig(max_trim=1e-6))
    outcome = installed(result)["drawer"]

    assert outcome.collision_share == 0.0
    assert ("case", "carved") in {(c.part, c.kind) for c in outcome.clearances}
    assert mesh_of(result, "drawer").box.high[1] < 0.199
