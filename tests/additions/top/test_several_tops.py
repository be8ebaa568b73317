"""Furniture of several heights, and what looks like a rim and is none: stretchers, basins, slants, trays, galleries."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from topless import D, H, T, W, basin, board, carcass, front, slide, swing, top

from grafu.additions.top.complete import missing_top, missing_tops
from grafu.additions.top.section import closed_up, offset
from grafu.asset.part import Part
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.vocabulary import PartLabel

THICK = 0.03  # metres: of the lost tops


def lifted(parts: list[Part], by: float, name: str) -> list[Part]:
    return [Part(f"{name}_{p.id}", p.label, tuple(_raised(s, by) for s in p.surfaces), p.source, "none") for p in parts]


def _raised(surface, by: float):  # type: ignore[no-untyped-def]
    return type(surface)(surface.mesh.translated(vec3(0.0, 0.0, by)))


def hutch(height: float = 0.4, low: float = H + THICK) -> list[Part]:
    """A shallow case, open at the top, on the back of what lies below it."""
    y0, y1, x = D / 2 - 0.22, D / 2, W / 2
    return [
        board("hutch_left", (-x, y0, low), (T - x, y1, low + height)),
        board("hutch_right", (x - T, y0, low), (x, y1, low + height)),
        board("hutch_back", (T - x, y1 - T, low), (x - T, y1, low + height)),
        board("hutch_bottom", (T - x, y0, low), (x - T, y1 - T, low + T)),
        board("hutch_front", (-x, y0 - T, low + 0.002), (x, y0, low + height), PartLabel.DOOR),
    ]


def hits(mesh: TriangleMesh, x: float, y: float) -> bool:
    """Whether a ray down meets a mesh."""
    return bool(np.isfinite(RayCaster(mesh).along(np.array([[x, y, 9.0]]), np.array([0.0, 0.0, -1.0]))[0]))


def test_a_desk_and_its_hutch_get_a_top_each() -> None:
    parts = [*carcass(), *hutch()]
    verdict = missing_tops(parts)
    assert verdict.missing
    tops = sorted((a.part for a in verdict.additions), key=lambda part: float(part.box.low[2]))
    assert [float(p.box.low[2]) for p in tops] == pytest.approx([H, H + THICK + 0.4], abs=1e-4)
    assert len({p.id for p in tops}) == 2
    assert missing_tops([*parts, *tops]).covered


def test_the_lower_top_fills_the_slot_below_the_hutch() -> None:
    verdict = missing_tops([*carcass(), *hutch()])
    low = min((a.part for a in verdict.additions), key=lambda part: float(part.box.low[2]))
    assert low.box.size[2] == pytest.approx(THICK, abs=1e-4)
    assert all(hits(low.mesh, x, y) for x in (-0.39, 0.0, 0.39) for y in (-0.24, 0.0, 0.2, 0.245))


def test_only_the_one_that_lacks_its_top_gets_one() -> None:
    cover = board("cover", (-W / 2, 0.0, H + THICK + 0.4), (W / 2, D / 2, H + 2 * THICK + 0.4))
    (low,) = missing_tops([*carcass(), *hutch(), cover]).additions
    assert low.part.box.low[2] == pytest.approx(H, abs=1e-4)
    (high,) = missing_tops([*carcass(), top(thickness=THICK), *hutch()]).additions
    assert high.part.box.low[2] == pytest.approx(H + THICK + 0.4, abs=1e-4)
    assert not missing_tops([*carcass(), top(thickness=THICK), *hutch(), cover]).additions


def test_two_cabinets_of_two_heights_get_two_tops_and_of_one_height_one() -> None:
    base, tower = carcass(0.6, x=-0.3), carcass(0.6, height=1.6, x=0.3)
    assert len(missing_tops([*base, *tower]).additions) == 2
    assert len(missing_tops([*base, *carcass(0.6, x=0.3)]).additions) == 1


@pytest.mark.parametrize("drop", [0.0, 0.03, 0.05])
def test_a_basin_whose_rim_was_flush_with_the_worktop_is_let_into_the_new_one(drop: float) -> None:
    parts = [*carcass(), front(H - 0.003), basin(H + 0.05 - drop)]
    verdict = missing_top(parts, [swing()])
    assert verdict.addition is not None
    slab = verdict.addition.part
    assert slab.box.low[2] == pytest.approx(H, abs=1e-4)
    assert not hits(slab.mesh, 0.0, 0.0)
    assert hits(slab.mesh, 0.0, -0.22)
    assert hits(slab.mesh, -0.35, 0.0)


def test_a_ring_of_stretchers_below_open_legs_is_no_rim() -> None:
    x, y = 0.58, 0.15
    legs = [board(f"leg_{a}_{b}", (a - 0.02, b - 0.02, 0.0), (a + 0.02, b + 0.02, H)) for a in (-x, x) for b in (-y, y)]
    ring = [board(f"along_{b}", (-x, b - 0.01, 0.08), (x, b + 0.01, 0.11)) for b in (-y, y)]
    ring += [board(f"across_{a}", (a - 0.01, -y, 0.08), (a + 0.01, y, 0.11)) for a in (-x, x)]
    drawer = board("drawer", (-0.5, -y, H - 0.2), (0.5, -y + 0.02, H - 0.01), PartLabel.DRAWER)
    verdict = missing_tops([*legs, *ring, drawer], [slide()])
    assert [float(a.part.box.low[2]) for a in verdict.additions] == pytest.approx([H], abs=1e-3)


def test_slanted_sides_behind_a_flap_are_no_rim() -> None:
    """A bureau's flap that was drawn upright leaves a gap before the top; a flat board would close it askew."""
    parts = carcass(depth=0.3, height=0.6, x=0.0)
    sides = []
    for x in (-W / 2, W / 2 - T):
        corners = [(-0.15, 0.6), (0.15, 0.6), (0.15, 1.0), (0.03, 1.0)]
        points = np.array([(x + dx, y, z) for dx in (0.0, T) for y, z in corners])
        hull = shapely.convex_hull(shapely.multipoints([(y, z) for y, z in corners]))
        assert hull.area > 0
        faces = [(0, 1, 2), (0, 2, 3), (4, 6, 5), (4, 7, 6)]
        for a in range(4):
            b = (a + 1) % 4
            faces += [(a, a + 4, b), (b, a + 4, b + 4)]
        mesh = TriangleMesh(points, np.array(faces, dtype=np.int64))
        part = board(f"slant_{x}", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
        sides.append(Part(part.id, part.label, (type(part.surfaces[0])(mesh),), part.source, "none"))
    writing = board("writing", (-W / 2, -0.15, 0.6), (W / 2, 0.15, 0.62))
    upper = board("upper", (-W / 2 + T, 0.03, 0.98), (W / 2 - T, 0.15, 1.0))
    back = board("back", (-W / 2, 0.14, 0.62), (W / 2, 0.15, 1.0))
    flap = board("flap", (-W / 2 + T, -0.16, 0.62), (W / 2 - T, -0.145, 1.0), PartLabel.DOOR)
    assert missing_tops([*parts, *sides, writing, upper, back, flap]).covered


def test_a_narrow_cabinet_without_a_back_is_open_behind_its_door() -> None:
    sides = [board(f"side_{x}", (x, -0.25, 0.0), (x + T, 0.25, H)) for x in (-0.075, 0.075 - T)]
    shelf = board("shelf", (-0.075 + T, -0.2, H - 0.13), (0.075 - T, 0.25, H - 0.11))
    door = board("door", (-0.075, -0.27, 0.0), (0.075, -0.25, H), PartLabel.DOOR)
    assert missing_top([*sides, shelf, door], [swing()]).missing
    mirror = board("upstand", (-0.075, 0.23, 0.0), (0.075, 0.25, H), PartLabel.BACK_PANEL)
    assert missing_top([*sides, shelf, mirror]).covered  # open in front: a gallery around the shelf


@pytest.mark.parametrize("dividers", [0, 1, 2])
def test_bays_between_dividers_want_a_top_and_a_tray_none(dividers: int) -> None:
    ends = [board(f"end_{x}", (x, -0.2, 0.0), (x + T, 0.2, 0.4)) for x in (-0.8, 0.8 - T)]
    shelf = board("shelf", (-0.8 + T, -0.2, 0.28), (0.8 - T, 0.2, 0.3))
    inner = np.linspace(-0.8, 0.8, dividers + 2)[1:-1]
    walls = [board(f"divider_{x}", (x, -0.2, 0.0), (x + T, 0.2, 0.4)) for x in inner.tolist()]
    assert missing_top([*ends, shelf, *walls]).covered is (dividers == 0)


def test_a_trays_front_ends_with_the_top_over_it() -> None:
    pedestals = [*carcass(0.3, x=-0.45), *carcass(0.3, x=0.45)]
    back = board("modesty", (-0.3, 0.2, 0.3), (0.3, 0.22, H))
    tray = board("tray", (-0.2, -D / 2 - 0.1, H), (0.2, 0.0, H + 0.035), PartLabel.DRAWER)
    (addition,) = missing_tops([*pedestals, back, tray], [slide("tray")]).additions
    assert addition.part.box.low[1] <= -D / 2 - 0.1 + 1e-6
    assert addition.part.box.high[2] > H + 0.035


# Coordinates of meshes, metres: shapely itself divides by zero where two lie 1e-176 m apart.
MICROMETRES = st.integers(-1_000_000, 1_000_000).map(lambda number: number / 1e6)


@settings(max_examples=60, deadline=None)
@given(
    points=st.lists(st.tuples(MICROMETRES, MICROMETRES), min_size=4, max_size=12, unique=True),
    width=st.floats(0.01, 0.6),
)
def test_closing_up_keeps_within_the_hull_and_moving_edges_keeps_shapes_valid(
    points: list[tuple[float, float]], width: float
) -> None:
    lines = shapely.linestrings(points).buffer(0.001)
    closed = closed_up(lines, width)
    assert closed.is_valid
    assert closed.difference(shapely.convex_hull(lines).buffer(1e-9)).area < 1e-9
    for distance in (-0.3 * width, 0.5 * width):
        assert offset(closed, distance).is_valid
