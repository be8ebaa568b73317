"""What every reader returns: an asset of parts in the object frame. It reads no files."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import Final, Literal, final

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.labels import label_of
from grafu.dataclass import dataclass
from grafu.errors import AssetError
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import ArrayValue, Mat4, frozen_array
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.visible import writable
from grafu.vocabulary import JointType, PartLabel

AssetKind = Literal[
    "partnet-mobility", "hssd", "urdf", "sdf", "mjcf", "usd", "glb", "mesh folder", "mesh file", "release", "made"
]
ROBOTS: Final = ("urdf", "sdf", "mjcf", "usd")
"""The kinds that describe links and joints as robots have them; `usd`: a scene with rigid bodies and joints."""


@final
@dataclass(frozen=True, slots=True)
class PartSource:
    """Where a part came from: its original name, and the file and link that held it (empty where there is none).

    Names are kept as UTF-8 can hold them (`writable`).
    """

    name: str
    file: str = ""
    link: str = ""

    def __post_init__(self) -> None:
        for field in ("name", "file", "link"):
            object.__setattr__(self, field, writable(getattr(self, field)))


@final
@dataclass(frozen=True, repr=False)
class Part:
    """One part, its surfaces in the object frame (metres, Z up, front -Y).

    `id` is unique and safe in URDF and USD. `labelled_by` states what the label rests on ("joint": what the input
    states about its motion; "added": the part is new; "hidden": the user hid it, and no name is to tell it).
    `carried_by` is the id of the moving part that carries this one, where the input states it (a handle in a door's
    link, a knob on a drawer).
    """

    id: str
    label: PartLabel
    surfaces: tuple[Surface, ...]
    source: PartSource
    labelled_by: Literal["name", "shape", "annotation", "joint", "user", "prediction", "added", "hidden", "none"] = (
        "none"
    )
    carried_by: str | None = None

    def __repr__(self) -> str:
        return f"<Part {self.id}: {self.label}, {sum(len(s.mesh.faces) for s in self.surfaces):,} faces>"

    @cached_property
    def mesh(self) -> TriangleMesh:
        """All surfaces as one mesh."""
        return merge_meshes([s.mesh for s in self.surfaces])

    @property
    def box(self) -> Box:
        """The axis-aligned box of the mesh."""
        return self.mesh.box


@final
@dataclass(frozen=True)
class AnnotatedJoint:
    """A joint that the input itself states: the moving part, the axis in the object frame, limits as stated.

    Limits are radians or metres along `axis`; unlike a `Joint`'s they may be negative, reversed or not start at 0,
    and `limited=False` states that the input states none. `stated_by` names who predicted it, where the input did not
    state it. With a `coupling` the input states that it follows the joint of another part, which it names. `members`
    are other parts of the same rigid body, and what that carries, where they do not ride on the part (`carried_by`).
    """

    part: str
    type: JointType
    axis: Axis
    lower: float
    upper: float
    limited: bool = True
    stated_by: str = "annotation"
    coupling: Coupling | None = None
    members: tuple[str, ...] = ()


@final
@dataclass(frozen=True)
class Annotation:
    """What an input states about its motions: its parts as its moving bodies group, label and carry them; their joints.

    The pieces of a body that moves are one part here, whatever they are called. `notes` states what was decided.
    `small_joints` are those of knobs, buttons and wheels: parts of what carries them unless small parts are asked for.

    Raises:
        AssetError: if part ids repeat, or `carried_by` or a joint names a part that is not there.
    """

    parts: tuple[Part, ...]
    joints: tuple[AnnotatedJoint, ...] = ()
    notes: tuple[str, ...] = ()
    small_joints: tuple[AnnotatedJoint, ...] = ()

    def __post_init__(self) -> None:
        _check_names(self.parts, (*self.joints, *self.small_joints), "an annotation")

    def of_parts(self, parts: tuple[Part, ...]) -> "Annotation":
        """Returns the annotation of these parts alone: joints of others, and followers of such, are left out."""
        known = {part.id for part in parts}
        freed = tuple(replace(p, carried_by=None) if p.carried_by not in known else p for p in parts)
        joints = tuple(
            replace(joint, coupling=joint.coupling if joint.coupling and joint.coupling.leader in known else None)
            for joint in self.joints
            if joint.part in known
        )
        small = tuple(
            replace(joint, members=tuple(member for member in joint.members if member in known))
            for joint in self.small_joints
            if joint.part in known
        )
        return replace(self, parts=freed, joints=joints, small_joints=small)


@final
@dataclass(frozen=True, eq=False, slots=True)
class Frame(ArrayValue):
    """How the input's own coordinates became the object frame.

    `input_to_output` is a similarity (4x4, row-major): from the coordinates of the input's mesh files (for a URDF: its
    static root link's) to the object frame. `up` and `front` are directions in the input's coordinates, spelled
    like `+Y`; `scale` is metres per input unit; `assumed` states in words what was decided and why.
    """

    input_to_output: Mat4
    up: str
    front: str
    scale: float
    assumed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "input_to_output", frozen_array(self.input_to_output))


IDENTITY_FRAME = Frame(np.eye(4), "+Z", "-Y", 1.0)


@final
@dataclass(frozen=True, eq=False, slots=True)
class Standing(ArrayValue):
    """How one of several pieces of furniture stands in a scene: its parts, by their ids, and where it faces.

    `T_piece_object` (4x4, rigid) maps the object frame to that of the piece, in which its front is -Y. `frame` is how
    the piece would be read alone; its words state what its front rests on.
    """

    parts: tuple[str, ...]
    T_piece_object: Mat4
    frame: Frame

    def __post_init__(self) -> None:
        object.__setattr__(self, "T_piece_object", frozen_array(self.T_piece_object))


@final
@dataclass(frozen=True, repr=False)
class Asset:
    """A part-segmented model in the object frame.

    Of a file, `parts` are read without its joints: the same with them and without. What it states about its motions is
    the `annotation`, in the same frame, and `as_annotated` is how that sees it. `joints` are those of an asset that was
    read so, that was made with joints, or that another system's were attached to; `small_joints` as in an `Annotation`.
    Where it holds several pieces of furniture, `standings` states how each stands; a part of none is floor, wall or
    prop. There are none where it is one piece.

    Name, path and notes are kept as UTF-8 can hold them (`writable`).

    Raises:
        AssetError: if part ids repeat, or `carried_by` or a joint names a part that is not there.
    """

    name: str
    path: str
    kind: AssetKind
    parts: tuple[Part, ...]
    frame: Frame = IDENTITY_FRAME
    joints: tuple[AnnotatedJoint, ...] = ()
    notes: tuple[str, ...] = ()  # what the reader left out or mended, in words
    annotation: Annotation | None = None
    small_joints: tuple[AnnotatedJoint, ...] = ()
    standings: tuple[Standing, ...] = ()

    def __repr__(self) -> str:
        return f"<Asset {self.name}: {self.kind}, {len(self.parts)} parts>"

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", writable(self.name))
        object.__setattr__(self, "path", writable(self.path))
        object.__setattr__(self, "notes", tuple(map(writable, self.notes)))
        _check_names(self.parts, (*self.joints, *self.small_joints), self.path or self.name)

    @cached_property
    def _by_id(self) -> dict[str, Part]:
        return {part.id: part for part in self.parts}

    def part(self, part_id: str) -> Part:
        """Returns the part with this id. Raises KeyError where there is none."""
        return self._by_id[part_id]

    @cached_property
    def box(self) -> Box:
        """The box around all parts."""
        return Box.enclosing(part.box for part in self.parts)

    def standing_of(self, part_id: str) -> Standing | None:
        """Returns how the piece that has this part stands; None where there is one piece, or the part is of none."""
        return next((standing for standing in self.standings if part_id in standing.parts), None)

    @property
    def extent(self) -> float:
        """The object's largest side in metres: the paper's unit cube (metrics scale by it)."""
        return float(self.box.size.max())

    @property
    def stated_joints(self) -> tuple[AnnotatedJoint, ...]:
        """The joints that the input itself states, read or not; their parts are those of `as_annotated`."""
        found = self.joints if self.annotation is None else self.annotation.joints
        return tuple(joint for joint in found if joint.stated_by == "annotation")

    def as_annotated(self) -> "Asset":
        """Returns the asset as its annotation sees it, with its joints; itself where it has no annotation apart."""
        found = self.annotation
        if found is None:
            return self
        notes = tuple(dict.fromkeys((*self.notes, *found.notes)))
        seen = replace(self, parts=found.parts, joints=found.joints, small_joints=found.small_joints)
        return replace(seen, notes=notes, annotation=None)

    def without_annotation(self) -> "Asset":
        """Returns the same parts without the joints and attachments of the input, and without labels from joints alone.

        Of an asset as a file is read, these are the parts of the same file without joints. Of one `as_annotated`, that
        some pieces are one part is kept: a method that is given them knows what belongs together, not how it moves.
        """
        bare = tuple(_without_annotation(part) for part in self.parts)
        return replace(self, parts=bare, joints=(), small_joints=(), annotation=None)

    def with_labels(self, labels: dict[str, PartLabel]) -> "Asset":
        """Returns the same asset with some parts relabelled by the user or a prediction."""
        parts = tuple(replace(p, label=labels[p.id]) if p.id in labels else p for p in self.parts)
        return replace(self, parts=parts)


def moved_joints(joints: Sequence[AnnotatedJoint], T: Mat4, scale: float) -> tuple[AnnotatedJoint, ...]:
    """Returns joints mapped by T, which makes lengths `scale` times as long: limits and couplings too."""
    growth = {joint.part: motion_kind(joint.type).length_scale(scale) for joint in joints}

    def moved(joint: AnnotatedJoint) -> AnnotatedJoint:
        kind, coupling = motion_kind(joint.type), joint.coupling
        own = kind.length_scale(scale)
        if coupling is not None:
            multiplier = coupling.multiplier * own / growth[coupling.leader]
            coupling = replace(coupling, multiplier=multiplier, offset=coupling.offset * own)
        axis = kind.mapped_axis(joint.axis, T)
        return replace(joint, axis=axis, lower=joint.lower * own, upper=joint.upper * own, coupling=coupling)

    return tuple(map(moved, joints))


def _check_names(parts: tuple[Part, ...], joints: tuple[AnnotatedJoint, ...], whose: str) -> None:
    known = {part.id for part in parts}
    if len(known) < len(parts):
        raise AssetError(f"part ids must be unique: {whose} repeats one")
    named = {joint.part for joint in joints} | {p.carried_by for p in parts if p.carried_by}
    named |= {joint.coupling.leader for joint in joints if joint.coupling}
    named |= {member for joint in joints for member in joint.members}
    if not named <= known:
        raise AssetError(f"joints and attached parts must name parts: {whose} lacks {sorted(named - known)}")


def _without_annotation(part: Part) -> Part:
    if part.labelled_by != "joint":
        return replace(part, carried_by=None)
    label = label_of(part.source.name)
    return replace(part, carried_by=None, label=label, labelled_by="none" if label is PartLabel.UNKNOWN else "name")
