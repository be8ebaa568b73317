"""A language model's list of edits as settings: every name and number checked. It runs nothing that a reply states.

Edits are the requests of the command line: `--move`, `--label`, openings of joints, additions. What no edit names does
not move, and nothing is added that no edit asks for.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import radians
from typing import Annotated, Final, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from grafu.additions.config import NO_ADDITIONS, AdditionConfig
from grafu.asset.foreign.motions import ForeignMotions, ForeignPart
from grafu.asset.part import Asset
from grafu.errors import ReplyError, did_you_mean
from grafu.evaluation.llm.reply_json import object_in_reply
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


class _LabelEdit(_Edit):
    do: Literal["label"]
    part: str
    label: PartLabel


class _AddEdit(_Edit):
    do: Literal["add"]
    what: Literal["top", "handles", "interior", "drawer boxes"]


_Motion = _HingeEdit | _SlideEdit | _FoldEdit | _FixEdit
_Any = _Motion | _LabelEdit | _AddEdit


class _Edits(_Edit):
    edits: tuple[Annotated[_Any, Field(discriminator="do")], ...]


_FIELDS: Final = {"top": "top", "handles": "handles", "interior": "interior", "drawer boxes": "drawer_boxes"}


def read_edit_reply(text: str, asset: Asset) -> Settings:
    """Returns the settings that the reply of a language model states for an asset.

    Raises:
        ReplyError: if it is no JSON of the form that was asked for, names a part that is not there, or states two
            motions or two labels of one part.
    """
    try:
        edits = _Edits.model_validate(object_in_reply(text, "edits")).edits
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(step) for step in first["loc"])
        raise ReplyError(f"`{where}` of the reply is wrong: {first['msg']}") from None
    motions = [edit for edit in edits if isinstance(edit, _Motion)]
    labels = [edit for edit in edits if isinstance(edit, _LabelEdit)]
    _require_parts(asset, [*motions, *labels])
    _require_once("motions", (edit.part for edit in motions))
    _require_once("labels", (edit.part for edit in labels))
    openings = {edit.part: _opening(edit) for edit in motions}
    return Settings(
        labels={edit.part: edit.label for edit in labels},
        motions={edit.part: _choice(edit) for edit in motions},
        joints={part: JointChoice(opening=opening) for part, opening in openings.items() if opening is not None},
        additions=_additions(edit.what for edit in edits if isinstance(edit, _AddEdit)),
    )


def without_motions(asset: Asset, model: str) -> ForeignMotions:
    """Returns the motions that edits begin with: none of any part."""
    parts = tuple(ForeignPart(p.id, p.mesh, label=p.label, slot=k) for k, p in enumerate(asset.parts))
    return ForeignMotions("grafu-pred", f"the reply of {model}", parts, ())


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
    chosen = {_FIELDS[what]: getattr(usual, _FIELDS[what]) for what in wanted}
    return replace(NO_ADDITIONS, **chosen)


def _require_parts(asset: Asset, edits: Sequence[_Motion | _LabelEdit]) -> None:
    known = {part.id for part in asset.parts}
    unknown = next((edit.part for edit in edits if edit.part not in known), None)
    if unknown is not None:
        raise ReplyError(
            f"an edit must name a part by its id: there is no `{unknown}`{did_you_mean(unknown, known)}"
        )


def _require_once(what: str, parts: Iterable[str]) -> None:
    twice = next((part for part, number in Counter(parts).items() if number > 1), None)
    if twice is not None:
        raise ReplyError(f"`{twice}` must have at most one edit of its {what}: got several")
