"""What was made of arrays is found again by what they hold, and leaves when there is no room."""

import numpy as np

from grafu.geometry.remembered import RememberedByContent

ROW, OTHER = np.arange(6.0), np.arange(6.0) + 1e-12


def test_equal_arrays_are_worked_on_once():
    remembered, made = RememberedByContent[list[int]](room=10), list[int]()

    def make() -> list[int]:
        made.append(len(made))
        return [made[-1]]

    first = remembered.of(make, 1, ROW, OTHER)

    assert remembered.of(make, 1, ROW.copy(), OTHER.copy()) is first
    assert remembered.of(make, 1, OTHER, ROW) is not first
    assert remembered.of(make, 1, ROW.reshape(2, 3), OTHER) is not first
    assert made == [0, 1, 2]


def test_what_was_used_longest_ago_leaves_first():
    remembered, made = RememberedByContent[str](room=10), list[str]()

    def ask(name: str, size: int) -> str:
        return remembered.of(lambda: made.append(name) or name, size, np.array([float(ord(name))]))  # type: ignore[func-returns-value]

    for name, size in (("a", 4), ("b", 4), ("a", 4), ("c", 4), ("a", 4), ("b", 4)):
        assert ask(name, size) == name
    assert made == ["a", "b", "c", "b"]
    ask("d", 11)  # more than all the room: it is made, and not kept
    ask("d", 11)
    assert made[4:] == ["d", "d"]
