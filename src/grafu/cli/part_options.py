"""Options on parts and the whole: `--motion`, `--move`, `--base`, `--catch`, those of additions. They move nothing."""

import argparse
import re
from typing import TYPE_CHECKING

from grafu.articulation.base import BaseKind
from grafu.articulation.catch_kind import CatchKind
from grafu.errors import OptionError, did_you_mean
from grafu.pipeline.motion_source import SourceOption, parse_motion
from grafu.vocabulary import MOTION_WORDS

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from grafu.additions.config import AdditionConfig
    from grafu.pipeline.settings import Settings

MOVE_HELP = (
    "how a part moves, whatever the motion source states: it turns about its left, right, top, bottom, front or back "
    "side (lift: top, drop: bottom; tilt: bottom, with its bin, and not far); lift-parallel: upright, on arms; slides, "
    "pull: out of the front; slide-left, slide-right, slide-up: along itself; fold-left, fold-right, fold-up: as one "
    "of two leaves that fold to that side; fixed; once for each part"
)
"""The help of `--move`."""


def motion_choice(text: str) -> SourceOption:
    """Returns the choice that `SOURCE` or `SOURCE:FILE` states; raises argparse's error where there is none."""
    try:
        return parse_motion(text)
    except OptionError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


OLD_FIXED = "not"  # the word of earlier versions for `fixed`
Move = tuple[str, str]


def part_move(text: str) -> Move:
    """Returns a part's id and how it moves, of `PART=HOW`.

    Raises:
        argparse.ArgumentTypeError: if it is not of that form.
    """
    part, _, motion = text.rpartition("=")
    if part and motion == OLD_FIXED:
        raise argparse.ArgumentTypeError(f"`not` is called `fixed` now: use --move {part}=fixed")
    if not part or motion not in MOTION_WORDS:
        near = did_you_mean(motion, MOTION_WORDS) if part else ""
        raise argparse.ArgumentTypeError(f"must be PART=HOW, HOW one of {', '.join(MOTION_WORDS)}: got {text!r}{near}")
    return part, motion


def with_moves(
    settings: "Settings", moves: "Sequence[Move]", alone: bool, prediction: "SourceOption | None"
) -> "Settings":
    """Returns the settings in which these parts move so; `alone` states that there is one input only.

    Raises:
        OptionError: if there are several inputs, or the motions are another system's.
    """
    from grafu.errors import OptionError
    from grafu.joints.motion_choice import choice_in_words

    if not alone:
        raise OptionError("`--move` names parts of one model: give one input, of split pieces one by --piece")
    if prediction is not None:
        raise OptionError(f"`--move` and `--motion {prediction.source}` exclude each other: leave one of them out")
    for part, word in moves:
        settings = settings.with_motion(part, choice_in_words(word))
    return settings


GRASP_HELP = (
    "what a door or drawer is grasped by, whatever the others get: none, a handle of `grafu templates`, or a carved "
    "grip: grip, groove, edge, hole; its sizes may follow: door_1=groove,length=12cm,width=3cm,depth=1cm,"
    "profile=sharp, of a handle its length alone; once for each part"
)
"""The help of `--grasp`."""
Grasp = tuple[str, str]


def part_grasp(text: str) -> Grasp:
    """Returns a part's id and what it is grasped by, of `PART=STYLE[,SIZE=LENGTH...]`.

    Raises:
        argparse.ArgumentTypeError: if it is not of that form.
    """
    choice, *sizes = text.split(",")
    part, _, style = choice.rpartition("=")
    if not part or not style:
        raise argparse.ArgumentTypeError(f"must be PART=STYLE, sizes behind the style: got {text!r}")
    return part, ",".join([style, *sizes])


def with_grasps(settings: "Settings", grasps: "Sequence[Grasp]", alone: bool, handles: "Collection[str]") -> "Settings":
    """Returns the settings in which these parts are grasped so; `alone` states that there is one input only.

    `handles` are the ids of all handle templates.

    Raises:
        OptionError: if there are several inputs, no such style, or what follows a style is no size that it has.
    """
    from grafu.errors import OptionError
    from grafu.pipeline.addition_choice import front_choice

    if not alone:
        raise OptionError("`--grasp` names parts of one model: give one input, of split pieces one by --piece")
    for part, stated in grasps:
        try:
            settings = settings.with_front(part, front_choice(stated, handles))
        except OptionError as error:
            raise OptionError(str(error).replace("`grasp`", "`--grasp`")) from None
    return settings


def add_choices_of_parts(parser: argparse.ArgumentParser) -> None:
    """Adds --move and --grasp: what is decided of single parts."""
    parser.add_argument("--move", action="append", type=part_move, default=[], metavar="PART=HOW", help=MOVE_HELP)
    parser.add_argument(
        "--grasp", action="append", type=part_grasp, default=[], metavar="PART=STYLE[,...]", help=GRASP_HELP
    )


def add_simulator_options(parser: argparse.ArgumentParser) -> None:
    """Adds --base and --catch: what holds the piece in a simulator, and what keeps its doors and drawers closed."""
    parser.add_argument(
        "--base",
        type=_base,
        metavar="HOW",
        help="what holds the piece in a simulator: free: nothing, it stands on the floor; fixed: it is fixed to the "
        "world; wall: it hangs on a wall or leans on one (default: fixed, and what is known to hang or lean there: "
        "wall)",
    )

    parser.add_argument(
        "--catch",
        type=_catch,
        metavar="KIND",
        help="what keeps doors and drawers closed in a simulator, besides friction: none; detent: they are held where "
        "they are closed; self-closing: they are pulled closed over the last centimetres and held there "
        "(default: none)",
    )


def _catch(text: str) -> CatchKind:
    if text not in {known.value for known in CatchKind}:
        raise argparse.ArgumentTypeError(f"must be one of {', '.join(CatchKind)}: got {text!r}")
    return CatchKind(text)


def _base(text: str) -> BaseKind:
    if text not in {known.value for known in BaseKind}:
        raise argparse.ArgumentTypeError(f"must be one of {', '.join(BaseKind)}: got {text!r}")
    return BaseKind(text)


TOP_SHAPES = ("rectangle", "rounded", "chamfered", "oval", "capsule")
STATICS = ("graph", "geometry", "both")  # as in `grafu.additions.statics`
GRIPS = ("grip", "groove", "edge", "hole")  # `grip`: whichever of the others fits


def add_addition_options(parser: argparse.ArgumentParser) -> None:
    """Adds what is said of additions: --only, --no-top, --no-handles, ..., --small-parts and --complete."""
    group = parser.add_argument_group("what is added (by default: tops, handles, drawer boxes, predicted shelves)")
    group.add_argument("--only", choices=("dynamic",), help="dynamic: joints and their hardware, nothing else is added")
    group.add_argument(
        "--statics",
        choices=STATICS,
        help="what decides which tops, handles, backs, bottoms, shelves and dividers are missing: the completed graph, "
        "tests of the geometry, or both (default: both)",
    )
    group.add_argument("--no-top", action="store_true", help="add no top, also where there is none")
    group.add_argument("--no-handles", action="store_true", help="add no handles and carve no grips")
    group.add_argument("--no-drawer-boxes", action="store_true", help="leave drawers that are only a front as they are")
    group.add_argument(
        "--no-compartments", action="store_true", help="leave what is solid behind doors and drawers as it is"
    )
    group.add_argument("--no-door-frame", action="store_true", help="add no frame to a door that is drawn without one")
    group.add_argument(
        "--top",
        metavar="SHAPE",
        help=f"shape of added tops: {', '.join(TOP_SHAPES)}; sizes may follow: oval,thickness=3cm,front=2cm,side=1cm,"
        "back=0",
    )
    group.add_argument(
        "--hinge",
        metavar="ID",
        help="hinges of doors, where these find room: a template of `grafu templates`, such as cup (default: the first "
        "that fits)",
    )
    group.add_argument("--no-stays", action="store_true", help="add no stays to lids and flaps")
    group.add_argument(
        "--handle",
        metavar="STYLE",
        help="style of added handles: a template of `grafu templates`, or a carved one: grip, groove, edge, hole; its "
        "sizes may follow: groove,length=12cm,width=3cm,depth=1cm,profile=sharp, of a template its length alone "
        "(default: like the model's other handles)",
    )
    group.add_argument(
        "--interior",
        metavar="WHAT",
        help="shelves and dividers: none, predicted, auto, or numbers per compartment like shelves=2,dividers=1; "
        "shelves=3,angle=20deg slope down to the front, carousel=2 are round trays that turn "
        "(default: predicted)",
    )
    group.add_argument(
        "--small-parts",
        action=argparse.BooleanOptionalAction,
        help="knobs, buttons, wheels and casters get joints of their own "
        "(default: those that are links of their own in a robot description)",
    )
    group.add_argument("--complete", choices=("carcass",), help="carcass: add backs and bottoms that are missing")


def addition_config(
    options: argparse.Namespace, handles: "Collection[str]", base: "AdditionConfig | None" = None
) -> "AdditionConfig":
    """Returns what the arguments allow to be added; what they leave out is as in `base` (None: by default).

    `handles` are the ids of all handle templates.

    Raises:
        OptionError: if options contradict each other, or name a style or an interior that there is not.
    """
    from grafu.additions.config import NO_ADDITIONS
    from grafu.errors import OptionError
    from grafu.pipeline.addition_choice import choose_additions

    _require_consistent(options)
    if options.only == "dynamic":
        return NO_ADDITIONS
    try:
        return choose_additions(
            handles,
            base=base,
            statics=options.statics,
            top=False if options.no_top else options.top,
            handles=False if options.no_handles else options.handle,
            drawer_boxes=False if options.no_drawer_boxes else None,
            compartments=False if options.no_compartments else None,
            door_frame=False if options.no_door_frame else None,
            interior=options.interior,
            carcass=True if options.complete == "carcass" else None,
        )
    except OptionError as error:
        raise OptionError(re.sub("`(interior|handle|top)`", r"`--\1`", str(error))) from None


def _require_consistent(options: argparse.Namespace) -> None:
    from grafu.errors import OptionError

    asked = {
        "--top": options.top,
        "--handle": options.handle,
        "--interior": options.interior,
        "--complete": options.complete,
        "--statics": options.statics,
    }
    pairs = [("--only", options.only, name) for name in asked]
    pairs += [("--no-top", options.no_top, "--top"), ("--no-handles", options.no_handles, "--handle")]
    for refusing, is_given, name in pairs:
        if is_given and asked[name]:
            raise OptionError(f"`{name}` and `{refusing}` exclude each other: leave one of them out")
