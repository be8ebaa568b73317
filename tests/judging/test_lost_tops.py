"""The judge of tops: what of a piece lies open from above, and how much of a lost top's plan a new one covers."""

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.judging.tops import lost_tops, open_ratio

Point = tuple[float, float, float]
W, D, H, T = 0.8, 0.5, 0.8, 0.018


def block(low: Point, high: Point) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high)))


def case(height: float = H, back: float = D / 2) -> list[TriangleMesh]:
    """Sides, front, back and bottom."""
    x, y = W / 2, D / 2
    return [
        block((-x, -y, 0.0), (T - x, back, height)),
        block((x - T, -y, 0.0), (x, back, height)),
        block((-x, back - T, 0.0), (x, back, height)),
        block((-x, -y, 0.0), (x, T - y, height)),
        block((-x, -y, 0.0), (x, back, T)),
    ]


def legs(height: float = H) -> list[TriangleMesh]:
    ends = [(x, y) for x in (-0.6, 0.56) for y in (-0.3, 0.26)]
    return [block((x, y, 0.0), (x + 0.04, y + 0.04, height)) for x, y in ends]


def plate(ratio: float = 1.0, low: float = H, over: float = 0.02) -> TriangleMesh:
    """A top over this fraction of the width of a case, from the left."""
    x, y = W / 2 + over, D / 2 + over
    return block((-x, -y, low), (-x + ratio * 2 * x, y, low + 0.025))


@pytest.mark.parametrize("ratio", [1.0, 0.9, 0.5])
def test_the_covered_fraction_is_that_of_the_body(ratio: float) -> None:
    (lost,) = lost_tops([plate()], case(), [], [plate(ratio)])
    assert lost.is_missed
    assert lost.hollow > 0.85
    assert lost.covered == pytest.approx(ratio, abs=0.03)


def test_overhangs_do_not_count() -> None:
    (lost,) = lost_tops([plate(over=0.15)], case(), [], [plate(over=0.0)])
    assert lost.covered == 1.0


def test_a_kneehole_and_what_lies_between_legs_count() -> None:
    top = block((-0.7, -0.35, H), (0.7, 0.35, H + 0.03))
    (lost,) = lost_tops([top], legs(), [], [block((-0.6, -0.3, H), (0.0, 0.3, H + 0.03))])
    assert lost.covered == pytest.approx(0.5, abs=0.02)


@pytest.mark.parametrize("low", [0.3, 0.7, 1.0])
def test_a_top_at_another_height_covers_nothing(low: float) -> None:
    (lost,) = lost_tops([plate()], case(), [], [plate(low=low)])
    assert lost.covered == 0.0


def test_what_other_boards_cover_is_not_missed() -> None:
    (lost,) = lost_tops([plate()], [*case(), plate(low=H - 0.02, over=-0.001)], [], [])
    assert not lost.is_missed
    assert lost.hollow < 0.05


def test_a_mirror_that_stands_through_a_top_is_no_part_of_its_plan() -> None:
    mirror = block((-0.3, 0.0, 0.0), (0.3, 0.05, 1.6))
    cut = merge_meshes(
        [block((-0.42, -0.27, H), (0.42, 0.0, H + 0.025)), block((-0.42, 0.05, H), (0.42, 0.27, H + 0.025))]
    )
    sides = [block((a, 0.0, H), (b, 0.05, H + 0.025)) for a, b in ((-0.42, -0.3), (0.3, 0.42))]
    (lost,) = lost_tops([plate()], [*case(), mirror], [], [merge_meshes([cut, *sides])])
    assert lost.covered > 0.99


def test_a_desk_and_its_hutch_lose_two_tops() -> None:
    hutch = [mesh.translated(vec3(0.0, 0.0, H + 0.025)) for mesh in case(0.4)]
    tops = [plate(low=H), plate(low=1.225)]
    found = lost_tops(tops, [*case(), *hutch], [], tops[1:])
    assert [round(one.level, 3) for one in found] == [1.25]
    shallow = [*case(0.4, back=-0.05)]
    shallow = [mesh.translated(vec3(0.0, 0.3, H + 0.025)) for mesh in shallow]
    tops = [plate(low=H), block((-0.4, 0.05, 1.225), (0.4, 0.25, 1.25))]
    found = lost_tops(tops, [*case(), *shallow], [], [plate(low=H)])
    assert [(round(one.level, 3), one.is_missed, round(one.covered)) for one in found] == [
        (1.25, True, 0),
        (0.825, True, 1),
    ]


def test_sheets_without_thickness_carry_a_top() -> None:
    x, y = W / 2, D / 2
    sheets = [block((a, -y, 0.0), (a, y, H)) for a in (-x, x)]
    (lost,) = lost_tops([plate(over=0.0)], sheets, [], [plate(over=0.0)])
    assert lost.is_missed
    assert lost.covered == 1.0


def test_nothing_taken_or_left_is_refused() -> None:
    with pytest.raises(ValueError, match="`taken` and `still`"):
        lost_tops([], case(), [], [])
    with pytest.raises(ValueError, match="`taken` and `still`"):
        lost_tops([plate()], [], [], [])
    with pytest.raises(ValueError, match="`meshes` must"):
        open_ratio([])


def test_rooms_and_what_stands_on_legs_alone_are_open() -> None:
    assert open_ratio(case()) > 0.85
    assert open_ratio(legs()) > 0.5
    assert open_ratio([*case(), plate()]) == 0.0


def test_a_rack_whose_posts_stand_higher_and_a_desk_before_its_hutch_are_not_open() -> None:
    shelves = [block((-0.6, -0.3, z), (0.6, 0.3, z + 0.02)) for z in (0.2, 0.6, 1.0)]
    assert open_ratio([*legs(1.2), *shelves]) == 0.0
    hutch = block((-0.42, 0.1, H + 0.025), (0.42, 0.27, 1.25))
    assert open_ratio([*case(), plate(), hutch]) == 0.0
