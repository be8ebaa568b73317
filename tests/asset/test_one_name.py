"""What has one name and numbers is several doors or drawers, or the pieces of one: geometry tells."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

AUTO = LoadOptions(up="+Z", front="-Y", scale=1.0)
CASE = {
    "side_1": ((-0.40, -0.18, 0.0), (-0.38, 0.20, 0.98)),
    "side_2": ((0.38, -0.18, 0.0), (0.40, 0.20, 0.98)),
    "top": ((-0.40, -0.20, 0.98), (0.40, 0.20, 1.00)),
    "bottom": ((-0.38, -0.18, 0.0), (0.38, 0.20, 0.02)),
    "back": ((-0.38, 0.18, 0.02), (0.38, 0.20, 0.98)),
    "shelf": ((-0.38, -0.17, 0.60), (0.38, 0.18, 0.62)),
}
DRAWER = [
    ((-0.36, 0.14, 0.65), (0.36, 0.15, 0.90)),
    ((-0.37, -0.18, 0.64), (0.37, 0.15, 0.65)),
    ((-0.37, -0.18, 0.65), (-0.36, 0.15, 0.90)),
    ((0.36, -0.18, 0.65), (0.37, 0.15, 0.90)),
    ((-0.39, -0.20, 0.63), (0.39, -0.18, 0.97)),
    ((-0.02, -0.23, 0.79), (0.02, -0.20, 0.81)),
]
FRAMED = [
    ((-0.31, -0.192, 0.07), (0.31, -0.188, 0.53)),
    ((-0.38, -0.20, 0.0), (-0.30, -0.18, 0.60)),
    ((0.30, -0.20, 0.0), (0.38, -0.18, 0.60)),
    ((-0.30, -0.20, 0.0), (0.30, -0.18, 0.08)),
    ((-0.30, -0.20, 0.52), (0.30, -0.18, 0.60)),
]


BLENDER = "{}.{:03}"


def read(tmp_path, called=BLENDER, **pieces):
    """The asset of a case and pieces, called as Blender calls the shells into which it separates an object."""
    scene = trimesh.Scene()
    copies = {called.format(n, k) if k else n: box for n, boxes in pieces.items() for k, box in enumerate(boxes)}
    for name, (low, high) in {**CASE, **copies}.items():
        mesh = trimesh.creation.box(bounds=(low, high))
        scene.add_geometry(mesh, node_name=name, geom_name=name)
    scene.export(tmp_path / "cabinet.glb")
    return load_asset(tmp_path / "cabinet.glb", AUTO)


def moving(asset):
    return sorted((p.source.name, p.label) for p in asset.parts if p.label.is_movable)


@pytest.mark.parametrize("name", ["drawer", "drawer_1_layer0", "Schublade"])
def test_the_boards_of_one_drawer_are_one_whatever_else_its_name_holds(tmp_path, name):
    asset = read(tmp_path, **{name: DRAWER})
    front = asset.part(next(p.id for p in asset.parts if p.source.name == f"{name}.004"))

    assert (f"{name}.004", PartLabel.DRAWER) in moving(asset)
    assert {n for n, _ in moving(asset)} <= {f"{name}.004", f"{name}.005"}  # the grip may still be told by its name
    np.testing.assert_allclose(front.box.size, [0.78, 0.35, 0.34], atol=1e-6)
    assert any(f"joined to {name}.004" in note for note in asset.notes)


def test_the_boards_of_drawers_are_one_whatever_numbers_trimesh_gave_them(tmp_path):
    """A drawer and its boards may be `drawer_4`, `drawer_3_5`, `drawer_3_6`: other drawers' names, counted on."""
    lower = [((x, y, z - 0.63), (X, Y, Z - 0.63)) for (x, y, z), (X, Y, Z) in DRAWER]
    boards = {f"drawer_3_{k}": [box] for k, box in enumerate(DRAWER[:-1], 5)}
    boards |= {f"drawer_2_{k}": [box] for k, box in enumerate(lower[:4], 4)}
    asset = read(tmp_path, **boards, drawer_4=[DRAWER[-1]], drawer_3=lower[4:5])

    fronts = [p for p in asset.parts if p.source.name in ("drawer_3_9", "drawer_3")]
    assert [round(float(front.box.size[1]), 3) for front in fronts] == [0.35, 0.35]


def test_stiles_rails_and_panel_of_one_name_are_one_door_beside_another_drawer(tmp_path):
    asset = read(tmp_path, door=FRAMED, drawer=DRAWER)
    doors = [p for p in asset.parts if p.label is PartLabel.DOOR]

    assert len(doors) == 1
    np.testing.assert_allclose(doors[0].box.size, [0.76, 0.02, 0.6], atol=1e-6)


@pytest.mark.parametrize("called", [BLENDER, "{}_{}", "{}-{}"])
def test_doors_of_one_name_stay_several(tmp_path, called):
    """Three doors side by side that nearly meet, and two fronts of drawers above each other."""
    leaves = [((x, -0.20, 0.0), (x + 0.256, -0.18, 0.60)) for x in (-0.39, -0.133, 0.124)]
    drawers = [((-0.39, -0.20, z), (0.39, -0.18, z + 0.17)) for z in (0.62, 0.795)]
    asset = read(tmp_path, called, Door=leaves, Drawer=drawers)

    names = ["Door", called.format("Door", 1), called.format("Door", 2), "Drawer", called.format("Drawer", 1)]
    assert [n for n, _ in moving(asset)] == names
    assert not any("joined" in note for note in asset.notes)


PANELS = [((-0.38, -0.20, z), (0.38, -0.19, z + 0.29)) for z in (0.0, 0.29)]
KNOB = ((-0.01, -0.24, 0.30), (0.01, -0.20, 0.32))


def test_panels_that_meet_under_a_stile_of_their_name_are_one_door(tmp_path):
    """Mouldings lie on two panels along their outline: one by one, each panel is a plate and each stile is a strip."""
    stiles = [((x, -0.205, 0.0), (x + 0.05, -0.185, 0.58)) for x in (-0.38, 0.33)]
    rails = [((-0.38, -0.205, z), (0.38, -0.185, z + 0.05)) for z in (0.0, 0.265, 0.53)]
    asset = read(tmp_path, door=[*PANELS, *stiles, *rails, KNOB])
    (door,) = [p for p in asset.parts if p.label is PartLabel.DOOR and p.box.size[0] > 0.1]

    np.testing.assert_allclose(door.box.size, [0.76, 0.02, 0.58], atol=1e-6)
    assert any(p.source.name == "door.007" for p in asset.parts)  # the knob


@pytest.mark.parametrize(
    "strip",
    [((-0.02, -0.21, 0.0), (0.02, -0.20, 0.60)), ((-0.39, -0.21, 0.58), (0.39, -0.17, 0.64))],
    ids=["along the seam", "above both"],
)
def test_a_strip_at_two_leaves_that_does_not_hold_them_joins_nothing(tmp_path, strip):
    leaves = [((x, -0.20, 0.0), (x + 0.389, -0.18, 0.60)) for x in (-0.39, 0.001)]
    asset = read(tmp_path, door=[*leaves, strip])

    assert {"door", "door.001"} <= {n for n, _ in moving(asset)}
    assert not any("joined" in note for note in asset.notes)


def test_pieces_of_different_names_stay_apart(tmp_path):
    """A panel called door in a frame of stiles that have another name is joined to none of them."""
    asset = read(tmp_path, door=FRAMED[:1], door_left=FRAMED[1:2], door_right=FRAMED[2:3])

    assert not any("joined" in note for note in asset.notes)


def test_as_it_is_in_the_file_where_that_is_asked_for(tmp_path):
    read(tmp_path, door=FRAMED, drawer=DRAWER)
    asset = load_asset(tmp_path / "cabinet.glb", replace(AUTO, parts="input"))

    assert len(asset.parts) == len(CASE) + len(FRAMED) + len(DRAWER)
    assert Box.enclosing(p.box for p in asset.parts).size[0] == pytest.approx(0.8)
