"""What only a top had joined: legs without aprons, pedestals, end panels; and what stands alike but has none."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from topless import D, H, T, W, board, carcass, drawer, slide

from grafu.additions.top.complete import missing_top
from grafu.additions.top.config import TopConfig
from grafu.asset.part import Part
from grafu.geometry.appearance import Material, Surface
from grafu.vocabulary import PartLabel

GRAZED = 0.009  # metres: a cell of 160 that a wall so much as grazes counts as its own
FLUSH = TopConfig(front=0.0, side=0.0)


def post(x: float, y: float, height: float = H, half: float = 0.02) -> Part:
    return board(f"post_{x}_{y}", (x - half, y - half, 0.0), (x + half, y + half, height), PartLabel.LEG)


def legs(width: float = 1.2, depth: float = 0.6, height: float = H, half: float = 0.02) -> list[Part]:
    """Four legs whose outer faces stand on a rectangle."""
    x, y = width / 2 - half, depth / 2 - half
    return [post(a, b, height, half) for a in (-x, x) for b in (-y, y)]


def plan_of(parts: list[Part], config: TopConfig = FLUSH) -> np.ndarray:
    """Returns the bounds of the top that parts are given (least x and y, greatest), which then is the only one."""
    verdict = missing_top(parts, config=config)
    assert verdict.addition is not None, verdict.why
    top = verdict.addition.part
    assert top.mesh.is_watertight
    assert missing_top([*parts, top], config=config).covered
    return np.concatenate([top.box.low[:2], top.box.high[:2]])


@settings(max_examples=25, deadline=None)
@given(
    width=st.floats(0.4, 2.4),
    depth=st.floats(0.35, 1.0),
    height=st.floats(0.35, 1.1),
    half=st.floats(0.012, 0.05),
)
def test_four_legs_are_a_table_without_its_top(width: float, depth: float, height: float, half: float) -> None:
    bounds = plan_of(legs(width, depth, height, half))
    assert bounds == pytest.approx([-width / 2, -depth / 2, width / 2, depth / 2], abs=GRAZED)


@pytest.mark.parametrize("uneven", [0.0, 0.004, -0.008])
def test_a_pedestal_and_an_end_panel_get_one_top(uneven: float) -> None:
    panel = board("end", (-1.0, -D / 2, 0.0), (-1.0 + T, D / 2, H + uneven))
    bounds = plan_of([*carcass(), panel])
    assert bounds == pytest.approx([-1.0, -D / 2, W / 2, D / 2], abs=GRAZED)


def test_a_pedestal_and_two_legs_get_one_top() -> None:
    bounds = plan_of([*carcass(0.4), post(-1.1, -0.2), post(-1.1, 0.2)])
    assert bounds == pytest.approx([-1.12, -D / 2, 0.2, D / 2], abs=GRAZED)


def test_two_panels_and_a_modesty_panel_get_one_top() -> None:
    ends = [board(f"end_{x}", (x, -0.35, 0.0), (x + T, 0.35, H)) for x in (-0.8, 0.8)]
    modesty = board("modesty", (-0.8 + T, 0.2, 0.3), (0.8, 0.2 + T, H))
    assert plan_of([*ends, modesty]) == pytest.approx([-0.8, -0.35, 0.8 + T, 0.35], abs=GRAZED)


def test_legs_that_stand_in_an_l_get_an_l() -> None:
    parts = [*carcass(0.5, 0.6, x=0.25)]
    parts += [post(x, y) for x, y in ((1.58, 0.28), (1.58, -0.28), (1.58, -1.38), (1.02, -1.38), (1.02, -0.28))]
    verdict = missing_top(parts, config=FLUSH)
    assert verdict.addition is not None
    t = verdict.addition.part.mesh.triangles
    volume = float(np.einsum("nd,nd->n", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)
    assert volume / 0.025 == pytest.approx(1.6 * 0.6 + 0.6 * 1.1, rel=0.03)


def test_legs_below_a_top_are_no_second_table() -> None:
    plate = board("plate", (-0.6, -0.3, H), (0.6, 0.3, H + 0.03))
    assert missing_top([*legs(), plate]).covered


@pytest.mark.parametrize("rise", [0.03, 0.12, 0.25])
def test_posts_that_stick_up_beyond_a_surface_need_no_top(rise: float) -> None:
    plate = board("plate", (-0.6, -0.3, H - rise - 0.03), (0.6, 0.3, H - rise))
    assert missing_top([*legs(), plate]).covered


def test_things_on_a_table_need_no_top() -> None:
    plate = board("plate", (-0.7, -0.4, 0.42), (0.7, 0.4, 0.45))
    bottles = [
        board(f"bottle_{x}_{y}", (x, y, 0.45), (x + 0.08, y + 0.08, 0.75)) for x in (-0.5, 0.4) for y in (-0.3, 0.2)
    ]
    assert missing_top([*legs(height=0.42), plate, *bottles]).covered


def test_a_lower_chest_beside_a_wardrobe_keeps_its_own_top() -> None:
    wardrobe = [*carcass(0.8, height=1.9), board("roof", (-0.4, -D / 2, 1.9), (0.4, D / 2, 1.92))]
    bounds = plan_of([*wardrobe, *carcass(0.6, x=0.701)])
    assert bounds[0] >= 0.4
    assert bounds[2] == pytest.approx(1.001, abs=GRAZED)


def test_tall_posts_a_screen_and_two_bottles_are_no_tables() -> None:
    assert missing_top(legs(height=1.9)).covered
    assert missing_top([board("screen", (-0.8, -0.01, 0.0), (0.8, 0.01, 1.0))]).covered
    assert missing_top([post(-0.4, 0.0), post(0.4, 0.0)]).covered


def test_two_chests_with_tops_stay_two() -> None:
    chests = [*carcass(0.4, x=-0.6), *carcass(0.4, x=0.6)]
    tops = [board(f"top_{x}", (x - 0.2, -D / 2, H), (x + 0.2, D / 2, H + 0.02)) for x in (-0.6, 0.6)]
    assert missing_top([*chests, *tops]).covered


def test_four_legs_of_two_heights_are_a_chairs() -> None:
    seat = board("seat", (-0.2, -0.2, 0.43), (0.2, 0.2, 0.45))
    chair = [post(x, 0.18, 0.9) for x in (-0.18, 0.18)] + [post(x, -0.18, 0.65) for x in (-0.18, 0.18)]
    assert missing_top([*chair, seat]).covered


def painted(part: Part, material: Material) -> Part:
    return replace(part, surfaces=tuple(Surface(s.mesh, material) for s in part.surfaces))


@pytest.mark.parametrize("runners", [False, True])
def test_a_painted_table_gets_a_painted_top_though_its_drawers_are_plain_inside(runners: bool) -> None:
    blue, birch = Material("blue", (0.2, 0.3, 0.7, 1.0)), Material("birch", (0.9, 0.8, 0.6, 1.0))
    inside = painted(drawer(H - 0.03), birch)
    face = painted(board("face", (-W / 2, -D / 2 - 2 * T, H - 0.18), (W / 2, -D / 2 - T, H - 0.03)), blue)
    box_ = replace(inside, surfaces=(*inside.surfaces, *face.surfaces))
    sides = [board(f"side_{x}", (x, -D / 2, H - 0.2), (x + T, D / 2, H), PartLabel.LEG) for x in (-W / 2, W / 2 - T)]
    still = [painted(p, blue) for p in [*legs(W, D), *sides]]
    rails = [painted(board(f"rail_{x}", (x, -0.2, 0.65), (x + 0.01, 0.2, 0.66)), birch) for x in (-0.37, 0.36)]
    verdict = missing_top([*still, box_, *(rails if runners else [])], [slide()])
    assert verdict.addition is not None
    assert verdict.addition.part.surfaces[0].material == blue
