"""`load_asset`: from a path to an asset in the object frame. It knows which reader reads what, and no format.

The kind of an input is detected from its content: PartNet-Mobility's files, a GLB with annotated parts beside it, a
`<robot>` element, glTF's JSON or magic bytes.
"""

from collections.abc import Callable
from importlib import import_module
from itertools import islice
from pathlib import Path
from typing import Final

from grafu.asset.folder import mesh_files_in
from grafu.asset.furniture_pieces import chosen_piece, endings_of
from grafu.asset.hssd_annotation import is_hssd, model_of_annotation
from grafu.asset.mesh_files import MESH_SUFFIXES
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset
from grafu.asset.reading import Reading, cleaned
from grafu.asset.regular_files import files_below, read_head
from grafu.asset.resources import ModelFiles
from grafu.asset.settling import EXPECTED, pieces_in, settled
from grafu.errors import UnreadableAsset, nearest

_MOST_BESIDE: Final = 2000  # files beside a missing one that are looked at

Reader = Callable[[Path, LoadOptions, ModelFiles], Reading]

READERS: Final = {
    "partnet-mobility": "grafu.asset.partnet_mobility:read_partnet_mobility",
    "hssd": "grafu.asset.hssd:read_hssd",
    "urdf": "grafu.asset.urdf:read_urdf",
    "sdf": "grafu.asset.sdf:read_sdf",
    "mjcf": "grafu.asset.mjcf:read_mjcf",
    "gltf": "grafu.asset.gltf:read_gltf",
    "collada": "grafu.asset.collada:read_collada",
    "usd": "grafu.asset.usd:read_usd",
    "fbx": "grafu.asset.fbx:read_fbx",
    "3mf": "grafu.asset.threemf:read_threemf",
    "3ds": "grafu.asset.threeds:read_threeds",
    "blend": "grafu.asset.blend:read_blend",
    "mesh folder": "grafu.asset.folder:read_mesh_folder",
    "mesh file": "grafu.asset.folder:read_mesh",
}
"""The reader of each kind, as module and function: it is imported when such an input is read."""
USD_SUFFIXES: Final = (".usd", ".usda", ".usdc", ".usdz")
SCENES: Final = {
    "urdf": (".urdf",),
    "sdf": (".sdf",),
    "gltf": (".glb", ".gltf"),
    "collada": (".dae",),
    "usd": USD_SUFFIXES,
    "fbx": (".fbx",),
    "3mf": (".3mf",),
    "mjcf": (".xml",),
    "3ds": (".3ds",),
    "blend": (".blend",),
}
"""Files of which a folder holds one, by how their names end; the first kind that is there is read."""
AFTER_MESHES: Final = ("3ds", "blend")
"""Kinds of scenes that do not count where there are meshes beside them: these are copies, with more in them."""
_HEAD: Final = 4096  # bytes of a file that tell what it is
_AS_GLB = "open it in the program that made it, or in Blender, and export it as GLB, objects apart"
# What people try, by the way it ends, and what they can do with it.
_WAYS_IN: Final[dict[str, str]] = {
    ".xacro": "expand it first: xacro FILE.xacro > FILE.urdf",
    ".skp": "in SketchUp, export it as GLB or COLLADA, groups and components kept",
    **dict.fromkeys(
        (".step", ".stp", ".iges", ".igs"), "in a CAD program (FreeCAD), export it as glTF, a body for each part"
    ),
    **dict.fromkeys((".max", ".c4d", ".ma", ".mb", ".x3d"), _AS_GLB),
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
        AssetError: if an option contradicts the input, or it holds several pieces, which are split, and none is chosen.
    """
    path = Path(path)
    reading, name = _read(path, options)
    if options.pieces == "together":
        return settled(reading, name, path, options)
    pieces, frame = pieces_in(cleaned(reading), options)
    ending, reading = chosen_piece(pieces, options.piece, path)
    return settled(reading, f"{name}_{ending}" if ending else name, path, options, frame)


def endings_in(path: Path, options: LoadOptions) -> tuple[str, ...]:
    """Returns for each piece of furniture at `path` that is to be read how the name of its results ends.

    It is empty where pieces are together, or there is one only.

    Raises:
        UnreadableAsset: if there is nothing at the path that can be read, it is damaged, or holds no piece.
        AssetTooLarge: if it exceeds a limit.
        AssetError: if an option contradicts the input, or there is no piece of the number that is chosen.
    """
    if options.pieces == "together":
        return ("",)
    pieces, _ = pieces_in(cleaned(_read(Path(path), options)[0]), options)
    if options.piece is not None or len(pieces) < 2:
        return (chosen_piece(pieces, options.piece, path)[0],)
    return endings_of(pieces)


def _read(path: Path, options: LoadOptions) -> tuple[Reading, str]:
    """Returns what a file or folder holds, and the name of the model."""
    kind, place = detect(path)
    # named as a file of its folder, a model of the data set is that folder
    files = ModelFiles(place if kind == "partnet-mobility" else path, options.limits)
    name = _name(place if kind == "partnet-mobility" else path)  # its folder names the model, never `mobility.urdf`
    module, function = READERS[kind].split(":")
    read: Reader = getattr(import_module(module), function)
    return read(place, options, files), name


def _name(path: Path) -> str:
    return path.resolve().name if path.is_dir() else path.stem


def detect(path: Path) -> tuple[str, Path]:
    """Returns which reader reads what is at `path`, and the file or folder to give it.

    Raises:
        UnreadableAsset: if there is nothing, or nothing that is read.
    """
    try:
        if not path.exists():
            raise UnreadableAsset(f"{path} does not exist{_like(path) or f': expected {EXPECTED}'}")
        if path.is_file() and path.stat().st_size == 0:
            raise UnreadableAsset(f"{path} is empty: fetch or export it again")
        return _detect_folder(path) if path.is_dir() else _detect_file(path)
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or "no file can have this name"
        raise UnreadableAsset(f"{path} cannot be read ({why}): expected {EXPECTED}") from None


def _like(path: Path) -> str:
    """Returns `; did you mean X?` with a path that is there and has one name spelled otherwise; empty where none is."""
    if path.is_symlink():
        return ": it is a link to what is not there"
    missing = next(one for one in reversed((path, *path.parents)) if not one.exists())
    rest = path.relative_to(missing)
    beside = islice(missing.parent.iterdir(), _MOST_BESIDE) if missing.parent.is_dir() else ()
    by_stem = {found.stem: found for found in sorted(beside) if (found / rest).exists()}  # endings are all alike
    near = by_stem.get(nearest(missing.stem, by_stem))
    return f"; did you mean `{near / rest}`?" if near else ""


def is_partnet_mobility(folder: Path) -> bool:
    """Whether the folder is a model of the data set, by the files that it holds."""
    has_json = (folder / "mobility_v2.json").is_file() and (folder / "result.json").is_file()
    return has_json or (folder / "mobility.urdf").is_file()


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
    if suffix == ".fbx" or head.startswith(b"Kaydara FBX Binary"):
        return "fbx", path
    if suffix in (".3mf", ".3ds", ".blend"):
        return suffix[1:], path
    if suffix in MESH_SUFFIXES:
        return "mesh file", path
    way_in = f"; {_WAYS_IN[suffix]}" if suffix in _WAYS_IN else ""
    raise UnreadableAsset(f"{path} is not a kind of file that is read: expected {EXPECTED}{way_in}")


def _is_mjcf(head: bytes) -> bool:
    return b"<mujoco" in head and b"<mujocoinclude" not in head and b"<robot" not in head


def scene_kind(path: Path) -> str | None:
    """Returns which reader of `SCENES` a file is for by its name, of XML by its head; None: for none.

    Raises:
        OSError: if the file is XML and cannot be read.
    """
    suffix = path.suffix.lower()
    kind = next((kind for kind, suffixes in SCENES.items() if suffix in suffixes), None)
    return None if kind == "mjcf" and not _is_mjcf(read_head(path, _HEAD)) else kind


def _detect_folder(folder: Path) -> tuple[str, Path]:
    if is_partnet_mobility(folder):
        return "partnet-mobility", folder
    has_meshes = bool(mesh_files_in(folder))
    for kind, suffixes in SCENES.items():
        if has_meshes and kind in AFTER_MESHES:
            break
        found = [path for path in files_below(folder, suffixes) if scene_kind(path) == kind]
        if len(found) == 1:
            return ("hssd" if is_hssd(found[0]) else kind), found[0]
        if len(found) > 1:
            raise UnreadableAsset(_several(folder, found))
    if has_meshes:
        return "mesh folder", folder
    state = "is empty" if not any(folder.iterdir()) else "holds nothing that is read"
    raise UnreadableAsset(f"{folder} {state}: expected {EXPECTED}")


def _several(folder: Path, found: list[Path]) -> str:
    """Returns what to do about a folder of models: name one of them, or all by a pattern."""
    names = ", ".join(str(path.relative_to(folder)) for path in found[:3])
    kind = found[0].suffix
    pattern = f"*{kind}" if found[0].parent == folder else "*"
    return f"{folder} holds {len(found)} {kind} files ({names}): name one, or all of them as {folder}/{pattern}"
