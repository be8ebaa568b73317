"""Furniture as judges see it: named meshes at rest, closed, and how bodies of them move. It judges nothing.

All is in the object frame: metres, Z up, front -Y.
"""

from collections.abc import Mapping
from dataclasses import field, replace
from functools import cached_property
from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import PartLabel

Origin = Literal["input", "added", "hardware"]
"""Where a part comes from: the input, what was added (a handle, a top, a shelf), or hinges, rails and blocks."""


@final
@dataclass(frozen=True)
class JudgedPart:
    """One mesh with its name, category and origin."""

    name: str
    mesh: TriangleMesh
    label: PartLabel = PartLabel.UNKNOWN
    origin: Origin = "input"

    @property
    def is_handle(self) -> bool:
        """Whether it is a handle: something to pull at that stands out; a carved grip is none."""
        return self.label is PartLabel.HANDLE and self.origin != "hardware" and len(self.mesh.faces) > 0


@final
@dataclass(frozen=True)
class JudgedMotion:
    """A turn about an axis (radians, `turns`) or a shift along it (metres), from `lower` to `upper`; positive opens."""

    turns: bool
    axis: Axis
    lower: float
    upper: float

    def at(self, value: float) -> Mat4:
        """Returns the 4x4 motion from rest at a value."""
        return self.axis.rotation(value) if self.turns else self.axis.shift(value)

    def seen_after(self, T: Mat4) -> "JudgedMotion":
        """Returns the motion of a body that was moved by T."""
        return replace(self, axis=self.axis.transformed(T, rotational=self.turns))


@final
@dataclass(frozen=True)
class JudgedBody:
    """What moves together. `motion` is None where it is fixed; `starts` are the values of others as it sets off."""

    id: str
    parts: tuple[JudgedPart, ...]
    motion: JudgedMotion | None = None
    starts: Mapping[str, float] = field(default_factory=dict)

    @cached_property
    def mesh(self) -> TriangleMesh:
        """All its parts as one mesh, hardware included."""
        return merge_meshes([part.mesh for part in self.parts])

    @property
    def handles(self) -> tuple[JudgedPart, ...]:
        """Its handles; carved grips are none."""
        return tuple(part for part in self.parts if part.is_handle)


@final
@dataclass(frozen=True)
class JudgedPiece:
    """A piece of furniture: what is static, and its other bodies."""

    still: tuple[JudgedPart, ...]
    bodies: tuple[JudgedBody, ...] = ()

    @property
    def moving(self) -> tuple[JudgedBody, ...]:
        """The bodies that move."""
        return tuple(body for body in self.bodies if body.motion is not None)

    @cached_property
    def still_mesh(self) -> TriangleMesh:
        """All that is static as one mesh, hardware included."""
        return merge_meshes([part.mesh for part in self.still])

    @property
    def parts(self) -> tuple[JudgedPart, ...]:
        """All parts, static ones first."""
        return (*self.still, *(part for body in self.bodies for part in body.parts))

    @cached_property
    def largest_side(self) -> float:
        """The largest side without hardware, metres; 0 where there is nothing."""
        boxes = [part.mesh.box for part in self.parts if part.origin != "hardware" and len(part.mesh.faces)]
        return float(Box.enclosing(boxes).size.max()) if boxes else 0.0

    def seen_after(self, T: Mat4) -> "JudgedPiece":
        """Returns the piece, motions included, as it stands after T."""

        def moved(parts: tuple[JudgedPart, ...]) -> tuple[JudgedPart, ...]:
            return tuple(replace(part, mesh=part.mesh.transformed(T)) for part in parts)

        bodies = tuple(
            replace(body, parts=moved(body.parts), motion=body.motion and body.motion.seen_after(T))
            for body in self.bodies
        )
        return JudgedPiece(moved(self.still), bodies)
