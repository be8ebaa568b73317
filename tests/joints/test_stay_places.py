import numpy as np
import pytest

from grafu.joints.stay_config import StayConfig
from grafu.joints.stay_places import StayPlace, places

ANGLES = np.radians(np.linspace(0.0, 90.0, 19))
PLACE = StayPlace(np.array([0.1, -0.2]), np.array([0.15, -0.03]), np.zeros(2))


def test_the_leafs_pivot_keeps_its_distance_from_the_hinges():
    ends = PLACE.spans(ANGLES) + PLACE.case

    assert np.allclose(np.linalg.norm(ends - PLACE.axis, axis=1), np.linalg.norm(PLACE.leaf))
    assert np.allclose(ends[0], PLACE.leaf)
    assert np.allclose(ends[-1], [0.03, 0.15])


def test_turns_point_the_stay_at_the_leafs_pivot():
    first = PLACE.spans(ANGLES)[0]
    for turn, span in zip(PLACE.turns(ANGLES), PLACE.spans(ANGLES), strict=True):
        c, s = np.cos(turn), np.sin(turn)
        turned = np.array([[c, -s], [s, c]]) @ first
        assert np.allclose(turned / np.linalg.norm(turned), span / np.linalg.norm(span))


def test_the_lever_is_how_the_length_grows_with_the_angle():
    fine = np.linspace(0.0, 1.5, 2001)
    grown = np.gradient(PLACE.lengths(fine), fine)

    assert np.allclose(grown[1:-1], PLACE.levers(fine)[1:-1], atol=1e-5)


@pytest.mark.parametrize("opening", [60, 90, 95])
def test_all_places_push_open_and_tube_and_rod_reach(opening):
    angles, config = np.radians(np.linspace(0.0, opening, 15)), StayConfig()
    found = list(places(np.array([0.0, 0.0]), -0.02, 0.5, angles, config))

    assert found
    for place, (tube, rod) in found:
        lengths = place.lengths(angles)
        assert np.all(np.diff(lengths) > 0)
        assert max(tube, rod) < lengths.min()
        assert tube + rod > (1 + config.lap) * lengths.max()
        assert place.levers(angles).min() >= config.lever * 0.5


def test_a_leaf_that_opens_all_around_has_no_place():
    angles = np.radians(np.linspace(0.0, 175.0, 15))

    assert list(places(np.zeros(2), -0.02, 0.5, angles, StayConfig())) == []
