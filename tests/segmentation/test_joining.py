"""Objects without names are joined where they are one door, drawer or handle; what is static stays out."""

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.joining import joined_objects
from small_assets import CABINET, DOOR, DRAWER, mesh_of

CASE = [mesh_of(name) for name in CABINET if name not in (*DOOR, *DRAWER)]
FRONT = ((-0.39, -0.20, 0.63), (0.39, -0.18, 0.97))
BOARDS = {
    "left": ((-0.37, -0.18, 0.65), (-0.36, 0.15, 0.90)),
    "right": ((0.36, -0.18, 0.65), (0.37, 0.15, 0.90)),
    "bottom": ((-0.37, -0.18, 0.64), (0.37, 0.15, 0.65)),
    "back": ((-0.36, 0.14, 0.65), (0.36, 0.15, 0.90)),
}
BAR = ((-0.1, -0.25, 0.80), (0.1, -0.24, 0.81))
POSTS = (((-0.09, -0.24, 0.80), (-0.08, -0.20, 0.81)), ((0.08, -0.24, 0.80), (0.09, -0.20, 0.81)))


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def groups(*fragments, case=CASE, may=None):
    """The groups of fragments, by their numbers, that stand in a case."""
    meshes = [*(board(*f) for f in fragments), *case]
    found = joined_objects(meshes, may or [True] * len(meshes))
    return sorted(tuple(sorted(group)) for group in found)


def test_the_boards_of_a_drawer_and_the_pieces_of_its_handle_are_joined():
    assert groups(FRONT, *BOARDS.values(), BAR, *POSTS) == [(0, 1, 2, 3, 4), (5, 6, 7)]


def test_bar_and_posts_before_a_front_of_several_shells_are_one_handle():
    stiles = [board((x, -0.2, 0.0), (x + 0.08, -0.18, 0.98)) for x in (-0.38, 0.3)]
    pane = board((-0.31, -0.2, 0.3), (0.31, -0.19, 0.6))
    rails = [board((-0.38, -0.2, z), (0.38, -0.18, z + 0.3)) for z in (0.0, 0.6)]
    hinge = board((-0.4, -0.19, -0.02), (0.4, -0.18, 0.01))
    door = merge_meshes([*stiles, *rails, pane, hinge])
    assert [
        set(group)
        for group in joined_objects([door, *(board(*f) for f in (BAR, *POSTS)), *CASE], [True] * (4 + len(CASE)))
    ] == [{1, 2, 3}]


def quad(x, z):
    """A sheet without thickness, as faces drawn one beside the other are."""
    corners = [[x[a], -0.21, z[b]] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return TriangleMesh(np.array(corners), np.array([[0, 1, 2], [0, 2, 3]]))


def test_a_face_frame_with_two_fronts_in_it_is_none():
    """Sheets that share their edges are one plate, two drawers and the rails around them; each drawer has a handle."""
    heights = (0.0, 0.02, 0.96, 0.98)
    sheets = [quad((x, x + 0.38), heights[k : k + 2]) for x in (-0.38, 0.0) for k in range(3)]
    bars = [board((x, -0.24, 0.5), (x + 0.1, -0.21, 0.52)) for x in (-0.24, 0.14)]
    with_one_handle = joined_objects([*sheets, bars[0], *CASE], [True] * (7 + len(CASE)))

    assert [set(group) for group in with_one_handle] == [set(range(6))]
    assert joined_objects([*sheets, *bars, *CASE], [True] * (8 + len(CASE))) == []


def test_stiles_rails_and_panes_are_one_door_also_with_a_muntin_across():
    stiles = [((x, -0.2, 0.0), (x + 0.08, -0.18, 0.98)) for x in (-0.38, 0.3)]
    rails = [((-0.3, -0.2, z), (0.3, -0.18, z + 0.08)) for z in (0.0, 0.45, 0.9)]
    panes = [((-0.31, -0.192, z), (0.31, -0.188, z + 0.39)) for z in (0.07, 0.52)]

    assert groups(*stiles, rails[0], rails[2], ((-0.31, -0.192, 0.07), (0.31, -0.188, 0.91))) == [(0, 1, 2, 3, 4)]
    assert groups(*stiles, *rails, *panes) == [(0, 1, 2, 3, 4, 5, 6)]


@pytest.mark.parametrize(("reach", "is_panel"), [(0.015, True), (-0.002, False)])
def test_a_raised_panel_that_is_flush_with_its_frame_reaches_into_it(reach, is_panel):
    """An inset front, as thick as the frame, lies in it with gaps."""
    stiles = [((x, -0.2, 0.0), (x + 0.08, -0.18, 0.98)) for x in (-0.38, 0.3)]
    rails = [((-0.3, -0.2, z), (0.3, -0.18, z + 0.08)) for z in (0.0, 0.9)]
    panel = ((-0.3 - reach, -0.2, 0.08 - reach), (0.3 + reach, -0.18, 0.9 + reach))

    assert groups(*stiles, *rails, panel) == ([(0, 1, 2, 3, 4)] if is_panel else [])


@pytest.mark.parametrize(
    "still",
    [
        [((-0.38, -0.18, 0.95), (0.38, -0.17, 0.97))],  # an edging behind the front, under the top
        [((-0.38, 0.1, 0.92), (-0.30, 0.18, 0.96))],  # a corner plate behind the drawer
        [((-0.38, -0.17, 0.70), (-0.37, 0.15, 0.72))],  # a runner between drawer and case
    ],
    ids=["edging", "corner plate", "runner"],
)
def test_what_hangs_on_the_case_is_not_joined_to_the_drawer_before_it(still):
    found = groups(FRONT, *BOARDS.values(), *still)

    assert found == [(0, 1, 2, 3, 4)]


def test_a_case_without_a_back_is_no_box_behind_its_door():
    """Sides, a shelf and a bottom behind one door lie as a drawer's boards do; the top lies on the sides."""
    door = ((-0.40, -0.20, 0.0), (0.40, -0.18, 0.98))
    case = [mesh_of(name) for name in CABINET if name not in (*DOOR, *DRAWER, "back_panel-5")]

    assert groups(door, case=case) == []


def test_what_holds_two_fronts_with_a_handle_each_is_their_case_and_no_drawer():
    """The top of a table with its apron, one object that its legs flank; fronts and boxes of two drawers are in it."""
    apron = [
        ((-0.7, y, z), (0.7, y + 0.01, z + h))
        for y, z, h in ((-0.4, 0.62, 0.04), (-0.4, 0.76, 0.04), (0.39, 0.62, 0.18))
    ]
    ends = [((x, -0.4, 0.62), (x + 0.08, 0.4, 0.8)) for x in (-0.7, 0.62)]
    top = merge_meshes([board(*ends) for ends in (((-0.75, -0.45, 0.8), (0.75, 0.45, 0.83)), *apron, *ends)])
    legs = [board((x, y, 0.0), (x + 0.06, y + 0.06, 0.79)) for x in (-0.7, 0.64) for y in (-0.4, 0.34)]
    fronts = [board((x, -0.4, 0.66), (x + 0.6, -0.38, 0.76)) for x in (-0.62, 0.02)]
    inner = [board((x + 0.02, -0.38, 0.67), (x + 0.58, 0.3, 0.75)) for x in (-0.62, 0.02)]
    bars = [board((x + 0.25, -0.43, 0.7), (x + 0.35, -0.4, 0.72)) for x in (-0.62, 0.02)]
    meshes = [top, *fronts, merge_meshes(legs), merge_meshes(inner), *bars]

    are_bars = [False] * 5 + [True] * 2
    assert joined_objects(meshes, [not is_bar for is_bar in are_bars], handles=are_bars) == []
    assert joined_objects(meshes, [not is_bar for is_bar in are_bars]) == [(0, 1, 2, 4)], "hinges tell nothing"


@pytest.mark.parametrize("is_known", [True, False], ids=["known as a handle", "not known"])
def test_a_wide_bar_that_stands_on_several_pieces_of_one_front_is_one_handle(is_known):
    """Nine sheets that share their edges, a framed door; the posts of its bar stand on the lower corners."""
    xs, zs = (-0.38, -0.28, 0.28, 0.38), (0.0, 0.1, 0.88, 0.98)
    pieces = [quad(xs[i : i + 2], zs[k : k + 2]) for i in range(3) for k in range(3)]
    posts = [board((x, -0.24, 0.05), (x + 0.01, -0.21, 0.06)) for x in (-0.33, 0.32)]
    bar = merge_meshes([board((-0.35, -0.25, 0.05), (0.35, -0.24, 0.06)), *posts])
    meshes = [*pieces, bar, *CASE]

    may = [True] * len(pieces) + [not is_known] + [True] * len(CASE)
    found = joined_objects(meshes, may, handles=[not one for one in may])
    assert [set(group) for group in found] == [set(range(len(pieces)))]


def test_objects_that_may_not_be_joined_are_not_and_never_all_are():
    fragments = [FRONT, *BOARDS.values()]
    closed = [True] * 5 + [False] * len(CASE)
    without_left = [True, False, *[True] * 3, *[False] * len(CASE)]

    assert groups(*fragments, case=[*CASE], may=[*closed[:-1], True]) == [(0, 1, 2, 3, 4)]
    assert all(1 not in group for group in groups(*fragments, may=without_left))
    assert groups(*fragments, case=[]) == []


def sheets(low, high, *missing) -> TriangleMesh:
    """A box of sheets without those that face along the axes that are named."""
    mesh = board(low, high)
    return mesh.with_faces(~(mesh.face_normals @ np.array(missing).T > 0.9).any(axis=1))


@pytest.mark.parametrize("may_case", [False, True])
def test_doors_that_meet_the_rim_of_their_case_at_its_corners_stay_apart(may_case):
    """Doors without a back, each along the whole edge of an opening in the face of a case of one object."""
    behind = (0.0, 1.0, 0.0)
    doors = [sheets((x, -0.02, 0.1), (x + 0.5, 0.0, 0.7), behind) for x in (0.05, 0.6, 1.15)]
    xs, zs = (0.0, 0.05, 0.55, 0.6, 1.1, 1.15, 1.65, 1.7), (0.0, 0.1, 0.7, 0.75)
    rim = [
        flat((xs[i], xs[i + 1]), (zs[k], zs[k + 1])) for i in range(7) for k in range(3) if k != 1 or i not in (1, 3, 5)
    ]
    case = merge_meshes([sheets((0.0, 0.0, 0.0), (1.7, 0.5, 0.75), (0.0, -1.0, 0.0)), *rim])
    foot = board((0.0, 0.0, -0.1), (0.05, 0.05, 0.0))
    assert joined_objects([*doors, foot, case], [True] * 4 + [may_case]) == []


def test_pieces_of_one_door_that_meet_at_corners_are_joined():
    leaf = sheets((0.0, -0.02, 0.1), (0.5, 0.0, 0.6), (0.0, 0.0, 1.0))
    strip = sheets((0.0, -0.02, 0.6), (0.5, 0.0, 0.7), (0.0, 0.0, -1.0))
    case = sheets((-0.05, 0.0, 0.0), (0.55, 0.5, 0.75), (0.0, -1.0, 0.0))
    assert [set(group) for group in joined_objects([leaf, strip, case], [True, True, False], has_name=True)] == [{0, 1}]


@pytest.mark.parametrize("is_carried", [True, False])
def test_a_front_and_what_is_behind_it_are_not_all_that_there_is(is_carried):
    """A flap with its bar, and a case behind it with faces drawn from both sides, are no drawer; in a case they are."""
    front, bar = board((-0.8, -0.32, 0.0), (0.8, -0.3, 0.6)), board((-0.2, -0.36, 0.1), (0.2, -0.32, 0.12))
    boards = [board((x, -0.3, 0.01), (x + 0.02, 0.2, 0.55)) for x in (-0.79, 0.77)]
    boards += [board((-0.77, -0.3, 0.01), (0.77, 0.2, 0.03)), board((-0.77, 0.18, 0.03), (0.77, 0.2, 0.55))]
    box = merge_meshes([TriangleMesh(one.vertices, np.vstack([one.faces, one.faces[:, ::-1]])) for one in boards])
    around = sheets((-0.82, -0.28, -0.02), (0.82, 0.25, 0.62), (0.0, -1.0, 0.0))
    meshes = [front, bar, box, *([around] if is_carried else [])]
    assert [set(group) for group in joined_objects(meshes, [True] * len(meshes))] == ([{0, 2}] if is_carried else [])


def flat(x, z):
    corners = np.array([[x[0], 0.0, z[0]], [x[1], 0.0, z[0]], [x[1], 0.0, z[1]], [x[0], 0.0, z[1]]])
    return TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))
