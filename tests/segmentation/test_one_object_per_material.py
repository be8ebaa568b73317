"""Furniture with one object for each material: fronts, handles and boxes of drawers are told apart, others stay."""

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.division import divided


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def cut(*meshes):
    """What the meshes are cut into: by number, the role and the box of each piece."""
    found = divided(meshes, [True] * len(meshes), [False] * len(meshes))
    return {k: [(p.role, meshes[k].with_faces(p.faces).box) for p in pieces] for k, pieces in found.items()}


def boxes(pieces, role):
    return sorted((*np.round(b.low, 4), *np.round(b.high, 4)) for r, b in pieces if r == role)


def rounded(meshes):
    return sorted((*np.round(m.box.low, 4), *np.round(m.box.high, 4)) for m in meshes)


def shell_of(width, height, depth=0.4, left=0.0, bottom=0.0):
    """The boards of a case that is open at -Y."""
    right, top = left + width, bottom + height
    return [
        board((left, 0.0, bottom), (left + 0.02, depth, top)),
        board((right - 0.02, 0.0, bottom), (right, depth, top)),
        board((left + 0.02, depth - 0.02, bottom), (right - 0.02, depth, top)),
        board((left + 0.02, 0.0, top - 0.02), (right - 0.02, depth - 0.02, top)),
        board((left + 0.02, 0.0, bottom), (right - 0.02, depth - 0.02, bottom + 0.02)),
    ]


# A desk 1.5 m wide: two pedestals with three drawers each, whose fronts are one object.
DESK = [
    *shell_of(0.4, 0.6, 0.5),
    *shell_of(0.4, 0.6, 0.5, left=1.1),
    board((-0.02, -0.05, 0.6), (1.52, 0.55, 0.64)),
]
FRONTS = [
    board((x, -0.02, z), (x + 0.4, 0.0, z + 0.19)) for x in (0.0, 1.1) for z in (0.005, 0.2, 0.395)
]  # they fill half of their outline


def test_fronts_of_two_pedestals_that_are_one_object_are_told_apart():
    found = cut(merge_meshes(DESK), merge_meshes(FRONTS))

    assert boxes(found[1], "front") == rounded(FRONTS)
    assert 0 not in found


def test_fronts_with_something_else_in_their_object_that_fills_less_than_they_do_stay():
    rail = board((0.4, -0.02, 0.56), (1.1, 0.0, 0.59))
    assert not boxes(cut(merge_meshes(DESK), merge_meshes([*FRONTS, rail])).get(1, []), "front")


@pytest.mark.parametrize("has_handles", [True, False])
def test_fronts_of_very_different_sizes_are_told_apart_where_a_handle_stands_on_each(has_handles):
    """A deep drawer below small ones in pairs, all fronts in one object; without handles they are a panelled door."""
    fronts = [board((0.0, -0.02, 0.0), (0.9, 0.0, 0.17))]
    fronts += [board((x, -0.02, z), (x + 0.44, 0.0, z + 0.07)) for x in (0.0, 0.46) for z in (0.18, 0.26, 0.34, 0.42)]
    middles = [(front.box.low + front.box.high) / 2 for front in fronts]
    bars = [board((x - 0.05, -0.04, z - 0.005), (x + 0.05, -0.02, z + 0.005)) for x, _, z in middles]
    bars = bars if has_handles else [board((0.3, 0.1, 0.6), (0.4, 0.2, 0.7))]
    found = cut(merge_meshes(shell_of(0.9, 0.5)), merge_meshes(fronts), merge_meshes(bars))
    assert boxes(found.get(1, []), "front") == (rounded(fronts) if has_handles else [])


def test_plates_of_handles_are_no_fronts_though_they_are_all_of_their_object():
    plates = [
        board((x + 0.17, -0.026, z + 0.08), (x + 0.22, -0.02, z + 0.11)) for x in (0.0, 1.1) for z in (0.2, 0.395)
    ]
    found = cut(merge_meshes(DESK), merge_meshes(FRONTS), merge_meshes(plates))
    assert boxes(found[2], "on front") == rounded(plates)


CHEST = shell_of(0.9, 0.5)
LEAVES = [board((x, -0.008, 0.03), (x + 0.42, 0.0, 0.47)) for x in (0.03, 0.45)]  # they meet in a seam
STRIP_BEHIND = board((0.44, 0.0, 0.1), (0.46, 0.004, 0.3))
BARS = [board((x, -0.05, 0.2), (x + 0.01, -0.02, 0.3)) for x in (0.42, 0.47)]


def test_a_strip_right_behind_a_seam_does_not_make_two_doors_one():
    found = cut(merge_meshes([*CHEST, *LEAVES, STRIP_BEHIND]), merge_meshes(BARS))
    assert boxes(found[0], "front") == rounded(LEAVES)


def test_a_plate_in_a_seam_that_reaches_the_face_of_both_halves_makes_them_one():
    across = board((0.42, -0.022, 0.2), (0.48, -0.012, 0.25))
    found = cut(merge_meshes([*CHEST, *LEAVES]), across, board((0.8, 0.3, 0.6), (0.85, 0.35, 0.7)))
    assert len(boxes(found[0], "front")) == 1


def ring(low, high):
    """A box without top and bottom, as drawers are drawn whose bottom is a board of its own."""
    whole = board(low, high)
    corners = whole.vertices[whole.faces]
    is_level = np.ptp(corners[:, :, 2], axis=1) < 1e-9
    return whole.with_faces(~is_level)


@pytest.mark.parametrize("gap", [0.002, 0.05])
def test_the_bottom_of_a_drawer_close_above_a_lower_one_goes_with_its_own(gap):
    lower, upper = ring((0.03, -0.02, 0.03), (0.87, 0.36, 0.25)), ring((0.03, -0.02, 0.252), (0.87, 0.36, 0.47))
    bottoms = [board((0.05, 0.0, z), (0.85, 0.34, z + 0.003)) for z in (0.04, 0.252 + gap)]
    whole = merge_meshes([*CHEST, lower, upper, *bottoms])
    fronts = [whole.with_faces(p.faces) for p in divided([whole], [True], [False])[0] if p.role == "front"]
    held = {round(float(f.box.low[2]), 3): sorted(np.unique(f.vertices[f.faces][:, :, 2].round(4))) for f in fronts}
    assert held == {0.03: [0.03, 0.04, 0.043, 0.25], 0.252: sorted([0.252, 0.252 + gap, round(0.255 + gap, 4), 0.47])}


def test_hinges_in_the_object_of_the_handles_are_parted_from_these():
    hinges = [board((x, -0.03, z), (x + 0.03, -0.02, z + 0.05)) for x in (0.02, 0.85) for z in (0.08, 0.36)]
    found = cut(merge_meshes([*CHEST, *LEAVES]), merge_meshes([*BARS, *hinges]))

    groups = boxes(found[1], "on front")
    assert len(groups) == 4
    assert set(rounded(BARS)) <= set(groups)


def test_bar_and_posts_stay_together_also_where_hinges_are_drawn():
    posts = [board((x + 0.002, -0.03, z), (x + 0.008, -0.02, z + 0.01)) for x in (0.42, 0.47) for z in (0.21, 0.28)]
    bars = [board((x, -0.04, 0.2), (x + 0.01, -0.03, 0.3)) for x in (0.42, 0.47)]
    hinge = board((0.02, -0.03, 0.1), (0.05, -0.02, 0.15))
    found = cut(merge_meshes([*CHEST, *LEAVES]), merge_meshes([*bars, *posts, hinge]))
    assert boxes(found[1], "on front") == sorted(
        [*rounded(merge_meshes([b, *posts[2 * k : 2 * k + 2]]) for k, b in enumerate(bars)), *rounded([hinge])]
    )


STRIP = board((0.03, -0.02, 0.38), (0.87, 0.0, 0.48))
DOOR = board((0.03, -0.02, 0.03), (0.87, 0.0, 0.36))


@pytest.mark.parametrize("count", [5, 1])
def test_a_strip_with_a_row_of_knobs_of_another_object_is_a_panel_of_controls(count):
    knobs = [board((x, -0.05, 0.41), (x + 0.04, -0.02, 0.45)) for x in np.linspace(0.1, 0.8, 5)[:count]]
    bar = board((0.3, -0.05, 0.32), (0.6, -0.02, 0.34))
    found = cut(merge_meshes([*CHEST, STRIP, DOOR]), merge_meshes([*knobs, bar]))

    assert boxes(found[0], "front") == rounded([DOOR] if count > 3 else [DOOR, STRIP])


def test_knobs_of_two_sides_in_one_object_are_parted_where_one_front_is_found():
    """A cabinet that opens to the front and to the back: the other knob hangs together with nothing on the front."""
    desk = [board((-0.9, -0.1, 0.5), (0.95, 0.5, 0.53)), board((-0.9, 0.0, 0.0), (-0.85, 0.4, 0.5))]
    case = [*CHEST[:2], *CHEST[3:]]
    doors = [board((0.03, -0.02, 0.03), (0.87, 0.0, 0.47)), board((0.03, 0.4, 0.03), (0.87, 0.42, 0.47))]
    knobs = [board((0.1, -0.04, 0.4), (0.13, -0.02, 0.43)), board((0.1, 0.42, 0.4), (0.13, 0.44, 0.43))]
    found = cut(merge_meshes([*case, *desk]), merge_meshes(doors), merge_meshes(knobs))

    assert boxes(found[1], "front") == rounded(doors[:1])
    assert boxes(found[2], "on front") == rounded(knobs[:1])


def both_sides(mesh):
    """The mesh with each face drawn once more from behind, as modellers of surfaces export it."""
    return TriangleMesh(mesh.vertices, np.vstack([mesh.faces, mesh.faces[:, ::-1]]))


SINGLE = [board((0.02, -0.02, 0.02), (0.88, 0.0, 0.45)), board((0.4, -0.05, 0.2), (0.5, -0.02, 0.22))]


def tub(low, high, thick=0.01):
    """A box with walls and a bottom, open from above, as one shell."""
    outer = board(low, high)
    inner = board(np.add(low, thick), np.subtract(high, (thick, thick, 0.0)))
    count, top = len(outer.vertices), float(high[2]) - 1e-9
    at_top = np.flatnonzero(outer.vertices[:, 2] > top)
    middle = outer.vertices[at_top, :2].mean(axis=0)
    around = at_top[np.argsort(np.arctan2(*(outer.vertices[at_top, :2] - middle).T))]
    rim = [[a, b, b + count] for a, b in zip(around, np.roll(around, 1), strict=True)]
    rim += [[a, b + count, a + count] for a, b in zip(around, np.roll(around, 1), strict=True)]
    kept = outer.faces[outer.vertices[outer.faces][:, :, 2].min(axis=1) < top]
    return TriangleMesh(np.vstack([outer.vertices, inner.vertices]), np.vstack([kept, kept[:, ::-1] + count, rim]))


@pytest.mark.parametrize("is_double", [False, True])
def test_a_body_right_behind_a_front_goes_with_it_where_it_is_a_box_that_is_open_from_above(is_double):
    """A drawer's box goes with its front; a closed body does not, also where all faces are drawn from both sides."""
    ends = (0.06, 0.0, 0.04), (0.84, 0.3, 0.36)
    for body, is_open in ((tub(*ends), True), (board(*ends), False)):
        meshes = [*CHEST, *SINGLE[:1], body]
        whole = merge_meshes([both_sides(mesh) for mesh in meshes] if is_double else meshes)
        fronts = boxes(cut(whole, SINGLE[1])[0], "front")
        assert [round(front[4] - front[1], 2) for front in fronts] == [0.32 if is_open else 0.02], is_open


@pytest.mark.parametrize(("out", "goes"), [(-0.002, True), (0.005, False)])
def test_a_strip_behind_a_front_is_a_liner_unless_it_stands_out_of_its_outline(out, goes):
    """A stile of the case behind the edge of a door is as thin as a liner, but is broader than what the door covers."""
    strip = board((0.82, 0.0, 0.1), (0.88 + out, 0.02, 0.4))
    found = cut(merge_meshes([*CHEST, SINGLE[0], strip]), SINGLE[1])
    assert [round(front[4] - front[1], 2) for front in boxes(found[0], "front")] == [0.04 if goes else 0.02]


@pytest.mark.parametrize("plinth", [True, False])
def test_a_base_unit_without_a_top_is_the_case_of_its_door_also_with_a_plinth(plinth):
    """It stands out of the door below; what else is plate-like there is no second front beside which it is compared."""
    width, height = 0.5, 0.9
    unit = [*shell_of(width, height)[:3], shell_of(width, height)[4]]
    door = board((0.01, -0.02, 0.2), (0.49, 0.0, 0.89))
    feet = [board((0.01, 0.05, 0.0), (0.49, 0.06, 0.15))] if plinth else []
    bar = board((0.42, -0.05, 0.7), (0.44, -0.02, 0.8))
    found = cut(merge_meshes([*unit, door, *feet]), bar)
    assert rounded([door])[0] in boxes(found[0], "front")
