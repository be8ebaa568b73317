"""What a mesh file holds: named pieces with surfaces. It reads nothing."""

from dataclasses import dataclass
from typing import final

from grafu.geometry.appearance import Surface


@final
@dataclass(frozen=True)
class MeshPiece:
    """A named piece of a mesh file; the name is empty where the file gives none."""

    name: str
    surfaces: tuple[Surface, ...]


@final
@dataclass(frozen=True)
class MeshFile:
    """The pieces of a mesh file, in order, and notes on what was left out."""

    pieces: tuple[MeshPiece, ...]
    notes: tuple[str, ...] = ()

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """All surfaces of all pieces."""
        return tuple(s for piece in self.pieces for s in piece.surfaces)
