"""`read_foreign`: another system's prediction from its file, whatever the format. It matches nothing with an asset.

The kind of a file is detected from its content; `grafu.asset.foreign.attach.attach_motions` lays it over an asset.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Final

from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart, ForeignSource
from grafu.asset.foreign.particulate import read_particulate
from grafu.asset.foreign.singapo import TREES, read_singapo
from grafu.asset.json_files import parse_json
from grafu.asset.load import is_partnet_mobility
from grafu.asset.options import Limits, LoadOptions, check_parts
from grafu.asset.part import AnnotatedJoint, Annotation
from grafu.asset.partnet_mobility import read_partnet_mobility
from grafu.asset.regular_files import files_below, is_within
from grafu.asset.resources import ModelFiles, read_bytes
from grafu.asset.urdf import read_urdf
from grafu.errors import AssetError, UnreadableAsset
from grafu.graph.official_prediction import SUFFIX, is_prediction, read_prediction
from grafu.pipeline.motion_source import SourceOption

_JOINT_NAMES = re.compile(rb"<joint\b[^>]*\bname=[\"']([^\"']*)")
_PARTICULATE = re.compile(rb"joint_\d+_\d+")  # joint_<parent>_<child>


def read_robot(path: Path, options: LoadOptions = LoadOptions()) -> ForeignMotions:
    """Returns the joints of a URDF file (or of a folder that is a PartNet-Mobility model) as a prediction.

    A URDF whose joints are all named in Particulate's way comes out as Particulate's.

    Raises:
        UnreadableAsset: if the file is missing or damaged.
        AssetTooLarge: if it exceeds the limits.
    """
    files = ModelFiles(path, options.limits)
    reading = read_partnet_mobility(path, options, files) if path.is_dir() else read_urdf(path, options, files)
    stated = reading.annotation or Annotation(reading.parts)
    check_parts(len(stated.parts), path, options.limits)
    parts = tuple(ForeignPart(p.id, p.mesh, label=p.label, parent=p.carried_by) for p in stated.parts)
    joints = tuple(_joint(joint) for joint in stated.joints)
    named = [] if path.is_dir() else _JOINT_NAMES.findall(read_bytes(path, options.limits))
    is_particulate = bool(named) and all(_PARTICULATE.fullmatch(name) for name in named)
    try:
        return ForeignMotions(
            "particulate" if is_particulate else "urdf", str(path), parts, joints, notes=(*reading.notes, *stated.notes)
        )
    except AssetError as error:
        raise UnreadableAsset(str(error)) from None


def _joint(joint: AnnotatedJoint) -> ForeignJoint:
    return ForeignJoint(joint.part, joint.type, joint.axis, joint.lower, joint.upper, joint.limited)


Reader = Callable[[Path, LoadOptions], ForeignMotions]

_READERS: Final[dict[str, Reader]] = {
    "particulate": read_particulate,
    "singapo": read_singapo,
    "grafu-pred": read_prediction,
    "urdf": read_robot,
}
_EXPECTED: Final[dict[str, str]] = {
    "particulate": "pred.npz beside pred.obj, the folder of its --eval, or its URDF",
    "singapo": "SINGAPO's or CAGE's object.json",
    "grafu-pred": "the authors' <model>_pred.json",
    "urdf": "a URDF file or a PartNet-Mobility folder",
}
_LIMITS = Limits()
_ENTRIES = ("", ".json", ".npz", ".urdf", SUFFIX)
_ANY = "; ".join(_EXPECTED.values())


def read_foreign(path: Path, source: ForeignSource | None = None, limits: Limits = _LIMITS) -> ForeignMotions:
    """Returns the prediction at `path`, a file or the folder that holds it.

    Args:
        path: what the other system wrote.
        source: whose it is said to be; None: whatever its content states.
        limits: what is read at most, of all its files together.

    Raises:
        UnreadableAsset: if there is nothing that can be read, it is damaged, or it is not of that source.
        AssetTooLarge: if it exceeds the limits.
    """
    path = Path(path)
    try:
        found = _found(path, limits)
    except OSError as error:
        raise UnreadableAsset(f"{path} cannot be read ({error.strerror}): expected {_expected(source)}") from None
    if found is None:
        state = "is no prediction that is read" if path.exists() else "does not exist"
        raise UnreadableAsset(f"{path} {state}: expected {_expected(source)}")
    kind, place = found
    if path.is_dir() and not is_within(place, path):
        raise UnreadableAsset(f"{place} leads out of {path}: expected {_expected(source)} in the folder itself")
    # Whose a robot description is, its content does not always say.
    if source is not None and kind != source and kind != "urdf":
        raise UnreadableAsset(f"{path} is of the kind {kind}, not {source}: expected {_expected(source)}")
    motions = _READERS[kind](
        place, LoadOptions(limits=limits)
    )  # what else is chosen for the input, it does not hold for
    if source is None or motions.source == source:
        return motions
    if {source, motions.source} == {"urdf", "particulate"}:
        return replace(motions, source=source)
    raise UnreadableAsset(f"{path} is of the kind {motions.source}, not {source}: expected {_expected(source)}")


def prediction_for(choice: SourceOption, name: str, alone: bool = True, limits: Limits = _LIMITS) -> ForeignMotions:
    """Returns what a foreign choice holds for the input whose results are called `name`.

    Where the choice's folder has an entry of that name (`name/`, `name.json`, `name.npz`, `name.urdf` or
    `name_pred.json`), that is read. Else the whole is, if the input is `alone`. Of it no more is
    read than the `limits` allow.

    Raises:
        UnreadableAsset: if there is no entry for one of several inputs, or what is there is damaged.
        AssetTooLarge: if it exceeds the limits.
    """
    folder = Path(choice.path or "")
    source: ForeignSource = choice.source.value  # type: ignore[assignment]
    entry = next((path for path in (folder / f"{name}{end}" for end in _ENTRIES) if path.exists()), None)
    if entry is None and not alone:
        raise UnreadableAsset(f"{folder} holds nothing for {name}: for several inputs {folder}/{name} is expected")
    if entry is not None and not is_within(entry, folder):
        raise UnreadableAsset(f"{entry} leads out of {folder}: expected {_expected(source)} in the folder itself")
    return read_foreign(entry or folder, source, limits)


def _expected(source: ForeignSource | None) -> str:
    return _ANY if source is None else _EXPECTED[source]


def _found(path: Path, limits: Limits) -> tuple[str, Path] | None:
    """Returns which reader reads what is at a path, and the file or folder to give it, or None."""
    return _in_folder(path) if path.is_dir() else _of_file(path, limits) if path.is_file() else None


def _in_folder(folder: Path) -> tuple[str, Path] | None:
    for file in (folder / "pred.npz", folder / "eval" / "pred.npz"):
        if file.is_file():
            return "particulate", file
    if (folder / "object.json").is_file():
        return "singapo", folder / "object.json"
    predicted = sorted(folder.glob(f"*{SUFFIX}"))
    if len(predicted) == 1:
        return "grafu-pred", predicted[0]
    if is_partnet_mobility(folder):
        return "urdf", folder
    robots = files_below(folder, (".urdf",))
    return ("urdf", robots[0]) if len(robots) == 1 else None


def _of_file(path: Path, limits: Limits) -> tuple[str, Path] | None:
    if path.suffix.lower() == ".npz":
        return "particulate", path
    if path.suffix.lower() == ".urdf":
        return "urdf", path
    data = read_bytes(path, limits)
    if path.suffix.lower() == ".json":
        return _of_json(data, path, limits)
    return ("urdf", path) if b"<robot" in data[:4096] else None


def _of_json(data: bytes, path: Path, limits: Limits) -> tuple[str, Path] | None:
    decoded = parse_json(data, path, f"{_EXPECTED['singapo']}; {_EXPECTED['grafu-pred']}", limits)
    if isinstance(decoded, dict) and any(key in decoded for key in TREES):
        return "singapo", path
    return ("grafu-pred", path) if is_prediction(decoded) else None
