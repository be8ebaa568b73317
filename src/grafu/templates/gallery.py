"""The built-in gallery, one table of styles and real-world sizes, and what a run can use with it: the user's own first.

It builds nothing until asked.
"""

from functools import cache
from math import radians
from pathlib import Path

from grafu.templates import leaves
from grafu.templates.concealed import ConcealedModel
from grafu.templates.handles import HANDLES
from grafu.templates.hinges import HingeStyle, hinge_model
from grafu.templates.rails import CENTRE_STYLE, CORNER_STYLE, rail_model
from grafu.templates.solids import BLACK, BRASS, BRONZE, NICKEL, STEEL
from grafu.templates.template import Gallery, HandleTemplate, HingeModel, HingeSize, RailModel, RailSize
from grafu.vocabulary import MechanismClass

_C, _F, _P = MechanismClass.C, MechanismClass.F, MechanismClass.P
_BUTT = HingeStyle(_C, radians(170), STEEL, leaves.plain, leaves.plain, leaves.screws_in_column, leaves.FLAT_HEAD)
_BALL = HingeStyle(_C, radians(170), BRASS, leaves.rounded, leaves.rounded, leaves.screws_in_column, leaves.BALL_TIP)
_LIFT = HingeStyle(
    _C, radians(105), BLACK, leaves.square, leaves.square, leaves.screws_in_column, leaves.ACORN, knuckles=2
)
_PIANO = HingeStyle(
    _C,
    radians(170),
    NICKEL,
    leaves.square,
    leaves.square,
    leaves.screws_every(0.1),
    leaves.PLAIN,
    pitch=0.04,
    segments=10,
)
_FLUSH = HingeStyle(_F, radians(170), STEEL, leaves.rounded, leaves.rounded, leaves.screws_wide, leaves.FLAT_HEAD)
_BUTTERFLY = HingeStyle(
    _F, radians(165), BRASS, leaves.butterfly, leaves.butterfly, leaves.screws_wide, leaves.PLAIN, 0.52, 3
)
_H = HingeStyle(
    _F, radians(165), BLACK, leaves.h_shape, leaves.h_shape, leaves.screws_on_upright, leaves.FLAT_HEAD, 0.4, 3
)
_STRAP = HingeStyle(
    _F, radians(160), BLACK, leaves.strap, leaves.strap, leaves.screws_along, leaves.FLAT_HEAD, knuckles=3
)
_ANGLE = HingeStyle(_P, radians(100), STEEL, leaves.plain, leaves.plain, leaves.screws_wide, leaves.FLAT_HEAD)
_CORNER = HingeStyle(
    _P, radians(100), BRONZE, leaves.scalloped, leaves.scalloped, leaves.screws_in_triangle, leaves.BALL_TIP
)
_ROUND = HingeStyle(
    _P,
    radians(95),
    BRASS,
    leaves.quarter_round,
    leaves.quarter_round,
    leaves.screws_in_triangle,
    leaves.FLAT_HEAD,
    0.9,
    3,
)

# id, title, style, natural size: length, leaf, thickness, radius in metres
_HINGES = (
    ("butt", "Butt hinge", _BUTT, HingeSize(0.064, 0.0175, 0.0018, 0.0034)),
    ("ball_tip", "Ball-tip hinge", _BALL, HingeSize(0.076, 0.018, 0.002, 0.0036)),
    ("lift_off", "Lift-off hinge", _LIFT, HingeSize(0.07, 0.018, 0.002, 0.004)),
    ("piano", "Piano hinge", _PIANO, HingeSize(0.6, 0.015, 0.001, 0.0024)),
    ("flush", "Flush hinge", _FLUSH, HingeSize(0.063, 0.028, 0.0018, 0.0034)),
    ("butterfly", "Butterfly hinge", _BUTTERFLY, HingeSize(0.05, 0.034, 0.0016, 0.003)),
    ("h_hinge", "H hinge", _H, HingeSize(0.09, 0.03, 0.002, 0.0036)),
    ("strap", "Strap hinge", _STRAP, HingeSize(0.04, 0.11, 0.002, 0.0042)),
    ("angle", "Angle hinge", _ANGLE, HingeSize(0.06, 0.026, 0.0018, 0.004)),
    ("corner", "Ornamental corner hinge", _CORNER, HingeSize(0.07, 0.036, 0.002, 0.0042)),
    ("quadrant", "Quadrant hinge", _ROUND, HingeSize(0.05, 0.03, 0.0018, 0.0038)),
)
_RAILS = (
    ("centre_mount", "Ball-bearing side rail", CENTRE_STYLE, RailSize(0.45, 0.045, 0.0127)),
    ("corner_mount", "Bottom-corner roller rail", CORNER_STYLE, RailSize(0.45, 0.036, 0.0125)),
)


@cache
def builtin_gallery() -> Gallery:
    """Returns the project's own templates, best first within each class."""
    hinges: tuple[HingeModel, ...] = tuple(hinge_model(*row) for row in _HINGES)
    rails: tuple[RailModel, ...] = tuple(rail_model(*row) for row in _RAILS)
    return Gallery(hinges, rails, (ConcealedModel("cup", "Concealed cup hinge"),))


def open_gallery(folder: Path | None) -> Gallery:
    """Returns the built-in gallery; the templates in `folder` come first where one is given.

    Raises:
        TemplateError: if a template in the folder is at fault.
    """
    if folder is None:
        return builtin_gallery()
    from grafu.templates.user import load_gallery

    return builtin_gallery().extended(load_gallery(folder))


def own_handles(folder: Path | None) -> dict[str, HandleTemplate]:
    """Returns the user's own handles in `folder` by id; without a folder none.

    Raises:
        TemplateError: if a handle in the folder is at fault.
    """
    if folder is None:
        return {}
    from grafu.templates.user import load_handles

    return load_handles(folder)


def open_handles(folder: Path | None) -> dict[str, HandleTemplate]:
    """Returns all handles by id, the user's own in `folder` first; one of theirs replaces a built-in one of its name.

    Raises:
        TemplateError: if a handle in the folder is at fault.
    """
    built_in, own = {template.id: template for template in HANDLES}, own_handles(folder)
    return {**own, **{name: template for name, template in built_in.items() if name not in own}}
