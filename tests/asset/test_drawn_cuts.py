"""Fronts drawn on the surface of one object among a few others, and handles drawn on the doors of others."""

import numpy as np
import pytest

from grafu.asset.cutting import cut_where_fronts_appear
from grafu.asset.part import IDENTITY_FRAME, Part, PartSource
from grafu.asset.reading import Convention, Reading
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel
from solids import as_mesh, solid


def part(name: str, mesh: TriangleMesh, label: PartLabel = PartLabel.UNKNOWN) -> Part:
    return Part(name, label, (Surface(mesh),), PartSource(name), "none" if label is PartLabel.UNKNOWN else "name")


def units(bare: int = 8) -> TriangleMesh:
    """A row of four units, 2.4 long, of which each has two drawers drawn on it; all but `bare` of these have a pull."""
    body = solid((0.0, 0.0, 0.0), (2.4, 0.6, 0.88))
    places = [(0.6 * k, z) for k in range(4) for z in ((0.1, 0.5), (0.52, 0.86))]
    for x, (low, high) in places:
        body += solid((x + 0.01, -0.02, low), (x + 0.59, 0.1, high))
    for x, (low, high) in places[bare:]:
        z = (low + high) / 2
        body += solid((x + 0.24, -0.05, z - 0.01), (x + 0.36, -0.01, z + 0.01))
    return as_mesh(body)


def board(name: str, low, high, label: PartLabel = PartLabel.UNKNOWN) -> Part:
    return part(name, as_mesh(solid(low, high)), label)


FITTINGS = [
    board("worktop", (0.0, 0.0, 0.88), (2.4, 0.6, 0.92), PartLabel.TOP_PANEL),
    board("hob", (0.1, 0.1, 0.92), (0.6, 0.5, 0.925)),
    board("hood", (0.1, 0.1, 1.6), (0.6, 0.5, 1.65)),
    board("tap", (1.5, 0.5, 0.92), (1.52, 0.52, 1.2)),
    board("bowl", (1.3, 0.1, 0.8), (1.8, 0.5, 0.93)),
]


def cut(*parts: Part) -> tuple[Part, ...]:
    return cut_where_fronts_appear(Reading("mesh file", parts, Convention("test")), IDENTITY_FRAME).parts


@pytest.mark.parametrize("kept", [0, 2, 5])
def test_fronts_drawn_on_a_row_of_units_are_found_whatever_stands_on_it(kept):
    found = cut(part("row", units()), *FITTINGS[:kept])
    assert sum(one.id.startswith("row_front") for one in found) == 8


def test_where_no_object_has_most_of_the_surface_none_is_looked_at():
    shelves = [board(f"shelf_{k}", (0.0, 1.0, 0.4 * k), (2.4, 1.6, 0.4 * k + 0.3)) for k in range(4)]
    found = cut(part("row", units()), *FITTINGS[:1], *shelves)
    assert not any("front" in one.id for one in found)


@pytest.mark.parametrize(("bare", "fronts"), [(0, 8), (8, 0)])
def test_beside_a_drawer_by_name_drawn_fronts_count_where_each_holds_a_handle(bare, fronts):
    drawer = board("drawer_1", (2.4, -0.02, 0.1), (2.8, 0.6, 0.5), PartLabel.DRAWER)
    found = cut(part("row", units(bare)), drawer)
    assert sum(one.id.startswith("row_front") for one in found) == fronts
    assert next(one for one in found if one.id == "drawer_1").label is PartLabel.DRAWER


def handled(x: float) -> TriangleMesh:
    body = solid((0.0, -0.02, 0.0), (0.5, 0.0, 2.0)) + solid((x, -0.05, 0.9), (x + 0.02, -0.01, 1.2))
    return as_mesh(body)


def test_a_handle_drawn_on_a_door_becomes_a_part_and_the_door_stays_one():
    case = solid((-0.02, 0.0, -0.1), (0.52, 0.6, 2.1)) - solid((0.0, -1.0, 0.0), (0.5, 0.58, 2.0))
    door, *rest = cut(part("leaf", handled(0.46)), part("case", as_mesh(case)))
    assert (door.id, len(rest)) == ("leaf", 2)
    (handle,) = (one for one in rest if one.id != "case")
    np.testing.assert_allclose([handle.box.low, handle.box.high], [(0.46, -0.05, 0.9), (0.48, -0.02, 1.2)])
    np.testing.assert_allclose(door.box.low[1], -0.02)
