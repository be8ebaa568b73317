"""Joints that wait for one another: what has to be open before a part may move. It knows no geometry."""

from collections.abc import Iterable, Mapping


def all_before(name: str, waits: Mapping[str, Iterable[str]]) -> set[str]:
    """Returns what a part waits for, what that waits for, and so on; `waits` says what each waits for by itself."""
    found: set[str] = set()
    queue = [name]
    while queue:
        for before in waits.get(queue.pop(), ()):
            if before not in found:
                found.add(before)
                queue.append(before)
    return found
