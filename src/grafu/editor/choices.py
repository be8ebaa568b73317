"""The questions that the editor asks about a part or the whole piece, each as a change of the settings.

Values are plain JSON; null takes a choice back, so that it is automatic again.
"""

from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum
from math import isfinite, radians
from types import MappingProxyType
from typing import Any, Final

from grafu.additions.config import AdditionConfig
from grafu.additions.handle.config import NO_HANDLE, HandleChoice
from grafu.additions.interior.request import MOST_PANELS, CompartmentChoice
from grafu.asset.lasso_cut import Lasso
from grafu.asset.regrouping import Regroup, Regrouping
from grafu.editor.known import Known
from grafu.errors import OptionError
from grafu.joints.motion_choice import FIXED, choice_in_words
from grafu.joints.plan import AUTOMATIC, CUP, PIVOT
from grafu.pipeline.addition_choice import GRIPS, TOP_SHAPES, choose_additions
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery, open_handles
from grafu.visible import visible
from grafu.vocabulary import MOTION_WORDS, PartLabel

WHOLE = ""  # the part of questions about the whole piece
_CENTIMETRE, _MILLIMETRE = 0.01, 0.001  # metres
_LEFT_OUT: Final = HandleChoice(NO_HANDLE, replaces=False)  # a front without what was added to it
FARTHEST = 10_000.0  # metres: no point that is pointed at lies farther off

LIMITS: Final = MappingProxyType({"turn": (1.0, 360.0), "slide": (0.1, 1000.0), "shelves": (0.0, float(MOST_PANELS))})
"""By question the least and the greatest number that is an answer: degrees, centimetres, shelves."""


class Choose(StrEnum):
    """What can be chosen."""

    MOTION = "motion"  # how a part moves: one of `MOTION_WORDS`
    ACCEPT = "accept"  # it moves, or is static, as it was built
    REJECT = "reject"  # it gets no joint; an added part is left out
    RESTORE = "restore"  # an added part that was left out comes back
    TURN = "turn"  # how far it turns at most, degrees
    SLIDE = "slide"  # how far it slides at most, centimetres
    TEMPLATE = "template"  # its hinges or rails: the id of a template
    HANDLE = "handle"  # its handle or grip: a style, or none
    HANDLE_OFFSET = "handle offset"  # how far its handle is moved aside and up, metres
    LABEL = "label"  # its category
    JOIN = "join"  # another part, by its id, becomes a piece of it
    SPLIT = "split"  # its connected shells become parts
    CUT = "cut"  # what lies inside a lasso becomes a part: {eye, corners, through}
    SHELVES = "shelves"  # how many shelves the compartment of this number gets
    TOP = "top"  # of the whole: the shape of a missing top, or none
    HINGE = "hinge"  # of the whole: the template that doors get where it finds room
    HANDLES = "handles"  # of the whole: the style of all handles that are added, or none


def with_choice(settings: Settings, question: str, part: str, value: Any, known: Known) -> Settings:
    """Returns the settings in which one question is answered.

    Args:
        settings: what was chosen before.
        question: one of `Choose`.
        part: the id of the part; for the whole piece `WHOLE`; for shelves the number of the compartment.
        value: the answer, as JSON; None: automatic.
        known: what the last build knows.

    Raises:
        OptionError: if there is no such question or part, or the answer is none of those that it has.
    """
    if question not in {one.value for one in Choose}:
        raise OptionError(f"a question must be one of {', '.join(Choose)}: got {_said(question)}")
    asked = Choose(question)
    _require_part(asked, part, known)
    try:
        return _ANSWERS[asked](settings, part, value, known)
    except ValueError as error:
        raise OptionError(f"`{asked}` of `{visible(part)}` cannot be so: {error}") from None


def _require_part(asked: Choose, part: str, known: Known) -> None:
    if asked in _OF_WHOLE:
        if part != WHOLE:
            raise OptionError(f"`{asked}` is asked about the whole piece: got the part {_said(part)}")
        return
    if asked is Choose.SHELVES:
        if not (part.isascii() and part.isdigit() and int(part[:9]) < known.compartments):
            last = known.compartments - 1
            raise OptionError(f"a compartment must be a number from 0 to {last}: got {_said(part)}")
        return
    if part not in known.parts and asked is not Choose.RESTORE and not (asked is Choose.REJECT and part in known.added):
        raise OptionError(f"there is no part {_said(part)}")


def _motion(settings: Settings, part: str, value: Any, _: Known) -> Settings:
    if value is None:
        return settings.with_motion(part, None)
    word = _word(value, MOTION_WORDS, "a motion")
    return settings.with_motion(part, choice_in_words(word))


def _accept(settings: Settings, part: str, _: Any, known: Known) -> Settings:
    if part not in known.moving:
        return settings.with_motion(part, FIXED)
    if part not in known.motions:
        raise OptionError(f"the motion of {_said(part)} has no word: it stays as it is")
    return settings.with_motion(part, known.motions[part])


def _reject(settings: Settings, part: str, _: Any, known: Known) -> Settings:
    front = known.fronts.get(part, WHOLE)
    if front in settings.additions.fronts:  # its handle was chosen: what is chosen now is that it gets none
        return settings.with_front(front, _LEFT_OUT)
    if part in known.added:
        return settings.with_addition(part, accepted=False)
    return settings.with_motion(part, FIXED)


def _restore(settings: Settings, part: str, _: Any, __: Known) -> Settings:
    if part not in settings.additions.rejected:
        raise OptionError(f"no part {_said(part)} was left out")
    return settings.with_addition(part, accepted=True)


def _turn(settings: Settings, part: str, value: Any, _: Known) -> Settings:
    opening = None if value is None else radians(_number(value, *LIMITS["turn"], "degrees"))
    return _with_joint(settings, part, opening=opening)


def _slide(settings: Settings, part: str, value: Any, _: Known) -> Settings:
    opening = None if value is None else _CENTIMETRE * _number(value, *LIMITS["slide"], "centimetres")
    return _with_joint(settings, part, opening=opening)


def _template(settings: Settings, part: str, value: Any, _: Known) -> Settings:
    word = "" if value is None else _word(value, (*hinge_templates(), *rail_templates()), "a template")
    return _with_joint(settings, part, template=word)


def _handle(settings: Settings, part: str, value: Any, _: Known) -> Settings:
    if value is None:
        return settings.with_front(part, None)
    chosen = settings.additions.fronts.get(part, _LEFT_OUT)
    before = HandleChoice() if chosen == _LEFT_OUT else chosen
    return settings.with_front(part, replace(before, style=_word(value, handle_styles(), "a handle")))


def _handle_offset(settings: Settings, part: str, value: Any, known: Known) -> Settings:
    before = settings.additions.fronts.get(part, HandleChoice())
    if value is None:
        moved = replace(before, offset=(0.0, 0.0))
        return settings.with_front(part, None if moved == HandleChoice() else moved)
    if not isinstance(value, list) or len(value) != 2:
        raise OptionError(f"the offset of a handle must be two numbers, metres: got {_said(value)}")
    if part not in known.rooms:
        raise OptionError(f"{_said(part)} has no handle that was added: there is none to be moved")
    (left, right), (down, above) = known.rooms[part]
    aside = _number(value[0], left - _MILLIMETRE, right + _MILLIMETRE, "metres")
    up = _number(value[1], down - _MILLIMETRE, above + _MILLIMETRE, "metres")
    return settings.with_front(part, replace(before, offset=(aside, up)))


def _label(settings: Settings, part: str, value: Any, _: Known) -> Settings:
    if value is None:
        return replace(settings, labels={name: kept for name, kept in settings.labels.items() if name != part})
    return settings.with_label(part, PartLabel(_word(value, tuple(PartLabel), "a category")))


def _join(settings: Settings, part: str, value: Any, known: Known) -> Settings:
    if not isinstance(value, str) or value not in known.parts or value == part:
        raise OptionError(f"a part is joined with another part of the input: got {_said(value)}")
    return settings.with_regrouping(Regrouping(Regroup.JOIN, (part, value)))


def _split(settings: Settings, part: str, _: Any, known: Known) -> Settings:
    return settings.with_regrouping(Regrouping(Regroup.SPLIT, (part,), category=known.categories.get(part)))


def _cut(settings: Settings, part: str, value: Any, known: Known) -> Settings:
    if not isinstance(value, dict) or set(value) - {"eye", "corners", "through"}:
        raise OptionError(f"a part is cut by a lasso, `eye`, `corners` and `through`: got {_said(value)}")
    corners = value.get("corners")
    if not isinstance(corners, list):
        raise OptionError(f"the corners of a lasso must be a list of points: got {_said(corners)}")
    lasso = Lasso(_point(value.get("eye")), tuple(_point(corner) for corner in corners), value.get("through") is True)
    return settings.with_regrouping(Regrouping(Regroup.CUT, (part,), lasso, known.categories.get(part)))


def _point(value: Any) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:
        raise OptionError(f"a point must be three numbers, metres: got {_said(value)}")
    x, y, z = (_number(number, -FARTHEST, FARTHEST, "metres") for number in value)
    return x, y, z


def _shelves(settings: Settings, part: str, value: Any, _: Known) -> Settings:
    if value is None:
        return settings.with_compartment(int(part), None)
    count = _number(value, *LIMITS["shelves"], "shelves")
    if count != int(count):
        raise OptionError(f"shelves are counted in whole numbers: got {_said(value)}")
    before = settings.additions.compartments.get(int(part), CompartmentChoice())
    return settings.with_compartment(int(part), replace(before, shelves=int(count)))


def _top(settings: Settings, _: str, value: Any, __: Known) -> Settings:
    additions, usual = settings.additions, AdditionConfig()
    if value is None:
        return replace(settings, additions=replace(additions, top=usual.top))
    wanted = False if value == NO_HANDLE else _word(value, TOP_SHAPES, "a top")
    return replace(settings, additions=choose_additions(open_handles(None), base=additions, top=wanted))


def _hinge(settings: Settings, _: str, value: Any, __: Known) -> Settings:
    return replace(settings, hinge="" if value is None else _word(value, hinge_templates(), "a hinge"))


def _handles(settings: Settings, _: str, value: Any, __: Known) -> Settings:
    additions, usual = settings.additions, AdditionConfig()
    if value is None:
        return replace(settings, additions=replace(additions, handles=usual.handles, grips=usual.grips))
    wanted = False if value == NO_HANDLE else _word(value, handle_styles(), "a handle")
    return replace(settings, additions=choose_additions(open_handles(None), base=additions, handles=wanted))


_ANSWERS: dict[Choose, Callable[[Settings, str, Any, Known], Settings]] = {
    Choose.MOTION: _motion,
    Choose.ACCEPT: _accept,
    Choose.REJECT: _reject,
    Choose.RESTORE: _restore,
    Choose.TURN: _turn,
    Choose.SLIDE: _slide,
    Choose.TEMPLATE: _template,
    Choose.HANDLE: _handle,
    Choose.HANDLE_OFFSET: _handle_offset,
    Choose.LABEL: _label,
    Choose.JOIN: _join,
    Choose.SPLIT: _split,
    Choose.CUT: _cut,
    Choose.SHELVES: _shelves,
    Choose.TOP: _top,
    Choose.HINGE: _hinge,
    Choose.HANDLES: _handles,
}
_OF_WHOLE = (Choose.TOP, Choose.HINGE, Choose.HANDLES)


def hinge_templates() -> tuple[str, ...]:
    """Returns the ids of what a door can hang on."""
    return (*(model.id for model in builtin_gallery().hinges), CUP, PIVOT)


def rail_templates() -> tuple[str, ...]:
    """Returns the ids of what a drawer can run on."""
    return tuple(model.id for model in builtin_gallery().rails)


def handle_styles() -> tuple[str, ...]:
    """Returns what a front can be grasped by, `none` last."""
    return (*open_handles(None), *GRIPS, NO_HANDLE)


def _with_joint(settings: Settings, part: str, **changes: Any) -> Settings:
    return settings.with_joint(part, replace(settings.joints.get(part, AUTOMATIC), **changes))


def _word(value: Any, known: tuple[str, ...], what: str) -> str:
    if not isinstance(value, str) or value not in known:
        raise OptionError(f"{what} must be one of {', '.join(known)}: got {_said(value)}")
    return value


def _number(value: Any, least: float, most: float, unit: str) -> float:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not is_number or not isfinite(value) or not least <= value <= most:
        raise OptionError(f"a number must be from {least:g} to {most:g} {unit}: got {_said(value)}")
    return float(value)


def _said(value: object) -> str:
    text = visible(repr(value))
    return text if len(text) <= 60 else f"{text[:57]}..."
