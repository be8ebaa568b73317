"""All that is chosen for one model, as one value and as JSON (`grafu.settings/1`) that gives the same again.

The command (`--settings`, its options), the Python functions and the Blender extension fill the same value. It runs
nothing.
"""

from collections.abc import Mapping
from dataclasses import field, is_dataclass, replace
from enum import Enum
from functools import cache
from pathlib import Path
from typing import Any, final

from grafu.additions.config import AdditionConfig
from grafu.additions.handle.config import HandleChoice
from grafu.additions.interior.request import CompartmentChoice
from grafu.articulation.base import BaseKind
from grafu.articulation.catch_kind import CatchKind
from grafu.asset.json_files import parse_json
from grafu.asset.options import LoadOptions
from grafu.asset.regrouping import Regroup, Regrouping
from grafu.dataclass import dataclass
from grafu.errors import AssetError, OptionError
from grafu.joints.motion_choice import MotionChoice
from grafu.joints.plan import AUTOMATIC, JointChoice
from grafu.pipeline.motion_source import MotionSource
from grafu.visible import ShortRepr
from grafu.vocabulary import PartLabel

SCHEMA = "grafu.settings/1"


@final
@dataclass(frozen=True)
class Settings(ShortRepr):
    """Where motions come from, how the input is read, what is added, and what is decided of single parts and joints.

    With `small_parts` knobs, buttons and wheels get joints of their own; without (None) only those that are links of
    their own in a robot description, with False none. `labels` and `motions` go by the ids of parts,
    `joints` by those of moving parts. `weights` is a file of trained weights (ONNX) for the network; None: those that
    came with the package. `hinge` is the template that doors get where it finds room. With `stays` lids and flaps get
    stays where there is room. `base` is what holds the piece: None, it is fixed, and what is known to hang on a wall or
    to lean on one is fixed to that. `catch` is what keeps doors and drawers closed. `regrouped` states which parts are
    joined or split, in this order, before all else; the other choices go by the ids of the parts after that. A motion
    source that reads another system's file is no setting: it needs the file.
    """

    motion: MotionSource = MotionSource.AUTO
    reading: LoadOptions = LoadOptions()
    trim: bool = True
    small_parts: bool | None = None
    labels: Mapping[str, PartLabel] = field(default_factory=dict)
    motions: Mapping[str, MotionChoice] = field(default_factory=dict)
    joints: Mapping[str, JointChoice] = field(default_factory=dict)
    additions: AdditionConfig = field(default_factory=AdditionConfig)
    weights: Path | None = None
    hinge: str = ""
    stays: bool = True
    base: BaseKind | None = None
    catch: CatchKind = CatchKind.NONE
    regrouped: tuple[Regrouping, ...] = ()

    def __post_init__(self) -> None:
        if self.motion.is_foreign:
            raise ValueError(f"the motion source {self.motion} reads a file, which settings do not name")

    def with_regrouping(self, change: Regrouping) -> "Settings":
        """Returns the settings with one more change of the parts; what was chosen of parts that it ends is gone."""
        gone = change.parts[1:] if change.do is Regroup.JOIN else ()
        return replace(
            self,
            regrouped=(*self.regrouped, change),
            labels={part: label for part, label in self.labels.items() if part not in gone},
            motions={part: motion for part, motion in self.motions.items() if part not in gone},
            joints={part: joint for part, joint in self.joints.items() if part not in gone},
            additions=replace(
                self.additions, fronts={part: f for part, f in self.additions.fronts.items() if part not in gone}
            ),
        )

    def with_label(self, part: str, label: PartLabel) -> "Settings":
        """Returns the settings in which a part has this category."""
        return replace(self, labels={**self.labels, part: label})

    def with_motion(self, part: str, choice: MotionChoice | None) -> "Settings":
        """Returns the settings in which a part moves so, or is static; None: as the motion source states."""
        motions: dict[str, MotionChoice] = {k: v for k, v in self.motions.items() if k != part}
        if choice is not None:
            motions[part] = choice
        return replace(self, motions=motions)

    def with_joint(self, part: str, choice: JointChoice) -> "Settings":
        """Returns the settings with this choice for a moving part; one that decides nothing is forgotten."""
        joints = {**self.joints, part: choice}
        return replace(self, joints={name: kept for name, kept in joints.items() if kept != AUTOMATIC})

    def with_front(self, part: str, choice: HandleChoice | None) -> "Settings":
        """Returns the settings with this choice of a handle for a door or drawer; None: as the others."""
        fronts: dict[str, HandleChoice] = {k: v for k, v in self.additions.fronts.items() if k != part}
        if choice is not None:
            fronts[part] = choice
        return replace(self, additions=replace(self.additions, fronts=fronts))

    def with_compartment(self, number: int, choice: CompartmentChoice | None) -> "Settings":
        """Returns the settings with this choice for a compartment; None: as the others."""
        found = {k: v for k, v in self.additions.compartments.items() if k != number}
        if choice is not None:
            found[number] = choice
        return replace(self, additions=replace(self.additions, compartments=found))

    def with_addition(self, part: str, *, accepted: bool) -> "Settings":
        """Returns the settings in which an added part is left out, or not any more."""
        rejected = self.additions.rejected - {part} if accepted else self.additions.rejected | {part}
        return replace(self, additions=replace(self.additions, rejected=rejected))

    def to_json(self) -> dict[str, Any]:
        """Returns plain JSON values, every setting written out: what later versions do by default changes nothing."""
        return {"schema": SCHEMA, **_plain(self)}


def settings_from_bytes(data: bytes, where: object) -> Settings:
    """Returns the settings that a file holds; `where` names it.

    Raises:
        OptionError: if it is no JSON, or as by `settings_from_json`.
    """
    try:
        stated = parse_json(data, where, f"settings of the form {SCHEMA}")
    except AssetError as error:
        raise OptionError(str(error)) from None
    return settings_from_json(stated)


def settings_from_json(data: object) -> Settings:
    """Returns the settings that JSON values state; what is left out is as by default.

    Raises:
        OptionError: if the form is another, a setting is unknown, or a value is out of range.
    """
    if not isinstance(data, dict) or data.get("schema") != SCHEMA:
        found = data.get("schema") if isinstance(data, dict) else type(data).__name__
        raise OptionError(f"settings must be a JSON object with `schema` {SCHEMA}: got {found!r}")
    from pydantic import ValidationError

    given = {name: value for name, value in data.items() if name != "schema"}
    try:
        settings = _adapter().validate_python(given)
        _require_known(given, _adapter().dump_python(settings, mode="json"))
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(step) for step in first["loc"]) or "motion"
        raise OptionError(f"the setting `{where}` is wrong: {first['msg']}") from None
    except AssetError as error:
        raise OptionError(f"the setting `reading` is wrong: {error}") from None
    return settings


def _plain(value: Any) -> Any:
    """Returns a value as pydantic would write it as JSON, without its schema, which takes longer to build than this."""
    if is_dataclass(value):
        return {name: _plain(getattr(value, name)) for name in value.__dataclass_fields__}
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, tuple | frozenset):
        return [_plain(item) for item in value]
    return str(value) if isinstance(value, Path) else value


@cache
def _adapter() -> Any:
    """Returns pydantic's reader and writer of settings; beartype cannot check its type."""
    from pydantic import TypeAdapter

    return TypeAdapter(Settings)


def _require_known(given: object, known: object, where: str = "") -> None:
    """Raises OptionError if something was given that is no setting: pydantic passes it over in plain dataclasses."""
    if isinstance(given, list | tuple) and isinstance(known, list | tuple):
        for number, (item, like) in enumerate(zip(given, known, strict=False)):
            _require_known(item, like, f"{where}.{number}")
    if not (isinstance(given, dict) and isinstance(known, dict)):
        return
    by_name = {str(key): value for key, value in known.items()}
    for name, value in given.items():
        path = f"{where}.{name}" if where else str(name)
        if str(name) not in by_name:
            raise OptionError(f"there is no setting `{path}`")
        _require_known(value, by_name[str(name)], path)
