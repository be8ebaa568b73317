"""A file whose furniture faces several ways, or stands apart, is read piece by piece, and stays one asset."""

from pathlib import Path

import numpy as np
import pytest

from furniture_rooms import (
    DOORS,
    Boxes,
    cabinet,
    corner,
    furnished_room,
    hutch_on_sideboard,
    island,
    meshes_of,
    numbered,
    quarter,
    room,
    table,
    write_scene,
)
from grafu.asset.edit import moved, scaled
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset, Standing
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.transform import from_rotation, rotation_matrix, transform_points
from grafu.vocabulary import PartLabel
from small_assets import Y_UP, obj_text


def read(folder: Path, boxes: Boxes, options: LoadOptions = LoadOptions()) -> Asset:
    return load_asset(write_scene(folder / "scene.glb", boxes), options)


def facing(standing: Standing) -> tuple[int, int]:
    """Where the front of a piece looks in the object frame, as whole numbers along X and Y."""
    front = np.linalg.inv(standing.T_piece_object)[:3, :3] @ np.array([0.0, -1.0, 0.0])
    return round(float(front[0])), round(float(front[1]))


def begins(asset: Asset, standing: Standing) -> set[str]:
    return {asset.part(part).source.name.split()[0] for part in standing.parts}


@pytest.mark.parametrize("name", [lambda boxes: boxes, numbered], ids=["named", "nameless"])
def test_the_two_sides_of_an_island_are_pieces_that_face_apart(tmp_path: Path, name) -> None:
    found = read(tmp_path, name(island()))
    assert sorted(facing(standing) for standing in found.standings) == [(0, -1), (0, 1)]
    assert {part for standing in found.standings for part in standing.parts} == {part.id for part in found.parts}


def test_the_wings_of_a_corner_are_pieces_with_their_own_fronts(tmp_path: Path) -> None:
    found = read(tmp_path, corner())
    fronts = {facing(standing): begins(found, standing) - {"worktop"} for standing in found.standings}
    assert fronts == {(0, -1): {"back"}, (1, 0): {"left"}}


def test_pieces_that_stand_apart_are_read_for_themselves_and_floor_and_walls_are_no_furniture(tmp_path: Path) -> None:
    found = read(tmp_path, furnished_room())
    assert len(found.standings) == 3
    others = [part for part in found.parts if found.standing_of(part.id) is None]
    assert {part.source.name for part in others} == {"floor", "wall behind", "wall left"}
    assert {part.label for part in others} == {PartLabel.MISC}


def test_the_parts_of_all_pieces_lie_where_they_were(tmp_path: Path) -> None:
    boxes = {**cabinet("a"), **quarter(cabinet("b"), 2.0, -1.0)}
    found = read(tmp_path, boxes)
    to_input = np.linalg.inv(found.frame.input_to_output)
    names = [part.source.name for part in found.parts]
    assert len(found.standings) == 2
    assert len({part.id for part in found.parts}) == len(names)
    for part in (part for part in found.parts if len(part.surfaces) == 1):
        low, high = boxes[part.source.name]
        at = transform_points(to_input, part.mesh.vertices) @ Y_UP
        assert np.allclose([at.min(axis=0), at.max(axis=0)], [low, high], atol=1e-5)


def test_an_object_with_shells_in_two_pieces_is_divided_and_ids_stay_unique(tmp_path: Path) -> None:
    """All that is one material is one object, as exporters join it."""
    cases = {**cabinet("a"), **cabinet("b", (3.0, 0.0, 0.0))}
    mesh = merge_meshes(meshes_of(cases))
    path = tmp_path / "scene.obj"
    path.write_text("o everything\n" + obj_text(mesh, np.eye(3)))
    found = load_asset(path, LoadOptions(up="+Z", scale=1.0))
    assert len(found.standings) == 2
    assert len({part.id for part in found.parts}) == len(found.parts)
    assert sum(len(part.mesh.faces) for part in found.parts) >= len(mesh.faces)


@pytest.mark.parametrize(
    "boxes",
    [
        cabinet(""),
        hutch_on_sideboard(),
        table(),
        {**cabinet("a", (-0.4, 0, 0)), **cabinet("b", (0.4, 0, 0))},
        {**cabinet("a", (-0.4, 0, 0)), **cabinet("b", (0.4, 0, 0)), "top": ((-0.8, -0.2, 1.0), (0.8, 0.2, 1.03))},
        {n: b for n, b in cabinet("").items() if n not in DOORS},
        {**cabinet(""), "vase": ((0.0, 0.0, 1.0), (0.1, 0.1, 1.2))},
    ],
    ids=["cabinet", "hutch", "table", "row", "row below a worktop", "without fronts", "with a vase"],
)
def test_what_stands_together_and_faces_one_way_is_one_piece(tmp_path: Path, boxes: Boxes) -> None:
    assert read(tmp_path, boxes).standings == ()
    assert read(tmp_path, numbered(boxes)).standings == ()


def test_a_drawer_that_is_drawn_loose_before_its_case_stays_with_it(tmp_path: Path) -> None:
    pulled = {
        n: ((a[0], a[1] - 0.04, a[2]), (b[0], b[1] - 0.04, b[2])) for n, (a, b) in cabinet("").items() if n in DOORS
    }
    assert read(tmp_path, {**cabinet(""), **pulled}).standings == ()


def test_the_users_front_is_that_of_all(tmp_path: Path) -> None:
    assert read(tmp_path, island(), LoadOptions(front="+Z")).standings == ()
    assert read(tmp_path, island(), LoadOptions(parts="input")).standings == ()


def test_standings_move_with_the_asset(tmp_path: Path) -> None:
    found = read(tmp_path, room(cabinet("", (0.0, 1.28, 0.0))))
    (standing,) = found.standings
    T = from_rotation(rotation_matrix(np.array([0.0, 0.0, 1.0]), 0.5), np.array([1.0, 2.0, 0.0]))
    for made, factor in ((moved(found, T), 1.0), (scaled(found, 2.0), 2.0)):
        (after,) = made.standings
        part = standing.parts[0]
        before = transform_points(standing.T_piece_object, found.part(part).mesh.vertices)
        assert np.allclose(transform_points(after.T_piece_object, made.part(part).mesh.vertices), factor * before)


def test_a_piece_that_is_split_off_a_file_has_its_own_sides_too(tmp_path: Path) -> None:
    boxes = {**{f"island {n}": box for n, box in island().items()}, **cabinet("", (3.0, 0.0, 0.0))}
    found = read(tmp_path, boxes, LoadOptions(pieces="split", piece=1))
    assert sorted(facing(standing) for standing in found.standings) == [(0, -1), (0, 1)]


def test_hidden_labels_do_not_tell_where_a_piece_faces(tmp_path: Path) -> None:
    """What shows it then are the handles: without these both sides of an island are one piece."""
    bare = {name: box for name, box in island().items() if "handle" not in name}
    assert len(read(tmp_path, bare).standings) == 2
    assert read(tmp_path, bare, LoadOptions(labels="none")).standings == ()
    assert len(read(tmp_path, island(), LoadOptions(labels="none")).standings) == 2
