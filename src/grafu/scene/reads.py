"""What of a scene was read while something was worked out: it holds for every scene in which that is the same.

Whoever works something out asks for what comes near a box, or by name. Where all of a kind is asked for, all is noted.
"""

from collections.abc import Iterator, Mapping
from contextvars import ContextVar
from enum import Enum
from typing import TypeVar, final

import numpy as np

from grafu.geometry.arrays import Points
from grafu.geometry.box import Box

T = TypeVar("T")
_PLAY = 1e-9  # metres: what rounding may make of a box


class Read(Enum):
    """What can be read of a scene: by boxes the first five, by names the others."""

    STILL = "static parts"
    HARDWARE = "static hardware"
    BODIES = "moving bodies at rest, with their hardware"
    BOXES = "the boxes around moving bodies with their hardware"
    PATHS = "the paths of moving bodies"
    PARTS = "parts"
    MEMBERS = "what moving bodies are made of"
    MOTIONS = "joint motions"


@final
class Reads:
    """What was read so far: boxes and names by kind, of which kinds all was read or counted; not a value."""

    def __init__(self) -> None:
        self.whole: set[Read] = set()
        self.counted: set[Read] = set()
        self._boxes: dict[Read, dict[bytes, None]] = {}
        self._names: dict[Read, dict[str, None]] = {}

    def box(self, kind: Read, box: Box, margin: float = 0.0) -> None:
        """Notes that what comes within a margin (metres) of a box was read."""
        grown = margin + _PLAY
        self._boxes.setdefault(kind, {})[np.concatenate([box.low - grown, box.high + grown]).tobytes()] = None

    def name(self, kind: Read, name: str) -> None:
        """Notes that what has a name was read, or that nothing has it."""
        self._names.setdefault(kind, {})[name] = None

    def names(self, kind: Read) -> tuple[str, ...]:
        """Returns the names that were read."""
        return tuple(self._names.get(kind, ()))

    def met(self, kind: Read, lows: Points, highs: Points) -> np.ndarray:
        """Returns which of some boxes, given by their corners, were read."""
        if kind in self.whole:
            return np.ones(len(lows), dtype=bool)
        asked = np.frombuffer(b"".join(self._boxes.get(kind, ()))).reshape(-1, 6)
        if not len(asked) or not len(lows):
            return np.zeros(len(lows), dtype=bool)
        meets = (lows[:, None] <= asked[:, 3:]) & (highs[:, None] >= asked[:, :3])
        return np.asarray(np.any(np.all(meets, axis=2), axis=1))


_present: ContextVar[Reads | None] = ContextVar("reads", default=None)


@final
class Noting:
    """Notes what is read meanwhile: `with Noting() as reads`."""

    def __enter__(self) -> Reads:
        reads = Reads()
        self._token = _present.set(reads)
        return reads

    def __exit__(self, *what: object) -> None:
        _present.reset(self._token)


def note_box(kind: Read, box: Box, margin: float = 0.0) -> None:
    """Notes, if anyone does, that what comes within a margin (metres) of a box is read."""
    if (reads := _present.get()) is not None:
        reads.box(kind, box, margin)


def note_whole(kind: Read) -> None:
    """Notes, if anyone does, that all of a kind is read."""
    if (reads := _present.get()) is not None:
        reads.whole.add(kind)


@final
class Noted(Mapping[str, T]):
    """A mapping, `plain`, that notes which names are read; whoever goes on after the first reads all."""

    def __init__(self, kind: Read, plain: Mapping[str, T]) -> None:
        self.kind = kind
        self.plain: Mapping[str, T] = plain

    def __getitem__(self, name: str) -> T:
        if (reads := _present.get()) is not None:
            reads.name(self.kind, name)
        return self.plain[name]

    def __iter__(self) -> Iterator[str]:
        for number, name in enumerate(self.plain):
            if number == 1:
                note_whole(self.kind)
            yield name

    def __len__(self) -> int:
        if (reads := _present.get()) is not None:
            reads.counted.add(self.kind)
        return len(self.plain)


def with_items(mapping: Mapping[str, T], items: Mapping[str, T]) -> Mapping[str, T]:
    """Returns a mapping with some items added or in the place of others; one that notes goes on noting."""
    merged = {**plain(mapping), **items}
    return Noted(mapping.kind, merged) if isinstance(mapping, Noted) else merged


def plain(mapping: Mapping[str, T]) -> Mapping[str, T]:
    """Returns what a mapping holds: reading that is not noted."""
    return mapping.plain if isinstance(mapping, Noted) else mapping
