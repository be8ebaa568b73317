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


@pytest.mark.parametrize(("held", "stays"), [(0.1 * GB, True), (2 * GB, False)])
def test_what_nobody_uses_is_given_back_where_much_is_held(
    monkeypatch: pytest.MonkeyPatch, held: float, stays: bool
) -> None:
    monkeypatch.setattr(limits, "_resident", lambda _: int(held))
    gc.disable()
    try:
        seen = weakref.ref(Thing())
        give_back_unused()
        assert (seen() is not None) == stays
    finally:
        gc.enable()
