"""Every family: draws that nearly always find room, sizes of the trade, consistent labels, joints that move freely."""

from math import pi

import numpy as np
import pytest

from grafu.synth.blueprint import draw_made
from grafu.synth.families.table import FAMILIES
from grafu.vocabulary import JointType, PartLabel
from sweeping import collisions

# metres: the least and greatest width, depth and height of a whole piece, fronts, handles and overhang included
SIZES = {
    "base cabinet": ((0.25, 1.35), (0.4, 0.85), (0.65, 0.95)),
    "wall cabinet": ((0.25, 1.1), (0.25, 0.55), (0.25, 1.0)),
    "tall cabinet": ((0.25, 1.1), (0.3, 0.85), (1.3, 2.35)),
    "nightstand": ((0.3, 0.8), (0.27, 0.7), (0.35, 0.8)),
    "desk": ((0.95, 2.0), (0.45, 1.0), (0.65, 0.85)),
    "filing cabinet": ((0.3, 0.6), (0.4, 0.8), (0.45, 1.45)),
}


def draws(family, number):
    return [draw_made(np.random.default_rng([11, k]), family)[1] for k in range(number)]


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_a_family_makes_consistent_furniture(family):
    for asset in draws(family, 12):
        movable = sorted(p.id for p in asset.parts if p.label.is_movable)
        assert movable
        assert sorted(j.part for j in asset.joints) == movable
        assert all((p.rides_on is None) or p.rides_on in movable for p in asset.parts)
        assert all(p.rides_on for p in asset.parts if p.label is PartLabel.HANDLE)
        assert 3 <= len(asset.parts) <= 140


@pytest.mark.parametrize("family", sorted(SIZES))
def test_pieces_have_the_sizes_of_the_trade(family):
    for asset in draws(family, 12):
        for side, (low, high) in zip(asset.box.size, SIZES[family], strict=True):
            assert low <= side <= high


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_joints_open_and_move_freely(family):
    for asset in draws(family, 2):
        for joint in asset.joints[:6]:
            limit = pi if joint.type is JointType.REVOLUTE else 1.0
            assert 0.03 < joint.upper <= limit
            hit = collisions(asset, joint.part, np.linspace(0.1, 1.0, 4) * joint.upper)
            assert max(hit.values(), default=0.0) < 0.0005, (asset.name, joint.part, hit)


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
