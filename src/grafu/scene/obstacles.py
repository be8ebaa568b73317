"""What a moving part may run into, found by boxes: most of it is far away, and what is not asked for is not read."""

from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import field
from functools import cached_property
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.scene.reads import Read, note_box, note_whole


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

    def __init__(self, entries: Iterable[Entry]) -> None:
        self._listed = entries

    @cached_property
    def _entries(self) -> tuple[Entry, ...]:
        """The obstacles, listed when first asked for: many are never."""
        return tuple(self._listed)

    @cached_property
    def _kinds(self) -> tuple[Read, ...]:
        return tuple({entry.kind: None for entry in self._entries})

    @cached_property
    def _ends(self) -> tuple[Points, Points]:
        lows = [entry.box.low for entry in self._entries]
        return np.reshape(lows, (-1, 3)), np.reshape([entry.box.high for entry in self._entries], (-1, 3))

    def near(self, box: Box, margin: float = 0.0) -> list[Obstacle]:
        """Returns those whose boxes come within a margin (metres) of a box."""
        for kind in self._kinds:
            note_box(kind, box, margin)
        lows, highs = self._ends
        is_near = (np.maximum(lows - box.high, box.low - highs) <= margin).all(axis=1)
        return [self._entries[k].obstacle for k in np.flatnonzero(is_near)]

    def without(self, ids: Collection[str]) -> "Obstacles":
        """Returns these without some."""
        return Obstacles(entry for entry in self._entries if entry.id not in ids) if ids else self

    def only(self, ids: Collection[str]) -> "Obstacles":
        """Returns some of these alone."""
        return Obstacles(entry for entry in self._entries if entry.id in ids)

    def joined(self, others: "Obstacles") -> "Obstacles":
        """Returns these, then others."""
        return Obstacles(entry for each in (self, others) for entry in each._entries)

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
