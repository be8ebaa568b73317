"""Welded furniture is cut where that makes doors and drawers appear, and nowhere else."""

from collections import Counter

import numpy as np
import pytest
import trimesh

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.shells import shell_numbers
from grafu.segmentation.config import CandidateConfig, DivisionConfig, FrameConfig, MemberConfig, SegmentationConfig
from grafu.segmentation.division import divided
from grafu.segmentation.mesh_shells import MeshShells, axes_from
from grafu.synth.samples import desk, dresser, kitchen_base
from small_assets import CABINET, DOOR, DRAWER, mesh_of

QUARTER = np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
CASE = [mesh_of(name) for name in CABINET if name not in (*DOOR, *DRAWER)]


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def finely(mesh, times):
    """The mesh with each face in four, so many times."""
    for _ in range(times):
        mesh = TriangleMesh(*trimesh.remesh.subdivide(mesh.vertices, mesh.faces))
    return mesh


def cut(*meshes, open_to=None, moving=None):
    """What the meshes are cut into: by number, the boxes of each role."""
    found = divided(meshes, open_to or [True] * len(meshes), moving or [False] * len(meshes))
    return {k: [(p.role, meshes[k].with_faces(p.faces).box) for p in pieces] for k, pieces in found.items()}


def boxes(found, role):
    return sorted(
        (*np.round(b.low, 4), *np.round(b.high, 4)) for pieces in found.values() for r, b in pieces if r == role
    )


def rounded(meshes):
    return sorted((*np.round(m.box.low, 4), *np.round(m.box.high, 4)) for m in meshes)


@pytest.mark.parametrize("turns", [0, 1, 2, 3])
def test_a_welded_cabinet_gives_its_door_drawer_and_handles_back_from_whichever_side(turns):
    T = np.linalg.matrix_power(QUARTER, turns)
    whole = merge_meshes([mesh_of(name) for name in CABINET]).transformed(T)
    found = cut(whole)

    front = rounded([mesh_of(DOOR[0]).transformed(T), mesh_of("drawer_front-9").transformed(T)])
    assert boxes(found, "front") == front
    assert boxes(found, "handle") == rounded([mesh_of(n).transformed(T) for n in ("handle-8", "handle-11")])
    assert [role for role, _ in found[0]].count("rest") == 1


@pytest.mark.parametrize("sample", [kitchen_base, dresser], ids=["framed doors", "drawers in a face frame"])
def test_welded_samples_give_each_front_back_whole(sample):
    asset = sample()
    whole = merge_meshes([part.mesh for part in asset.parts])
    moving = [part.mesh for part in asset.parts if part.label.is_movable]

    assert boxes(cut(whole), "front") == rounded(moving)


@pytest.mark.parametrize(
    ("config", "expected"),
    [
        (SegmentationConfig(), {"rest": 1, "front": 2, "handle": 2}),
        (SegmentationConfig(candidates=CandidateConfig(least=0.9), division=DivisionConfig(low=0.9)), {}),
        (SegmentationConfig(candidates=CandidateConfig(least=0.9)), {"rest": 1, "front": 2, "handle": 2}),
        (SegmentationConfig(members=MemberConfig(handle_side=1e-9)), {"rest": 1, "front": 2}),
        (SegmentationConfig(division=DivisionConfig(small=0.9, low=0.9)), {}),
    ],
    ids=[
        "as usual",
        "no plate is large enough",
        "handles stand on small plates",
        "nothing is a handle",
        "fronts are trifles",
    ],
)
def test_thresholds_can_be_chosen(config, expected):
    whole = merge_meshes([mesh_of(name) for name in CABINET])
    pieces = divided([whole], [True], [False], config=config).get(0, [])

    assert Counter(piece.role for piece in pieces) == expected


def test_without_bars_no_front_is_framed():
    whole = merge_meshes([part.mesh for part in kitchen_base().parts])
    config = SegmentationConfig(frames=FrameConfig(bar=1e3))

    assert divided([whole], [True], [False]) != divided([whole], [True], [False], config=config)


def test_every_face_goes_to_one_piece():
    whole = merge_meshes([part.mesh for part in desk().parts])
    [pieces] = divided([whole], [True], [False]).values()

    faces = np.concatenate([piece.faces for piece in pieces])
    assert sorted(faces.tolist()) == list(range(len(whole.faces)))
    assert Counter(piece.role for piece in pieces)["front"] > 1


@pytest.mark.parametrize("sample", [kitchen_base, dresser, desk])
def test_what_is_divided_already_stays_as_it_is(sample):
    asset = sample()
    meshes = [part.mesh for part in asset.parts]

    assert any(shell_numbers(mesh).max() for mesh in meshes)
    assert cut(*meshes, moving=[part.label.is_movable for part in asset.parts]) == {}
    assert cut(*meshes) == {}, "nor where no name states what the parts are"


def test_the_back_behind_all_fronts_does_not_count_as_one_because_they_lie_before_it():
    names = [name for name in CABINET if name not in ("top_panel-3", "back_panel-5", *DOOR, *DRAWER)]
    back = board((-0.4, 0.18, -0.02), (0.4, 0.2, 0.92))
    worktop, pipe = board((-0.6, -0.3, 1.2), (0.6, 0.3, 1.24)), board((-0.4, 0.2, 0.1), (0.4, 0.5, 0.8))
    doors = [board((x, -0.2, 0.0), (x + 0.38, -0.18, 0.9)) for x in (-0.39, 0.01)]
    found = cut(merge_meshes([*map(mesh_of, names), back, worktop, pipe, *doors]))

    assert boxes(found, "front") == rounded(doors)


@pytest.mark.parametrize("turns", [0, 2])
def test_fronts_with_handles_are_clearer_than_a_back_in_two_panels(turns):
    T = np.linalg.matrix_power(QUARTER, turns)
    backs = [board((x, 0.205, 0.1), (x + 0.38, 0.215, 0.9)) for x in (-0.39, 0.01)]
    names = [name for name in CABINET if name != "back_panel-5"]
    found = cut(merge_meshes([*map(mesh_of, names), *backs]).transformed(T))

    doors = [mesh_of(name).transformed(T) for name in (DOOR[0], "drawer_front-9")]
    assert boxes(found, "front") == rounded(doors)


def test_where_an_object_is_a_front_with_a_handle_the_front_of_the_piece_is_there():
    """What looks like fronts behind it is the back of the case."""
    case = merge_meshes([mesh_of(name) for name in CABINET]).transformed(np.linalg.matrix_power(QUARTER, 2))
    low, high = case.box.low[1], case.box.high[2]
    door = board((-0.39, low - 0.02, 0.02), (0.39, low, high - 0.02))
    bar = board((0.3, low - 0.05, 0.4), (0.32, low - 0.02, 0.6))

    assert len(boxes(cut(case), "front")) == 2
    found = cut(case, merge_meshes([door, bar]))
    assert {k: [role for role, _ in pieces] for k, pieces in found.items()} == {1: ["body", "handle"]}


def test_the_only_object_of_an_input_is_a_case_also_where_it_looks_like_a_drawer():
    """A base cabinet has no top, and its door is as wide as its sides stand apart."""
    names = ("vertical_side_panel-1", "vertical_side_panel-2", "bottom_panel-4", "back_panel-5")
    door = board((-0.41, -0.2, 0.0), (0.41, -0.18, 0.98))
    whole = merge_meshes([*map(mesh_of, names), door, mesh_of("handle-8")])

    assert boxes(cut(whole), "front") == rounded([door])
    assert boxes(cut(whole, board((-0.5, -0.2, -0.1), (0.5, 0.2, -0.05))), "front") == [], "a drawer over a board"


COOKER = [
    board((-0.5, -0.4, 0.0), (-0.43, 0.5, 0.78)),
    board((0.43, -0.4, 0.0), (0.5, 0.5, 0.78)),
    board((-0.43, -0.4, 0.0), (0.43, 0.5, 0.07)),
    board((-0.43, 0.43, 0.07), (0.43, 0.5, 0.72)),
    board((-0.5, -0.47, 0.78), (0.5, 0.5, 0.85)),  # the hob
    board((-0.5, 0.4, 0.85), (0.5, 0.55, 1.1)),
]


@pytest.mark.parametrize("beside", [False, True])
def test_the_body_of_a_cooker_is_no_box_of_a_drawer_behind_its_door(beside):
    door, bar = board((-0.5, -0.47, 0.0), (0.5, -0.4, 0.775)), board((-0.4, -0.53, 0.68), (0.4, -0.47, 0.72))
    walls = [board((x, -0.47, 0.0), (x + 0.05, 0.55, 1.1)) for x in (-0.56, 0.51)] if beside else []
    whole = merge_meshes([*COOKER, *walls, door, bar])
    (front,) = boxes(cut(whole), "front")
    assert bool(front[4] > 0.4) is beside, "between walls it may be a drawer"


def test_what_may_not_be_cut_stays_whole():
    whole = merge_meshes([mesh_of(name) for name in CABINET])

    assert cut(whole, open_to=[False]) == {}
    assert cut(merge_meshes(CASE)) == {}, "a case without fronts"


def test_two_doors_in_one_object_become_two_and_a_panel_beside_one_stays():
    left, right = board((-0.4, -0.22, 0), (-0.001, -0.2, 1)), board((0.001, -0.22, 0), (0.4, -0.2, 1))
    narrow = board((0.201, -0.22, 0), (0.4, -0.2, 1))
    wide = board((-0.4, -0.22, 0), (0.199, -0.2, 1))
    case = merge_meshes(CASE)

    assert boxes(cut(case, merge_meshes([left, right]), moving=[False, True]), "front") == rounded([left, right])
    assert boxes(cut(case, merge_meshes([wide, narrow])), "front")[0] == rounded([wide])[0]
    assert cut(case, merge_meshes([wide, narrow.translated(np.array([0, 0.3, 0]))]), moving=[False, True]) == {}


def test_a_pane_in_the_rails_of_an_object_is_no_front_beside_a_panel():
    """Stiles and rails as deep as the door overlap at its corners: no frame in the sense of a joiner."""
    stiles = [board((x, -0.24, 0.0), (x + 0.1, -0.2, 0.9)) for x in (-0.38, 0.28)]
    rails = [board((-0.38, -0.24, z), (0.38, -0.2, z + 0.12)) for z in (0.0, 0.78)]
    pane = board((-0.3, -0.26, 0.11), (0.3, -0.245, 0.79))
    door = merge_meshes([*stiles, *rails, pane])

    assert cut(merge_meshes(CASE), door) == {}


@pytest.mark.parametrize(("width", "is_apron"), [(0.2, True), (0.45, False)])
def test_a_narrow_front_on_a_board_is_a_drawer_in_an_apron_and_a_wide_one_the_panel_of_a_front(width, is_apron):
    legs = [board((x, y, 0.0), (x + 0.06, y + 0.06, 0.45)) for x in (-0.5, 0.44) for y in (-0.3, 0.24)]
    aprons = [board((-0.44, y, 0.33), (0.44, y + 0.02, 0.45)) for y in (-0.29, 0.27)]
    ends = [board((x, -0.27, 0.33), (x + 0.02, 0.27, 0.45)) for x in (-0.46, 0.44)]
    front, sides = board((-width, -0.31, 0.34), (width, -0.29, 0.44)), (-width + 0.01, width - 0.02)
    boards = [board((x, -0.27, 0.35), (x + 0.01, 0.1, 0.42)) for x in sides]
    whole = merge_meshes([*legs, *aprons, *ends, front, *boards, board((-0.55, -0.35, 0.45), (0.55, 0.35, 0.48))])

    plate = front if is_apron else merge_meshes([aprons[0], front, *boards])
    assert rounded([plate])[0] in boxes(cut(whole), "front")


@pytest.mark.parametrize("has_knob", [True, False])
def test_a_solid_drawer_before_legs_is_known_by_its_knob(has_knob):
    legs = [board((x, y, 0.0), (x + 0.08, y + 0.08, 0.5)) for x in (-0.45, 0.37) for y in (-0.35, 0.27)]
    top, shelf = board((-0.5, -0.4, 0.5), (0.5, 0.4, 0.55)), board((-0.5, -0.4, 0.1), (0.5, 0.4, 0.13))
    drawer = board((-0.42, -0.42, 0.34), (0.42, 0.3, 0.49))
    knob = [board((-0.04, -0.5, 0.37), (0.04, -0.42, 0.45))] if has_knob else []

    fronts = boxes(cut(merge_meshes([*legs, top, shelf, drawer, *knob])), "front")
    assert fronts == (rounded([drawer]) if has_knob else [])


@pytest.mark.parametrize(
    ("strip", "has_knob", "is_one"),
    [
        ((0.25, 0.4), False, True),
        ((0.25, 0.4), True, False),  # it has a handle of its own
        ((0.253, 0.4), False, False),  # there is a gap
        ((0.1, 0.4), False, False),  # it is no strip
    ],
)
def test_a_stile_drawn_beside_the_plate_of_a_drawer_is_part_of_its_front(strip, has_knob, is_one):
    left, right = strip
    end = left if left < 0.25 else 0.25
    plates = [board((x, -0.22, 0.02), (y, -0.2, 0.48)) for x, y in ((-0.4, end), (left, right))]
    upper = board((-0.4, -0.22, 0.52), (0.4, -0.2, 0.98))
    knobs = [board((x, -0.25, z), (x + 0.02, -0.22, z + 0.02)) for x, z in ((-0.05, 0.25), (-0.05, 0.75))]
    knobs += [board(((left + right) / 2, -0.25, 0.3), ((left + right) / 2 + 0.02, -0.22, 0.32))] if has_knob else []
    found = cut(merge_meshes([*CASE, *plates, upper, *knobs]))

    assert boxes(found, "front") == rounded([merge_meshes(plates), upper] if is_one else [*plates, upper])


def test_bar_and_posts_of_one_handle_are_one_piece_and_panes_go_with_their_frame():
    bar = board((-0.1, -0.25, 0.5), (0.1, -0.24, 0.51))
    posts = [board((x, -0.24, 0.5), (x + 0.01, -0.2, 0.51)) for x in (-0.09, 0.08)]
    stiles = [board((x, -0.2, 0.0), (x + 0.08, -0.18, 0.98)) for x in (-0.38, 0.3)]
    rails = [board((-0.3, -0.2, z), (0.3, -0.18, z + 0.08)) for z in (0.0, 0.9)]
    pane = board((-0.31, -0.192, 0.07), (0.31, -0.188, 0.91))
    whole = merge_meshes([*CASE, *stiles, *rails, pane, *posts, bar])
    found = cut(whole)

    assert boxes(found, "front") == rounded([merge_meshes([*stiles, *rails, pane])])
    handles = [m.translated(np.array([0.34, 0, 0])) for m in (*posts, bar)]
    found = cut(merge_meshes([*CASE, *stiles, *rails, pane, *handles]))
    assert boxes(found, "handle") == rounded([merge_meshes(handles)])


def test_inset_fronts_leave_their_face_frame_behind():
    stiles = [board((x, -0.2, 0.0), (x + 0.04, -0.18, 0.98)) for x in (-0.4, -0.02, 0.36)]
    rails = [board((x, -0.2, z), (x + 0.34, -0.18, z + 0.04)) for x in (-0.36, 0.02) for z in (0.0, 0.94)]
    doors = [board((x, -0.2, 0.042), (x + 0.336, -0.182, 0.938)) for x in (-0.358, 0.022)]
    found = cut(merge_meshes([*CASE, *stiles, *rails, *doors]))

    assert boxes(found, "front") == rounded(doors)


PLATE = board((-0.38, -0.22, 0.02), (0.38, -0.2, 0.96))
BAR = board((0.3, -0.26, 0.4), (0.32, -0.22, 0.6))


def roles(found, number):
    return [role for role, _ in found[number]]


@pytest.mark.parametrize("is_named", [True, False], ids=["called a door", "without a name"])
def test_a_handle_drawn_in_a_front_becomes_a_part_and_the_front_stays_one(is_named):
    found = cut(merge_meshes(CASE), merge_meshes([PLATE, BAR]), moving=[False, is_named])

    assert list(found) == [1]
    assert roles(found, 1) == ["body", "handle"]
    assert boxes(found, "body") == rounded([PLATE])
    assert boxes(found, "handle") == rounded([BAR])


def sheet(xs, zs, depth, raised=()):
    """A sheet of cells at y = depth(x), those that are `raised` drawn out to y = -0.26; and which faces these have."""
    corners, is_raised = [], []
    for i, j in np.ndindex(len(xs) - 1, len(zs) - 1):
        (x0, x1), (z0, z1) = xs[i : i + 2], zs[j : j + 2]
        ring = [np.array([x, depth(x), z]) for x, z in ((x0, z0), (x1, z0), (x1, z1), (x0, z1))]
        out = [np.array([p[0], -0.26, p[2]]) for p in ring]
        cells = [ring] if (i, j) not in raised else [out]
        if (i, j) in raised:
            cells += [[ring[k], ring[(k + 1) % 4], out[(k + 1) % 4], out[k]] for k in range(4)]
        for a, b, c, d in cells:
            corners += [a, b, c, a, c, d]
            is_raised += 2 * [(i, j) in raised]
    points = np.array(corners)
    return TriangleMesh(points, np.arange(len(points)).reshape(-1, 3)), np.array(is_raised, dtype=np.int64)


def test_a_handle_welded_to_its_front_is_known_by_its_material():
    case = merge_meshes(CASE)
    door, material = sheet([-0.38, 0.3, 0.32, 0.38], [0.02, 0.4, 0.6, 0.96], lambda _: -0.22, raised=[(1, 1)])
    assert shell_numbers(door).max() == 0

    one = [np.zeros(len(case.faces), np.int64)]
    found = divided([case, door], [True, True], [False, True], [*one, material])
    plain = divided([case, door], [True, True], [False, True], [*one, np.zeros_like(material)])

    assert {k: [piece.role for piece in pieces] for k, pieces in found.items()} == {1: ["body", "handle"]}
    assert found[1][1].faces.tolist() == np.flatnonzero(material).tolist()
    assert plain == {}


def test_a_front_with_many_pieces_on_it_keeps_them():
    slats = [board((-0.3, -0.23, z), (0.3, -0.22, z + 0.01)) for z in (0.2, 0.4, 0.6, 0.8)]

    assert cut(merge_meshes(CASE), merge_meshes([PLATE, *slats]), moving=[False, True]) == {}


def test_a_handle_on_a_curved_front_stands_out_of_the_front_beside_it():
    front, _ = sheet(np.linspace(-0.38, 0.38, 17), [0.02, 0.96], lambda x: -0.21 - 0.1 * np.cos(np.pi * x / 0.76))
    bar = board((0.34, -0.28, 0.4), (0.36, -0.235, 0.6))
    assert bar.box.low[1] > front.box.low[1] + 0.02, "it lies behind the front's middle"

    found = cut(merge_meshes(CASE), merge_meshes([front, bar]), moving=[False, True])

    assert boxes(found, "handle") == rounded([bar])


@pytest.mark.filterwarnings("error")
def test_a_speck_at_the_very_border_is_seen_by_the_last_ray():
    plate = board((0.0, -0.21001, 0.9797), (0.0003, -0.21, 0.98))
    behind = board((0.0, -0.2099, 0.9797), (0.0003, -0.2095, 0.98))

    assert cut(merge_meshes(CASE), merge_meshes([plate, behind])) == {}


def test_marks_printed_on_a_front_are_no_handles():
    mark = board((-0.05, -0.2225, 0.8), (0.05, -0.2224, 0.85))
    found = cut(merge_meshes(CASE), merge_meshes([PLATE, BAR, mark]), moving=[False, True])

    assert boxes(found, "handle") == rounded([BAR])


def test_a_cabinet_of_very_many_faces_looks_as_one_of_few():
    """Faces between the rays are not traced; what a ray meets, and how far off, stays the same."""
    looks = []
    for times in (0, 6):
        meshes = [finely(mesh, times) for mesh in CASE]
        shells = np.repeat(np.arange(len(meshes)), [len(mesh.faces) for mesh in meshes])
        view = MeshShells.of(meshes).sorted(shells, np.arange(len(meshes))).seen(axes_from(0))
        looks.append((view.seen, view.depth, sum(len(mesh.faces) for mesh in meshes)))

    assert looks[1][2] > 100_000
    np.testing.assert_array_equal(looks[0][0], looks[1][0])
    np.testing.assert_allclose(looks[0][1], looks[1][1], atol=1e-5)


LOW_TABLE = [
    board((-0.75, -0.40, 0.72), (0.75, 0.40, 0.75)),
    *(board((x, y, 0.0), (x + 0.05, y + 0.05, 0.72)) for x in (-0.74, 0.69) for y in (-0.39, 0.34)),
    board((-0.69, 0.30, 0.62), (0.69, 0.32, 0.72)),
    board((-0.025, -0.385, 0.645), (0.025, 0.30, 0.715)),
]
LOW_FRONTS = [board((x, -0.39, 0.65), (x + 0.63, -0.37, 0.71)) for x in (-0.67, 0.04)]


@pytest.mark.parametrize("knobs", [2, 1, 0])
def test_low_drawers_of_a_table_are_cut_out_where_a_handle_stands_on_them(knobs):
    """Rails of a face frame are as low, and have none."""
    handles = [board((x, -0.42, 0.67), (x + 0.04, -0.39, 0.69)) for x in (-0.375, 0.335)][:knobs]
    found = cut(merge_meshes([*LOW_TABLE, *LOW_FRONTS, *handles]))

    fronts = [box for role, box in found.get(0, []) if role == "front"]
    assert len(fronts) == knobs
    for box, mesh in zip(sorted(fronts, key=lambda box: box.low[0]), LOW_FRONTS[:knobs], strict=True):
        np.testing.assert_allclose([box.low, box.high], [mesh.box.low, mesh.box.high], atol=1e-9)
    assert [role for role, _ in found.get(0, [])].count("handle") == knobs


@pytest.mark.parametrize(("is_held", "count"), [(True, 3), (False, 2)])
def test_a_low_drawer_of_one_piece_of_a_wide_row_is_compared_with_that_piece(is_held, count):
    """It is lower than 2 % of the row, as a rail is, and has a knob, which is another object."""
    case = [board((x, 0.02, 0), (x + 0.02, 0.4, 0.8)) for x in (0.0, 0.42, 0.86, 1.28)]
    case += [board((0, 0.0, 0.8), (1.3, 0.4, 0.82)), board((0, 0.38, 0), (1.3, 0.4, 0.8))]
    doors = [board((x, 0.0, 0.01), (x + 0.43, 0.015, 0.79)) for x in (0.0, 0.87)]
    drawer = board((0.445, 0.0, 0.745), (0.855, 0.36, 0.795))
    knob = board((0.64, -0.02, 0.762), (0.66, 0.0, 0.778))
    wall = board((1.4, 0.0, 0.0), (3.4, 0.4, 2.0))
    others = [wall, knob] if is_held else [wall]
    found = cut(merge_meshes([*case, *doors, drawer]), *others, open_to=[True] + [False] * len(others))
    assert [role for role, _ in found[0]].count("front") == count


@pytest.mark.parametrize(("height", "count"), [(0.09, 6), (0.06, 0)])
def test_flat_drawers_for_plans_are_cut_out_where_a_handle_stands_on_them(height, count):
    """They are more than twelve times as wide as high; rails and mouldings are flatter, whatever stands on them."""
    body, levels = board((-0.6, 0.0, 0.0), (0.6, 0.8, 0.7)), [0.05 + 0.1 * k for k in range(6)]
    fronts = [board((-0.58, -0.018, z), (0.58, 0.0, z + height)) for z in levels]
    pulls = [board((-0.05, -0.04, z + 0.03), (0.05, -0.018, z + 0.05)) for z in levels]
    found = cut(merge_meshes([body, *fronts, *pulls]))
    assert len(boxes(found, "front")) == count
    assert cut(merge_meshes([body, *fronts])) == {}, "no handle tells that these are no boards"


def test_a_low_upright_strip_with_a_knob_is_no_drawer():
    stile = board((-0.67, -0.39, 0.05), (-0.61, -0.37, 0.70))
    knob = board((-0.65, -0.42, 0.4), (-0.63, -0.39, 0.42))

    assert cut(merge_meshes([*LOW_TABLE, stile, knob])) == {}


# A chest whose two fronts are shells of one object, 0.9 x 0.4 x 0.5 m, its front at y = 0.
CHEST = [
    board((-0.45, 0.0, 0.0), (-0.43, 0.4, 0.5)),
    board((0.43, 0.0, 0.0), (0.45, 0.4, 0.5)),
    board((-0.43, 0.38, 0.0), (0.43, 0.4, 0.5)),
    board((-0.43, 0.0, 0.48), (0.43, 0.38, 0.5)),
    board((-0.43, 0.0, 0.0), (0.43, 0.38, 0.02)),
]
STACK = [board((-0.42, -0.02, z), (0.42, 0.0, z + 0.21)) for z in (0.03, 0.26)]
PLATES = [board((x, -0.026, z + 0.09), (x + 0.05, -0.02, z + 0.12)) for x in (-0.3, 0.25) for z in (0.03, 0.26)]
FEET = [board((x, 0.1, -0.05), (x + 0.05, 0.15, 0.0)) for x in (-0.4, 0.35)]


@pytest.mark.parametrize("others", [[], FEET], ids=["alone", "with feet"])
def test_what_lies_on_fronts_of_another_object_is_parted_by_them(others):
    found = cut(merge_meshes([*CHEST, *STACK]), merge_meshes([*PLATES, *others]))

    assert boxes({0: found[0]}, "front") == rounded(STACK)
    lying = [(round(box.low[2], 4), round(box.high[2], 4)) for role, box in found[1] if role == "on front"]
    assert sorted(lying) == [(0.12, 0.15), (0.35, 0.38)]
    assert [role for role, _ in found[1]].count("rest") == bool(others)


@pytest.mark.parametrize("wide", [0.12, 0.3])
def test_a_drawer_that_stands_before_a_front_of_another_object_stays_whole(wide):
    front, knob = board((-wide, -0.04, 0.06), (wide, -0.02, 0.2)), board((-0.02, -0.06, 0.12), (0.02, -0.04, 0.14))
    sides = [board((x, -0.02, 0.08), (x + 0.01, 0.35, 0.18)) for x in (-wide + 0.01, wide - 0.02)]
    ends = [board((-wide + 0.02, y, 0.08), (wide - 0.02, y + 0.01, 0.18)) for y in (0.0, 0.34)]
    found = cut(merge_meshes([*CHEST, *STACK]), merge_meshes([front, knob, *sides, *ends]))

    assert boxes({0: found[0]}, "front") == rounded(STACK)
    assert not [role for role, _ in found.get(1, []) if role in ("on front", "rest")]


def test_a_handle_on_the_only_door_is_parted_from_the_case_that_it_is_one_object_with():
    door, bar = board((-0.42, -0.02, 0.03), (0.42, 0.0, 0.47)), board((0.36, -0.05, 0.2), (0.38, -0.02, 0.3))
    through = board((0.36, -0.02, 0.2), (0.38, 0.05, 0.3))  # reaches the face from behind, as a bolt: it is no handle

    found = cut(merge_meshes([*CHEST, bar]), door)
    assert boxes(found, "on front") == rounded([bar])
    assert [role for role, _ in found[0]].count("rest") == 1
    assert cut(merge_meshes([*CHEST, through]), door) == {}


UNITS = [
    *(board((x, 0.0, 0.0), (x + 0.02, 0.4, 0.5)) for x in (-0.45, -0.01, 0.43)),
    *(board((-0.43, 0.0, z), (0.43, 0.4, z + 0.02)) for z in (0.0, 0.48)),
    *(board((x, 0.401, 0.01), (x + 0.42, 0.406, 0.49)) for x in (-0.44, 0.02)),  # their backs, seen from behind
]
LEAVES = [board((x, -0.02, 0.0), (x + 0.44, 0.0, 0.5)) for x in (-0.45, 0.01)]


@pytest.mark.parametrize("bars", [2, 0])
def test_handles_of_several_fronts_show_that_the_backs_of_units_are_none(bars):
    """All handles are one object, and all boards of the case another; without any, what is cut is of no account."""
    handles = [board((x, -0.05, 0.2), (x + 0.02, -0.02, 0.3)) for x in (-0.06, 0.04)][:bars]
    found = cut(merge_meshes(UNITS), *LEAVES, *([merge_meshes(handles)] if bars else []))
    assert boxes(found, "on front") == rounded(handles)
    assert len(boxes(found, "front")) == (0 if bars else 2)


def test_what_lies_on_one_front_alone_stays_whole():
    lower = [plate for plate in PLATES if plate.box.low[2] < 0.2]
    assert set(cut(merge_meshes([*CHEST, *STACK]), merge_meshes(lower))) == {0}


HALVES = [board((x, -0.02, 0.03), (x + 0.42, 0.0, 0.24)) for x in (-0.42, 0.0)]


def test_two_mirrored_halves_with_a_plate_across_their_seam_are_one_front():
    across = board((-0.03, -0.026, 0.12), (0.03, -0.02, 0.15))
    found = cut(merge_meshes([*CHEST, STACK[1], *HALVES]), across)
    assert boxes(found, "front") == rounded(STACK)


def test_two_doors_that_meet_with_a_handle_each_stay_two():
    handles = [board((x, -0.05, 0.1), (x + 0.02, -0.02, 0.17)) for x in (-0.05, 0.03)]
    found = cut(merge_meshes([*CHEST, STACK[1], *HALVES, *handles]))
    assert len(boxes(found, "front")) == 3


def test_a_sheet_seen_from_its_edge_is_no_handle():
    corners = [[0.1, y, z] for y, z in ((-0.05, 0.05), (0.0, 0.05), (0.0, 0.2), (-0.05, 0.2))]
    sheet = TriangleMesh(np.array(corners), np.array([[0, 1, 2], [0, 2, 3]]))
    found = cut(merge_meshes([*CHEST, *STACK, sheet]))
    assert boxes(found, "handle") == []


@pytest.mark.parametrize(
    ("width", "out", "role"), [(0.83, 0.002, "front"), (0.83, 0.03, "handle"), (0.6, 0.003, "handle")]
)
def test_a_strip_along_a_whole_border_is_a_moulding_and_goes_with_its_front(width, out, role):
    strip = board((-width / 2, -0.02 - out, 0.04), (width / 2, -0.02, 0.05))
    found = cut(merge_meshes([*CHEST, *STACK, strip]))
    inside = [r for r, box in found[0] if box.contains(strip.box.corners()).all() and r != "rest"]
    assert inside == [role]


# A desk's pedestal, one body with three inset fronts, and a knob on each that is another object's.
PEDESTAL = board((0.0, -0.3, 0.0), (0.5, 0.3, 0.7))
INSET = [board((0.05, -0.303, z), (0.45, -0.28, z + 0.17)) for z in (0.14, 0.32, 0.5)]
DESK = [board((-0.7, -0.32, 0.7), (0.52, 0.32, 0.74)), board((-0.68, -0.3, 0.0), (-0.63, 0.3, 0.7)), PEDESTAL]
KNOBS = [board((0.24, -0.34, z), (0.26, -0.303, z + 0.02)) for z in (0.22, 0.4, 0.58)]


def test_inset_fronts_of_a_body_are_the_fronts_and_not_the_body():
    found = cut(merge_meshes([*DESK, *INSET]), merge_meshes(KNOBS))
    assert boxes(found, "front") == rounded(INSET)
    assert boxes(found, "on front") == rounded(KNOBS)

    alone = divided([merge_meshes([*DESK, *INSET]), merge_meshes(KNOBS)], [True, False], [False] * 2)
    assert set(alone) == {0}, "handles that may not be parted"
    parted = divided(
        [merge_meshes([*DESK, *INSET]), merge_meshes(KNOBS)], [True, False], [False] * 2, lying=[False, True]
    )
    assert [piece.role for piece in parted[1]] == ["on front"] * 3


@pytest.mark.parametrize("has_knob", [True, False])
def test_drawers_behind_the_edge_of_a_desk_are_known_by_the_handles_of_another_object(has_knob):
    fronts = [board((x, 0.2, 0.75), (x + 0.3, 0.21, 0.85)) for x in (-0.6, 0.2)]
    boards = [board((x, 0.2, 0.74), (x + 0.01, 0.31, 0.86)) for x in (-0.61, -0.3, 0.19, 0.5)]
    gallery = merge_meshes(
        [board((-0.62, 0.2, 0.86), (0.51, 0.31, 0.88)), board((-0.62, 0.31, 0.74), (0.51, 0.32, 0.88))]
    )
    knobs = [board((x, 0.17, 0.79), (x + 0.02, 0.2, 0.81)) for x in (-0.46, 0.34)]
    others = [merge_meshes(knobs)] if has_knob else [board((0, 0.25, 0.9), (0.1, 0.3, 1.0))]

    found = boxes(cut(merge_meshes([*DESK, *fronts, *boards, gallery]), *others), "front")
    assert all(one in found for one in rounded(fronts)) == has_knob


def test_handles_on_fronts_that_are_objects_of_their_own_are_parted_by_these():
    stiles = board((-0.5, 0.0, 0.0), (-0.4, 0.02, 0.5))
    found = cut(merge_meshes(CHEST), *STACK, merge_meshes(PLATES))
    assert [role for role, _ in found[3]] == ["on front", "on front"]

    large = [board((-0.4, -0.03, z), (0.4, -0.02, z + 0.19)) for z in (0.04, 0.27)]
    assert cut(merge_meshes(CHEST), *STACK, merge_meshes([*large, stiles])).keys() <= {3}, "no handles"


@pytest.fixture
def traced(monkeypatch):
    """How many rays each grid that was traced has."""
    counts, first_faces = [], RayCaster.first_faces
    monkeypatch.setattr(RayCaster, "first_faces", lambda *given: counts.append(len(given[1])) or first_faces(*given))
    return counts


def test_no_ray_is_traced_where_no_shell_could_be_a_front(traced):
    legs = [board((x, y, 0.0), (x + 0.05, y + 0.05, 0.7)) for x in (0.0, 0.9) for y in (0.0, 0.5)]

    assert cut(merge_meshes(legs)) == {}
    assert traced == []


def test_a_side_is_traced_once_however_its_shells_are_parted(traced):
    meshes = [part.mesh for part in dresser().parts]
    moving = [part.label.is_movable for part in dresser().parts]
    two = [np.arange(len(mesh.faces)) % 2 for mesh in meshes]

    assert divided(meshes, moving, moving, two) == {}
    assert len(traced) == 4


@pytest.mark.parametrize("is_whole", [True, False], ids=["called a door", "without a name"])
@pytest.mark.parametrize(
    ("battens", "fronts"),
    [
        ([((0.02, 0.58), 0.2), ((0.02, 0.58), 0.9)], 0),
        ([], 2),
        ([((0.02, 0.28), 0.2), ((0.02, 0.28), 0.9), ((0.32, 0.58), 0.2), ((0.32, 0.58), 0.9)], 2),
    ],
    ids=["battens across both", "none", "battens on each"],
)
def test_boards_that_battens_hold_together_are_one_leaf(battens, fronts, is_whole):
    """Two boards of a plank door stay together; two leaves beside each other do not, whatever lies on each."""
    leaves = [board((x, 0.0, 0.0), (x + 0.297, 0.014, 1.2)) for x in (0.0, 0.303)]
    strips = [board((a, -0.006, z), (b, 0.0, z + 0.07)) for (a, b), z in battens]
    case = [board((-0.02, 0.014, -0.02), (0.62, 0.4, 0.0)), board((-0.02, 0.4, 0.0), (0.62, 0.41, 1.22))]
    found = cut(merge_meshes([*leaves, *strips]), *case, moving=[is_whole, False, False])
    assert len(boxes({k: p for k, p in found.items() if k == 0}, "front")) == fronts
