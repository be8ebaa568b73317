import numpy as np
import pytest

from grafu.errors import TemplateError
from grafu.templates.concealed import LINKAGE, RANGE
from grafu.templates.four_bar import FourBar

ANGLES = np.linspace(0.0, RANGE, 43)


def turned(angle: float) -> np.ndarray:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def test_links_keep_their_lengths_over_the_whole_sweep():
    arms = LINKAGE.moved(ANGLES) - np.array(LINKAGE.fixed)

    assert np.allclose(np.linalg.norm(arms, axis=2), LINKAGE.lengths, atol=1e-12)


def test_a_link_turned_by_its_angle_meets_its_moving_pivot():
    turns, moved = LINKAGE.link_turns(ANGLES), LINKAGE.moved(ANGLES)
    for k in (0, 1):
        fixed, moving = np.array(LINKAGE.fixed[k]), np.array(LINKAGE.moving[k])
        found = np.array([fixed + turned(turn) @ (moving - fixed) for turn in turns[:, k]])
        assert np.allclose(found, moved[:, k], atol=1e-12)
        assert np.all(np.abs(np.diff(turns[:, k])) < 0.2)  # no jump to the other assembly


def test_at_rest_nothing_has_moved():
    bars = FourBar(((0.0, 0.0), (1.0, 0.0)), ((0.0, 0.5), (1.2, 0.5)))

    assert np.allclose(bars.shifts(np.zeros(3)), 0.0)
    assert bars.lengths == pytest.approx((0.5, np.hypot(0.2, 0.5)))


def test_the_coupler_of_a_hinge_whose_pivots_nearly_coincide_turns_about_them():
    bars = FourBar(((0.0, 0.0), (1e-4, 0.0)), ((0.0, 1.0), (0.0, 1.0001)))
    axis, largest = bars.best_axis(np.linspace(0.0, 0.01, 5))

    assert largest < 1e-3
    assert np.all(np.isfinite(axis))


def test_the_cup_hinge_is_up_to_9_mm_beside_the_axis_that_fits_best():
    axis, largest = LINKAGE.best_axis(ANGLES)

    assert largest == pytest.approx(0.0084, abs=2e-4)
    assert axis == pytest.approx((0.0059, 0.0145), abs=2e-4)
    assert np.hypot(*LINKAGE.slips(ANGLES, (0.02, 0.01)).T).max() > largest
    assert not np.any(LINKAGE.slips(ANGLES, axis)[0])


def test_a_door_of_18_mm_clears_its_case_and_hardly_leaves_its_own_width():
    door = np.array([[0.0, 0.0], [0.0, 0.018], [0.018, 0.0], [0.4, 0.0]])
    poses = [door @ turned(a).T + shift for a, shift in zip(ANGLES, LINKAGE.shifts(ANGLES), strict=True)]

    assert min(pose[:, 1].min() for pose in poses) > -1e-9  # never behind the plane of the case's front
    assert min(pose[:, 0].min() for pose in poses[: len(poses) * 6 // 7]) > -0.0011  # up to 90 degrees


@pytest.mark.parametrize("scale", [0.01, 3.0])
def test_a_scaled_linkage_moves_in_scale(scale):
    assert np.allclose(LINKAGE.scaled(scale).shifts(ANGLES), scale * LINKAGE.shifts(ANGLES))


def test_what_the_linkage_cannot_reach_is_refused():
    with pytest.raises(TemplateError, match="does not reach"):
        FourBar(((0.0, 0.0), (1.0, 0.0)), ((0.0, 0.1), (1.2, 0.1))).shifts(np.array([0.0, np.pi]))


def test_pivots_that_coincide_are_refused():
    with pytest.raises(TemplateError, match="four pivots apart"):
        FourBar(((0.0, 0.0), (0.0, 0.0)), ((0.0, 1.0), (1.0, 1.0)))
