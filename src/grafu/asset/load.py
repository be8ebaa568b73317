"""`load_asset`: from a path to an asset in the object frame. It knows which reader reads what, and no format.

The kind of an input is detected from its content: PartNet-Mobility's files, a GLB with annotated parts beside it, a
`<robot>` element, glTF's JSON or magic bytes.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Final

from grafu.asset.collada import read_collada
from grafu.asset.cutting import cut_where_fronts_appear
from grafu.asset.fbx import read_fbx
from grafu.asset.fbx_document import MAGIC
from grafu.asset.folder import divide, looked_for_fronts, mesh_files_in, read_mesh, read_mesh_folder
from grafu.asset.folders import files_below
from grafu.asset.frame import settle_frame, whole_box
from grafu.asset.gltf import read_gltf
from grafu.asset.hssd import is_hssd, model_of_annotation, read_hssd
from grafu.asset.loose import loose_parts, with_split_handles
from grafu.asset.mesh_files import MESH_SUFFIXES
from grafu.asset.mjcf import read_mjcf
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.part import Asset, Part
from grafu.asset.partnet_mobility import is_partnet_mobility, read_partnet_mobility
from grafu.asset.pieces import with_joined_pieces
from grafu.asset.plausibility import with_plausible_labels
from grafu.asset.reading import Placing, Reading, cleaned
from grafu.asset.regular_files import read_head
from grafu.asset.resources import ModelFiles
from grafu.asset.sdf import read_sdf
from grafu.asset.threemf import read_threemf
from grafu.asset.urdf import read_urdf
from grafu.asset.usd import USD_SUFFIXES, read_usd
from grafu.errors import UnreadableAsset, UnsegmentedAsset
from grafu.vocabulary import PartLabel

Reader = Callable[[Path, LoadOptions, ModelFiles], Reading]

READERS: Final[dict[str, Reader]] = {
    "partnet-mobility": read_partnet_mobility,
    "hssd": read_hssd,
    "urdf": read_urdf,
    "sdf": read_sdf,
    "mjcf": read_mjcf,
    "gltf": read_gltf,
    "collada": read_collada,
    "usd": read_usd,
    "fbx": read_fbx,
    "3mf": read_threemf,
    "mesh folder": read_mesh_folder,
    "mesh file": read_mesh,
}
# Files of which a folder holds one, by how their names end; the first kind that is there is read.
_SCENES: Final = {
    "urdf": (".urdf",),
    "sdf": (".sdf",),
    "gltf": (".glb", ".gltf"),
    "collada": (".dae",),
    "usd": USD_SUFFIXES,
    "fbx": (".fbx",),
    "3mf": (".3mf",),
    "mjcf": (".xml",),
}
_HEAD: Final = 4096  # bytes of a file that tell what it is
_EXPECTED = (
    "a PartNet-Mobility folder, an HSSD model, a URDF, SDF or MJCF, a GLB, glTF, COLLADA, OpenUSD, FBX or 3MF scene, "
    "an OBJ with groups, or a folder of meshes"
)

_AS_GLB = "open it in the program that made it, or in Blender, and export it as GLB, objects apart"
# What people try, by the way it ends, and what they can do with it.
_WAYS_IN: Final[dict[str, str]] = {
    ".xacro": "expand it first: xacro FILE.xacro > FILE.urdf",
    ".skp": "in SketchUp, export it as GLB or COLLADA, groups and components kept",
    **dict.fromkeys(
        (".step", ".stp", ".iges", ".igs"), "in a CAD program (FreeCAD), export it as glTF, a body for each part"
    ),
    **dict.fromkeys((".blend", ".3ds", ".max", ".c4d", ".ma", ".mb", ".x3d"), _AS_GLB),
    **dict.fromkeys((".zip", ".7z", ".rar", ".gz", ".tar"), "unpack it and give what it holds"),
    **dict.fromkeys((".jpg", ".jpeg", ".png", ".webp"), "a picture is no model; give one that is divided into parts"),
}


def load_asset(path: Path, options: LoadOptions = LoadOptions()) -> Asset:
    """Returns the asset at `path`, in metres, Z up, front -Y, standing on z = 0.

    Args:
        path: a file or a folder.
        options: what the user states about the frame, the scale, the labels and the limits.

    Raises:
        UnreadableAsset: if there is nothing at the path that can be read, or it is damaged.
        UnsegmentedAsset: if it is one piece where parts were expected.
        AssetTooLarge: if it exceeds a limit.
        AssetError: if an option contradicts the input.
    """
    path = Path(path)
    kind, place = detect(path)
    # named as a file of its folder, a model of the data set is that folder
    files = ModelFiles(place if kind == "partnet-mobility" else path, options.limits)
    name = _name(place if kind == "partnet-mobility" else path)  # its folder names the model, never `mobility.urdf`
    return settled(READERS[kind](place, options, files), name, path, options)


def settled(reading: Reading, name: str, path: Path, options: LoadOptions = LoadOptions()) -> Asset:
    """Returns what was read as an asset in the object frame, cleaned, its loose pieces joined, its handles carried.

    Raises:
        UnreadableAsset: if it holds no part with faces.
        UnsegmentedAsset: if it is one piece where parts were expected.
        AssetTooLarge: if it exceeds a limit.
        AssetError: if an option contradicts it.
    """
    reading = cleaned(reading)
    if options.parts == "loose":
        reading = _taken_apart(reading, path, options)
    elif not reading.grouped and reading.parts:
        reading = _joined(reading)
    if reading.parts:
        reading = _plausible(reading)
    if options.parts == "auto" and reading.parts:
        reading = _with_split_handles(cut_where_fronts_appear(reading, settle_frame(reading, options), name))
    _check_parts(reading, path, options)
    reading = _without_labels(reading) if options.labels == "none" else reading
    frame = settle_frame(reading, options)
    place = Placing(frame)
    annotation = reading.annotation and place.annotation(reading.annotation)
    return Asset(
        name, str(path), reading.kind, place.parts(reading.parts), frame, notes=reading.notes, annotation=annotation
    )


def _name(path: Path) -> str:
    return path.resolve().name if path.is_dir() else path.stem


def detect(path: Path) -> tuple[str, Path]:
    """Returns which reader reads what is at `path`, and the file or folder to give it.

    Raises:
        UnreadableAsset: if there is nothing, or nothing that is read.
    """
    try:
        if not path.exists():
            raise UnreadableAsset(f"{path} does not exist: expected {_EXPECTED}")
        return _detect_folder(path) if path.is_dir() else _detect_file(path)
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or "no file can have this name"
        raise UnreadableAsset(f"{path} cannot be read ({why}): expected {_EXPECTED}") from None


def _detect_file(path: Path) -> tuple[str, Path]:
    suffix = path.suffix.lower()
    if path.name in ("mobility.urdf", "mobility_v2.json") and is_partnet_mobility(path.parent):
        return "partnet-mobility", path.parent
    model = path if is_hssd(path) else model_of_annotation(path)
    if model is not None:
        return "hssd", model
    head = read_head(path, _HEAD)
    if suffix == ".urdf" or (b"<robot" in head and suffix != ".xacro"):
        return "urdf", path
    if suffix == ".sdf" or b"<sdf" in head:
        return "sdf", path
    if suffix == ".mjcf" or _is_mjcf(head):
        return "mjcf", path
    if suffix in (".glb", ".gltf") or head[:4] == b"glTF":
        return "gltf", path
    if suffix == ".dae" or b"<COLLADA" in head:
        return "collada", path
    if suffix in USD_SUFFIXES or head[:8] == b"PXR-USDC" or head[:5] == b"#usda":
        return "usd", path
    if suffix == ".fbx" or head.startswith(MAGIC):
        return "fbx", path
    if suffix == ".3mf":
        return "3mf", path
    if suffix in MESH_SUFFIXES:
        return "mesh file", path
    way_in = f"; {_WAYS_IN[suffix]}" if suffix in _WAYS_IN else ""
    raise UnreadableAsset(f"{path} is not a kind of file that is read: expected {_EXPECTED}{way_in}")


def _is_mjcf(head: bytes) -> bool:
    return b"<mujoco" in head and b"<mujocoinclude" not in head and b"<robot" not in head


def _detect_folder(folder: Path) -> tuple[str, Path]:
    if is_partnet_mobility(folder):
        return "partnet-mobility", folder
    for kind, suffixes in _SCENES.items():
        found = [path for path in files_below(folder, suffixes) if kind != "mjcf" or _is_mjcf(read_head(path, _HEAD))]
        if len(found) == 1:
            return ("hssd" if is_hssd(found[0]) else kind), found[0]
        if len(found) > 1:
            raise UnreadableAsset(_several(folder, found))
    if mesh_files_in(folder):
        return "mesh folder", folder
    state = "is empty" if not any(folder.iterdir()) else "holds nothing that is read"
    raise UnreadableAsset(f"{folder} {state}: expected {_EXPECTED}")


def _several(folder: Path, found: list[Path]) -> str:
    """Returns what to do about a folder of models: name one of them, or all by a pattern."""
    names = ", ".join(str(path.relative_to(folder)) for path in found[:3])
    kind = found[0].suffix
    pattern = f"*{kind}" if found[0].parent == folder else "*"
    return f"{folder} holds {len(found)} {kind} files ({names}): name one, or all of them as {folder}/{pattern}"


def _check_parts(reading: Reading, path: Path, options: LoadOptions) -> None:
    count = len(reading.parts)
    check_parts(count, path, options.limits)
    lost = next((f" ({note})" for note in reading.notes if note.endswith("was left out")), "")
    if count == 0:
        raise UnreadableAsset(f"{path} holds no part with faces{lost}: expected {_EXPECTED}")
    if count == 1:
        only = reading.parts[0]
        tried = f"; {looked_for_fronts(only.surfaces)}" if options.parts == "auto" else ""
        raise UnsegmentedAsset(
            f"{path} is one part, `{only.source.name}`{lost}: expected several{tried}; {divide(only.surfaces)}"
        )


def _taken_apart(reading: Reading, path: Path, options: LoadOptions) -> Reading:
    """Returns the reading with shells as parts; what an annotation lets move, ride or carry stays whole in that."""

    def allow(count: int) -> None:
        check_parts(count, path, options.limits)

    parts = loose_parts(reading.parts, allow=allow)
    note = f"each connected shell is a part (--parts loose): {len(reading.parts)} became {len(parts)}"
    annotation = reading.annotation
    if annotation is not None:
        held = {joint.part for joint in annotation.joints}
        held |= {part for p in annotation.parts if p.rides_on for part in (p.id, p.rides_on)}
        annotation = replace(annotation, parts=loose_parts(annotation.parts, held, allow))
    return replace(reading, parts=parts, annotation=annotation, notes=(*reading.notes, note))


def _joined(reading: Reading) -> Reading:
    parts, notes = with_joined_pieces(reading.parts, whole_box(reading.parts))
    return replace(reading, parts=parts, notes=(*reading.notes, *notes))


def _plausible(reading: Reading) -> Reading:
    judged, notes = with_plausible_labels(reading.parts)
    return _with_split_handles(replace(reading, parts=judged, notes=(*reading.notes, *notes)))


def _with_split_handles(reading: Reading) -> Reading:
    parts, notes = with_split_handles(reading.parts)
    return replace(reading, parts=parts, notes=(*reading.notes, *notes))


def _without_labels(reading: Reading) -> Reading:
    stated = reading.annotation
    annotation = stated and replace(stated, parts=tuple(_unlabelled(p) for p in stated.parts))
    parts = tuple(_unlabelled(p) for p in reading.parts)
    return replace(reading, parts=parts, annotation=annotation, furniture=None)


def _unlabelled(part: Part) -> Part:
    return replace(part, label=PartLabel.UNKNOWN, labelled_by="none")
