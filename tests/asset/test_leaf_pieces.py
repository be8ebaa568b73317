"""Stiles and trims whose names begin as that of their front are one with it; what has another beginning is not."""

import pytest

from grafu.asset.labels import label_of
from grafu.asset.leaf_pieces import with_leaf_pieces
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel

WHOLE = Box(vec3(-0.5, -0.1, 0.0), vec3(0.5, 0.5, 1.0))


def part(name: str, low, high) -> Part:
    mesh = TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high)))
    return Part(name, label_of(name), (Surface(mesh),), PartSource(name), "name")


def framed(beginning: str, panel: str = "door", x: float = 0.0, trim: str = "trim") -> list[Part]:
    """A panel of 0.36 x 0.76 m in a frame of four trims that stand out of it, 0.5 m wide."""
    return [
        part(f"{beginning}_door_{panel}", (x + 0.07, -0.01, 0.07), (x + 0.43, 0.0, 0.83)),
        part(f"{beginning}_door_{trim}_top", (x + 0.07, -0.02, 0.83), (x + 0.43, 0.0, 0.9)),
        part(f"{beginning}_door_{trim}_bottom", (x + 0.07, -0.02, 0.0), (x + 0.43, 0.0, 0.07)),
        part(f"{beginning}_door_{trim}_left", (x, -0.02, 0.0), (x + 0.07, 0.0, 0.9)),
        part(f"{beginning}_door_{trim}_right", (x + 0.43, -0.02, 0.0), (x + 0.5, 0.0, 0.9)),
    ]


def joined(*parts: Part) -> dict[str, int]:
    """Returns the parts that are left, and of how many pieces each is made."""
    kept, _ = with_leaf_pieces(parts, WHOLE)
    return {one.id: len(one.surfaces) for one in kept}


@pytest.mark.parametrize("trim", ["trim", "stile", "moulding"])
@pytest.mark.parametrize("beginning", ["left", "stack0", "cab_1_left"])
def test_trims_around_a_panel_are_one_with_it(beginning, trim):
    parts = framed(beginning, trim=trim)
    assert joined(*parts) == {f"{beginning}_door_door": 5}


def test_camel_case_and_a_name_that_is_the_beginning_do_as_well():
    panel = part("LeftDoor", (0.07, -0.01, 0.07), (0.43, 0.0, 0.83))
    stile = part("LeftDoorStileLeft", (0.0, -0.02, 0.0), (0.07, 0.0, 0.9))
    assert joined(panel, stile) == {"LeftDoor": 2}


def test_two_doors_side_by_side_stay_two():
    assert joined(*framed("left", x=-0.5), *framed("right")) == {"left_door_door": 5, "right_door_door": 5}


SEPARATE = {
    "two wholes of one beginning": [*framed("cabinet"), part("cabinet_door_right", (0.5, -0.02, 0.0), (1.0, 0.0, 0.9))],
    "trims that touch nothing": [
        framed("left")[0],
        part("left_door_trim_top", (0.07, -0.02, 0.93), (0.43, 0.0, 1.0)),
    ],
    "another beginning": [framed("left")[0], *framed("right")[1:]],
    "a box behind the front": [
        part("left_drawer", (0.0, -0.02, 0.0), (0.5, 0.0, 0.3)),
        part("left_drawer_box", (0.02, 0.0, 0.02), (0.48, 0.4, 0.28)),
    ],
    "pieces alone": framed("left")[1:],
}


@pytest.mark.parametrize("what", SEPARATE)
def test_others_stay_apart(what):
    parts = SEPARATE[what]
    assert joined(*parts) == {one.id: 1 for one in parts}


def test_a_file_of_such_pieces_has_one_door(tmp_path):
    boards = [
        part("side_left", (0.0, 0.0, 0.0), (0.02, 0.4, 0.9)),
        part("side_right", (0.48, 0.0, 0.0), (0.5, 0.4, 0.9)),
        part("back", (0.02, 0.38, 0.0), (0.48, 0.4, 0.9)),
    ]
    text, start = "", 1
    for one in (*boards, *framed("stack_1")):
        mesh = one.mesh
        text += f"o {one.id}\n" + "".join(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in mesh.vertices)
        text += "".join(f"f {a} {b} {c}\n" for a, b, c in mesh.faces + start)
        start += len(mesh.vertices)
    (tmp_path / "unit.obj").write_text(text)
    asset = load_asset(tmp_path / "unit.obj", LoadOptions(up="+Z", front="-Y", scale=1.0))
    doors = [one for one in asset.parts if one.label is PartLabel.DOOR]
    assert [(one.id, len(one.surfaces)) for one in doors] == [("stack_1_door_door", 5)]
