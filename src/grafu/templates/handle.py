"""What a handle template is: a shape that can be built at any length and protrusion. It knows no door and no metal.

Handle frame: the foot plane is y = 0 and the origin its middle; +X runs along the handle's long side, -Y points away
from the front that the handle lies on, +Z is up. So a drawer that faces -Y takes a handle as it is, and a door turns it
upright about Y where `turns` says that this makes sense (a cup or a drop handle hangs level everywhere).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, final

from grafu.errors import TemplateError
from grafu.geometry.mesh import TriangleMesh

HandleFamily = Literal["bar", "knob", "cup"]


@final
@dataclass(frozen=True, slots=True)
class HandleSize:
    """Metres: `length` along x, `protrusion` from the foot plane to the farthest point before it.

    Raises:
        TemplateError: if a size is not above 0.
    """

    length: float
    protrusion: float

    def __post_init__(self) -> None:
        if not (self.length > 0 and self.protrusion > 0):
            raise TemplateError(f"a handle's sizes must be above 0: got {self.length}, {self.protrusion}")


@final
@dataclass(frozen=True)
class HandleTemplate:
    """A handle that can be built at any size; `natural` is its real-world size, `longest` its greatest sensible length.

    `shape` returns closed meshes with outward faces that fill the length in x and the protrusion in -Y exactly.
    """

    id: str
    title: str
    family: HandleFamily
    natural: HandleSize
    longest: float
    shape: Callable[[float, float], tuple[TriangleMesh, ...]]
    turns: bool = True

    def __post_init__(self) -> None:
        if not self.longest >= self.natural.length:
            raise TemplateError(f"`longest` of handle `{self.id}` must reach {self.natural.length}: got {self.longest}")

    def build(self, length: float | None = None, protrusion: float | None = None) -> tuple[TriangleMesh, ...]:
        """Returns the handle at a length and a protrusion, metres (none: the natural ones).

        Raises:
            TemplateError: if a size is not above 0.
        """
        size = HandleSize(
            self.natural.length if length is None else length,
            self.natural.protrusion if protrusion is None else protrusion,
        )
        return self.shape(size.length, size.protrusion)
