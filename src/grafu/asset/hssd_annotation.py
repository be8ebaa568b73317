"""The annotation files beside an HSSD model, checked: which triangles are which part, and how parts move.

`<id>.artpre.json` states parts, `<id>.articulations.json` motions, as the Scene Toolkit writes them for S2O.
Coordinates are the GLB's: metres, Y up. It reads no meshes and settles no labels.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeGuard, final

import numpy as np

from grafu.articulation.motion_kind import kind_named
from grafu.asset.json_files import finite, read_json
from grafu.asset.resources import ModelFiles
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.vocabulary import JointType

PARTS, MOTIONS = ".artpre.json", ".articulations.json"
_LARGEST = 1e9  # metres or radians: beyond, a number is no coordinate


@final
@dataclass(frozen=True)
class TriangleRun:
    """Triangles `first` up to, not including, `last` of a mesh; None: all of them."""

    mesh: int
    first: int = 0
    last: int | None = None


@final
@dataclass(frozen=True)
class AnnotatedPart:
    """One part by its pid: its word, empty where it has none, its triangles, and the box around it where stated."""

    pid: str
    word: str
    runs: tuple[TriangleRun, ...]
    box: Box | None

    @property
    def name(self) -> str:
        """Its word and pid, like `door-1`."""
        return f"{self.word or 'part'}-{self.pid}"


@final
@dataclass(frozen=True)
class Articulation:
    """How a part moves. Limits count from the pose as drawn, radians or metres; `closed` does, too, where stated."""

    pid: str
    type: JointType
    axis: Axis
    lower: float
    upper: float
    limited: bool
    closed: float | None
    base: tuple[str, ...]


@final
@dataclass(frozen=True)
class HssdAnnotation:
    """What the files say. `neighbours` are the parts that touch, both ways; `up` and `front` are spelled like `+Y`."""

    parts: tuple[AnnotatedPart, ...]
    articulations: tuple[Articulation, ...]
    neighbours: Mapping[str, frozenset[str]]
    up: str | None
    front: str | None


def read_annotation(model: Path, files: ModelFiles) -> HssdAnnotation:
    """Returns what the files beside `<id>.glb` say.

    Raises:
        UnreadableAsset: if one is damaged, or states a motion of a part that is not there.
    """
    parts_file = model.with_name(model.stem + PARTS)
    stated = _Json(parts_file, files)
    parts = tuple(_part(stated, entry, k) for k, entry in enumerate(stated.list("parts", stated.root)) if entry)
    known = {part.pid for part in parts}
    if len(known) < len(parts):
        raise stated.damaged("a pid repeats")
    graph = stated.root.get("connectivityGraph")
    motions_file = find_motions(model)
    articulations: tuple[Articulation, ...] = ()
    if motions_file is not None:
        said = _Json(motions_file, files)
        annotation = said.root.get("annotation", said.root)
        if not isinstance(annotation, dict):
            raise said.damaged("`annotation` is no object")
        graph = annotation.get("connectivity") or graph  # corrected by the annotator
        articulations = tuple(_articulation(said, a, known) for a in said.list("articulations", annotation))
    up, front = (_direction(stated.root.get(key)) for key in ("upAxis", "frontAxis"))
    return HssdAnnotation(parts, articulations, _neighbours(graph, known), up, front)


def is_hssd(path: Path) -> bool:
    """Whether the file is a GLB with annotated parts beside it."""
    return path.suffix.lower() == ".glb" and path.with_name(path.stem + PARTS).is_file()


def model_of_annotation(path: Path) -> Path | None:
    """Returns the GLB that an annotation file belongs to, or None where the file is none or has no GLB beside it."""
    ending = next((e for e in (PARTS, MOTIONS) if path.name.endswith(e)), None)
    if ending is None:
        return None
    stem = path.name.removesuffix(ending)
    stems = (stem, stem.rpartition(".")[2])  # articulations may be named after their data set, too
    return next((m for s in stems if is_hssd(m := path.with_name(f"{s}.glb"))), None)


def find_motions(model: Path) -> Path | None:
    """Returns the articulations beside a model: `<id>.articulations.json`, or with the data set's name before it."""
    named = model.with_name(model.stem + MOTIONS)
    if named.is_file():
        return named
    ending = f".{model.stem}{MOTIONS}"
    return next((p for p in sorted(model.parent.iterdir()) if p.name.endswith(ending)), None)


class _Json:
    """One JSON file with an object at its root; a byte order mark is skipped."""

    def __init__(self, path: Path, files: ModelFiles) -> None:
        self.path = path
        root = read_json(path, files, "an HSSD annotation; fetch it again")
        if not isinstance(root, dict):
            raise self.damaged("it holds no object")
        self.root: dict[str, Any] = root

    def damaged(self, why: str) -> UnreadableAsset:
        return UnreadableAsset(f"{self.path} is damaged ({why}): expected an HSSD annotation; fetch it again")

    def list(self, key: str, holder: dict[str, Any]) -> list[dict[str, Any] | None]:
        """Returns a list of objects, or of objects and nulls."""
        found = holder.get(key)
        if not isinstance(found, list) or not all(entry is None or isinstance(entry, dict) for entry in found):
            raise self.damaged(f"`{key}` is no list of objects")
        return found

    def vector(self, what: str, value: Any) -> np.ndarray:
        numbers = [_number(v) for v in value] if isinstance(value, list) and len(value) == 3 else [None]
        if None in numbers:
            raise self.damaged(f"{what} is not three numbers")
        return np.array(numbers, dtype=np.float64)


def _part(file: _Json, entry: dict[str, Any], place: int) -> AnnotatedPart:
    pid = str(entry.get("pid", place))
    info = entry.get("partInfo")
    triangles = info.get("meshTri") if isinstance(info, dict) else None
    if not isinstance(triangles, list) or not all(isinstance(t, dict) for t in triangles):
        raise file.damaged(f"part {pid} has no `partInfo.meshTri`")
    word = str(entry.get("label") or entry.get("name") or "")
    return AnnotatedPart(pid, word, tuple(r for t in triangles for r in _runs(file, pid, t)), _box(entry.get("obb")))


def _runs(file: _Json, pid: str, entry: dict[str, Any]) -> list[TriangleRun]:
    mesh, ranges = entry.get("meshIndex"), entry.get("triIndex")
    if not _is_count(mesh):
        raise file.damaged(f"part {pid} names mesh {mesh!r}")
    if ranges is None:
        return [TriangleRun(mesh)]
    pairs: list[Any] = [[r, r + 1] if _is_count(r) else r for r in ranges] if isinstance(ranges, list) else [None]
    if not all(isinstance(p, list) and len(p) == 2 and all(map(_is_count, p)) and p[0] <= p[1] for p in pairs):
        raise file.damaged(f"part {pid} has a triangle range that is not [first, last)")
    return [TriangleRun(mesh, first, last) for first, last in pairs]


def _is_count(value: Any) -> TypeGuard[int]:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**53


def _number(value: Any) -> float | None:
    number = finite(value)
    return number if number is not None and abs(number) < _LARGEST else None


def _box(obb: Any) -> Box | None:
    """Returns the axis-aligned box around an oriented one."""
    if not isinstance(obb, dict):
        return None
    stated = [obb.get(key) for key in ("centroid", "axesLengths", "normalizedAxes")]
    rows = [[_number(v) for v in values] if isinstance(values, list) else [] for values in stated]
    if [len(row) for row in rows] != [3, 3, 9] or any(None in row for row in rows):
        return None
    center, lengths, axes = (np.array(row, dtype=np.float64) for row in rows)
    half = np.abs(axes.reshape(3, 3)).T @ np.abs(lengths) / 2
    return Box(center - half, center + half)


def _articulation(file: _Json, entry: dict[str, Any] | None, known: set[str]) -> Articulation:
    entry = entry or {}
    pid, word = str(entry.get("pid")), str(entry.get("type")).lower()
    if pid not in known:
        raise file.damaged(f"a motion is stated for part {pid}, which is not there")
    kind = kind_named("hssd", word)
    if kind is None:
        raise file.damaged(f"part {pid} has a motion of type {word!r}: rotation and translation are known")
    direction = file.vector(f"the axis of part {pid}", entry.get("axis"))
    if np.linalg.norm(direction) < 1e-9:
        raise file.damaged(f"the axis of part {pid} is zero")
    point = [0, 0, 0] if kind.slides and entry.get("origin") is None else entry.get("origin")
    axis = Axis(file.vector(f"the origin of part {pid}", point), direction)
    drawn = _number(entry.get("defaultValue")) or 0.0
    low, high = (_number(entry.get(key)) for key in ("rangeMin", "rangeMax"))
    lower, upper = ((drawn if v is None else v) - drawn for v in (low, high))
    limited = not (low is None and high is None)
    stated = _closed(entry.get("motionStates"))
    closed = None if stated is None else stated - drawn
    return _opening(Articulation(pid, kind.type, axis, lower, upper, limited, closed, _base(entry)))


def _closed(states: Any) -> float | None:
    state = states.get("closed") if isinstance(states, dict) else None
    return _number(state.get("value")) if isinstance(state, dict) else None


def _base(entry: dict[str, Any]) -> tuple[str, ...]:
    base = entry.get("base")
    return tuple(str(pid) for pid in base) if isinstance(base, list) else ()


def _opening(stated: Articulation) -> Articulation:
    """Returns the articulation with positive values opening, where the closed end of its range is the upper one."""
    low, high = sorted((stated.lower, stated.upper))
    if not stated.limited or stated.closed is None or abs(stated.closed - low) <= abs(stated.closed - high):
        return stated
    axis = stated.axis.reversed()
    return Articulation(stated.pid, stated.type, axis, -high, -low, True, -stated.closed, stated.base)


def _direction(axis: Any) -> str | None:
    """Returns an axis, three numbers as a list or as x, y and z, like `+Y`; None where it is none of the six."""
    values = [axis.get(k) for k in "xyz"] if isinstance(axis, dict) else axis
    numbers = [_number(v) for v in values] if isinstance(values, list) and len(values) == 3 else [None]
    if None in numbers:
        return None
    vector = vec3(*(float(v or 0.0) for v in numbers))
    along = int(np.argmax(np.abs(vector)))
    if abs(vector[along]) < 0.99 * float(np.linalg.norm(vector)) or not vector.any():
        return None
    return f"{'+' if vector[along] > 0 else '-'}{'XYZ'[along]}"


def _neighbours(graph: Any, known: set[str]) -> Mapping[str, frozenset[str]]:
    """Returns which parts touch, both ways, from a list of pids by pid; what is no such list states nothing."""
    found: dict[str, set[str]] = {pid: set() for pid in known}
    for place, others in enumerate(graph if isinstance(graph, list) else ()):
        for other in others if isinstance(others, list) else ():
            a, b = str(place), str(other)
            if a in known and b in known and a != b:
                found[a].add(b)
                found[b].add(a)
    return {pid: frozenset(others) for pid, others in found.items()}
