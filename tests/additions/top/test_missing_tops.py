"""Which furniture lacks a top."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry import Polygon
from topless import (
    D,
    H,
    T,
    W,
    basin,
    board,
    carcass,
    drawer,
    front,
    holed_top,
    lift,
    merged,
    slide,
    swing,
    top,
)

from grafu.additions.top.complete import missing_top
from grafu.additions.top.config import TopConfig
from grafu.additions.top.evidence import basin_with_tap
from grafu.additions.top.roles import roles_of
from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel


def scaled(parts: list[Part], factor: float) -> list[Part]:
    T_scale = np.diag([factor, factor, factor, 1.0])
    return [replace(p, surfaces=tuple(Surface(s.mesh.transformed(T_scale)) for s in p.surfaces)) for p in parts]


@settings(max_examples=25, deadline=None)
@given(
    width=st.floats(0.3, 2.5),
    depth=st.floats(0.25, 0.9),
    height=st.floats(0.35, 2.2),
    factor=st.sampled_from([0.1, 1.0, 10.0]),
)
def test_a_carcass_lacks_a_top_and_has_one_afterwards(width: float, depth: float, height: float, factor: float) -> None:
    parts = scaled(carcass(width, depth, height), factor)
    verdict = missing_top(parts)
    assert verdict.missing
    assert verdict.addition is not None
    again = missing_top([*parts, verdict.addition.part])
    assert again.covered
    assert again.ratio >= 0.97


@pytest.mark.parametrize("label", [PartLabel.TOP_PANEL, PartLabel.MISC, PartLabel.UNKNOWN])
def test_a_top_covers_whatever_it_is_called(label: PartLabel) -> None:
    assert missing_top([*carcass(), front(), top(label=label)], [swing()]).covered


def test_a_sheet_without_thickness_covers() -> None:
    assert missing_top([*carcass(), top(thickness=0.0)]).covered


def test_a_let_in_top_below_its_rim_covers() -> None:
    inside = board("lid", (-W / 2 + T, -D / 2, H - 0.045), (W / 2 - T, D / 2 - T, H - 0.03))
    assert missing_top([*carcass(), front(), inside], [swing()]).covered


def test_a_back_that_stands_higher_hides_neither_a_top_nor_its_lack() -> None:
    mirror = board("mirror", (-W / 2, D / 2, 0.0), (W / 2, D / 2 + 0.01, 1.7))
    assert missing_top([*carcass(), mirror, top()]).covered
    verdict = missing_top([*carcass(), mirror, front()], [swing()])
    assert verdict.missing
    assert verdict.addition is not None
    assert verdict.addition.part.box.low[2] == pytest.approx(H, abs=1e-6)
    assert verdict.addition.part.box.high[1] <= D / 2 + 1e-6


@pytest.mark.parametrize("solid", [False, True])
def test_a_drawer_is_no_top(solid: bool) -> None:
    verdict = missing_top([*carcass(), drawer(solid=solid)], [slide()])
    assert verdict.missing
    assert verdict.addition is not None
    assert missing_top([*carcass(), drawer(solid=solid), top()], [slide()]).covered


def test_a_lid_covers_though_it_moves_and_even_when_drawn_open() -> None:
    lid, hinge = top(), replace(lift("lid"), drawn_at=0.0)
    assert missing_top([*carcass(), front(), lid], [hinge]).covered
    opened = hinge.axis.rotation(1.2)
    ajar = replace(lid, surfaces=(Surface(lid.mesh.transformed(opened)),))
    assert missing_top([*carcass(), ajar], [replace(hinge, drawn_at=1.2)]).covered


def test_bars_at_the_rim_are_no_top() -> None:
    x, y = W / 2 - T, D / 2 - T
    bars = [
        board("bar_left", (-x, -y, H - T), (-x + 0.08, y, H), PartLabel.BAR),
        board("bar_right", (x - 0.08, -y, H - T), (x, y, H), PartLabel.BAR),
        board("bar_front", (-x, -D / 2, H - T), (x, -D / 2 + 0.08, H), PartLabel.BAR),
        board("bar_back", (-x, y - 0.08, H - T), (x, y, H), PartLabel.BAR),
    ]
    assert missing_top([*carcass(), *bars, front()], [swing()]).missing


def test_a_worktop_with_a_sinks_hole_is_a_top() -> None:
    assert missing_top([*carcass(), front(), holed_top(0.65)], [swing()]).covered
    assert missing_top([*carcass(), front(), holed_top(0.65), basin(H + 0.02)], [swing()]).covered


def test_a_basin_without_a_worktop_gets_one_with_its_cut_out() -> None:
    verdict = missing_top([*carcass(), basin(), front()], [swing()])
    assert verdict.missing
    assert verdict.addition is not None
    mesh = verdict.addition.part.mesh
    assert mesh.is_watertight
    near = np.abs(mesh.vertices[:, :2]) < [0.3, 0.2]
    assert near.all(axis=1).any()  # corners of a cut-out in the middle
    assert mesh.box.size[0] >= W


def drained(bowl: float) -> Part:
    """A sink that fills a worktop's hole; its bowl takes this fraction of the width, a drainer the rest."""
    x, y, t, low, rim = 0.45 * W, 0.45 * D, 0.003, H - 0.12, H + 0.035
    end = -x + bowl * 2 * x
    return merged(
        "inox",
        ((-x, -y, low), (end, y, low + t)),
        ((-x, -y, low), (-x + t, y, rim)),
        ((end - t, -y, low), (end, y, rim)),
        ((-x, -y, low), (end, -y + t, rim)),
        ((-x, y - t, low), (end, y, rim)),
        ((end, -y, rim - t), (x, y, rim)),
    )


@pytest.mark.parametrize("bowl", [0.5, 0.35])
def test_a_sink_whose_drainer_takes_most_of_it_is_not_closed_by_a_predicted_top(bowl: float) -> None:
    hint = Box(vec3(-W / 2, -D / 2, H + 0.01), vec3(W / 2, D / 2, H + 0.04))
    assert missing_top([*carcass(), holed_top(0.88), drained(bowl), front()], [swing()], hint=hint).covered


def test_racks_of_shelves_need_no_top_on_their_posts() -> None:
    posts = [
        board(f"post_{x}_{y}", (x - 0.015, y - 0.015, 0.0), (x + 0.015, y + 0.015, 1.8))
        for x in (-0.4, 0.4)
        for y in (-0.15, 0.15)
    ]
    shelves = [board(f"shelf_{z}", (-0.4, -0.15, z), (0.4, 0.15, z + T)) for z in (0.3, 0.8, 1.3)]
    assert missing_top([*posts, *shelves]).covered


@settings(max_examples=20, deadline=None)
@given(beyond=st.floats(0.06, 0.1), long=st.floats(1.0, 3.2), wide=st.floats(0.6, 1.1), low=st.floats(0.6, 0.8))
def test_legs_that_stand_beyond_a_tables_top_are_no_rim(beyond: float, long: float, wide: float, low: float) -> None:
    x, y = long / 2, wide / 2
    legs = [
        board(f"leg_{i}_{k}", (min(a, b), min(c, d), 0.0), (max(a, b), max(c, d), low), PartLabel.LEG)
        for i, (a, b) in enumerate(((-x - beyond, -x + 0.05), (x - 0.05, x + beyond)))
        for k, (c, d) in enumerate(((-y - beyond, -y + 0.05), (y - 0.05, y + beyond)))
    ]
    aprons = [board(f"apron_{s}", (-x, s * (y - 0.03) - 0.01, 0.55), (x, s * (y - 0.03) + 0.01, 0.9)) for s in (-1, 1)]
    plate = board("top", (-x, -y, 0.9), (x, y, 0.93), PartLabel.TOP_PANEL)
    assert missing_top([*legs, *aprons, plate]).covered


@pytest.mark.parametrize(("label", "covered"), [(PartLabel.TOP_PANEL, True), (PartLabel.SHELF, False)])
def test_bars_beside_what_is_called_a_top_are_its_frame(label: PartLabel, covered: bool) -> None:
    x, y = 0.4, 0.2
    posts = [
        board(f"post_{i}_{k}", (a, b, 0.0), (a + 0.03, b + 0.03, 1.2))
        for i, a in enumerate((-x, x - 0.03))
        for k, b in enumerate((-y, y - 0.03))
    ]
    bars = [
        board("bar_left", (-x, -y, 1.17), (-x + 0.03, y, 1.2), PartLabel.BAR),
        board("bar_right", (x - 0.03, -y, 1.17), (x, y, 1.2), PartLabel.BAR),
        board("bar_front", (-x, -y, 1.17), (x, -y + 0.03, 1.2), PartLabel.BAR),
        board("bar_back", (-x, y - 0.03, 1.17), (x, y, 1.2), PartLabel.BAR),
    ]
    plate = board("plate", (-x, -y + 0.14, 1.18), (x, y, 1.2), label)
    assert missing_top([*posts, *bars, plate]).covered is covered


def slanted(part: Part, drop: float) -> Part:
    """A board whose front is lowered by `drop` at the top, and evenly less towards its back."""
    low, high = part.box.low[1], part.box.high[1]
    moved = part.mesh.vertices.copy()
    up = moved[:, 2] > 0.5 * part.box.high[2]
    moved[up, 2] -= drop * (high - moved[up, 1]) / (high - low)
    return replace(part, surfaces=(Surface(TriangleMesh(moved, part.mesh.faces)),))


@pytest.mark.parametrize("drop", [0.5, 0.6])
def test_the_slanted_sides_of_a_bureau_are_no_rim_before_its_flap(drop: float) -> None:
    sides = [slanted(board(f"side_{x}", (x, -0.22, 0.0), (x + T, 0.22, 1.1)), drop) for x in (-0.35, 0.35 - T)]
    flap = slanted(board("flap", (-0.33, -0.22, 1.08), (0.33, 0.12, 1.1)), drop)
    back = board("back", (-0.33, 0.2, 0.0), (0.33, 0.22, 1.1))
    plate = board("top", (-0.35, 0.12, 1.1), (0.35, 0.22, 1.12), PartLabel.TOP_PANEL)
    assert missing_top([*sides, flap, back, plate]).covered


def test_a_bookcase_open_in_front_lacks_a_top() -> None:
    shelves = [board(f"shelf_{z}", (-W / 2, -D / 2, z), (W / 2, D / 2, z + T)) for z in (0.4, 0.8, 1.2)]
    assert missing_top([*carcass(height=1.6), *shelves]).missing


def test_a_gallery_around_three_sides_is_no_rim() -> None:
    around = [
        board("gallery_back", (-W / 2, D / 2 - T, H), (W / 2, D / 2, H + 0.12)),
        board("gallery_left", (-W / 2, -D / 2, H), (-W / 2 + T, D / 2, H + 0.12)),
        board("gallery_right", (W / 2 - T, -D / 2, H), (W / 2, D / 2, H + 0.12)),
    ]
    assert missing_top([*carcass(), front(), top(H - 0.03), *around], [swing()]).covered


def test_a_hint_settles_only_close_calls() -> None:
    x, y, wide = W / 2 - T, D / 2 - T, 0.17
    strips = merged("strips", ((-x, -y, H - T), (x, -y + wide, H)), ((-x, y - wide / 2, H - T), (x, y, H)))
    hint = Box(vec3(-W / 2, -D / 2, H), vec3(W / 2, D / 2, H + 0.03))
    config = TopConfig(coverage=0.55)
    parts = [*carcass(), strips, front()]
    alone, hinted = missing_top(parts, [swing()], config), missing_top(parts, [swing()], config, hint)
    assert alone.close_call
    assert (alone.covered, hinted.covered) == (True, False)
    assert missing_top([*carcass(), top()], (), config, hint).covered


def test_nothing_at_all_is_nothing_to_cover() -> None:
    assert missing_top([]).covered


def test_both_maps_are_told() -> None:
    coverage = missing_top([*carcass(), front()], [swing()]).coverage
    assert coverage is not None
    assert coverage.near_top.sum() < 0.5 * coverage.everything.sum()
    assert coverage.level == pytest.approx(H, abs=1e-6)


def tap(x: float = 0.0, rises: float = 0.1) -> Part:
    low, high = (x - 0.02, 0.06, H - 0.06), (x + 0.02, 0.12, H + rises)
    return board("tap", low, high, PartLabel.MISC)


PREDICTED = Box(vec3(-0.25, -0.16, H - 0.01), vec3(0.25, 0.16, H + 0.01))


def test_a_basin_that_a_tap_stands_over_has_no_top_whatever_was_predicted() -> None:
    waste = board("waste", (-0.02, -0.02, 0.0), (0.02, 0.02, H - 0.15), PartLabel.LEG)
    verdict = missing_top([basin(), waste, tap()], hint=PREDICTED)
    assert verdict.covered
    assert verdict.addition is None
    assert verdict.why == "`basin` is a basin: `tap` stands over it"


def test_a_shallow_basin_that_a_tap_stands_over_has_no_top() -> None:
    low, high, deep = (-0.25, -0.18, H - 0.07), (0.25, 0.16, H), H - 0.05
    tray = [
        board("basin", low, (0.25, 0.16, deep)),
        board("left", low, (-0.23, 0.16, H)),
        board("right", (0.23, -0.18, low[2]), high),
        board("before", low, (0.25, -0.16, H)),
        board("behind", (-0.25, 0.14, low[2]), high),
    ]
    shallow = replace(tray[0], surfaces=tuple(surface for piece in tray for surface in piece.surfaces))
    base = board("base", (-0.25, -0.18, 0.0), (0.25, 0.16, H - 0.07))
    assert missing_top([base, shallow, tap()]).covered
    assert missing_top([base, shallow]).addition is not None


def test_where_nothing_is_open_there_is_no_basin() -> None:
    parts = [basin(), tap()]
    seen = missing_top(parts, hint=PREDICTED).coverage
    assert seen is not None
    roles, evidence = roles_of(parts, (), TopConfig().upright), TopConfig().evidence
    assert basin_with_tap(roles, seen, evidence, 1.0) is not None
    assert basin_with_tap(roles, replace(seen, near_top=seen.everything), evidence, 1.0) is None


@pytest.mark.parametrize(
    "beside",
    [
        [],
        [tap(rises=-0.01)],
        [tap(x=0.6)],
        [board("wall", (-0.25, 0.16, 0.0), (0.25, 0.18, H + 0.3))],
        [tap(), board("drawer", (-0.25, -0.18, H - 0.14), (0.25, -0.16, H), PartLabel.DRAWER)],
    ],
    ids=["alone", "a post inside it", "a tap elsewhere", "a back behind it", "a drawer in it"],
)
def test_other_boxes_that_are_open_above_get_the_top_that_they_lack(beside: list[Part]) -> None:
    assert missing_top([basin(), *beside], hint=PREDICTED).addition is not None


def test_a_case_in_which_something_tall_stands_is_no_basin() -> None:
    assert missing_top([*carcass(), front(), tap(rises=0.3)], [swing()]).addition is not None


def test_what_is_nothing_but_a_basin_is_judged_like_any_other_piece() -> None:
    lone = replace(basin(), label=PartLabel.MISC)
    assert missing_top([lone]).coverage is not None


def vessel(around: list[tuple[float, float]]) -> Part:
    """A shell of 1 cm with a bottom, and with a plan of these corners (metres)."""
    outer = trimesh.creation.extrude_polygon(Polygon(around), 0.6)
    inner = trimesh.creation.extrude_polygon(Polygon(around).buffer(-0.01), 0.6)
    inner.apply_translation((0.0, 0.0, 0.1))
    part = board("vessel", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    hollow = trimesh.boolean.difference([outer, inner], engine="manifold")
    return replace(part, surfaces=(Surface(TriangleMesh.from_trimesh(hollow)),))


OVAL = [(0.85 * np.cos(t), 0.4 * np.sin(t)) for t in np.linspace(0.0, 2 * np.pi, 48, endpoint=False)]
SQUARE = [(-0.85, -0.4), (0.85, -0.4), (0.85, 0.4), (-0.85, 0.4)]
CORNER = [(-0.85, -0.4), (0.85, -0.4), (0.85, -0.1), (-0.35, -0.1), (-0.35, 0.4), (-0.85, 0.4)]


@pytest.mark.parametrize(("plan", "is_tub"), [(OVAL, True), (SQUARE, False), (CORNER, False)])
def test_a_tub_lacks_no_top_and_a_case_does(plan, is_tub):
    tub = vessel(plan)
    assert missing_top([tub]).missing is not is_tub
    door = board("door", (-0.2, -0.43, 0.1), (0.2, -0.41, 0.5), PartLabel.DOOR)
    assert missing_top([tub, door], (swing(),)).missing, "a round case with a door"


def test_a_round_frame_without_a_bottom_lacks_its_top():
    ring = vessel(OVAL)
    upper = ring.mesh.with_faces(np.flatnonzero(ring.mesh.triangles[:, :, 2].max(axis=1) > 0.3))
    assert missing_top([replace(ring, surfaces=(Surface(upper),))]).why.count("vessel") == 0
