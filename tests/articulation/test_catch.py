"""The force of a catch: constant near closed, falling to zero, and never so strong that a pull opens nothing."""

from dataclasses import fields

import numpy as np
import pytest

from grafu.articulation.catch import Catch, CatchConfig, catch_of
from grafu.articulation.catch_kind import CatchKind

CONFIG = CatchConfig()
DETENT, SELF_CLOSING = CatchKind.DETENT, CatchKind.SELF_CLOSING


def drawer(kind: CatchKind, friction: float = 1.0, upper: float = 0.4, pull: float = 20.0) -> Catch | None:
    return catch_of(kind, False, (0.0, upper), (1.0, 1.0), pull, friction, CONFIG)


def door(kind: CatchKind, grip: float = 0.4, friction: float = 0.4) -> Catch | None:
    return catch_of(kind, True, (0.0, 1.9), (0.4, grip), 20.0, friction, CONFIG)


def test_the_force_is_constant_then_falls_and_is_zero_beyond() -> None:
    catch = Catch(effort=8.0, reach=0.04, fade=0.01, closed=0.1)
    values = np.array([0.05, 0.1, 0.13, 0.135, 0.14, 0.3])

    assert catch.effort_at(values) == pytest.approx([-8.0, -8.0, -8.0, -4.0, 0.0, 0.0])


def test_what_closes_by_itself_reaches_further_than_a_detent() -> None:
    near, far = drawer(DETENT), drawer(SELF_CLOSING)

    assert near is not None
    assert far is not None
    assert (near.reach, far.reach) == (CONFIG.detent, CONFIG.rail)
    assert near.effort == far.effort == CONFIG.force


def test_ways_and_forces_of_doors_are_those_of_the_far_edge() -> None:
    catch = door(SELF_CLOSING)

    assert catch is not None
    assert catch.reach == pytest.approx(CONFIG.hinge / 0.4)
    assert catch.effort == pytest.approx(CONFIG.force * 0.4)


@pytest.mark.parametrize("friction", [0.1, 1.0, 5.0, 9.0, 14.0])
@pytest.mark.parametrize("kind", [DETENT, SELF_CLOSING])
def test_with_friction_it_never_takes_all_of_the_pull(kind: CatchKind, friction: float) -> None:
    catch = drawer(kind, friction)

    assert catch is not None
    assert catch.effort + friction <= CONFIG.ease * 20.0


def test_a_grip_near_the_hinge_opens_the_door_all_the_same() -> None:
    catch = door(DETENT, grip=0.15)

    assert catch is not None
    assert catch.effort + 0.4 == pytest.approx(CONFIG.ease * 20.0 * 0.15)


def test_a_short_joint_is_not_closed_over_its_whole_range() -> None:
    catch = drawer(SELF_CLOSING, upper=0.05)

    assert catch is not None
    assert catch.reach == pytest.approx(0.025)


@pytest.mark.parametrize(
    "none", [drawer(CatchKind.NONE), drawer(DETENT, friction=20.0), drawer(DETENT, upper=0.0)], ids=str
)
def test_where_nothing_is_wanted_or_left_there_is_no_catch(none: Catch | None) -> None:
    assert none is None


@pytest.mark.parametrize("name", [f.name for f in fields(CatchConfig)])
def test_a_config_refuses_what_is_not_above_zero(name: str) -> None:
    with pytest.raises(ValueError, match=f"`CatchConfig.{name}`"):
        CatchConfig(**{name: 0.0})


@pytest.mark.parametrize("values", [(0.0, 0.1, 0.1), (1.0, 0.0, 0.1), (1.0, 0.1, 0.2), (1.0, 0.1, 0.0)])
def test_a_catch_without_force_or_range_is_refused(values: tuple[float, float, float]) -> None:
    with pytest.raises(ValueError, match=r"`Catch\."):
        Catch(*values)
