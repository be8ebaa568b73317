"""Drawers in the apron of a table, without handles: told by their boxes where all is one object, and left whole."""

import numpy as np

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.division import divided
from grafu.vocabulary import PartLabel

AUTO = LoadOptions(up="+Z", front="-Y", scale=1.0)
LEFTS = (-0.94, -0.46, 0.02, 0.5)
WIDTH, LOW, HIGH = 0.44, 0.56, 0.64


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def front(left):
    return board((left, -0.40, LOW), (left + WIDTH, -0.384, HIGH))


def bottom(left, rise=0.0):
    """The bottom of a drawer's box, and the two runners below it that are a hair wider than the front."""
    at = LOW + rise
    return [
        board((left - 0.004, -0.384, at - 0.002), (left + 0.03, -0.08, at + 0.014)),
        board((left + WIDTH - 0.03, -0.384, at - 0.002), (left + WIDTH + 0.004, -0.08, at + 0.014)),
        board((left + 0.02, -0.384, at + 0.015), (left + WIDTH - 0.02, -0.08, at + 0.02)),
    ]


def walls(left, width=WIDTH):
    """Both sides and the back of a drawer's box."""
    return [
        board((left + 0.01, -0.384, 0.58), (left + 0.024, -0.08, 0.63)),
        board((left + width - 0.024, -0.384, 0.58), (left + width - 0.01, -0.08, 0.63)),
        board((left + 0.024, -0.092, 0.58), (left + width - 0.024, -0.08, 0.63)),
        board((left + 0.024, -0.384, 0.58), (left + width - 0.024, -0.092, 0.585)),
    ]


def table():
    """Four legs, the apron on three sides, the boards between the drawers, and the top."""
    legs = [board((x, y, 0.0), (x + 0.06, y + 0.06, 0.66)) for x in (-1.02, 0.96) for y in (-0.4, 0.34)]
    sides = [board((x, -0.34, 0.54), (x + 0.02, 0.34, 0.66)) for x in (-1.0, 0.98)]
    rails = [board((-0.96, -0.398, z), (0.96, -0.38, z + 0.014)) for z in (0.54, 0.646)]
    stiles = [board((left - 0.03, -0.398, 0.554), (left - 0.005, -0.38, 0.646)) for left in (*LEFTS[1:],)]
    return [*legs, *sides, *rails, *stiles, board((-0.96, 0.36, 0.54), (0.96, 0.38, 0.66)), *top()]


def top():
    return [board((-1.1, -0.46, 0.66), (1.1, 0.46, 0.69))]


def fronts_of(mesh):
    (pieces,) = divided([mesh], [True], [False]).values() or [[]]
    return sorted(float(np.round(mesh.with_faces(p.faces).box.low[0], 3)) for p in pieces if p.role == "front")


def test_low_fronts_without_handles_are_found_where_boxes_are_drawn_behind_them():
    drawers = [mesh for left in LEFTS for mesh in (front(left), *walls(left))]
    assert fronts_of(merge_meshes([*table(), *drawers])) == list(LEFTS)


def test_low_plates_with_nothing_behind_them_are_panels_of_the_apron():
    table_with_panels = merge_meshes([*table(), *(front(left) for left in LEFTS)])
    assert divided([table_with_panels], [True], [False]) == {}


def test_a_front_with_the_bottom_of_its_box_is_no_case_behind_that_front():
    drawer = merge_meshes([front(LEFTS[0]), *bottom(LEFTS[0])])
    assert divided([merge_meshes(table()), drawer], [True, True], [False, False]).get(1) is None


def test_a_front_below_the_boards_of_its_case_is_cut_out_of_it():
    case = merge_meshes([front(LEFTS[0]), *bottom(LEFTS[0]), *bottom(LEFTS[0], HIGH - LOW)])
    assert divided([merge_meshes(table()), case], [True, True], [False, False]).get(1) is not None


def read(tmp_path, apron):
    """The parts of a table whose apron is one object, and each box of a drawer behind it, a hair apart, another."""
    import trimesh

    scene = trimesh.Scene()
    boxes = {f"Object_{k}": merge_meshes(walls(-0.97 + 0.48 * k, 0.486)) for k in range(4)}
    rest = merge_meshes(table()[:6] + top())
    for name, mesh in {"Object_9": rest, "Object_8": apron, **boxes}.items():
        scene.add_geometry(mesh.to_trimesh(), node_name=name, geom_name=name)
    scene.export(tmp_path / "table.glb")
    return load_asset(tmp_path / "table.glb", AUTO)


def test_an_apron_before_the_boxes_of_several_drawers_is_the_front_of_none(tmp_path):
    parts = read(tmp_path, board((-0.96, -0.40, 0.55), (0.96, -0.385, 0.66))).parts
    assert all(part.label is not PartLabel.DRAWER for part in parts)
    assert len(parts) == 6
