"""Particulate's evaluation files: `pred.npz` beside `pred.obj`, the mesh that it was given, parts by face.

Joints are stated in the normalised frame of the run: turned so that its `--up_dir` becomes Z, centred, the largest
side 1. Which direction was stated is not stored, so all six come out as possible frames. It matches nothing.
"""

import io
import zipfile
from collections.abc import Container, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Final

import numpy as np

from grafu.articulation.motion_kind import moving_kinds
from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart, JointFrame
from grafu.asset.obj_parser import parse_obj
from grafu.asset.options import LoadOptions
from grafu.asset.polygons import triangulate
from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import array_from, library_call
from grafu.errors import AssetError, UnreadableAsset
from grafu.geometry.arrays import Indices, Mat3, Mat4, Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, invert

UP_ROTATIONS: Final[Mapping[str, Mat3]] = MappingProxyType(
    {
        "-Z": np.diag([1.0, -1.0, -1.0]),  # its default
        "Z": np.eye(3),
        "Y": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
        "-Y": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
        "X": np.array([[0.0, 0, -1], [0, 1, 0], [1, 0, 0]]),
        "-X": np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    }
)
"""For each `--up_dir` the rotation from the mesh's coordinates to the normalised frame."""

_SHAPES: Final[Mapping[str, tuple[int | None, ...]]] = MappingProxyType(
    {
        "face_part_ids": (None,),
        "motion_hierarchy": (None, 2),
        "is_part_revolute": (None,),
        "is_part_prismatic": (None,),
        "revolute_plucker": (None, 6),
        "revolute_range": (None, 2),
        "prismatic_axis": (None, 3),
        "prismatic_range": (None, 2),
    }
)
_EXPECTED = "Particulate's eval/pred.npz with pred.obj beside it (written by its --eval)"

Arrays = dict[str, np.ndarray]


def normalisation(box: Box, up_dir: str) -> Mat4:
    """Returns the transform from a mesh's coordinates to the normalised frame, given the mesh's box.

    Raises:
        KeyError: if `up_dir` is not one of `UP_ROTATIONS`.
    """
    R = UP_ROTATIONS[up_dir]
    turned = Box.around(box.corners() @ R.T)
    scale = 1.0 / max(float(turned.size.max()), 1e-12)
    return from_rotation(scale * R, -scale * turned.center)


def read_particulate(path: Path, options: LoadOptions = LoadOptions()) -> ForeignMotions:
    """Returns the prediction of a `pred.npz`; its parts are cut out of `pred.obj` by faces.

    Raises:
        UnreadableAsset: if a file is missing or damaged, or the two do not fit together.
        AssetTooLarge: if a file exceeds the limits.
    """
    files = ModelFiles(path, options.limits)
    arrays = _arrays(path, files)
    mesh, polygons = _mesh(path.with_name("pred.obj"), files)
    part_of = arrays["face_part_ids"].astype(np.int64)
    if len(part_of) == polygons != len(mesh.faces):
        raise UnreadableAsset(f"{path.with_name('pred.obj')} has faces of more than three corners: triangulate it")
    if len(part_of) != len(mesh.faces):
        raise UnreadableAsset(
            f"{path}: `face_part_ids` names the parts of {len(part_of)} faces, pred.obj has {len(mesh.faces)}: "
            "expected the two files of one run"
        )
    _check_numbers(arrays, path)
    files.tally.add(path, parts=len(arrays["is_part_revolute"]))
    parents = {int(child): int(parent) for parent, child in arrays["motion_hierarchy"]}
    filled = _faces_by_part(part_of)
    parts = tuple(
        ForeignPart(_name(k), mesh.with_faces(faces), parent=_parent(k, parents, filled)) for k, faces in filled.items()
    )
    notes: list[str] = []
    joints = tuple(joint for k in filled for joint in _joints(k, arrays, notes))
    frames = tuple(JointFrame(f"up_dir {up}", invert(normalisation(mesh.box, up))) for up in UP_ROTATIONS)
    try:
        return ForeignMotions("particulate", str(path), parts, joints, frames, notes=tuple(notes))
    except AssetError as error:
        raise UnreadableAsset(str(error)) from None


def _arrays(path: Path, files: ModelFiles) -> Arrays:
    data = files.read(path)
    archive = f"a NumPy archive of plain arrays, {_EXPECTED}"
    with library_call(path, archive):
        stated = _stated_bytes(data)
    files.tally.add(path, bytes=stated)
    with library_call(path, archive), zipfile.ZipFile(io.BytesIO(data)) as stored:
        held = set(stored.namelist())
        found = {key: array_from(stored.read(f"{key}.npy")) for key in _SHAPES if f"{key}.npy" in held}
    missing = [key for key in _SHAPES if key not in found]
    if missing:
        raise UnreadableAsset(f"{path} lacks `{missing[0]}`: expected {_EXPECTED}")
    for key, shape in _SHAPES.items():
        array = found[key]
        if key == "motion_hierarchy" and not array.size:
            found[key] = np.zeros((0, 2), np.int64)
        elif array.ndim != len(shape) or any(n not in (None, m) for n, m in zip(shape, array.shape, strict=True)):
            raise UnreadableAsset(f"{path}: `{key}` has the shape {array.shape}: expected {_spelled(shape)}")
        elif array.dtype.kind not in "biuf":
            raise UnreadableAsset(f"{path}: `{key}` holds no numbers: expected {_EXPECTED}")
    return found


def _spelled(shape: tuple[int | None, ...]) -> str:
    return (
        "(" + ", ".join("n" if size is None else str(size) for size in shape) + ("," if len(shape) == 1 else "") + ")"
    )


def _check_numbers(arrays: Arrays, path: Path) -> None:
    """Refuses arrays of parts that differ in length, part numbers that name none, and numbers that are not finite."""
    count = len(arrays["is_part_revolute"])
    for key in _SHAPES:
        if key not in ("face_part_ids", "motion_hierarchy") and len(arrays[key]) != count:
            raise UnreadableAsset(
                f"{path}: `{key}` has {len(arrays[key])} rows: expected one for each of {count} parts"
            )
        if not np.isfinite(arrays[key].astype(np.float64)).all():
            raise UnreadableAsset(f"{path}: `{key}` holds numbers that are not finite")
    for key in ("face_part_ids", "motion_hierarchy"):
        ids = arrays[key]
        if ids.size and (ids.min() < 0 or ids.max() >= count):
            raise UnreadableAsset(f"{path}: `{key}` names parts {ids.min()}..{ids.max()}: there are 0..{count - 1}")


def _stated_bytes(data: bytes) -> int:
    """Returns the bytes of the arrays in an archive: each states its size, and more than that is not unpacked."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return sum(info.file_size for info in archive.infolist())


def _mesh(path: Path, files: ModelFiles) -> tuple[TriangleMesh, int]:
    """Returns the mesh with its faces in the file's order, and how many polygons they come from."""
    if not path.is_file():
        raise UnreadableAsset(f"{path} is missing: expected {_EXPECTED}")
    obj = parse_obj(files.read(path), str(path), files.tally)
    triangles, _ = triangulate(obj.vertices, obj.corners[:, 0], obj.starts)
    if not len(triangles):
        raise UnreadableAsset(f"{path} holds no faces: expected the mesh that Particulate was given")
    return TriangleMesh(obj.vertices, obj.corners[:, 0][triangles]), len(obj.starts) - 1


def _name(part: int) -> str:
    return f"part_{part}"


def _faces_by_part(part_of: Indices) -> dict[int, np.ndarray]:
    """Returns the faces of each part that has some, in the file's order."""
    order = np.argsort(part_of, kind="stable")
    found, starts = np.unique(part_of[order], return_index=True)
    return dict(zip(found.tolist(), np.split(order, starts[1:]), strict=True))


def _parent(part: int, parents: Mapping[int, int], filled: Container[int]) -> str | None:
    """Returns the nearest ancestor that has faces."""
    above = parents.get(part)
    seen = {part}
    while above is not None and above not in filled and above not in seen:
        seen.add(above)
        above = parents.get(above)
    return _name(above) if above is not None and above in filled else None


def _joints(part: int, arrays: Arrays, notes: list[str]) -> list[ForeignJoint]:
    """Returns the joint of a part, or none; of a part that turns and slides, the turn is kept."""
    stated = (kind for kind in moving_kinds() if kind.limited)  # the format does not tell what turns without limits
    kinds = [kind for kind in stated if arrays[f"is_part_{kind.word('particulate')}"][part]]
    if not kinds:
        return []
    kind = next((kind for kind in kinds if kind.turns), kinds[0])
    if len(kinds) > 1:
        notes.append(f"{_name(part)} is predicted to turn and to slide: only the turn is read")
    word = kind.word("particulate")
    line = arrays[f"{word}_{'plucker' if kind.turns else 'axis'}"][part].astype(np.float64)
    axis = _axis(part, line[:3], line[3:] if kind.turns else np.zeros(3), notes)
    low, high = arrays[f"{word}_range"][part].astype(np.float64).tolist()
    return [ForeignJoint(_name(part), kind.type, axis, low, high)] if axis else []


def _axis(part: int, direction: Vec3, moment: Vec3, notes: list[str]) -> Axis | None:
    """Returns the line of Particulate's Pluecker coordinates, whose moment is l x p: its point is m x l."""
    length = float(np.linalg.norm(direction))
    if length < 1e-9:
        notes.append(f"{_name(part)} is predicted to move along an axis without a direction: left still")
        return None
    unit = direction / length
    return Axis(np.cross(moment, unit), unit)
