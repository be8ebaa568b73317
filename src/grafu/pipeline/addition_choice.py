"""What may be added, in the words of the command and of the Python functions. It adds nothing."""

from collections.abc import Collection
from dataclasses import replace

from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.compartment.config import SolidBodyConfig
from grafu.additions.config import AdditionConfig
from grafu.additions.door_frame.config import DoorFrameConfig
from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.additions.grip.config import GripConfig, GripKind
from grafu.additions.handle.config import HandleConfig
from grafu.additions.interior.request import InteriorRequest, parse_interior
from grafu.additions.top.config import TopConfig
from grafu.errors import OptionError, did_you_mean

TOP_SHAPES = ("rectangle", "rounded", "chamfered")
GRIPS = ("grip", "groove", "edge", "hole")
"""Recessed grips by name; `grip` is whichever of the others fits."""


def choose_additions(
    known_handles: Collection[str],
    *,
    base: AdditionConfig | None = None,
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
        top: whether tops are added, or their shape: one of `TOP_SHAPES`.
        handles: whether handles and grips are added, or their style: a template's id or one of `GRIPS`.
        drawer_boxes: whether a drawer that is only a front gets a box.
        compartments: whether what is solid behind doors and drawers gets compartments.
        door_frame: whether a door of a building that is drawn alone gets a frame.
        interior: `none`, `auto`, `predicted`, or counts for each compartment such as `shelves=2,dividers=1`.
        carcass: whether missing backs and bottoms are added.

    Raises:
        OptionError: if there is no such shape, style or interior.
    """
    config = base or AdditionConfig()
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
    if wanted not in TOP_SHAPES:
        raise OptionError(
            f"`top` must be one of {', '.join(TOP_SHAPES)}: got {wanted!r}{did_you_mean(wanted, TOP_SHAPES)}"
        )
    return replace(top, shape=wanted)  # type: ignore[arg-type]  # it is one of them


def _with_handles(config: AdditionConfig, wanted: bool | str, known: Collection[str]) -> AdditionConfig:
    if wanted is False:
        return replace(config, handles=None, grips=None)
    if wanted is True:
        usual = AdditionConfig()
        has_any = config.handles is not None or config.grips is not None
        return config if has_any else replace(config, handles=usual.handles, grips=usual.grips)
    if wanted in GRIPS:
        kind = GripConfig() if wanted == "grip" else GripConfig(GripKind(wanted))
        return replace(config, handles=None, grips=kind)
    if wanted not in known:
        every = (*known, *GRIPS)
        raise OptionError(f"`handle` must be one of {', '.join(every)}: got {wanted!r}{did_you_mean(wanted, every)}")
    handles, grips = config.handles or HandleConfig(), config.grips or GripConfig()
    return replace(config, handles=replace(handles, style=wanted), grips=grips)
