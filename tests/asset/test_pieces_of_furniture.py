"""`pieces="split"`: a file of several pieces of furniture is read as one of them, with its own front and size."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furniture_rooms import (
    Boxes,
    cabinet,
    furnished_room,
    hutch_on_sideboard,
    meshes_of,
    numbered,
    room,
    table,
    write_scene,
)
from grafu.asset.load import endings_in, load_asset
from grafu.asset.options import LoadOptions
from grafu.errors import AssetError, UnreadableAsset
from grafu.geometry.mesh import merge_meshes
from small_assets import CABINET, urdf_text, write_urdf

SPLIT = LoadOptions(pieces="split")


def endings(path: Path, boxes: Boxes) -> tuple[str, ...]:
    return endings_in(write_scene(path / "scene.glb", boxes), SPLIT)


def test_a_piece_is_read_as_the_same_piece_in_a_file_of_its_own(tmp_path: Path) -> None:
    row = write_scene(tmp_path / "row.glb", {**cabinet("", (-0.6, 0.3, 0)), **numbered(cabinet("", (0.6, 0, 0)))})
    alone = load_asset(write_scene(tmp_path / "alone.glb", cabinet("")))
    found = load_asset(row, replace(SPLIT, piece=1))

    assert (found.name, found.path) == ("row_piece_1", str(row))
    assert [p.id for p in found.parts] == [p.id for p in alone.parts]
    assert [p.label for p in found.parts] == [p.label for p in alone.parts]
    for mine, other in zip(found.parts, alone.parts, strict=True):
        assert np.allclose(mine.mesh.vertices, other.mesh.vertices, atol=1e-6)
    assert found.frame.scale == alone.frame.scale
    assert "piece 1 of 2 of the file (--pieces split)" in found.notes
    assert len(load_asset(row).parts) > len(CABINET)


def test_each_piece_has_its_own_front(tmp_path: Path) -> None:
    scene = {**cabinet("a", (-0.6, 0, 0)), **cabinet("b", (0.6, 0, 0), turned=True)}
    path = write_scene(tmp_path / "scene.glb", scene)
    assert [load_asset(path, replace(SPLIT, piece=k)).frame.front for k in (1, 2)] == ["+Z", "-Z"]


def test_results_are_called_after_the_common_name_of_the_objects(tmp_path: Path) -> None:
    row = {**cabinet("wardrobe", (-1, 0, 0)), **numbered(cabinet("", (0, 0, 0))), **cabinet("bed-side", (1, 0, 0))}
    assert endings(tmp_path, row) == ("wardrobe", "piece_2", "bed_side")
    twins = {**table("table", 1.0), **{f"{n} b": box for n, box in table("table", -1.0).items()}}
    assert endings(tmp_path, twins) == ("piece_1", "piece_2")


@pytest.mark.parametrize("boxes", [cabinet(""), hutch_on_sideboard(), table()], ids=["cabinet", "hutch", "table"])
def test_one_piece_is_read_as_without_the_option(tmp_path: Path, boxes: Boxes) -> None:
    path = write_scene(tmp_path / "one.glb", boxes)
    assert endings_in(path, SPLIT) == ("",)
    split, together = load_asset(path, SPLIT), load_asset(path)
    assert (split.name, split.notes) == (together.name, together.notes)
    assert [(p.id, p.label) for p in split.parts] == [(p.id, p.label) for p in together.parts]


def test_floor_and_walls_are_left_out_with_a_note(tmp_path: Path) -> None:
    path = write_scene(tmp_path / "room.glb", furnished_room())
    assert endings_in(path, SPLIT) == ("wardrobe", "desk", "piece_3")
    for k in (1, 2, 3):
        found = load_asset(path, replace(SPLIT, piece=k))
        assert (
            "floor, wall behind, wall left: left out of every piece, as floor or wall (--pieces split)" in found.notes
        )
        assert np.isclose(found.box.low[2], 0.0)
    one = load_asset(write_scene(tmp_path / "one.glb", room(cabinet(""))), SPLIT)
    alone = load_asset(write_scene(tmp_path / "alone.glb", cabinet("")))
    assert (one.name, [p.id for p in one.parts]) == ("one", [p.id for p in alone.parts])


@pytest.mark.parametrize(
    ("boxes", "piece", "error", "said"),
    [
        (room({}), None, UnreadableAsset, "holds no piece of furniture, only floor and walls"),
        (furnished_room(), None, AssetError, r"holds 3 pieces of furniture \(1 wardrobe, 2 desk, 3 piece_3\): choose"),
        (furnished_room(), 4, AssetError, "--piece must be at most 3"),
    ],
)
def test_what_cannot_be_chosen_is_refused(
    tmp_path: Path, boxes: Boxes, piece: int | None, error: type[AssetError], said: str
) -> None:
    with pytest.raises(error, match=said):
        load_asset(write_scene(tmp_path / "scene.glb", boxes), replace(SPLIT, piece=piece))


def test_a_number_needs_split_pieces() -> None:
    for wrong in ({"piece": 1}, {"piece": 0, "pieces": "split"}):
        with pytest.raises(AssetError, match="--piece must be a number from 1, with --pieces split"):
            LoadOptions(**wrong)  # type: ignore[arg-type]


def test_a_file_has_one_unit_and_one_up(tmp_path: Path) -> None:
    """An OBJ in centimetres states no unit: the small table has that of the cabinet."""
    boxes = {**cabinet("cabinet", (-1, 0, 0)), **table("table", 1.2)}
    text, start = "", 1
    for name, mesh in zip(boxes, meshes_of(boxes), strict=True):
        text += f"g {name}\n" + "".join(f"v {x} {y} {z}\n" for x, y, z in mesh.vertices * 100)
        text += "".join(f"f {a} {b} {c}\n" for a, b, c in mesh.faces + start)
        start += len(mesh.vertices)
    (tmp_path / "two.obj").write_text(text)
    found = [load_asset(tmp_path / "two.obj", replace(SPLIT, piece=k)) for k in (1, 2)]

    assert [(one.frame.up, one.frame.scale) for one in found] == [("+Z", 0.01)] * 2
    assert np.allclose(found[1].box.size, [1.4, 1.0, 0.75])


def test_an_object_of_two_pieces_is_divided(tmp_path: Path) -> None:
    boxes = {**cabinet("", (-0.6, 0, 0)), **{f"{n} b": box for n, box in cabinet("", (0.6, 0, 0)).items()}}
    handles = [mesh for name, mesh in zip(boxes, meshes_of(boxes), strict=True) if "handle" in name]
    others = [mesh for name, mesh in zip(boxes, meshes_of(boxes), strict=True) if "handle" not in name]
    text, start = "", 1
    for name, mesh in (("handles", merge_meshes(handles)), *((f"part {k}", mesh) for k, mesh in enumerate(others))):
        text += f"g {name}\n" + "".join(f"v {x} {y} {z}\n" for x, y, z in mesh.vertices)
        text += "".join(f"f {a} {b} {c}\n" for a, b, c in mesh.faces + start)
        start += len(mesh.vertices)
    (tmp_path / "two.obj").write_text(text)
    found = [load_asset(tmp_path / "two.obj", replace(SPLIT, piece=k, up="+Z", scale=1.0)) for k in (1, 2)]

    for one in found:
        (held,) = [p for p in one.parts if p.source.name == "handles"]
        assert len(held.mesh.faces) == 24
        assert len(one.parts) == len(CABINET) - 2  # both handles are one object; the drawer's bottom joins its front


def test_joints_go_with_their_piece(tmp_path: Path) -> None:
    second = '<link name="other"><visual><origin xyz="1.2 0 0.5"/><geometry><box size="0.6 0.4 1"/></geometry></visual>'
    second += '<visual><origin xyz="1.2 0 1.02"/><geometry><box size="0.6 0.4 0.04"/></geometry></visual></link>'
    second += '<joint name="to_other" type="fixed"><parent link="carcass"/><child link="other"/></joint>'
    path = write_urdf(tmp_path, urdf_text(second))
    first, other = (load_asset(path, replace(SPLIT, piece=k, up="+Z", front="-Y")) for k in (1, 2))

    assert {joint.part for joint in first.stated_joints} == {"door_link", "drawer_link"}
    assert len(first.as_annotated().parts) > 2
    assert other.annotation is None
    assert len(other.parts) == 2
