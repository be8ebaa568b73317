"""What a moving part may run into, found by boxes: most of it is far away, and what is not asked for is not read."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import field
from functools import cached_property, partial
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mask, Points
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.scene.reads import Read, note_box, note_whole

Ends = tuple[Points, Points]
"""The lowest and the highest corners of boxes, one row for each."""


@final
@dataclass(frozen=True, eq=False)
class Obstacle:
    """Something that a moving part may run into."""

    id: str
    collider: MeshCollider


@final
@dataclass(eq=False)
class Entry:
    """An obstacle that is prepared when it is first asked for: its id, its box at rest, and what prepares it."""

    kind: Read
    id: str
    box: Box
    prepare: Callable[[], Obstacle]
    _made: Obstacle | None = field(default=None, init=False)

    @property
    def obstacle(self) -> Obstacle:
        """The obstacle."""
        if self._made is None:
            self._made = self.prepare()
        return self._made


@final
class Obstacles:
    """Obstacles in order. `near` reads those that meet a box; going through them, or counting them, reads all."""

    def __init__(self, entries: Iterable[Entry], find_ends: Callable[[], Ends] | None = None) -> None:
        self._listed, self._find_ends = entries, find_ends

    @cached_property
    def _entries(self) -> tuple[Entry, ...]:
        """The obstacles, listed when first asked for: many are never."""
        return tuple(self._listed)

    @cached_property
    def _kinds(self) -> tuple[Read, ...]:
        kinds: list[Read] = []
        for entry in self._entries:
            if entry.kind not in kinds:  # a list of few is quicker than to hash the kind of each
                kinds.append(entry.kind)
        return tuple(kinds)

    @cached_property
    def _ends(self) -> Ends:
        if self._find_ends is not None:
            return self._find_ends()
        lows = [entry.box.low for entry in self._entries]
        return np.reshape(lows, (-1, 3)), np.reshape([entry.box.high for entry in self._entries], (-1, 3))

    def near(self, box: Box, margin: float = 0.0) -> list[Obstacle]:
        """Returns those whose boxes come within a margin (metres) of a box."""
        for kind in self._kinds:
            note_box(kind, box, margin)
        return [self._entries[k].obstacle for k in np.flatnonzero(self._is_near(box, margin)).tolist()]

    def meets(self, box: Box) -> bool:
        """Whether the box of one of them shares a point with a box; that is not noted as read."""
        return bool(self._is_near(box, 0.0).any())

    def _is_near(self, box: Box, margin: float) -> Mask:
        lows, highs = self._ends
        return np.asarray((np.maximum(lows - box.high, box.low - highs) <= margin).all(axis=1))

    def without(self, ids: Collection[str]) -> "Obstacles":
        """Returns these without some."""
        return self._where(lambda entry: entry.id not in ids) if ids else self

    def only(self, ids: Collection[str]) -> "Obstacles":
        """Returns some of these alone."""
        return self._where(lambda entry: entry.id in ids)

    def _where(self, is_wanted: Callable[[Entry], bool]) -> "Obstacles":
        rows = [row for row, entry in enumerate(self._entries) if is_wanted(entry)]
        return Obstacles((self._entries[row] for row in rows), lambda: (self._ends[0][rows], self._ends[1][rows]))

    def with_entries(self, new: Collection[Entry]) -> "Obstacles":
        """Returns these with others in the place of those of their ids."""
        rows, entries = {entry.id: row for row, entry in enumerate(self._entries)}, list(self._entries)
        for entry in new:
            entries[rows[entry.id]] = entry
        ends: Ends | None = self.__dict__.get("_ends")  # of many scenes they are never asked for
        return Obstacles(entries, ends and partial(_with_rows, ends, {rows[entry.id]: entry.box for entry in new}))

    def joined(self, others: "Obstacles") -> "Obstacles":
        """Returns these, then others."""
        ends = partial(_joined_ends, self, others)
        return Obstacles((entry for each in (self, others) for entry in each._entries), ends)

    def __iter__(self) -> Iterator[Obstacle]:
        self._note_all()
        return iter([entry.obstacle for entry in self._entries])

    def __len__(self) -> int:
        self._note_all()
        return len(self._entries)

    def __getitem__(self, number: int) -> Obstacle:
        self._note_all()
        return self._entries[number].obstacle

    def _note_all(self) -> None:
        for kind in self._kinds:
            note_whole(kind)


def _joined_ends(some: Obstacles, others: Obstacles) -> Ends:
    lows, highs = (np.concatenate(each) for each in zip(some._ends, others._ends, strict=True))
    return lows, highs


def _with_rows(ends: Ends, boxes: Mapping[int, Box]) -> Ends:
    lows, highs = (each.copy() for each in ends)
    for row, box in boxes.items():
        lows[row], highs[row] = box.low, box.high
    return lows, highs


def entry_of(kind: Read, name: str, mesh: TriangleMesh) -> Entry:
    """Returns a mesh at rest as an obstacle that is prepared when it is first asked for."""
    return Entry(kind, name, mesh.box, lambda: Obstacle(name, MeshCollider(mesh)))
