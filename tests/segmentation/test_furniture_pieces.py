"""Which boxes of a scene are one piece of furniture: what touches is, but for pieces side by side with own sides."""

import numpy as np
import pytest

from furniture_rooms import Boxes, cabinet, furnished_room, hutch_on_sideboard, meshes_of, room, table
from grafu.geometry.mesh import merge_meshes
from grafu.segmentation.furniture_pieces import ALONE, FLOOR_OR_WALL, SceneShells, furniture_pieces


def pieces_of(boxes: Boxes) -> dict[str, int]:
    return dict(zip(boxes, furniture_pieces(SceneShells.of(meshes_of(boxes))).tolist(), strict=True))


def count_of(boxes: Boxes) -> int:
    return max(pieces_of(boxes).values()) + 1


def assert_apart(boxes: Boxes, *names: str) -> None:
    """Asserts that the parts whose names begin so are a piece each, in this order."""
    found = pieces_of(boxes)
    for k, name in enumerate(names):
        assert {number for part, number in found.items() if part.startswith(f"{name} ")} == {k}
    assert max(found.values()) + 1 == len(names)


def test_cabinets_that_stand_apart_are_pieces_from_left_to_right() -> None:
    assert_apart({**cabinet("b", (0.6, 0.0, 0.0)), **cabinet("a", (-0.6, 0.0, 0.0))}, "a", "b")


@pytest.mark.parametrize("gap", [0.0, 0.001, 0.004])
def test_cabinets_side_by_side_are_pieces_where_each_has_its_own_sides(gap: float) -> None:
    row = {**cabinet("a", (-0.8 - gap, 0, 0)), **cabinet("b"), **cabinet("c", (0.8 + gap, 0, 0))}
    assert_apart(row, "a", "b", "c")


def test_cabinets_back_to_back_are_pieces() -> None:
    assert_apart({**cabinet("front"), **cabinet("back", (0.0, 0.4, 0.0), turned=True)}, "front", "back")


@pytest.mark.parametrize("axis", [0, 1])
def test_a_panel_before_a_solid_body_is_no_piece(axis: int) -> None:
    low, high = [-0.4, -0.3, 0.0], [0.4, 0.3, 1.0]
    body = (tuple(low), tuple(high))
    high[axis], low[axis] = low[axis], low[axis] - 0.02
    assert count_of({"body": body, "panel": (tuple(low), tuple(high))}) == 1


def test_a_part_across_the_plane_makes_one_piece_of_two() -> None:
    row = {**cabinet("a", (-0.4, 0, 0)), **cabinet("b", (0.4, 0, 0))}
    assert count_of({**row, "worktop": ((-0.8, -0.2, 1.0), (0.8, 0.2, 1.03))}) == 1


def test_neighbours_that_share_a_side_are_one_piece() -> None:
    row = {**cabinet("a", (-0.4, 0, 0)), **cabinet("b", (0.4, 0, 0))}
    shared = {name: box for name, box in row.items() if name != "b vertical_side_panel-1"}
    assert count_of(shared) == 1


def test_a_neighbour_without_an_outer_side_is_one_piece_with_the_other() -> None:
    row = {**cabinet("a", (-0.4, 0, 0)), **cabinet("b", (0.4, 0, 0))}
    assert count_of({name: box for name, box in row.items() if name != "b vertical_side_panel-2"}) == 1


@pytest.mark.parametrize("boxes", [table(), hutch_on_sideboard(), cabinet("")], ids=["table", "hutch", "cabinet"])
def test_what_touches_is_one_piece(boxes: Boxes) -> None:
    assert set(pieces_of(boxes).values()) == {0}


def test_a_large_table_and_a_large_wardrobe_have_no_floor_and_no_wall() -> None:
    large = {name: (tuple(2.5 * v for v in low), tuple(2.5 * v for v in high)) for name, (low, high) in table().items()}
    assert set(pieces_of(large).values()) == {0}
    tall = {n: (tuple(2.5 * v for v in low), tuple(2.5 * v for v in high)) for n, (low, high) in cabinet("").items()}
    assert set(pieces_of(tall).values()) == {0}


def test_a_floor_and_walls_connect_nothing_and_belong_to_no_piece() -> None:
    found = pieces_of(furnished_room())
    assert {n for n, k in found.items() if k == FLOOR_OR_WALL} == {"floor", "wall behind", "wall left"}
    assert {k for n, k in found.items() if n.startswith("wardrobe")} == {0}
    assert {k for n, k in found.items() if n.startswith("desk")} == {1}
    assert sorted(set(found.values())) == [FLOOR_OR_WALL, 0, 1, 2]


def test_a_carpet_connects_nothing() -> None:
    carpet = {"carpet": ((-1.3, -1.0, -0.01), (1.3, 1.0, 0.0))}
    found = pieces_of({**carpet, **cabinet("a", (-0.8, 0, 0)), **cabinet("b", (0.8, 0, 0))})
    assert found.pop("carpet") == FLOOR_OR_WALL
    assert set(found.values()) == {0, 1}


def test_only_a_floor_and_walls_are_no_piece() -> None:
    assert set(pieces_of(room({})).values()) == {FLOOR_OR_WALL}


def test_props_contents_and_fronts_that_hang_free_go_with_their_piece() -> None:
    first, second = cabinet("a", (-0.6, 0, 0)), cabinet("b", (0.6, 0, 0))
    extra = {
        "vase on a": ((-0.65, 0.0, 1.0), (-0.55, 0.1, 1.2)),
        "book within b": ((0.5, 0.0, 0.3), (0.6, 0.1, 0.5)),
        "door before b": ((0.2, -0.26, 0.0), (1.0, -0.24, 0.6)),
        "bulb over b": ((0.6, 0.0, 1.5), (0.65, 0.05, 1.55)),
    }
    found = pieces_of({**first, **second, **extra})
    assert [found[name] for name in extra] == [0, 1, 1, ALONE]


def test_panels_that_hang_free_are_one_piece() -> None:
    panels = {f"panel {k}": ((k * 0.5, 0.0, 0.0), (k * 0.5 + 0.4, 0.02, 0.6)) for k in range(3)}
    assert set(pieces_of(panels).values()) == {0}


def test_one_mesh_of_several_pieces_is_told_apart_by_its_shells() -> None:
    left, right = cabinet("a", (-0.6, 0, 0)), cabinet("b", (0.6, 0, 0))
    by_material = [
        merge_meshes(meshes_of({n: b for n, b in {**left, **right}.items() if ("handle" in n) is handles}))
        for handles in (False, True)
    ]
    shells = SceneShells.of(by_material)
    found = furniture_pieces(shells)
    middle = np.array([mesh.box.center[0] for mesh in shells.meshes])
    assert (found == (middle > 0)).all()


def test_one_mesh_of_pieces_that_touch_is_not_cut() -> None:
    row = {**cabinet("a", (-0.4, 0, 0)), **cabinet("b", (0.4, 0, 0))}
    assert set(furniture_pieces(SceneShells.of([merge_meshes(meshes_of(row))])).tolist()) == {0}
