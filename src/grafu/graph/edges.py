"""The kinds of functional edges as final types: a motion stands only where it can exist. No geometry here.

Four are the paper's; the network and the authors' files know no others. `Slide` stands in graphs that were completed by
what the input or the user states, and in graphs as built.

Codes are the authors' (official.md 3): `HingeBorder` names a border of the door's own box, `AxisSign` the sense of the
rotation axis along it (1 is positive), `SignedAxis` one of -X, +X, -Y, +Y, -Z, +Z. `grafu.graph.motion` turns them into
lines in space and back.
"""

from dataclasses import dataclass
from typing import ClassVar, Literal, final, get_args

from grafu.errors import GraphError
from grafu.vocabulary import EdgeKind, JointType

HingeBorder = Literal[0, 1, 2, 3]
AxisSign = Literal[0, 1]
SignedAxis = Literal[0, 1, 2, 3, 4, 5]

BORDERS: tuple[HingeBorder, ...] = get_args(HingeBorder)
SIGNS: tuple[AxisSign, ...] = get_args(AxisSign)
SIGNED_AXES: tuple[SignedAxis, ...] = get_args(SignedAxis)


@final
@dataclass(frozen=True, slots=True)
class Contact:
    """Two parts touch. It has no direction: the two ids are kept in alphabetical order."""

    a: str
    b: str

    def __post_init__(self) -> None:
        if self.b < self.a:
            first, second = self.b, self.a
            object.__setattr__(self, "a", first)
            object.__setattr__(self, "b", second)


@final
@dataclass(frozen=True, slots=True)
class Attached:
    """The handle `child` is fixed to the door or drawer `parent`."""

    parent: str
    child: str


@final
@dataclass(frozen=True, slots=True)
class Hinge:
    """The door `child` turns on the support `parent`, about a border of the door's box (official.md 3.2).

    Raises:
        GraphError: if `border` is not 0..3 or `sign` not 0 or 1.
    """

    joint_type: ClassVar = JointType.REVOLUTE
    parent: str
    child: str
    border: HingeBorder
    sign: AxisSign

    def __post_init__(self) -> None:
        _require_code("Hinge.border", self.border, BORDERS)
        _require_code("Hinge.sign", self.sign, SIGNS)


@final
@dataclass(frozen=True, slots=True)
class Rail:
    """The drawer `child` slides on the support `parent` and opens along a signed axis.

    Raises:
        GraphError: if `axis` is not 0..5.
    """

    joint_type: ClassVar = JointType.PRISMATIC
    parent: str
    child: str
    axis: SignedAxis

    def __post_init__(self) -> None:
        _require_code("Rail.axis", self.axis, SIGNED_AXES)


@final
@dataclass(frozen=True, slots=True)
class Slide:
    """The door `child` slides on the support `parent` and opens along a signed axis, which may be any of the case's.

    Raises:
        GraphError: if `axis` is not 0..5.
    """

    joint_type: ClassVar = JointType.PRISMATIC
    parent: str
    child: str
    axis: SignedAxis

    def __post_init__(self) -> None:
        _require_code("Slide.axis", self.axis, SIGNED_AXES)


Edge = Contact | Attached | Hinge | Rail | Slide

_KINDS: dict[type, EdgeKind] = {
    Contact: EdgeKind.CONTACT,
    Attached: EdgeKind.ATTACHED,
    Hinge: EdgeKind.HINGE,
    Rail: EdgeKind.RAIL,
    Slide: EdgeKind.SLIDE,
}


def kind_of(edge: Edge) -> EdgeKind:
    """Returns the kind that the edge's type stands for."""
    return _KINDS[type(edge)]


def ends_of(edge: Edge) -> tuple[str, str]:
    """Returns the two ids: parent then child, or a contact's two in alphabetical order."""
    return (edge.a, edge.b) if isinstance(edge, Contact) else (edge.parent, edge.child)


def as_paper(edge: Edge) -> Edge:
    """Returns the edge as the paper's four kinds can say it: of a slide, that the two parts touch."""
    return Contact(edge.parent, edge.child) if isinstance(edge, Slide) else edge


def _require_code(name: str, value: int, allowed: tuple[int, ...]) -> None:
    if isinstance(value, bool) or value not in allowed:
        raise GraphError(f"`{name}` must be one of {allowed[0]}..{allowed[-1]}: got {value!r}")
