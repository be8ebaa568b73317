"""The kinds of functional edges as final types: a motion stands only where it can exist. No geometry here.

Four are the paper's; the authors' files know no others. `Slide`, `Turn`, and a joint whose parent is a moving part
itself, are predicted by networks that know all kinds of edges, or stated by the input or the user. That a joint follows
another (`coupling`) is never predicted.

Codes are the authors': `HingeBorder` names a border of the door's own box, `AxisSign` the sense of the
rotation axis along it (1 is positive), `SignedAxis` one of -X, +X, -Y, +Y, -Z, +Z. `grafu.graph.motion` turns them into
lines in space and back.
"""

from typing import ClassVar, Literal, final, get_args

from grafu.articulation.articulated_object import Coupling
from grafu.dataclass import dataclass
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
    """The door `child` turns on the support or moving part `parent`, about a border of its own box.

    The leader of a `coupling` is a part, and both values count from closed.

    Raises:
        GraphError: if `border` is not 0..3 or `sign` not 0 or 1.
    """

    joint_type: ClassVar = JointType.REVOLUTE
    parent: str
    child: str
    border: HingeBorder
    sign: AxisSign
    coupling: Coupling | None = None

    def __post_init__(self) -> None:
        _require_code("Hinge.border", self.border, BORDERS)
        _require_code("Hinge.sign", self.sign, SIGNS)


@final
@dataclass(frozen=True, slots=True)
class Rail:
    """The drawer `child` slides on the support or moving part `parent` and opens along a signed axis.

    Raises:
        GraphError: if `axis` is not 0..5.
    """

    joint_type: ClassVar = JointType.PRISMATIC
    parent: str
    child: str
    axis: SignedAxis
    coupling: Coupling | None = None

    def __post_init__(self) -> None:
        _require_code("Rail.axis", self.axis, SIGNED_AXES)


@final
@dataclass(frozen=True, slots=True)
class Slide:
    """A part that is no drawer slides on the support or moving part `parent` and opens along any signed axis.

    Raises:
        GraphError: if `axis` is not 0..5.
    """

    joint_type: ClassVar = JointType.PRISMATIC
    parent: str
    child: str
    axis: SignedAxis
    coupling: Coupling | None = None

    def __post_init__(self) -> None:
        _require_code("Slide.axis", self.axis, SIGNED_AXES)


@final
@dataclass(frozen=True, slots=True)
class Turn:
    """A part turns on the support or moving part `parent` about a signed axis, but about no border of its own box.

    Such are a knob, which turns about the axis across its thin side, and a part that is no door.

    Raises:
        GraphError: if `axis` is not 0..5.
    """

    joint_type: ClassVar = JointType.REVOLUTE
    parent: str
    child: str
    axis: SignedAxis
    coupling: Coupling | None = None

    def __post_init__(self) -> None:
        _require_code("Turn.axis", self.axis, SIGNED_AXES)


MotionEdge = Hinge | Rail | Slide | Turn
"""An edge that states how its child moves."""

Edge = Contact | Attached | MotionEdge

_KINDS: dict[type, EdgeKind] = {
    Contact: EdgeKind.CONTACT,
    Attached: EdgeKind.ATTACHED,
    Hinge: EdgeKind.HINGE,
    Rail: EdgeKind.RAIL,
    Slide: EdgeKind.SLIDE,
    Turn: EdgeKind.TURN,
}


def kind_of(edge: Edge) -> EdgeKind:
    """Returns the kind that the edge's type stands for."""
    return _KINDS[type(edge)]


def ends_of(edge: Edge) -> tuple[str, str]:
    """Returns the two ids: parent then child, or a contact's two in alphabetical order."""
    return (edge.a, edge.b) if isinstance(edge, Contact) else (edge.parent, edge.child)


def motion_of(edge: MotionEdge) -> tuple[EdgeKind, int, int, Coupling | None]:
    """Returns what the edge states of the motion alone: all edges of one part must agree in it."""
    code, sign = (edge.border, edge.sign) if isinstance(edge, Hinge) else (edge.axis, 0)
    return kind_of(edge), code, sign, edge.coupling


def _require_code(name: str, value: int, allowed: tuple[int, ...]) -> None:
    if isinstance(value, bool) or value not in allowed:
        raise GraphError(f"`{name}` must be one of {allowed[0]}..{allowed[-1]}: got {value!r}")
