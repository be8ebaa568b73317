"""What is a front and what only looks like one: shallow cases, open compartments, thick doors, boards of a back."""

from itertools import product

import manifold3d
import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.creases import drawn_fronts
from grafu.segmentation.division import divided


def board(*bounds):
    """A box from its low and its high corner."""
    return TriangleMesh.box_mesh(Box(np.array(bounds[:3], float), np.array(bounds[3:], float)))


def rounded(meshes):
    return sorted((*np.round(m.box.low, 4), *np.round(m.box.high, 4)) for m in meshes)


def fronts(*meshes, open_to=None):
    """By mesh, the boxes of the fronts that it is cut into."""
    found = divided(meshes, open_to or [True] * len(meshes), [False] * len(meshes))
    return {k: rounded([meshes[k].with_faces(p.faces) for p in ps if p.role == "front"]) for k, ps in found.items()}


# An island, 0.88 x 0.6 x 0.8 m: sides and back of upright boards, and two drawers above two doors that are one object.
SIDES = [board(x, 0.1 * k, 0.0, x + 0.015, 0.1 * (k + 1), 0.76) for x in (-0.455, 0.44) for k in range(6)]
WORKTOP = board(-0.47, -0.02, 0.76, 0.47, 0.62, 0.8)
LEAVES = [board(x, -0.02, z, x + 0.437, 0.0, top) for x in (-0.44, 0.003) for z, top in ((0.08, 0.6), (0.604, 0.75))]


def boards(width, gap=0.0, at=0.585):
    """The upright boards of a back, in a row across the island."""
    xs = np.arange(-0.44, 0.44 - 1e-6, width)
    return [board(x, at, 0.0, x + width - gap, at + 0.015, 0.76) for x in xs]


@pytest.mark.parametrize("width", [0.11, 0.22, 0.88])
def test_fronts_before_a_back_in_boards_are_found_as_before_one_in_one_piece(width):
    found = fronts(merge_meshes(LEAVES), merge_meshes(SIDES), merge_meshes(boards(width)), WORKTOP)
    assert found == {0: rounded(LEAVES)}


def test_panels_with_nothing_behind_them_are_no_fronts():
    rail = board(-0.44, 0.0, 0.0, 0.44, 0.02, 0.05)
    assert fronts(merge_meshes(LEAVES), merge_meshes(SIDES), rail, WORKTOP) == {}


@pytest.mark.parametrize(("width", "gap", "is_cut"), [(0.11, 0.0, False), (0.11, 0.004, True), (0.22, 0.0, True)])
def test_boards_that_meet_are_one_panel_and_what_has_gaps_or_is_wide_are_fronts(width, gap, is_cut):
    """Seen from behind, where the doors on the other side are objects of their own already."""
    back = boards(width, gap)
    found = fronts(*LEAVES, merge_meshes(SIDES), WORKTOP, merge_meshes(back))
    assert found.get(6, []) == (rounded(back) if is_cut else [])


def test_boards_that_meet_are_fronts_where_handles_stand_on_them():
    back = boards(0.11)
    knobs = [board(0.11 * k - 0.39, 0.6, 0.4, 0.11 * k - 0.37, 0.63, 0.42) for k in range(8)]
    found = fronts(*LEAVES, merge_meshes(SIDES), WORKTOP, merge_meshes([*back, *knobs]))
    assert found[6] == rounded(back)


# A bookcase, 1.6 x 0.32 x 1.8 m, open above and with three doors below.
BOOKCASE = [
    *(board(x, 0.0, 0.0, x + 0.02, 0.32, 1.8) for x in (-0.8, 0.78)),
    *(board(-0.78, 0.0, z, 0.78, 0.31, z + 0.02) for z in (0.0, 0.6, 1.0, 1.4, 1.78)),
    board(-0.78, 0.31, 0.0, 0.78, 0.32, 1.8),
]
LOW_DOORS = [board(x, 0.0, 0.022, x + 0.515, 0.02, 0.598) for x in (-0.778, -0.258, 0.262)]


@pytest.mark.parametrize("case", [BOOKCASE, [merge_meshes(BOOKCASE)]], ids=["in boards", "one shell"])
def test_doors_in_the_lower_part_of_a_shallow_case_are_fronts(case):
    whole = merge_meshes([*case, *LOW_DOORS])
    assert fronts(whole)[0] == rounded(LOW_DOORS)


def test_panels_on_a_door_are_no_fronts_of_it():
    """A plate that is hardly deeper than what lies on it is a door, as wide and as high as it may be."""
    leaf = board(-0.8, -0.05, 0.0, 0.8, 0.0, 1.8)
    panels = [board(x, -0.062, 0.2, x + 0.3, -0.05, 0.8) for x in (-0.7, -0.15, 0.4)]
    case = merge_meshes(BOOKCASE)
    assert fronts(case, merge_meshes([leaf, *panels])) == {}


def solid(low, high, radius=0.0):
    """A box; with a radius, its corners and edges are rounded."""
    if not radius:
        size = [b - a for a, b in zip(low, high, strict=True)]
        return manifold3d.Manifold.cube(size).translate([*map(float, low)])
    ball = manifold3d.Manifold.sphere(radius, 32)
    ends = [(a + radius, b - radius) for a, b in zip(low, high, strict=True)]
    return manifold3d.Manifold.batch_hull([ball.translate(p) for p in product(*ends)])


def welded(*parts, less=(), radius=0.0):
    """One closed surface of boxes, less others, whose edges may be rounded."""
    body = sum((solid(*part) for part in parts[1:]), solid(*parts[0]))
    for part in less:
        body -= solid(*part, radius)
    found = body.to_mesh()
    return TriangleMesh(np.asarray(found.vert_properties)[:, :3].astype(float), np.asarray(found.tri_verts))


NICHES = [((x, -0.1, z), (x + 0.36, 0.36, z + 0.3)) for x in (0.03, 0.41) for z in (0.52, 0.85)]
LOW = [(0.03, 0.39), (0.41, 0.77)]


def drawn(mesh):
    found = drawn_fronts([mesh], [True], [np.zeros(len(mesh.faces), np.int64)]).get(0, [])
    boxes = [mesh.with_faces(p.faces).box for p in found if p.role == "front"]
    return sorted(tuple(np.round([b.low[0], b.high[0], b.low[2], b.high[2]], 3)) for b in boxes)


@pytest.mark.parametrize("radius", [0.0, 0.001, 0.02])
@pytest.mark.parametrize("deep", [0.36, 0.15])
@pytest.mark.parametrize("raised", [True, False], ids=["with doors", "open"])
def test_an_open_compartment_drawn_on_a_surface_is_no_front_and_a_raised_door_is_one(deep, raised, radius):
    niches = [(low, (high[0], deep, high[2])) for low, high in NICHES]
    doors = [((left, -0.015, 0.05), (right, 0.1, 0.48)) for left, right in LOW] if raised else []
    mesh = welded(((0, 0, 0), (0.8, 0.4, 1.2)), *doors, less=niches, radius=radius)
    assert drawn(mesh) == ([(left, right, 0.05, 0.48) for left, right in LOW] if raised else [])


@pytest.mark.parametrize("radius", [0.0, 0.01], ids=["sharp", "rounded"])
def test_a_front_sunk_by_the_width_of_a_reveal_stays_a_front(radius):
    sunk = [(low, (high[0], 0.03, high[2])) for low, high in NICHES]
    mesh = welded(((0, 0, 0), (0.8, 0.4, 1.2)), less=sunk, radius=radius)
    assert len(drawn(mesh)) == 4


def test_a_wide_niche_is_no_front_although_it_is_flat():
    niches = [((0.03, -0.1, z), (1.77, 0.15, z + 1.1)) for z in (0.05, 1.2)]
    assert drawn(welded(((0, 0, 0), (1.8, 0.4, 2.4)), less=niches, radius=0.001)) == []


@pytest.mark.parametrize("is_closed", [True, False])
def test_a_box_between_two_walls_is_a_drawer_where_it_is_closed_before_and_else_a_compartment(is_closed):
    inner = [((0.032, -1.0 if not is_closed else 0.02, 0.52), (0.38, 0.36, 0.968))]
    boxes = [welded(((0.022, 0.0, 0.512), (0.388, 0.38, 0.978)), less=inner).translated(np.array([0.39, 0.0, 0.0]))]
    boxes.append(boxes[0].translated(np.array([-0.39, 0.0, 0.0])))
    walls = [board(x, 0.0, 0.0, x + 0.02, 0.4, 1.0) for x in (0.0, 0.39, 0.78)]
    lying = [board(0.0, 0.0, z, 0.8, 0.4, z + 0.02) for z in (0.0, 0.49, 0.98)]
    back = board(0.0, 0.39, 0.0, 0.8, 0.4, 1.0)
    found = fronts(merge_meshes([*walls, *lying, back, *boxes]))
    assert found.get(0, []) == (rounded(boxes) if is_closed else [])


# A refrigerator with two doors of one thickness; the door of its icebox is narrow, and has a dispenser in it.
BODY = welded(((0.0, 0.0, 0.0), (0.92, 0.6, 1.8)), less=[((0.05, -0.1, 0.05), (0.87, 0.5, 1.75))])
WIDE, NARROW = board(0.39, -0.14, 0.02, 0.92, 0.0, 1.8), board(0.0, -0.14, 0.02, 0.38, 0.0, 1.8)
DISPENSER = board(0.05, -0.145, 0.9, 0.33, -0.08, 1.3)
BARS = [board(x, -0.2, 0.8, x + 0.025, -0.14, 1.6) for x in (0.345, 0.41)]
TAP = board(0.15, -0.155, 1.0, 0.2, -0.145, 1.1)


def test_a_narrow_door_as_thick_as_the_wide_one_beside_it_is_a_front_and_its_dispenser_is_none():
    found = fronts(merge_meshes([BODY, WIDE, NARROW, DISPENSER, TAP, *BARS]))[0]
    assert found[1] == rounded([WIDE])[0]
    assert len(found) == 2
    assert found[0][0] == 0.0
    assert found[0][3:] == (0.38, 0.0, 1.8)


@pytest.mark.parametrize(
    "block",
    [
        board(0.0, -0.34, 0.02, 0.38, -0.2, 1.8),  # it stands apart
        board(0.0, -0.24, 0.02, 0.38, 0.0, 1.8),  # it is a column
        board(-0.3, -0.14, 0.02, 0.08, 0.0, 1.8),  # it stands beside the case
    ],
)
def test_a_block_before_a_case_is_no_door_of_it(block):
    found = fronts(merge_meshes([BODY, WIDE, BARS[1], block]))
    assert found[0] == rounded([WIDE])


# A low table with a drawer that goes through from one long side to the other, a knob on each.
TABLE = [
    board(-0.3, -0.7, 0.48, 0.3, 0.7, 0.51),
    board(-0.28, -0.68, 0.29, 0.28, 0.68, 0.32),
    *(board(x, y, 0.0, x + 0.04, y + 0.04, 0.48) for x in (-0.28, 0.24) for y in (-0.68, 0.64)),
    *(board(-0.28, y, 0.32, 0.28, y + 0.013, 0.48) for y in (-0.25, 0.237)),
]
THROUGH = board(-0.275, -0.23, 0.325, 0.275, 0.23, 0.475)
KNOBS = [board(x, -0.01, 0.39, x + 0.02, 0.01, 0.41) for x in (-0.295, 0.275)]


@pytest.mark.parametrize("knobs", [KNOBS, KNOBS[:1]], ids=["on both sides", "on one side"])
def test_a_table_stands_with_the_drawer_ahead_that_was_cut_out_and_its_other_knob_goes_with_it(tmp_path, knobs):
    glass = board(-0.25, -0.6, 0.511, 0.25, 0.6, 0.513)
    merge_meshes([*TABLE, THROUGH, *knobs, glass]).to_trimesh().export(tmp_path / "table.ply")
    asset = load_asset(tmp_path / "table.ply", LoadOptions(up="+Z", scale=1.0))

    assert asset.frame.front == ("+X" if len(knobs) > 1 else "-X")
    assert "small parts stand out there alone" in asset.frame.assumed[1]  # before the cut, where the front faces
    [drawer] = [part for part in asset.parts if part.id.endswith("_front")]
    assert drawer.box.size == pytest.approx([0.46, 0.57 if len(knobs) > 1 else 0.55, 0.15])
    assert load_asset(tmp_path / "table.ply", LoadOptions(up="+Z", front="-Y", scale=1.0)).frame.front == "-Y"


def test_rails_on_a_panel_are_no_handles_that_tell_a_front_behind():
    """A wine rack: rails on the inside of its one standing panel, which is seen from behind between them."""
    panel = board(-0.2, 0.6, 0.0, 0.2, 0.62, 0.85)
    rails = [board(-0.17, 0.62, z, 0.17, 0.64, z + 0.015) for z in (0.3, 0.4, 0.5, 0.6)]
    rack = [board(x, -0.3, z, x + 0.015, 0.6, z + 0.04) for x in (-0.19, 0.175) for z in (0.3, 0.5)]
    legs = [board(x, -0.3, 0.0, x + 0.065, -0.28, 0.85) for x in (-0.2, 0.135)]
    whole = [panel, *rack, *legs, board(-0.3, -0.4, 0.85, 0.3, 0.65, 0.88)]
    assert fronts(merge_meshes([*whole, *rails])) == {}
    assert fronts(merge_meshes([*whole, *rails[:1]])) == {0: rounded([panel])}


def framed_door(x, thick=0.02):
    """Stiles and rails of a door, 0.44 x 1.4 m, from its left end on."""
    stiles = [board(x + dx, -thick, 0.0, x + dx + 0.06, 0.0, 1.4) for dx in (0.0, 0.38)]
    return [*stiles, *(board(x + 0.06, -thick, z, x + 0.38, 0.0, z + 0.06) for z in (0.0, 1.34))]


def pane(x, thick=0.004):
    return board(x + 0.05, -0.012, 0.05, x + 0.39, -0.012 + thick, 1.35)


CUPBOARD = [
    *(board(x, 0.0, 0.0, x + 0.02, 0.3, 1.4) for x in (-0.445, 0.425)),
    *(board(-0.425, 0.0, z, 0.425, 0.29, z + 0.02) for z in (0.0, 0.7, 1.38)),
    board(-0.425, 0.29, 0.0, 0.425, 0.3, 1.4),
]
DOORS_AT = (-0.445, 0.005)


@pytest.mark.parametrize("one_glass", [True, False], ids=["one object of both panes", "an object for each pane"])
def test_frames_that_panes_of_another_object_fill_are_a_front_each(one_glass):
    frames, panes = [framed_door(x) for x in DOORS_AT], [pane(x) for x in DOORS_AT]
    glass = [merge_meshes(panes)] if one_glass else panes
    found = fronts(merge_meshes([bar for frame in frames for bar in frame]), merge_meshes(CUPBOARD), *glass)
    assert found[0] == rounded([merge_meshes(frame) for frame in frames])
    assert found.get(2, []) == []


@pytest.mark.parametrize("filled", ["open", "inset doors"])
def test_a_face_frame_that_is_open_or_holds_inset_doors_of_another_object_is_no_front(filled):
    """Doors as thick as their face frame lie in it; the frame stays."""
    frame = [bar for x in DOORS_AT for bar in framed_door(x)]
    doors = [board(x + 0.06, -0.019, 0.06, x + 0.38, 0.0, 1.34) for x in DOORS_AT] if filled != "open" else []
    found = fronts(merge_meshes(frame), merge_meshes(CUPBOARD), *doors)
    assert found.get(0, []) == []


def table(depth):
    """A table of one object, 0.8 x 0.8 x 1 m, with beams below its top; that in front is so deep, metres."""
    legs = [board(x, y, 0.0, x + 0.06, y + 0.06, 0.96) for x, y in product((-0.4, 0.34), (0.0, 0.74))]
    sides = [board(x, 0.06, 0.89, x + 0.06, 0.74, 0.95) for x in (-0.4, 0.34)]
    beam, top = board(-0.335, 0.003, 0.89, 0.335, 0.003 + depth, 0.95), board(-0.4, 0.0, 0.96, 0.4, 0.8, 1.0)
    back = board(-0.335, 0.74, 0.89, 0.335, 0.8, 0.95)
    return merge_meshes([*legs, *sides, back, top, beam])


@pytest.mark.parametrize(("depth", "count"), [(0.06, 0), (0.3, 1)], ids=["beam", "drawer"])
def test_a_beam_as_deep_as_high_between_legs_is_no_drawer(depth, count):
    assert len(fronts(table(depth)).get(0, [])) == count


@pytest.mark.parametrize(("height", "knobs", "count"), [(0.06, 0, 0), (0.06, 1, 1), (0.2, 0, 1)])
def test_a_low_board_at_the_floor_below_a_door_is_a_plinth_unless_a_knob_is_on_it(height, knobs, count):
    sides = [board(x, 0.0, 0.0, x + 0.016, 0.5, 0.8) for x in (0.0, 0.484)]
    shelves = [board(0.0, 0.0, z, 0.5, 0.5, z + 0.016) for z in (0.784, height + 0.002)]
    plinth = board(0.016, 0.001, 0.0, 0.484, 0.017, height)
    knob = board(0.24, -0.02, height / 2 - 0.01, 0.26, 0.002, height / 2 + 0.01)
    case = merge_meshes([*sides, *shelves, board(0.0, 0.48, 0.0, 0.5, 0.5, 0.8), plinth, *[knob] * knobs])
    door = board(0.002, -0.02, height + 0.004, 0.498, -0.002, 0.796)
    assert len(fronts(case, door, open_to=[True, False]).get(0, [])) == count
