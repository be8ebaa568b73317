"""How a process is watched, and what it gives back: as seldom as is safe, and only where it holds much."""

import gc
import weakref

import pytest

from grafu.processes import limits
from grafu.processes.limits import give_back_unused
from grafu.processes.worker import next_look

GB = 10**9


class Thing:
    def __init__(self) -> None:
        self.itself = self


@pytest.mark.parametrize(
    ("left", "room", "seconds"),
    [
        (1000.0, 3.5 * GB, 0.5),  # far from both limits
        (1000.0, 0.4 * GB, 0.2),  # it could be too large in a fifth of a second
        (1000.0, 0.0, 0.05),
        (1000.0, -1.0 * GB, 0.05),
        (0.3, 3.5 * GB, 0.3),  # late in a moment
        (-1.0, 3.5 * GB, 0.05),
        (float("inf"), float("inf"), 0.5),
    ],
)
def test_who_has_time_and_room_is_seldom_looked_at(left: float, room: float, seconds: float) -> None:
    assert next_look(left, room) == pytest.approx(seconds)


@pytest.fixture
def fresh(monkeypatch: pytest.MonkeyPatch) -> None:
    """A process that has given back nothing yet."""
    monkeypatch.setattr(limits._LastGivenBack, "held", 0)


@pytest.mark.parametrize(("held", "stays"), [(0.1 * GB, True), (2 * GB, False)])
def test_what_nobody_uses_is_given_back_where_much_is_held(
    fresh: None, monkeypatch: pytest.MonkeyPatch, held: float, stays: bool
) -> None:
    monkeypatch.setattr(limits, "_resident", lambda _: int(held))
    gc.disable()
    try:
        seen = weakref.ref(Thing())
        give_back_unused()
        assert (seen() is not None) == stays
    finally:
        gc.enable()


def test_a_process_looks_again_only_where_it_has_grown(fresh: None, monkeypatch: pytest.MonkeyPatch) -> None:
    def looks(held: float) -> bool:
        times: list[None] = []
        monkeypatch.setattr(limits, "_resident", lambda _: int(held * GB))
        monkeypatch.setattr(limits, "_collect", lambda: times.append(None))
        give_back_unused()
        return bool(times)

    expected = [
        (2.0, True),
        (2.05, False),  # hardly more than it kept: a process may hold much that is not ours
        (2.2, True),
        (1.0, False),  # it has shrunk
        (1.2, True),
    ]
    assert [(held, looks(held)) for held, _ in expected] == expected
