"""The one shape that every addition has: `(scene, request, config) -> StepResult`. It adds nothing itself."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import field, replace
from enum import StrEnum
from typing import Literal, final

import numpy as np

from grafu.additions.grip.carve import Carved
from grafu.asset.part import Part, PartSource
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import ArrayValue, Vec3, freeze_arrays
from grafu.geometry.box import Box
from grafu.joints.plan import RealizationPlan
from grafu.joints.rail_config import DrawerConfig
from grafu.refusal import Refusal
from grafu.scene.scene import Scene
from grafu.templates.template import HandleTemplate
from grafu.vocabulary import PartLabel

GraspKind = Literal["handle", "recess", "edge", "driven", "none"]


@final
@dataclass(frozen=True)
class Addition:
    """A new part at rest in the object frame, why it was added, and in which style (a template's id, an outline).

    `part.carried_by` is the door or drawer that it is fixed to; None: it is static.
    """

    part: Part
    why: str
    style: str = ""


def added_part(part_id: str, label: PartLabel, surfaces: Sequence[Surface], carried_by: str | None = None) -> Part:
    """Returns a part that the input did not have."""
    return Part(part_id, label, tuple(surfaces), PartSource(""), "added", carried_by)


def free_ids(stem: str, count: int, taken: Collection[str]) -> tuple[str, ...]:
    """Returns `count` ids that no part has: the stem itself if one is enough and it is free, else with numbers."""
    if count == 1 and stem not in taken:
        return (stem,)
    found: list[str] = []
    number = 1
    while len(found) < count:
        if (name := f"{stem}_{number}") not in taken:
            found.append(name)
        number += 1
    return tuple(found)


class DeficiencyKind(StrEnum):
    """The things that furniture can lack."""

    JOINT = "joint"  # the input does not say how the part moves
    HINGE = "hinge"  # a door without hardware
    RAIL = "rail"  # a drawer without hardware
    HANDLE = "handle"  # nothing to grasp the part by
    TOP = "top panel"  # nothing closes it from above
    BACK = "back panel"  # the back of a carcass is open
    BOTTOM = "bottom panel"  # its bottom is open
    DRAWER_BOX = "drawer box"  # a drawer is only a front, or its box lacks boards
    DOOR_FRAME = "door frame"  # a door of a building is drawn without one
    COMPARTMENT = "compartment"  # what carries a door or drawer is solid right behind it
    LABEL = "label"  # the part's category is not known


@final
@dataclass(frozen=True, slots=True)
class Deficiency:
    """One thing that is missing: at which part (empty: the whole object), and in words what was looked for."""

    kind: DeficiencyKind
    part: str
    detail: str


@final
@dataclass(frozen=True, eq=False)
class Grasp(ArrayValue):
    """How a moving body can be grasped. `confidence` is in [0, 1]; of "none" it is 1.

    `part` is the id of the handle (empty: it is geometry of the moving body itself), `center` the middle of the grip in
    the object frame (None: there is none), `length` metres of it that fingers can use, and `why` states what was found.
    """

    moving: str
    kind: GraspKind
    confidence: float
    why: str
    center: Vec3 | None = None
    length: float = 0.0
    part: str = ""

    def __post_init__(self) -> None:
        if self.center is not None:
            freeze_arrays(self, "center", dtype=np.float64)


@final
@dataclass(frozen=True, slots=True)
class PanelHint:
    """A shelf or divider that the completed graph expects at about this box (object frame, metres).

    Raises:
        ValueError: if the label is another.
    """

    id: str
    label: PartLabel
    box: Box

    def __post_init__(self) -> None:
        if self.label not in (PartLabel.SHELF, PartLabel.DIVIDER):
            raise ValueError(f"`PanelHint.label` must be shelf or divider: got {self.label.value} for `{self.id}`")


@final
@dataclass(frozen=True)
class StepRequest:
    """What a run knows that a scene does not say; the same for all steps.

    `plan` are the joints to build, `drawers` states what counts as a drawer, for joints and additions alike. `names`
    are those of the piece and of its parts, `tops` the parts that are called top panels. The completed graph expects
    `top` (a box, object frame), `handles` (by moving part, their middles) and `panels`; `boards` are backs, bottoms or
    both, where one may be missing. With `only_expected`, no other top and handle is added. `own_handles` are the user's
    templates by id, `rejected` the ids of added parts that are left out again.
    """

    plan: RealizationPlan = field(default_factory=RealizationPlan)
    drawers: DrawerConfig = DrawerConfig()
    names: tuple[str, ...] = ()
    tops: frozenset[str] = frozenset()
    top: Box | None = None
    handles: Mapping[str, Vec3] = field(default_factory=dict)
    panels: tuple[PanelHint, ...] = ()
    boards: frozenset[PartLabel] = frozenset()
    only_expected: bool = False
    own_handles: Mapping[str, HandleTemplate] = field(default_factory=dict)
    rejected: frozenset[str] = frozenset()


@final
@dataclass(frozen=True)
class CutCompartment:
    """A still part with compartments cut into it, and for each the doors and drawers that it is behind."""

    part: Part
    fronts: tuple[tuple[str, ...], ...]


@final
@dataclass(frozen=True)
class Changes:
    """What a step did to parts that were there.

    It `removed` parts, found some to move with a drawer (`attached`: drawer, then part), `carved` grips, and cut
    `compartments` into what is solid.
    """

    removed: frozenset[str] = frozenset()
    attached: tuple[tuple[str, str], ...] = ()
    carved: tuple[Carved, ...] = ()
    compartments: tuple[CutCompartment, ...] = ()


@final
@dataclass(frozen=True)
class StepResult:
    """The scene with what was added and changed, and what was refused.

    `deficiencies` and `grasps` say what was found before anything was added, wanted or not.
    """

    scene: Scene
    additions: tuple[Addition, ...] = ()
    changes: Changes = Changes()
    refusals: tuple[Refusal, ...] = ()
    deficiencies: tuple[Deficiency, ...] = ()
    grasps: Mapping[str, Grasp] = field(default_factory=dict)

    @property
    def attached(self) -> tuple[tuple[str, str], ...]:
        """What moves with a moving part from now on: of each pair the moving part, then what was found or added."""
        riding = ((a.part.carried_by, a.part.id) for a in self.additions if a.part.carried_by is not None)
        return (*self.changes.attached, *riding)

    def without(self, rejected: Collection[str], before: Scene) -> "StepResult":
        """Returns the result without additions that the user rejected.

        Where all are, nothing that they were to replace is taken away from the scene `before` the step.
        """
        gone = {addition.part.id for addition in self.additions} & set(rejected)
        if not gone:
            return self
        kept = tuple(addition for addition in self.additions if addition.part.id not in gone)
        if not kept and self.changes.removed:
            return replace(self, scene=before, additions=(), changes=Changes())
        return replace(self, scene=self.scene.without_parts(gone), additions=kept)

    def then(self, later: "StepResult") -> "StepResult":
        """Returns this result and that of a later step as one."""
        ours, theirs = self.changes, later.changes
        changes = Changes(
            ours.removed | theirs.removed,
            (*ours.attached, *theirs.attached),
            (*ours.carved, *theirs.carved),
            (*ours.compartments, *theirs.compartments),
        )
        return StepResult(
            later.scene,
            (*self.additions, *later.additions),
            changes,
            (*self.refusals, *later.refusals),
            (*self.deficiencies, *later.deficiencies),
            {**self.grasps, **later.grasps},
        )
