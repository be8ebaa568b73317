"""What may be added, in the words of the command and of the Python functions. It adds nothing."""

from collections.abc import Collection
from dataclasses import replace
from typing import Any

from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.compartment.config import SolidBodyConfig
from grafu.additions.config import AdditionConfig
from grafu.additions.door_frame.config import DoorFrameConfig
from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.additions.grip.config import GripConfig, GripKind, GripProfile
from grafu.additions.handle.config import NO_HANDLE, HandleChoice, HandleConfig
from grafu.additions.interior.request import InteriorRequest, parse_interior
from grafu.additions.statics import Statics
from grafu.additions.top.config import TopConfig
from grafu.errors import OptionError, did_you_mean
from grafu.pipeline.sized_words import SizedWord, sized_word

TOP_SHAPES = ("rectangle", "rounded", "chamfered", "oval", "capsule")
TOP_SIZES = ("thickness", "front", "side", "back")
"""What may be stated of a top behind its shape: how thick it is, and how far it juts out, metres."""
GRIPS = ("grip", "groove", "edge", "hole")
"""Recessed grips by name; `grip` is whichever of the others fits."""
GRIP_SIZES = ("length", "width", "depth")
"""What may be stated of a grip behind its name: along and across the gripped edge, and how deep a groove is, metres."""
HANDLE_SIZES = ("length",)
"""What may be stated of a handle template behind its id: how long its longest side is, metres."""
GRIP_PROFILES = ("sharp", "rounded")


def choose_additions(
    known_handles: Collection[str],
    *,
    base: AdditionConfig | None = None,
    statics: str | None = None,
    top: bool | str | None = None,
    handles: bool | str | None = None,
    drawer_boxes: bool | None = None,
    compartments: bool | None = None,
    door_frame: bool | None = None,
    interior: str | None = None,
    carcass: bool | None = None,
) -> AdditionConfig:
    """Returns the configuration that the words state; None leaves a choice as it is in `base`.

    Args:
        known_handles: the ids of all handle templates.
        base: what is changed; None: the defaults.
        statics: who decides what is missing: `graph`, `geometry` or `both`.
        top: whether tops are added, or their shape: one of `TOP_SHAPES`, sizes behind it, such as `oval,thickness=3cm`.
        handles: whether handles and grips are added, or their style: a template's id or one of `GRIPS`, sizes behind
            it, such as `groove,length=12cm,profile=sharp`; of a template only the length.
        drawer_boxes: whether a drawer that is only a front gets a box.
        compartments: whether what is solid behind doors and drawers gets compartments.
        door_frame: whether a door of a building that is drawn alone gets a frame.
        interior: `none`, `auto`, `predicted`, or counts for each compartment such as `shelves=2,dividers=1`,
            `shelves=3,angle=20deg` of shelves that slope down to the front, or `carousel=2`, round trays that turn.
        carcass: whether missing backs and bottoms are added.

    Raises:
        OptionError: if there is no such shape, style or interior.
    """
    config = base or AdditionConfig()
    if statics is not None:
        config = replace(config, statics=_statics(statics))
    if top is not None:
        config = replace(config, top=_top(top, config.top))
    if drawer_boxes is not None:
        config = replace(config, drawer_boxes=(config.drawer_boxes or DrawerBoxConfig()) if drawer_boxes else None)
    if compartments is not None:
        config = replace(config, solid_bodies=(config.solid_bodies or SolidBodyConfig()) if compartments else None)
    if door_frame is not None:
        config = replace(config, door_frame=(config.door_frame or DoorFrameConfig()) if door_frame else None)
    if carcass is not None:
        config = replace(config, carcass=(config.carcass or CarcassConfig()) if carcass else None)
    if interior is not None:
        config = replace(config, interior=_interior(interior))
    return config if handles is None else _with_handles(config, handles, known_handles)


def _statics(wanted: str) -> Statics:
    words = tuple(word.value for word in Statics)
    if wanted not in words:
        raise OptionError(f"`statics` must be one of {', '.join(words)}: got {wanted!r}{did_you_mean(wanted, words)}")
    return Statics(wanted)


def _interior(wanted: str) -> InteriorRequest:
    try:
        return parse_interior(wanted)
    except ValueError as error:
        raise OptionError(str(error)) from None


def _top(wanted: bool | str, before: TopConfig | None) -> TopConfig | None:
    if wanted is False:
        return None
    top = before or TopConfig()
    if wanted is True:
        return top
    stated = sized_word(wanted, "top", TOP_SIZES)
    shape = stated.word
    if shape not in TOP_SHAPES:
        raise OptionError(
            f"`top` must be one of {', '.join(TOP_SHAPES)}: got {shape!r}{did_you_mean(shape, TOP_SHAPES)}"
        )
    _require_above_zero(stated, "top", ("thickness",))
    sizes: dict[str, Any] = {"shape": shape, **stated.lengths}
    return replace(top, **sizes)


def _with_handles(config: AdditionConfig, wanted: bool | str, known: Collection[str]) -> AdditionConfig:
    if wanted is False:
        return replace(config, handles=None, grips=None)
    if wanted is True:
        usual = AdditionConfig()
        has_any = config.handles is not None or config.grips is not None
        return config if has_any else replace(config, handles=usual.handles, grips=usual.grips)
    name = wanted.split(",")[0].strip()
    if name in GRIPS:
        return replace(config, handles=None, grips=_grip(wanted))
    if name not in known:
        every = (*known, *GRIPS)
        raise OptionError(f"`handle` must be one of {', '.join(every)}: got {name!r}{did_you_mean(name, every)}")
    stated = sized_word(wanted, "handle", HANDLE_SIZES)
    _require_above_zero(stated, "handle", HANDLE_SIZES)
    handles, grips = config.handles or HandleConfig(), config.grips or GripConfig()
    length = stated.lengths.get("length", handles.length)
    return replace(config, handles=replace(handles, style=name, length=length), grips=grips)


def _grip(wanted: str) -> GripConfig:
    stated = sized_word(wanted, "handle", GRIP_SIZES, {"profile": GRIP_PROFILES})
    _require_above_zero(stated, "handle", GRIP_SIZES)
    usual = GripConfig()
    sizes = usual.sizes.with_lengths(*(stated.lengths.get(name, 0.0) for name in GRIP_SIZES))
    profile: GripProfile = "sharp" if stated.words.get("profile") == "sharp" else "rounded"
    return replace(usual, kind="auto" if stated.word == "grip" else GripKind(stated.word), profile=profile, sizes=sizes)


def front_choice(stated: str, known_handles: Collection[str]) -> HandleChoice:
    """Returns what one door or drawer is grasped by: `none`, a grip as `groove,depth=8mm`, or `bar-round,length=9cm`.

    `known_handles` are the ids of all handle templates, of which only the length can be stated.

    Raises:
        OptionError: if there is no such style, or what follows it is no length or profile that it has.
    """
    style, every = stated.split(",")[0].strip(), (*known_handles, *GRIPS, NO_HANDLE)
    if style not in every:
        raise OptionError(f"`grasp` must be one of {', '.join(every)}: got {style!r}{did_you_mean(style, every)}")
    if style in GRIPS:
        found = sized_word(stated, "grasp", GRIP_SIZES, {"profile": GRIP_PROFILES})
    else:
        found = sized_word(stated, "grasp", () if style == NO_HANDLE else HANDLE_SIZES)
    _require_above_zero(found, "grasp", GRIP_SIZES)
    sizes: dict[str, Any] = {**found.lengths, **found.words}
    return HandleChoice(found.word, **sizes)


def _require_above_zero(stated: SizedWord, option: str, names: Collection[str]) -> None:
    for name in names:
        if stated.lengths.get(name) == 0:
            raise OptionError(f"`{name}` of `{option}` must be above 0: got 0")
