"""A lid between arms or under a high back closes its box: no slab is put over it, which would hold it shut."""

from math import radians

import pytest
from topless import D, T, W, board, carcass, front, lift

from grafu.additions.top.complete import missing_top
from grafu.additions.top.coverage import Coverage
from grafu.additions.top.height_map import Grid
from grafu.additions.top.lids_below import lid_in
from grafu.additions.top.roles import roles_of
from grafu.asset.part import Part
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.plan import JointRequest
from grafu.vocabulary import JointType, PartLabel

SEAT, ARMS = 0.42, 0.65


def bench(width: float = 1.0, thick: float = 0.027) -> list[Part]:
    """A box, arms on its sides and a back behind it, and a lid that takes a fraction of its width."""
    a, y = W / 2, D / 2
    high = [
        board(f"arm_{s}", (s * a - (T if s > 0 else 0), -y, SEAT), (s * a + (T if s < 0 else 0), y, ARMS))
        for s in (-1, 1)
    ]
    lid = board(
        "lid", (-a + T + 0.003, -y - 0.02, SEAT + 0.003), (-a + T + width * (W - 2 * T), y - 0.023, SEAT + thick)
    )
    return [*carcass(height=SEAT), *high, board("back", (-a, y - 0.02, SEAT), (a, y, 0.95)), relabelled(lid)]


def relabelled(part: Part) -> Part:
    return board(part.id, tuple(part.box.low), tuple(part.box.high), PartLabel.DOOR)


def raised(part: str = "lid") -> JointRequest:
    axis = Axis(vec3(0.0, D / 2 - 0.023, SEAT + 0.03), vec3(-1.0, 0.0, 0.0))
    return JointRequest(part, JointType.REVOLUTE, axis, "test", radians(90))


def test_the_lid_of_a_bench_between_its_arms_gets_no_top_over_it() -> None:
    verdict = missing_top(bench(), [raised()])
    assert verdict.covered
    assert verdict.addition is None
    assert verdict.why == "`lid` is a lid: it closes what is open there"


@pytest.mark.parametrize(
    ("parts", "joints"),
    [
        (bench(width=0.3), [raised()]),
        ([*carcass(), front()], [lift()]),
        ([*bench()[:-1], board("seat", (-W / 2 + T, -D / 2, 0.2), (W / 2 - T, D / 2 - T, 0.22))], []),
    ],
    ids=["a lid of a third of it", "a front that turns up", "no lid"],
)
def test_what_no_lid_closes_lacks_its_top(parts, joints) -> None:
    assert missing_top(parts, joints).addition is not None


def test_what_turns_about_an_upright_axis_or_is_thick_is_no_lid() -> None:
    def found(parts: list[Part], joint: JointRequest) -> object:
        roles = roles_of(parts, [joint], 0.5)
        assert roles is not None
        seen = missing_top(bench()[:-1]).coverage
        assert isinstance(seen, Coverage)
        assert isinstance(seen.grid, Grid)
        return lid_in(roles, seen)

    upright = JointRequest(
        "lid", JointType.REVOLUTE, Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0)), "test", radians(90)
    )
    assert found(bench(), raised()) is not None
    assert found(bench(), upright) is None
    assert found(bench(thick=0.22), raised()) is None
