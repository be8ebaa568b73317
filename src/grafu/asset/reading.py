"""What a reader hands on: parts as the input has them, before the frame is settled. It decides nothing.

A mesh file holds named pieces with surfaces. Faces without area and parts without faces are dropped, and said so; no
shape is changed. At last parts and annotation are mapped to the object frame.
"""

from dataclasses import replace
from typing import Literal, final

import numpy as np

from grafu.asset.part import Annotation, AssetKind, Frame, Part, moved_joints
from grafu.asset.pieces import with_attached
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mask, cross
from grafu.geometry.mesh import TriangleMesh


@final
@dataclass(frozen=True)
class MeshPiece:
    """A named piece of a mesh file; the name is empty where the file gives none.

    `label_name` is the name that its label is read from, where it is not its own.
    """

    name: str
    surfaces: tuple[Surface, ...]
    label_name: str = ""


@final
@dataclass(frozen=True)
class MeshFile:
    """The pieces of a mesh file, in order, and notes on what was left out."""

    pieces: tuple[MeshPiece, ...]
    notes: tuple[str, ...] = ()

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """All surfaces of all pieces."""
        return tuple(s for piece in self.pieces for s in piece.surfaces)


class Placing:
    """Maps what was read by one frame; a mesh that parts and annotation share is mapped once, and is shared again."""

    def __init__(self, frame: Frame) -> None:
        self._frame = frame
        self._T = np.asarray(frame.input_to_output)
        self._made: dict[tuple[int, int], tuple[Surface, Surface]] = {}  # by ids, with what they are the ids of

    def parts(self, parts: tuple[Part, ...]) -> tuple[Part, ...]:
        """Returns parts in the object frame, handles riding on what they touch where nothing states on what."""
        return with_attached(self.moved(parts))

    def moved(self, parts: tuple[Part, ...]) -> tuple[Part, ...]:
        """Returns parts in the object frame, and no more."""
        return tuple(replace(part, surfaces=tuple(map(self._surface, part.surfaces))) for part in parts)

    def annotation(self, annotation: Annotation) -> Annotation:
        """Returns an annotation in the object frame, slides in metres."""
        T, scale = self._T, self._frame.scale
        joints, small = (moved_joints(given, T, scale) for given in (annotation.joints, annotation.small_joints))
        return replace(annotation, parts=self.parts(annotation.parts), joints=joints, small_joints=small)

    def _surface(self, surface: Surface) -> Surface:
        key = id(surface.mesh), id(surface.material)
        if key not in self._made:
            self._made[key] = surface, surface.transformed(self._T)
        return replace(self._made[key][1], name=surface.name)


Furniture = Literal["storage", "table", "door", "window"]


@final
@dataclass(frozen=True, slots=True)
class Convention:
    """What the format or the dataset states about its coordinates; None where it states nothing.

    `unit` is metres per input unit. `normalised` states that the unit has no meaning, because the dataset scales every
    model to one size. `origin` names who states it, in words for the report.
    """

    origin: str
    up: str | None = None
    front: str | None = None
    unit: float | None = None
    normalised: bool = False
    usual_up: str = "+Y"


@final
@dataclass(frozen=True)
class Reading:
    """An input in its own coordinates: every `Part` and joint here is still to be mapped to the object frame.

    `parts` are what it holds without its joints; the `annotation` is what it states about its motions, None where
    nothing. `grouped` states that the parts are segmented by hand: pieces of doors and drawers are not joined by where
    they lie. `fronts_face` is the direction (like `-Y`) that the fronts face which were cut out of its meshes.
    """

    kind: AssetKind
    parts: tuple[Part, ...]
    convention: Convention
    annotation: Annotation | None = None
    furniture: Furniture | None = None
    notes: tuple[str, ...] = ()
    grouped: bool = False
    fronts_face: str | None = None


# A triangle is degenerate where its height is below this fraction of its longest side.
_FLATNESS = 1e-9


def cleaned(reading: Reading) -> Reading:
    """Returns the reading without degenerate faces, and without parts (and their joints) that have no face left."""
    parts, notes = _cleaned(reading.parts)
    annotation = reading.annotation and _cleaned_annotation(reading.annotation)
    return replace(reading, parts=parts, annotation=annotation, notes=(*reading.notes, *notes))


def _cleaned_annotation(annotation: Annotation) -> Annotation:
    parts, _ = _cleaned(annotation.parts)
    return annotation.of_parts(parts)


def _cleaned(given: tuple[Part, ...]) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts that keep a face, and in words what was dropped."""
    parts: list[Part] = []
    dropped_faces, mended, empty = 0, 0, []
    for part in given:
        surfaces, dropped = _without_degenerate(part.surfaces)
        dropped_faces += dropped
        mended += dropped > 0
        if surfaces:
            parts.append(replace(part, surfaces=surfaces) if dropped else part)
        else:
            empty.append(part)
    notes = [f"dropped {dropped_faces:,} faces without area in {mended} parts"] if dropped_faces else []
    notes += [f"part {part.source.name!r} has no faces and was left out" for part in empty]
    gone = {part.id for part in empty}
    return tuple(replace(p, carried_by=None) if p.carried_by in gone else p for p in parts), notes


def _without_degenerate(surfaces: tuple[Surface, ...]) -> tuple[tuple[Surface, ...], int]:
    kept, dropped = [], 0
    for surface in surfaces:
        good = has_area(surface.mesh)
        if good.all():
            kept.append(surface)
            continue
        dropped += int((~good).sum())
        mesh = TriangleMesh(surface.mesh.vertices, surface.mesh.faces[good])
        kept.append(replace(surface, mesh=mesh))
    return tuple(s for s in kept if not s.is_empty), dropped


def has_area(mesh: TriangleMesh) -> Mask:
    """Returns for each face whether it is a triangle rather than a line or a point."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    ab, ac, bc = b - a, c - a, c - b
    twice_area = np.linalg.norm(cross(ab, ac), axis=1)
    longest = np.maximum.reduce([(e * e).sum(axis=1) for e in (ab, ac, bc)])
    return twice_area > _FLATNESS * np.maximum(longest, 1e-300)


def tells_of_lost_mesh(note: str) -> bool:
    """Whether a reader's note states that a mesh was left out: a piece of the model is missing, and not its look."""
    return note.startswith(("mesh ", "textured_objs/")) and "was left out" in note
