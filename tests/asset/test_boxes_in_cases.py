"""Boxes of drawers drawn in the case's object, or as boards without drawers' words, go with their fronts; nothing else.

Pieces stand Z up, their front at -Y: a case 0.8 m wide with three overlay fronts, boxes behind them.
"""

import numpy as np
import pytest
import trimesh

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.vocabulary import PartLabel

AUTO = LoadOptions(up="+Z", front="-Y", scale=1.0)
CASE = [
    ((-0.40, -0.22, 0.0), (-0.38, 0.22, 0.80)),
    ((0.38, -0.22, 0.0), (0.40, 0.22, 0.80)),
    ((-0.38, -0.22, 0.0), (0.38, 0.22, 0.02)),
    ((-0.40, -0.24, 0.80), (0.40, 0.22, 0.82)),
    ((-0.38, 0.21, 0.02), (0.38, 0.22, 0.80)),
]
LOWS = (0.01, 0.275, 0.54)
FRONTS = [((-0.399, -0.24, low), (0.399, -0.22, low + 0.255)) for low in LOWS]
WIDE, DEEP = (-0.36, 0.36), (-0.22, 0.18)


def boards(low, width=WIDE, depth=DEEP, height=0.17):
    """Sides, bottom and back of a box."""
    (left, right), (near, far) = width, depth
    bottom, top = low + 0.03, low + 0.03 + height
    return [
        ((left, near, bottom), (left + 0.012, far, top)),
        ((right - 0.012, near, bottom), (right, far, top)),
        ((left + 0.012, near, bottom), (right - 0.012, far, bottom + 0.01)),
        ((left + 0.012, far - 0.012, bottom + 0.01), (right - 0.012, far, top)),
    ]


def tub(low):
    """A thin-walled box drawn as one shell, open above and at its front."""
    made = trimesh.creation.box(bounds=[(WIDE[0], DEEP[0], low + 0.03), (WIDE[1], DEEP[1], low + 0.2)])
    kept = made.face_normals @ np.array([[0.0, 0, 1], [0, -1.0, 0]]).T
    return trimesh.Trimesh(made.vertices, made.faces[(kept < 0.5).all(axis=1)], process=False)


def solid(held):
    return trimesh.util.concatenate([trimesh.creation.box(bounds=box) for box in held])


def read(tmp_path, **objects):
    """The parts of a file by id, from objects that are meshes or lists of boxes."""
    scene = trimesh.Scene()
    for name, held in objects.items():
        mesh = held if isinstance(held, trimesh.Trimesh) else solid(held)
        scene.add_geometry(mesh, node_name=name, geom_name=name)
    scene.export(tmp_path / "piece.glb")
    return {part.id: part for part in load_asset(tmp_path / "piece.glb", AUTO).parts}


def deep_drawers(parts):
    """How many parts are drawers that reach as far back as the boxes do."""
    return sum(p.label is PartLabel.DRAWER and p.box.size[1] > 0.35 for p in parts.values())


@pytest.mark.parametrize("kind", ["boards", "tub"])
def test_boxes_in_the_object_of_the_case_go_with_fronts_in_one_object(tmp_path, kind):
    boxes = [trimesh.util.concatenate([solid(boards(low)) if kind == "boards" else tub(low)]) for low in LOWS]
    parts = read(tmp_path, carcass=trimesh.util.concatenate([solid(CASE), *boxes]), fronts=FRONTS)

    assert deep_drawers(parts) == 3
    assert parts["carcass"].box.low[1] > -0.27
    assert len(parts["carcass"].mesh.faces) == 12 * len(CASE)


def test_a_box_that_stands_close_above_the_bottom_of_the_case_is_told_from_it(tmp_path):
    lowest = ((-0.399, -0.24, 0.0), FRONTS[0][1])
    low = -0.0095  # of the box: half a millimetre above the bottom of the case
    parts = read(tmp_path, carcass=[*CASE, *boards(low)], fronts=[lowest, *FRONTS[1:]])

    assert deep_drawers(parts) == 1
    assert len(parts["carcass"].mesh.faces) == 12 * len(CASE)


INSET = [((-0.375, -0.24, low), (0.375, -0.22, low + 0.255)) for low in LOWS]


def as_large_as(front, far=0.18):
    """The boards of a box as wide and as high as its front."""
    (left, _, low), (right, back, high) = front
    return [
        ((left, back, low), (left + 0.012, far, high)),
        ((right - 0.012, back, low), (right, far, high)),
        ((left + 0.012, back, low), (right - 0.012, far, low + 0.01)),
        ((left + 0.012, far - 0.012, low + 0.01), (right - 0.012, far, high)),
    ]


def test_a_box_as_wide_and_high_as_its_low_front_goes_with_it(tmp_path):
    held = [board for front in INSET for board in as_large_as(front)]
    parts = read(tmp_path, carcass=[*CASE, *held], fronts=INSET)

    assert deep_drawers(parts) == 3
    assert len(parts["carcass"].mesh.faces) == 12 * len(CASE)


@pytest.mark.parametrize("closed", [False, True])
def test_what_a_high_front_or_a_lid_closes_is_no_box_though_it_is_as_large(tmp_path, closed):
    """The compartment behind a door that is higher than most drawers, and one that a board closes from above."""
    front = ((-0.375, -0.24, 0.01), (0.375, -0.22, 0.26 if closed else 0.60))
    lid = [((-0.363, -0.22, 0.25), (0.363, 0.168, 0.26))] if closed else []
    parts = read(tmp_path, carcass=[*CASE, *as_large_as(front), *lid], slab=[front])

    assert parts["slab"].label is not PartLabel.DRAWER
    assert parts["slab"].box.size[1] < 0.03


def test_boards_of_a_case_that_a_box_of_another_object_touches_are_none_of_it(tmp_path):
    """Behind a low front the box fills its opening, a board of the case lies right below it."""
    box, below = as_large_as(INSET[0]), [((-0.375, -0.22, 0.006), (0.375, 0.18, 0.0099))]
    parts = read(tmp_path, carcass=[*CASE, *below], mesh_1=box, fronts=INSET)
    assert len(parts["carcass"].mesh.faces) == 12 * (len(CASE) + 1)


def test_a_knob_in_the_object_of_a_front_does_not_make_it_too_thick_for_one(tmp_path):
    knob = ((-0.03, -0.44, 0.10), (0.03, -0.24, 0.16))
    parts = read(tmp_path, carcass=[*CASE, *boards(LOWS[0])], slab=[FRONTS[0], knob])
    assert parts["slab"].label is PartLabel.DRAWER


def test_boards_without_names_that_are_joined_to_a_front_are_a_drawer_in_a_case_alone(tmp_path):
    inside = {f"mesh_{k}": [board] for k, board in enumerate([FRONTS[0], *boards(LOWS[0])])}
    case = {f"mesh_{9 + k}": [board] for k, board in enumerate(CASE)}
    parts = read(tmp_path, **inside, **case)
    assert parts["mesh_0"].label is PartLabel.DRAWER

    parts = read(tmp_path, **inside, mesh_8=[((-0.4, -0.24, -0.1), (0.4, 0.22, 0.0))])
    assert "mesh_3" not in parts
    assert parts["mesh_0"].label is not PartLabel.DRAWER


@pytest.mark.parametrize("deeper", [0.0, 0.001, 0.004], ids=["rests", "cuts in by 1 mm", "cuts in by 4 mm"])
def test_a_box_that_rests_on_the_bottom_of_the_case_or_cuts_into_it_is_told_from_it(tmp_path, deeper):
    lowest = ((-0.399, -0.24, 0.0), FRONTS[0][1])
    parts = read(tmp_path, carcass=[*CASE, *boards(-0.01 - deeper)], fronts=[lowest, *FRONTS[1:]])

    assert deep_drawers(parts) == 1
    assert len(parts["carcass"].mesh.faces) == 12 * len(CASE)


@pytest.mark.parametrize("left", [-1.2, -0.4])
def test_the_sides_of_a_case_that_stand_on_its_bottom_are_no_box(tmp_path, left):
    """Units of a row: each has a bottom under its sides, a back between them, and one front before it."""
    units = [
        [
            ((x, -0.22, 0.0), (x + 0.8, 0.22, 0.02)),
            ((x + 0.02, -0.22, 0.02), (x + 0.04, 0.22, 0.8)),
            ((x + 0.76, -0.22, 0.02), (x + 0.78, 0.22, 0.8)),
            ((x + 0.04, 0.2, 0.02), (x + 0.76, 0.22, 0.8)),
        ]
        for x in (-1.2, -0.4, 0.4)
    ]
    front = ((left - 0.01, -0.24, -0.01), (left + 0.81, -0.22, 0.85))
    parts = read(tmp_path, carcass=[board for unit in units for board in unit], fronts=[front])

    assert deep_drawers(parts) == 0


@pytest.mark.parametrize("left_out", [None, "tray_floor", "tray_rear"])
def test_boards_with_words_of_their_own_go_with_the_front_before_them(tmp_path, left_out):
    words = ("tray_l", "tray_r", "tray_floor", "tray_rear")
    named = {word: [board] for word, board in zip(words, boards(LOWS[0]), strict=True) if word != left_out}
    parts = read(tmp_path, carcass=CASE, slab=FRONTS[:1], **named)

    assert parts["slab"].label is PartLabel.DRAWER
    assert not set(words) & set(parts)


def test_the_case_of_a_single_front_is_no_box(tmp_path):
    """Sides, bottom and back behind one front, open above under a worktop, beside the next unit: as a drawer's box."""
    unit = boards(-0.02, (-0.40, 0.40), (-0.22, 0.22), 0.79)
    beside = [tuple((x + shift, y, z) for x, y, z in board) for shift in (-0.8, 0.8) for board in unit]
    parts = read(
        tmp_path, units=[*unit, *beside], worktop=[((-1.2, -0.24, 0.81), (1.2, 0.22, 0.85))],
        slab=[((-0.399, -0.24, 0.012), (0.399, -0.22, 0.798))], wall=[((-1.2, 0.23, 0.0), (1.2, 0.24, 1.4))],
    )  # fmt: skip

    assert parts["slab"].label is not PartLabel.DRAWER
    assert parts["slab"].box.size[1] < 0.03


@pytest.mark.parametrize(
    ("name", "front", "inside"),
    [
        ("compartment", FRONTS[0], [*boards(LOWS[0]), ((-0.36, -0.22, 0.20), (0.36, 0.18, 0.21))]),
        ("two trays", ((-0.399, -0.24, 0.01), (0.399, -0.22, 0.53)), [*boards(LOWS[0]), *boards(LOWS[1])]),
        ("set back", FRONTS[0], boards(LOWS[0], depth=(-0.18, 0.18))),
        ("low tray", ((-0.399, -0.24, 0.01), (0.399, -0.22, 0.79)), boards(LOWS[0])),
        ("no sides", FRONTS[0], boards(LOWS[0])[2:]),
        ("two sides", FRONTS[0], boards(LOWS[0], width=(-0.36, 0.36))[:2]),
        ("sides and a strip", FRONTS[0], [*boards(LOWS[0])[:2], ((-0.35, -0.1, 0.04), (0.35, -0.05, 0.05))]),
        ("narrow", FRONTS[0], boards(LOWS[0], width=(-0.1, 0.1))),
    ],
)
def test_what_else_stands_behind_a_front_stays(tmp_path, name, front, inside):
    """Closed above, one of several, not right behind its front, much lower or narrower, no box at all."""
    parts = read(tmp_path, carcass=[*CASE, *inside], slab=[front])

    assert parts["slab"].label is not PartLabel.DRAWER, name
    assert parts["slab"].box.size[1] < 0.03


@pytest.mark.parametrize("left_out", [0, 1, 4], ids=["left side", "right side", "back"])
def test_a_crate_behind_a_panel_that_stands_in_no_case_stays(tmp_path, left_out):
    case = [board for k, board in enumerate(CASE) if k != left_out]
    crate = boards(LOWS[0], depth=(-0.22, 0.22)) if left_out == 4 else boards(LOWS[0])
    parts = read(tmp_path, carcass=[*case, *crate], slab=FRONTS[:1])

    assert parts["slab"].label is not PartLabel.DRAWER
    assert parts["slab"].box.size[1] < 0.03


def test_what_is_called_a_door_gets_no_box(tmp_path):
    parts = read(tmp_path, carcass=[*CASE, *boards(LOWS[0])], cabinet_door=FRONTS[:1])

    assert parts["cabinet_door"].label is PartLabel.DOOR
    assert parts["cabinet_door"].box.size[1] < 0.03
