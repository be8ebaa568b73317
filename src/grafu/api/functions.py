"""`grafu.load` and `grafu.functionalize`: from a path to an asset, and from either to a result."""

import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from os import PathLike
from typing import Any, Final

from grafu.api.request import (
    Request,
    as_path,
    described,
    motion_in_words,
    optional_number,
    require,
    require_bool_or_word,
    require_word,
)
from grafu.api.result import Result
from grafu.articulation.base import BaseKind
from grafu.articulation.catch_kind import CatchKind
from grafu.asset.load import endings_in, load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset
from grafu.errors import AssetError, OptionError, did_you_mean
from grafu.export.output_names import output_name, with_ending
from grafu.joints.motion_choice import MotionChoice
from grafu.pipeline.addition_choice import choose_additions
from grafu.pipeline.foreign import prediction_for
from grafu.pipeline.motion_source import MotionSource, parse_motion
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import open_handles

PathLikeStr = str | PathLike[str]
_READING: Final = ("up", "front", "scale", "height", "labels", "parts", "pieces", "piece")
_OPTION: Final = re.compile(rf"--({'|'.join(reversed(_READING))})\b(?: (split|loose|[+-][XYZ]|\d[\d.e+-]*)(?![\w]))?")


def load(
    path: PathLikeStr,
    *,
    up: str | None = None,
    front: str | None = None,
    scale: float | None = None,
    height: float | None = None,
    labels: str = "input",
    parts: str = "auto",
    pieces: str = "together",
    piece: int | None = None,
) -> Asset:
    """Returns the asset at a path: its parts in metres, Z up, front -Y, standing on z = 0.

    Args:
        path: a file of a kind that is read (`docs/inputs.md`), or a folder of meshes, of PartNet-Mobility or of HSSD.
        up: the input's axis that points up, such as `+Y`; None: it is detected.
        front: the input's axis that points out of the front; None: it is detected.
        scale: metres per unit of the input; None: as the format states, or estimated.
        height: the real height in metres; wins over `scale`.
        labels: `input` takes categories from names, `none` ignores them.
        parts: `auto` takes the objects of the input as parts but cuts those that hide doors or drawers, `input` takes
            them as they are, `loose` takes each connected shell.
        pieces: `together` takes all that the input holds as one model, `split` one piece of furniture of it.
        piece: which one, from 1, in the order of `grafu.piece_names`; None: there is one only.

    Raises:
        TypeError: if an argument has a wrong type.
        AssetError: if the input cannot be read, has only one part, is split into several pieces and none is
            chosen, or an argument contradicts it.
        OptionError: if `labels`, `parts` or `pieces` is another word.
    """
    with _arguments_of_python():
        return load_asset(as_path(path, "path"), _reading(up, front, scale, height, labels, parts, pieces, piece))


def piece_names(path: PathLikeStr, **reading: Any) -> tuple[str, ...]:
    """Returns the names of the pieces of furniture that an input holds, from left to right; its own for a single one.

    Args:
        path: as for `grafu.load`.
        **reading: `up`, `front`, `scale`, `height`, `labels` and `parts` of `grafu.load`.

    Raises:
        TypeError: if an argument has a wrong type or an unknown name.
        AssetError: if the input cannot be read or holds no piece, or an argument contradicts it.
    """
    _require_known(reading, _READING[:-2], "piece_names")
    found = as_path(path, "path")
    with _arguments_of_python():
        endings = endings_in(found, _reading(**reading, pieces="split"))
    return tuple(with_ending(output_name(found), ending) for ending in endings)


def functionalize(
    source: PathLikeStr | Asset,
    *,
    motion: str = "auto",
    motions: Mapping[str, str] | None = None,
    weights: PathLikeStr | None = None,
    statics: str = "both",
    top: bool | str = True,
    handles: bool | str = True,
    drawer_boxes: bool = True,
    compartments: bool = True,
    door_frame: bool = True,
    interior: str = "predicted",
    carcass: bool = False,
    trim: bool = True,
    small_parts: bool | None = None,
    hinge: str = "",
    stays: bool = True,
    base: str | None = None,
    catch: str = "none",
    templates: PathLikeStr | None = None,
    **reading: Any,
) -> Result:
    """Returns the articulated furniture, its functional graph and its report.

    Args:
        source: a path, as for `grafu.load`, or the asset that it returned.
        motion: where motions come from: `auto`, `network`, `rule`, `annotation`, or another system's file such as
            `particulate:FILE`.
        motions: by the id of a part, how it moves, whatever the source states; see `Result.with_motion`.
        weights: a file of trained weights (ONNX) for the network; None: those that came with the package.
        statics: what decides which tops, handles, backs, bottoms, shelves and dividers are missing: `graph` (the
            completed graph), `geometry` (tests of the meshes) or `both`.
        top: whether a missing top is added, or its shape: `rectangle`, `rounded`, `chamfered`, `oval`, `capsule`; sizes
            may follow: `oval,thickness=3cm,front=2cm,side=1cm,back=0`.
        handles: whether handles or grips are added, or their style: a template's id, `grip`, `groove`, `edge`, `hole`;
            sizes of a grip may follow: `groove,length=12cm,width=3cm,depth=1cm,profile=sharp`.
        drawer_boxes: whether a drawer that is only a front gets a box.
        compartments: whether what is solid behind doors and drawers gets compartments.
        door_frame: whether a door of a building that is drawn alone gets a frame.
        interior: shelves and dividers: `predicted`, `auto`, `none`, or counts such as `shelves=2,dividers=1`,
            of shelves that slope down to the front with an angle: `shelves=3,angle=20deg`; or `carousel=2`, round
            trays that turn.
        carcass: whether missing backs and bottoms are added.
        trim: whether material may be taken away to give a part clearance.
        small_parts: whether knobs, buttons, wheels and casters get joints of their own; None: those that are links of
            their own in a robot description.
        hinge: the hinge that doors get where it finds room: a template's id, such as `cup`.
        stays: whether lids and flaps get stays where there is room.
        base: what holds the piece in a simulator: `free`, `fixed` or `wall`; None: it is fixed, and what is known to
            hang on a wall or to lean on one has `wall`.
        catch: what keeps doors and drawers closed in a simulator, besides friction: `none`, `detent` (they are held
            where they are closed) or `self-closing` (they are pulled closed over the last centimetres and held there).
        templates: a folder of your own hinge, rail and handle templates.
        **reading: `up`, `front`, `scale`, `height`, `labels`, `parts`, `pieces` and `piece` of `grafu.load`, where
            `source` is a path.

    Raises:
        TypeError: if an argument has a wrong type or an unknown name.
        FunctionalizationError: if the input, an option, a template or the weights are at fault.
    """
    folder = None if templates is None else as_path(templates, "templates")
    choice = parse_motion(require(motion, str, "motion", "a motion source such as `auto`"))
    additions = choose_additions(
        open_handles(folder),
        statics=require(statics, str, "statics", "`graph`, `geometry` or `both`"),
        top=require_bool_or_word(top, "top", "a shape"),
        handles=require_bool_or_word(handles, "handles", "a style"),
        drawer_boxes=require(drawer_boxes, bool, "drawer_boxes", "True or False"),
        compartments=require(compartments, bool, "compartments", "True or False"),
        door_frame=require(door_frame, bool, "door_frame", "True or False"),
        interior=require(interior, str, "interior", "a word such as `auto`"),
        carcass=require(carcass, bool, "carcass", "True or False"),
    )
    asset, read = _asset(source, reading)
    settings = Settings(
        MotionSource.AUTO if choice.source.is_foreign else choice.source,
        read,
        require(trim, bool, "trim", "True or False"),
        None if small_parts is None else require(small_parts, bool, "small_parts", "True, False or None"),
        motions=_motions(motions),
        additions=additions,
        weights=None if weights is None else as_path(weights, "weights"),
        hinge=require_word(hinge, "hinge", "the id of a hinge template, as str"),
        stays=require(stays, bool, "stays", "True or False"),
        base=_base(base),
        catch=_catch(catch),
    )
    foreign = prediction_for(choice, asset.name) if choice.source.is_foreign else None
    return Result.of(Request(asset, settings, foreign, folder))


def _base(word: str | None) -> BaseKind | None:
    if word is None:
        return None
    if require_word(word, "base", "`free`, `fixed`, `wall` or None") not in {known.value for known in BaseKind}:
        raise OptionError(f"`base` must be one of {', '.join(BaseKind)}: got {word!r}{did_you_mean(word, BaseKind)}")
    return BaseKind(word)


def _catch(word: str) -> CatchKind:
    if require_word(word, "catch", "`none`, `detent` or `self-closing`") not in {known.value for known in CatchKind}:
        raise OptionError(f"`catch` must be one of {', '.join(CatchKind)}: got {word!r}{did_you_mean(word, CatchKind)}")
    return CatchKind(word)


def _asset(source: object, reading: Mapping[str, Any]) -> tuple[Asset, LoadOptions]:
    _require_known(reading, _READING, "functionalize")
    if isinstance(source, Asset):
        if reading:
            raise OptionError(f"{', '.join(reading)} say how a path is read: give them to `grafu.load`")
        frame = source.frame
        return source, LoadOptions(frame.up, frame.front, frame.scale)
    if not isinstance(source, str | PathLike):
        raise TypeError(f"`source` must be a path or the asset that `grafu.load` returned: got {described(source)}")
    return load(source, **reading), _reading(**reading)


@contextmanager
def _arguments_of_python() -> Iterator[None]:
    """Raises the reader's errors, which name options of the command, with the names of arguments instead."""
    try:
        yield
    except AssetError as error:
        text = _OPTION.sub(lambda m: f"`{m[1]}={m[2]!r}`" if m[2] else f"`{m[1]}=`", str(error))
        raise type(error)(text) from error.__cause__


def _reading(
    up: str | None = None,
    front: str | None = None,
    scale: float | None = None,
    height: float | None = None,
    labels: str = "input",
    parts: str = "auto",
    pieces: str = "together",
    piece: int | None = None,
) -> LoadOptions:
    for name, value in (("up", up), ("front", front)):
        if value is not None:
            require(value, str, name, "an axis such as `+Z`")
    if labels not in ("input", "none"):
        raise OptionError(f"`labels` must be input or none: got {labels!r}")
    if parts not in ("auto", "input", "loose"):
        raise OptionError(f"`parts` must be auto, input or loose: got {parts!r}")
    if pieces not in ("together", "split"):
        raise OptionError(f"`pieces` must be together or split: got {pieces!r}")
    if piece is not None:
        require(piece, int, "piece", "a number such as 2, or None")
    numbers = optional_number(scale, "scale"), optional_number(height, "height")
    return LoadOptions(up, front, *numbers, labels, parts, pieces, piece)  # type: ignore[arg-type]  # checked above


def _require_known(given: Mapping[str, Any], known: Collection[str], function: str) -> None:
    unknown = sorted(set(given) - set(known))
    if unknown:
        raise TypeError(f"`grafu.{function}` has no argument {', '.join(unknown)}")


def _motions(given: Mapping[str, str] | None) -> dict[str, MotionChoice]:
    if given is None:
        return {}
    require(given, Mapping, "motions", "a dict such as {'door_1': 'left'}")  # type: ignore[type-abstract]
    return {part: motion_in_words(part, word) for part, word in given.items()}
