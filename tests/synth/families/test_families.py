"""Every family: draws that nearly always find room, sizes of the trade, consistent labels, joints that move freely."""

from math import pi

import numpy as np
import pytest

from grafu.synth.families.table import FAMILIES, draw_made
from grafu.synth.truth.check import faults_of
from grafu.vocabulary import JointType, PartLabel
from sweeping import collisions

# metres: the least and greatest width, depth and height of a whole piece, fronts, handles and overhang included
SIZES = {
    "base cabinet": ((0.14, 1.35), (0.4, 0.85), (0.65, 0.95)),
    "wall cabinet": ((0.18, 1.35), (0.25, 0.55), (0.25, 1.0)),
    "washstand": ((0.45, 1.4), (0.34, 0.7), (0.28, 0.75)),
    "tall cabinet": ((0.24, 1.1), (0.28, 0.85), (1.3, 2.45)),
    "nightstand": ((0.3, 0.95), (0.27, 0.7), (0.3, 0.85)),
    "desk": ((0.95, 2.0), (0.45, 1.7), (0.65, 1.25)),
    "filing cabinet": ((0.3, 0.6), (0.4, 0.8), (0.45, 1.45)),
}


def draws(family, number):
    return [draw_made(np.random.default_rng([11, k]), family)[1] for k in range(number)]


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_a_family_makes_consistent_furniture(family):
    for asset in draws(family, 6):
        moving = [j.part for j in asset.joints]
        assert moving
        assert {p.id for p in asset.parts if p.label.is_movable} <= {*moving}
        assert len({*moving}) == len(moving)
        assert all((p.carried_by is None) or p.carried_by in moving for p in asset.parts)
        assert all(p.carried_by for p in asset.parts if p.label is PartLabel.HANDLE)
        assert 3 <= len(asset.parts) <= 140


@pytest.mark.parametrize("family", sorted(SIZES))
def test_pieces_have_the_sizes_of_the_trade(family):
    for asset in draws(family, 6):
        for side, (low, high) in zip(asset.box.size, SIZES[family], strict=True):
            assert low <= side <= high


def doors_before(asset, joint):
    """Returns the doors and their handles: those stand open before a drawer behind them moves."""
    if joint.type is JointType.REVOLUTE:
        return frozenset()
    doors = {p.id for p in asset.parts if p.label is PartLabel.DOOR}
    return frozenset(p.id for p in asset.parts if p.id in doors or p.carried_by in doors)


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_joints_open_and_move_freely(family):
    for asset in draws(family, 1):
        leading = {joint.coupling.leader for joint in asset.joints if joint.coupling}  # `faults_of` sweeps these
        alone = [joint for joint in asset.joints if joint.coupling is None and joint.part not in leading]
        for joint in alone[:6]:
            limit = pi if joint.type is JointType.REVOLUTE else 1.0
            assert 0.03 < joint.upper <= limit
            hit = collisions(asset, joint.part, np.linspace(0.1, 1.0, 4) * joint.upper, doors_before(asset, joint))
            assert max(hit.values(), default=0.0) < 0.0005, (asset.name, joint.part, hit)


def test_nearly_all_draws_are_sound():
    drawn = [asset for family in sorted(FAMILIES) for asset in draws(family, 3)]
    unsound = [asset.name for asset in drawn if faults_of(asset)]
    assert len(unsound) < 0.05 * len(drawn), unsound


def test_most_pieces_have_few_movable_parts_and_some_have_many():
    rng = np.random.default_rng(13)
    assets = [draw_made(rng)[1] for _ in range(300)]
    movable, parts = [len(a.joints) for a in assets], [len(a.parts) for a in assets]
    assert 1 <= np.median(movable) <= 4
    assert max(movable) >= 9
    assert 12 <= np.median(parts) <= 26
    assert np.mean([n <= 60 for n in parts]) > 0.95


def test_draws_rarely_fail():
    failed = 0
    for k in range(150):
        rng = np.random.default_rng([12, k])
        family = sorted(FAMILIES)[k % len(FAMILIES)]
        try:
            FAMILIES[family][1](rng)
        except ValueError:
            failed += 1
    assert failed / 150 < 0.2
