"""What a template is: a mechanism with two ends, a motion axis, snap planes and a range; or a handle of any length.

Hinge frame, closed: the pin runs through the origin along +Z, which is also the opening axis (right-hand rule). +X
points from the pin across the moving part, +Y is where the moving part sets off to when it opens. A snap plane's normal
points from the template to the part that its end is mounted on (supplement, Template Annotation):

    class   static end              dynamic end
    C       leaf along -Y, n = -X   leaf along -Y, n = +X     the leaves lie stacked in the seam
    F       leaf along -X, n = -Y   leaf along +X, n = -Y     the leaves lie on two flush faces
    P       leaf along +Y, n = -X   leaf along +X, n = -Y     the leaves line an inner corner

Rail frame, closed: +X points from the wall to the drawer, +Z up, and the drawer slides out along -Y. The origin is the
centre of the static snap plane (n = -X, x = 0); the dynamic one has n = +X, x = thickness. The other rail mirrors it.

Handle frame: the foot plane is y = 0 and the origin its middle; +X runs along the handle's long side, -Y points away
from the front that the handle lies on, +Z is up. A drawer that faces -Y takes a handle as it is; a door turns it about
Y where `turns` states that.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import ClassVar, Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import OptionError, TemplateError, did_you_mean
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import ArrayValue, Mat4, Vec3, freeze_arrays
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import transform_points
from grafu.templates.concealed import ConcealedModel
from grafu.vocabulary import JointType, MechanismClass

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

    `shape` returns watertight meshes with outward faces that fill the length in x and the protrusion in -Y exactly.
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


@final
@dataclass(frozen=True, eq=False, slots=True)
class SnapPlane(ArrayValue):
    """A rectangle that comes to lie on a part: centre, unit normal (towards the part), half-extent vectors u and v."""

    center: Vec3
    normal: Vec3
    u: Vec3
    v: Vec3

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)
        across = max(abs(float(self.normal @ self.u)), abs(float(self.normal @ self.v)), abs(float(self.u @ self.v)))
        size = float(np.linalg.norm(self.u) * np.linalg.norm(self.v))
        if abs(float(np.linalg.norm(self.normal)) - 1) > 1e-6 or size <= 0 or across > 1e-6:
            found = f"{self.normal}, {self.u}, {self.v}"
            raise TemplateError(f"a snap plane needs a unit normal square to two extents: got {found}")

    def transformed(self, T: Mat4) -> "SnapPlane":
        """Returns the plane mapped by a similarity T (normals and extents like displacements)."""
        L = T[:3, :3]
        normal = L @ self.normal
        center = transform_points(T, np.asarray(self.center)[None])[0]
        return SnapPlane(center, normal / np.linalg.norm(normal), L @ self.u, L @ self.v)


@final
@dataclass(frozen=True)
class TemplateEnd:
    """One end of a mechanism: what it looks like and where it meets its part."""

    surfaces: tuple[Surface, ...]
    snap: SnapPlane

    @cached_property
    def mesh(self) -> TriangleMesh:
        """All surfaces as one mesh."""
        return merge_meshes([s.mesh for s in self.surfaces])

    def transformed(self, T: Mat4) -> "TemplateEnd":
        """Returns the end mapped by T."""
        return TemplateEnd(tuple(s.transformed(T) for s in self.surfaces), self.snap.transformed(T))


@final
@dataclass(frozen=True, slots=True)
class HingeSize:
    """Metres: `length` along the pin, `leaf` from the pin to the leaf's far edge, leaf `thickness`, barrel `radius`."""

    length: float
    leaf: float
    thickness: float
    radius: float

    def scaled(self, factor: float) -> "HingeSize":
        """Returns all four sizes times `factor`."""
        return HingeSize(self.length * factor, self.leaf * factor, self.thickness * factor, self.radius * factor)


@final
@dataclass(frozen=True)
class HingeTemplate:
    """A hinge in its own frame, closed. `range` is the widest opening in radians, in (0, 2 pi)."""

    joint_type: ClassVar = JointType.REVOLUTE
    id: str
    mechanism: MechanismClass
    static: TemplateEnd
    dynamic: TemplateEnd
    range: float
    size: HingeSize

    def __post_init__(self) -> None:
        if not 0 < self.range < 2 * np.pi:
            raise TemplateError(f"the range of hinge `{self.id}` must be in (0, 2 pi) radians: got {self.range}")

    def scaled(self, factor: float) -> "HingeTemplate":
        """Returns the template with all lengths times `factor`."""
        T = np.diag([factor, factor, factor, 1.0])
        static, dynamic = self.static.transformed(T), self.dynamic.transformed(T)
        return replace(self, static=static, dynamic=dynamic, size=self.size.scaled(factor))


@final
@dataclass(frozen=True, slots=True)
class RailSize:
    """Metres: `length` along the slide, `height`, and `thickness` from wall to drawer flank."""

    length: float
    height: float
    thickness: float

    def scaled(self, factor: float) -> "RailSize":
        """Returns all three sizes times `factor`."""
        return RailSize(self.length * factor, self.height * factor, self.thickness * factor)


@final
@dataclass(frozen=True)
class RailTemplate:
    """One rail of a pair in its own frame, closed. `range` is the widest travel in metres.

    `support` is the plane under the drawer's bottom (n = +Z) for mounts that carry the drawer from below, else None.
    """

    joint_type: ClassVar = JointType.PRISMATIC
    id: str
    mechanism: MechanismClass
    static: TemplateEnd
    dynamic: TemplateEnd
    range: float
    size: RailSize
    support: SnapPlane | None = None

    def __post_init__(self) -> None:
        if not 0 < self.range <= self.size.length:
            raise TemplateError(f"the range of rail template `{self.id}` must be in (0, its length]: got {self.range}")

    def scaled(self, factor: float) -> "RailTemplate":
        """Returns the template with all lengths times `factor`."""
        size, T = self.size.scaled(factor), np.diag([factor, factor, factor, 1.0])
        support = None if self.support is None else self.support.transformed(T)
        static, dynamic = self.static.transformed(T), self.dynamic.transformed(T)
        reach = min(factor * self.range, size.length)
        return replace(self, static=static, dynamic=dynamic, range=reach, size=size, support=support)


@final
@dataclass(frozen=True)
class HingeModel:
    """A hinge template that can be built at any size; `natural` is its real-world size in metres."""

    id: str
    title: str
    mechanism: MechanismClass
    natural: HingeSize
    build: Callable[[HingeSize], HingeTemplate]

    def at_scale(self, metre: float) -> "HingeModel":
        """Returns the template for furniture on which a metre is `metre` metres long, screws in scale."""
        return replace(
            self,
            natural=self.natural.scaled(metre),
            build=lambda size: self.build(size.scaled(1 / metre)).scaled(metre),
        )


@final
@dataclass(frozen=True)
class RailModel:
    """A rail template that can be built at any size; `natural` is its real-world size in metres."""

    id: str
    title: str
    mechanism: MechanismClass
    natural: RailSize
    build: Callable[[RailSize], RailTemplate]

    def at_scale(self, metre: float) -> "RailModel":
        """Returns the template for furniture on which a metre is `metre` metres long, screws in scale."""
        return replace(
            self,
            natural=self.natural.scaled(metre),
            build=lambda size: self.build(size.scaled(1 / metre)).scaled(metre),
        )


@final
@dataclass(frozen=True)
class Gallery:
    """All templates at hand, in order of preference within each class."""

    hinges: tuple[HingeModel, ...]
    rails: tuple[RailModel, ...]
    concealed: tuple[ConcealedModel, ...] = ()

    def __post_init__(self) -> None:
        ids = [h.id for h in self.hinges] + [r.id for r in self.rails] + [c.id for c in self.concealed]
        if len(set(ids)) < len(ids):
            raise TemplateError(f"template ids must be unique: got {sorted(i for i in ids if ids.count(i) > 1)}")

    def hinges_of(self, mechanism: MechanismClass) -> tuple[HingeModel, ...]:
        """Returns the hinges of one class, best first."""
        return tuple(h for h in self.hinges if h.mechanism is mechanism)

    def preferring(self, hinge: str) -> "Gallery":
        """Returns the gallery with one hinge before all others of its class ("": as it is).

        Raises:
            OptionError: if no hinge has this id.
        """
        if not hinge:
            return self
        known = [model.id for model in self.hinges] + [model.id for model in self.concealed]
        if hinge not in known:
            raise OptionError(
                f"the preferred hinge must be one of {', '.join(known)}: got {hinge!r}{did_you_mean(hinge, known)}"
            )
        return replace(self, hinges=tuple(sorted(self.hinges, key=lambda model: model.id != hinge)))

    def at_scale(self, metre: float) -> "Gallery":
        """Returns the gallery for furniture on which a metre is `metre` metres long; it is to be asked for once."""
        if metre == 1.0:
            return self
        concealed = tuple(model.at_scale(metre) for model in self.concealed)
        hinges, rails = tuple(h.at_scale(metre) for h in self.hinges), tuple(r.at_scale(metre) for r in self.rails)
        return Gallery(hinges, rails, concealed)

    def extended(self, other: "Gallery") -> "Gallery":
        """Returns both galleries as one; the other's templates come first."""
        concealed = other.concealed + self.concealed
        return Gallery(other.hinges + self.hinges, other.rails + self.rails, concealed)
