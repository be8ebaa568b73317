"""Which nodes hang together. It knows no kinds of edges."""

from collections.abc import Iterable, Mapping


def joined_groups(neighbours: Mapping[str, Iterable[str]]) -> list[frozenset[str]]:
    """Returns the groups of nodes between which a way leads, in the order of their first nodes.

    `neighbours` names for each node those that it is joined to, both ways.
    """
    groups: list[frozenset[str]] = []
    seen: set[str] = set()
    for first in neighbours:
        if first in seen:
            continue
        group, queue = {first}, [first]
        while queue:
            reached = set(neighbours[queue.pop()]) - group
            group |= reached
            queue += reached
        seen |= group
        groups.append(frozenset(group))
    return groups
