"""What may be added, in the words that the command and the Python functions share. It adds nothing."""

from collections.abc import Collection
from dataclasses import replace

from grafu.errors import OptionError
from grafu.pipeline.addition_config import AdditionConfig
from grafu.realization.carcass.config import CarcassConfig
from grafu.realization.drawer_box.config import DrawerBoxConfig
from grafu.realization.grip.config import GripConfig, GripKind
from grafu.realization.handle.config import HandleConfig
from grafu.realization.interior.request import parse_interior
from grafu.realization.top.config import TopConfig

TOP_SHAPES = ("rectangle", "rounded", "chamfered")
GRIPS = ("grip", "groove", "edge", "hole")
"""Recessed grips by name; `grip` is whichever of the others fits."""


def choose_additions(
    known_handles: Collection[str],
    *,
    top: bool | str = True,
    handles: bool | str = True,
    drawer_boxes: bool = True,
    interior: str = "predicted",
    carcass: bool = False,
) -> AdditionConfig:
    """Returns the configuration that the words state.

    Args:
        known_handles: the ids of all handle templates.
        top: whether tops are added, or their shape: one of `TOP_SHAPES`.
        handles: whether handles and grips are added, or their style: a template's id or one of `GRIPS`.
        drawer_boxes: whether a drawer that is only a front gets a box.
        interior: `none`, `auto`, `predicted`, or counts for each compartment such as `shelves=2,dividers=1`.
        carcass: whether missing backs and bottoms are added.

    Raises:
        OptionError: if there is no such shape, style or interior.
    """
    config = AdditionConfig(
        top=_top(top),
        drawer_boxes=DrawerBoxConfig() if drawer_boxes else None,
        carcass=CarcassConfig() if carcass else None,
    )
    try:
        config = replace(config, interior=parse_interior(interior))
    except ValueError as error:
        raise OptionError(str(error)) from None
    return _with_handles(config, handles, known_handles)


def _top(wanted: bool | str) -> TopConfig | None:
    if isinstance(wanted, bool):
        return TopConfig() if wanted else None
    if wanted not in TOP_SHAPES:
        raise OptionError(f"`top` must be one of {', '.join(TOP_SHAPES)}: got {wanted!r}")
    return TopConfig(shape=wanted)  # type: ignore[arg-type]  # it is one of them


def _with_handles(config: AdditionConfig, wanted: bool | str, known: Collection[str]) -> AdditionConfig:
    if isinstance(wanted, bool):
        return config if wanted else replace(config, handles=None, grips=None)
    if wanted in GRIPS:
        kind = GripConfig() if wanted == "grip" else GripConfig(GripKind(wanted))
        return replace(config, handles=None, grips=kind)
    if wanted not in known:
        raise OptionError(f"`handle` must be one of {', '.join((*known, *GRIPS))}: got {wanted!r}")
    return replace(config, handles=HandleConfig(style=wanted))
