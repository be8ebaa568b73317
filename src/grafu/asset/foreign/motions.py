"""What another system predicted: parts and joints in its file's own coordinates, one value for all formats.

It reads no files and matches nothing: an asset's own parts come in with `grafu.asset.foreign.attach`.
"""

from collections.abc import Set
from functools import cached_property
from typing import Literal, Protocol, final, runtime_checkable

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import AssetError
from grafu.geometry.arrays import ArrayValue, Mat4, frozen_array
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType, PartLabel

ForeignSource = Literal["particulate", "singapo", "grafu-pred", "urdf"]


@runtime_checkable
class MotionCode(Protocol):
    """A motion that is said by sides of a part's box, as in the authors' graphs: the true box gives the true axis."""

    def axis_on(self, box: Box) -> Axis:
        """Returns the axis on a box, both in the file's coordinates."""


@final
@dataclass(frozen=True)
class ForeignPart:
    """A predicted part: its mesh, or the mesh of its box where the format gives only that (`is_box`).

    `parent` names the part that carries this one; a part without a joint is fixed to it. `label` is `unknown` where
    the format has none. `slot` is the part's place in the input's order, where the format states it.
    """

    name: str
    mesh: TriangleMesh
    is_box: bool = False
    label: PartLabel = PartLabel.UNKNOWN
    parent: str | None = None
    slot: int | None = None


@final
@dataclass(frozen=True)
class ForeignJoint:
    """How a part moves against its parent, signs and limits as the file states them (radians, or the file's lengths).

    `limited=False`: the file states no limits. With a `code` the axis is only as good as the predicted box, and is
    taken anew on the box of the part that it is matched with.
    """

    part: str
    type: JointType
    axis: Axis
    lower: float = 0.0
    upper: float = 0.0
    limited: bool = True
    code: MotionCode | None = None


@final
@dataclass(frozen=True, eq=False, slots=True)
class JointFrame(ArrayValue):
    """A frame in which the joints may be stated: its name in words, and the transform to the parts' coordinates."""

    name: str
    T_parts_joints: Mat4

    def __post_init__(self) -> None:
        object.__setattr__(self, "T_parts_joints", frozen_array(self.T_parts_joints))


AS_PARTS = JointFrame("", np.eye(4))


@final
@dataclass(frozen=True)
class ForeignMotions:
    """A prediction as its file states it.

    `joint_frames` are the frames in which the joints may be stated; where there are several, geometry decides which.
    `notes` state in words what was left out.

    Raises:
        AssetError: if there is no part, names repeat, or a parent or joint names a part that is not there.
    """

    source: ForeignSource
    path: str
    parts: tuple[ForeignPart, ...]
    joints: tuple[ForeignJoint, ...]
    joint_frames: tuple[JointFrame, ...] = (AS_PARTS,)
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        names = [part.name for part in self.parts]
        jointed = [joint.part for joint in self.joints]
        if not names or not self.joint_frames:
            raise AssetError(f"{self.path} predicts no part: expected the parts of one object")
        for what, listed in (("parts", names), ("joints", jointed)):
            if len(set(listed)) < len(listed):
                raise AssetError(f"{self.path}: {what} must be unique: got {sorted(listed)}")
        lost = ({p.parent for p in self.parts if p.parent is not None} | set(jointed)) - set(names)
        if lost:
            raise AssetError(f"{self.path}: parents and joints must name parts: there is no {sorted(lost)}")
        rooted: set[str | None] = {None}
        for part in self.parts:
            rooted |= self._rooted(part, rooted)

    def _rooted(self, part: ForeignPart, known: Set[str | None]) -> set[str]:
        """Returns a part and what carries it, up to what is known."""
        seen = {part.name}
        while part.parent not in known:
            part = self._by_name[str(part.parent)]
            if part.name in seen:
                raise AssetError(f"{self.path}: parts must form a tree: {part.name} carries itself")
            seen.add(part.name)
        return seen

    @cached_property
    def _by_name(self) -> dict[str, ForeignPart]:
        return {part.name: part for part in self.parts}

    @cached_property
    def labels(self) -> dict[str, PartLabel]:
        """The label of each part."""
        return {part.name: part.label for part in self.parts}

    @cached_property
    def body_of(self) -> dict[str, str | None]:
        """For each part the jointed part that it moves with (itself, where it has a joint); None: it stays."""
        jointed = {joint.part for joint in self.joints}
        found: dict[str, str | None] = {}
        for part in self.parts:
            above: list[str] = []
            name: str | None = part.name
            while name is not None and name not in found and name not in jointed:
                above.append(name)
                name = self._by_name[name].parent
            body = found.get(name, name) if name is not None else None
            found |= dict.fromkeys([*above, part.name], body)
        return {part.name: found[part.name] for part in self.parts}

    def carrier_of(self, part: str) -> str | None:
        """Returns the jointed part that carries a part's body, or None where that stands on what stays."""
        parent = self._by_name[part].parent
        return None if parent is None else self.body_of[parent]
