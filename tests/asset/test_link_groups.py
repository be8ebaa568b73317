"""A link of a robot description is one part, whatever its name and its joint, unless it holds several or the whole."""

import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset
from grafu.vocabulary import PartLabel

CASE = {
    "left_board": ((-0.4, 0.0, 0.4), (0.02, 0.4, 0.8)),
    "right_board": ((0.4, 0.0, 0.4), (0.02, 0.4, 0.8)),
    "bottom_panel": ((0.0, 0.0, 0.01), (0.78, 0.4, 0.02)),
    "top_panel": ((0.0, 0.0, 0.79), (0.78, 0.4, 0.02)),
    "back_panel": ((0.0, 0.195, 0.4), (0.78, 0.01, 0.76)),
}
LEAF = {
    "stile_a": ((-0.35, -0.21, 0.4), (0.08, 0.02, 0.78)),
    "stile_b": ((0.35, -0.21, 0.4), (0.08, 0.02, 0.78)),
    "infill": ((0.0, -0.21, 0.4), (0.62, 0.01, 0.78)),
    "pull_bar": ((0.3, -0.235, 0.4), (0.02, 0.03, 0.2)),
}
TRAY = {
    "drawer_front": ((0.0, -0.21, 0.2), (0.7, 0.02, 0.3)),
    "left_cheek": ((-0.3, -0.05, 0.2), (0.01, 0.3, 0.2)),
    "drawer_bottom": ((0.0, -0.05, 0.1), (0.6, 0.3, 0.01)),
}
PAIR = {
    "door_1": ((-0.2, -0.21, 0.4), (0.38, 0.02, 0.78)),
    "door_2": ((0.2, -0.21, 0.4), (0.38, 0.02, 0.78)),
}


def _link(name: str, boxes: dict[str, tuple[tuple[float, ...], tuple[float, ...]]]) -> str:
    shapes = [
        f'<visual name="{visual}"><origin xyz="{" ".join(map(str, at))}"/>'
        f'<geometry><box size="{" ".join(map(str, size))}"/></geometry></visual>'
        for visual, (at, size) in boxes.items()
    ]
    return f'<link name="{name}">{"".join(shapes)}</link>'


def _read(tmp_path, *links: tuple[str, dict], joint: str = "revolute", parts: str = "auto") -> Asset:
    (base, _), *others = links
    joints = [
        f'<joint name="j{k}" type="{joint}"><parent link="{base}"/><child link="{child}"/><axis xyz="0 0 -1"/>'
        '<limit lower="0" upper="1"/></joint>'
        for k, (child, _) in enumerate(others)
    ]
    path = tmp_path / "cabinet.urdf"
    path.write_text(f'<robot name="r">{"".join(_link(*link) for link in links)}{"".join(joints)}</robot>')
    return load_asset(path, LoadOptions(parts=parts))


@pytest.mark.parametrize("joint", ["revolute", "fixed"])
def test_a_link_of_any_name_is_one_part_and_its_handle_rides_on_it(tmp_path, joint: str) -> None:
    asset = _read(tmp_path, ("body_0", CASE), ("assembly_b", LEAF), joint=joint)
    names = {part.source.name for part in asset.parts}

    assert names == {*CASE, "assembly_b", "pull_bar"}
    handle = next(part for part in asset.parts if part.label is PartLabel.HANDLE)
    assert handle.carried_by == "assembly_b"
    assert len(asset.part("assembly_b").surfaces) == 3


def test_a_link_whose_pieces_are_named_as_those_of_a_drawer_is_one(tmp_path) -> None:
    asset = _read(tmp_path, ("body_0", CASE), ("unit_c", TRAY))

    assert asset.part("unit_c").label is PartLabel.DRAWER
    assert _read(tmp_path, ("body_0", CASE), ("unit_c", LEAF)).part("unit_c").label is PartLabel.UNKNOWN


def test_a_link_with_names_of_doors_and_of_drawers_alike_is_neither(tmp_path) -> None:
    mixed = {"drawer_front": TRAY["drawer_front"], "door_panel": ((0.0, -0.21, 0.6), (0.7, 0.02, 0.3))}

    assert _read(tmp_path, ("body_0", CASE), ("unit_c", mixed)).part("unit_c").label is PartLabel.UNKNOWN


def test_a_link_with_several_whole_doors_is_no_part(tmp_path) -> None:
    names = {part.source.name for part in _read(tmp_path, ("body_0", CASE), ("fronts_b", PAIR)).parts}

    assert names == {*CASE, *PAIR}


def test_a_link_whose_doors_are_pieces_of_one_is_that_door(tmp_path) -> None:
    """A leaf, its liner and the bins behind it, each called a door by an exporter that numbers shapes."""
    leaf = {
        "door_0": ((0.0, -0.21, 0.4), (0.78, 0.02, 0.78)),
        "door_1": ((0.0, -0.17, 0.4), (0.7, 0.06, 0.7)),
        "door_2": ((0.0, -0.15, 0.2), (0.6, 0.1, 0.1)),
    }
    asset = _read(tmp_path, ("body_0", CASE), ("leaf", leaf))
    assert {part.source.name for part in asset.parts} == {*CASE, "leaf"}


def test_a_link_that_has_a_number_for_a_name_is_called_as_its_largest_shape(tmp_path) -> None:
    asset = _read(tmp_path, ("body_0", CASE), ("link_1", PAIR | TRAY | {"door_2": PAIR["door_1"]}))
    assert "link_1" not in {part.source.name for part in asset.parts}
    tray = {"drawer_3": ((0.0, -0.05, 0.2), (0.7, 0.3, 0.3)), "grip_0": ((0.0, -0.22, 0.2), (0.2, 0.02, 0.02))}
    asset = _read(tmp_path, ("body_0", CASE), ("link_1", {**tray, "liner": ((0.0, -0.05, 0.2), (0.5, 0.2, 0.2))}))
    assert {part.source.name for part in asset.parts} == {*CASE, "drawer_3", "grip_0"}


def test_two_links_with_numbers_whose_shapes_have_one_name_keep_the_links_names(tmp_path) -> None:
    shapes = {"door": ((-0.2, -0.21, 0.4), (0.38, 0.02, 0.78)), "infill": ((-0.2, -0.22, 0.4), (0.3, 0.01, 0.7))}
    other = {name: ((0.2, *at[1:]), size) for name, (at, size) in shapes.items()}
    asset = _read(tmp_path, ("body_0", CASE), ("link_1", shapes), ("link_2", other))
    assert {part.source.name for part in asset.parts} == {*CASE, "link_1", "link_2"}


def test_a_link_that_holds_the_whole_piece_is_no_part(tmp_path) -> None:
    floor = {"ground": ((0.0, 0.0, -0.005), (0.7, 0.4, 0.01))}
    names = {part.source.name for part in _read(tmp_path, ("world", floor), ("unit_c", CASE | LEAF)).parts}

    assert names == {"ground", *CASE, *LEAF}


def test_the_name_of_the_root_is_no_name_of_its_shapes(tmp_path) -> None:
    """What frames a door is often called a door frame: its boards are none of the door."""
    posts = {"casing_a": ((-0.5, 0.0, 1.0), (0.1, 0.1, 2.0)), "casing_b": ((0.5, 0.0, 1.0), (0.1, 0.1, 2.0))}
    leaf = {"stile": ((-0.39, 0.0, 1.0), (0.1, 0.04, 1.98)), "infill": ((0.05, 0.0, 1.0), (0.78, 0.02, 1.98))}
    asset = _read(tmp_path, ("door_frame", posts), ("door_leaf", leaf))

    assert {part.source.name for part in asset.parts} == {*posts, "door_leaf"}
    unnamed = _read(tmp_path, ("door_frame", {"": posts["casing_a"]}), ("door_leaf", leaf))
    assert {part.source.name for part in unnamed.parts} == {"door_frame", "door_leaf"}


def test_shapes_stay_as_they_are_in_the_file_where_that_is_asked_for(tmp_path) -> None:
    names = {part.source.name for part in _read(tmp_path, ("body_0", CASE), ("link_1", LEAF), parts="input").parts}

    assert names == {*CASE, *LEAF}


def test_a_link_that_stands_apart_is_a_piece_of_furniture_of_its_own(tmp_path) -> None:
    far = {name: ((x + 2.0, y, z), size) for name, ((x, y, z), size) in CASE.items() if name != "back_panel"}
    parts = _read(tmp_path, ("body_0", CASE), ("second_1", far)).parts

    assert len(parts) == len(CASE) + len(far)
