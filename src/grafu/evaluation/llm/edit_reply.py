"""A language model's list of edits as settings: every name and number checked. It runs nothing that a reply states.

Edits are the requests of the command line: `--move`, `--label`, openings of joints, additions. What no edit names does
not move, and nothing is added that no edit asks for.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from math import radians
from typing import Annotated, Final, Literal, final

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from grafu.additions.config import AdditionConfig
from grafu.additions.interior.request import NOTHING
from grafu.additions.statics import Statics
from grafu.dataclass import dataclass
from grafu.errors import ReplyError, did_you_mean
from grafu.evaluation.llm.reply_json import first_fault, object_in_reply
from grafu.joints.motion_choice import FIXED, MotionChoice, Moves, Side
from grafu.joints.plan import JointChoice
from grafu.pipeline.settings import Settings
from grafu.vocabulary import PartLabel


class _Edit(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class _HingeEdit(_Edit):
    do: Literal["hinge"]
    part: str
    edge: Side
    opens: Literal["outwards", "inwards"] = "outwards"
    degrees: Annotated[float, Field(gt=0, le=360)] | None = None


class _SlideEdit(_Edit):
    do: Literal["slide"]
    part: str
    direction: Side
    distance: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = None


class _FoldEdit(_Edit):
    do: Literal["fold"]
    part: str
    to: Literal["left", "right", "top"]


class _FixEdit(_Edit):
    do: Literal["fix"]
    part: str


class _AttachEdit(_Edit):
    do: Literal["attach"]
    part: str
    to: str


class _LabelEdit(_Edit):
    do: Literal["label"]
    part: str
    label: PartLabel


class _AddEdit(_Edit):
    do: Literal["add"]
    what: Literal["top", "handles", "interior"]


_Motion = _HingeEdit | _SlideEdit | _FoldEdit | _FixEdit
_Any = _Motion | _AttachEdit | _LabelEdit | _AddEdit


class _Edits(_Edit):
    edits: tuple[Annotated[_Any, Field(discriminator="do")], ...]


_NOT_ASKED: Final = AdditionConfig(statics=Statics.GEOMETRY, top=None, handles=None, grips=None, interior=NOTHING)
"""What no edit asks for is not added; what joints need, such as room behind a drawer, is made as for every method."""


@final
@dataclass(frozen=True)
class EditsByReply:
    """What a reply states: the settings, and which part moves as one with which, both by the ids of parts."""

    settings: Settings
    attached: Mapping[str, str]


def read_edit_reply(text: str, ids: Mapping[str, str]) -> EditsByReply:
    """Returns what the reply of a language model states; `ids` holds for each name that it knows the id of the part.

    Raises:
        ReplyError: if it is no JSON of the form that was asked for, names a part that is not there, states two
            motions or two labels of one part, or parts carry one another in a circle.
    """
    try:
        edits = _Edits.model_validate(object_in_reply(text, "edits")).edits
    except ValidationError as error:
        raise ReplyError(first_fault(error)) from None
    motions = [edit for edit in edits if isinstance(edit, _Motion)]
    labels = [edit for edit in edits if isinstance(edit, _LabelEdit)]
    attached = [edit for edit in edits if isinstance(edit, _AttachEdit)]
    _require_parts(ids, [edit.part for edit in (*motions, *attached, *labels)] + [edit.to for edit in attached])
    _require_once("motions", (edit.part for edit in (*motions, *attached)))
    _require_once("labels", (edit.part for edit in labels))
    carried = {ids[edit.part]: ids[edit.to] for edit in attached}
    _require_no_circle(carried, {part: name for name, part in ids.items()})
    openings = {ids[edit.part]: _opening(edit) for edit in motions}
    settings = Settings(
        labels={ids[edit.part]: edit.label for edit in labels},
        motions={ids[edit.part]: _choice(edit) for edit in motions},
        joints={part: JointChoice(opening=opening) for part, opening in openings.items() if opening is not None},
        additions=_additions(edit.what for edit in edits if isinstance(edit, _AddEdit)),
    )
    return EditsByReply(settings, carried)


def _choice(edit: _Motion) -> MotionChoice:
    match edit:
        case _HingeEdit():
            return MotionChoice(Moves.TURNS, edit.edge, inwards=edit.opens == "inwards")
        case _SlideEdit():
            return MotionChoice(Moves.SLIDES, edit.direction)
        case _FoldEdit():
            return MotionChoice(Moves.FOLDS, Side(edit.to))
        case _FixEdit():
            return FIXED


def _opening(edit: _Motion) -> float | None:
    """Returns how far a part is to open, in radians or metres; None: as far as it goes."""
    if isinstance(edit, _HingeEdit):
        return None if edit.degrees is None else radians(edit.degrees)
    return edit.distance if isinstance(edit, _SlideEdit) else None


def _additions(wanted: Iterable[str]) -> AdditionConfig:
    usual = AdditionConfig()
    return replace(_NOT_ASKED, **{what: getattr(usual, what) for what in wanted})


def _require_parts(known: Collection[str], named: Iterable[str]) -> None:
    unknown = next((part for part in named if part not in known), None)
    if unknown is not None:
        raise ReplyError(f"an edit must name a part by its id: there is no `{unknown}`{did_you_mean(unknown, known)}")


def _require_once(what: str, parts: Iterable[str]) -> None:
    twice = next((part for part, number in Counter(parts).items() if number > 1), None)
    if twice is not None:
        raise ReplyError(f"`{twice}` must have at most one edit of its {what}: got several")


def _require_no_circle(carried: Mapping[str, str], names: Mapping[str, str]) -> None:
    for first in carried:
        above, seen = carried[first], {first}
        while above in carried and above not in seen:
            seen.add(above)
            above = carried[above]
        if above in seen:
            raise ReplyError(f"parts must not be attached in a circle: `{names[above]}` is attached to itself")
