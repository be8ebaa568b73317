"""Pieces of synthetic furniture and their asset: boards, names, attachments, joints, the centred frame."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import final

from grafu.articulation.articulated_object import Coupling
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.edit import centred
from grafu.asset.part import IDENTITY_FRAME, AnnotatedJoint, Asset, Part, PartSource
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Mat4
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.pieces.finish import surface_of
from grafu.synth.pieces.shapes import board, sheet
from grafu.vocabulary import JointType, PartLabel


@final
@dataclass(frozen=True, slots=True)
class PieceMotion:
    """How a piece truly moves: positive opens, from 0 to `upper` (radians or metres).

    One that `follows` what carries it has so many times its value; 0: it moves by itself. A `small` motion is a
    knob's, a button's.
    """

    type: JointType
    axis: Axis
    upper: float
    follows: float = 0.0
    small: bool = False

    def transformed(self, T: Mat4) -> "PieceMotion":
        """Returns the motion mapped by a rigid T."""
        return replace(self, axis=motion_kind(self.type).mapped_axis(self.axis, T))


@final
@dataclass(frozen=True)
class PieceDraft:
    """A part to be: `stem` becomes its name, numbered where it repeats; `attached` move with it, or on it."""

    label: PartLabel
    stem: str
    surfaces: tuple[Surface, ...]
    motion: PieceMotion | None = None
    attached: tuple["PieceDraft", ...] = ()  # those that move may carry others

    def transformed(self, T: Mat4) -> "PieceDraft":
        """Returns the piece, its motion and its attached parts mapped by a rigid T."""
        return replace(
            self,
            surfaces=tuple(surface.transformed(T) for surface in self.surfaces),
            motion=self.motion.transformed(T) if self.motion else None,
            attached=tuple(part.transformed(T) for part in self.attached),
        )


def assemble(name: str, pieces: Sequence[PieceDraft]) -> Asset:
    """Returns the asset of all pieces, centred in x and y and standing on z = 0, with its true joints."""
    entries = _with_carriers(pieces)
    ids = _numbered([piece.stem for piece, _ in entries])
    parts = tuple(
        Part(i, piece.label, piece.surfaces, PartSource(i), "annotation", None if carrier is None else ids[carrier])
        for i, (piece, carrier) in zip(ids, entries, strict=True)
    )
    moving = [(i, piece.motion, carrier) for i, (piece, carrier) in zip(ids, entries, strict=True) if piece.motion]
    joints = tuple(_joint(i, m, "" if k is None else ids[k]) for i, m, k in moving if not m.small)
    small = tuple(_joint(i, m, "" if k is None else ids[k]) for i, m, k in moving if m.small)
    made = Asset(name, "", "made", parts, joints=joints, small_joints=small)
    return replace(centred(made), frame=IDENTITY_FRAME)


def _joint(part: str, motion: PieceMotion, carrier: str) -> AnnotatedJoint:
    coupling = Coupling(carrier, motion.follows) if motion.follows else None
    return AnnotatedJoint(part, motion.type, motion.axis, 0.0, motion.upper, coupling=coupling)


def _with_carriers(pieces: Sequence[PieceDraft]) -> list[tuple[PieceDraft, int | None]]:
    """Returns the pieces and all that is attached to them, each with the place of what carries it."""
    found: list[tuple[PieceDraft, int | None]] = []

    def add(piece: PieceDraft, carrier: int | None) -> None:
        place = len(found)
        found.append((piece, carrier))
        for part in piece.attached:
            add(part, place)

    for piece in pieces:
        add(piece, None)
    return found


def _numbered(stems: Sequence[str]) -> list[str]:
    """Returns unique ids: a stem that occurs once stays as it is, others get _1, _2, ..."""
    total, seen = Counter(stems), Counter[str]()
    ids = []
    for stem in stems:
        seen[stem] += 1
        ids.append(stem if total[stem] == 1 else f"{stem}_{seen[stem]}")
    return ids


Corner = tuple[float, float, float]
Span = tuple[Corner, Corner]
LEAST = 1e-6  # metres below which a board is a sheet without thickness


def plank(label: PartLabel, stem: str, material: Material, *spans: Span) -> PieceDraft:
    """Returns a piece of one or more boards, each between two corners; one without thickness is a sheet."""
    return PieceDraft(label, stem, tuple(surface_of(straight(low, high), material) for low, high in spans))


def solid(label: PartLabel, stem: str, material: Material, meshes: Sequence[TriangleMesh]) -> PieceDraft:
    """Returns a piece of several solids in one material."""
    return PieceDraft(label, stem, tuple(surface_of(mesh, material) for mesh in meshes))


def straight(low: Corner, high: Corner) -> TriangleMesh:
    """Returns a board, or a sheet where the corners agree along one axis."""
    thin = min(b - a for a, b in zip(low, high, strict=True)) < LEAST
    return sheet(low, high) if thin else board(low, high)


def mirrored_span(span: Span) -> Span:
    """Returns the mirror image of a span across x = 0."""
    (x0, *low), (x1, *high) = span
    return (-x1, low[0], low[1]), (-x0, high[0], high[1])


def both_sides(span: Span) -> tuple[tuple[str, Span], tuple[str, Span]]:
    """Returns a span given on the right (+x) and its mirror image, each with the word for its side."""
    return ("left", mirrored_span(span)), ("right", span)
