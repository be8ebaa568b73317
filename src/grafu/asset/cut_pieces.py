"""The parts that the pieces of a cut object make: their ids, labels and surfaces, and the note on the cut."""

from collections import Counter
from dataclasses import replace

from grafu.asset.loose import faces_of_part
from grafu.asset.names import unique_ids
from grafu.asset.part import Part
from grafu.asset.plausibility import BODY
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.mesh import merge_meshes
from grafu.segmentation.backs import back_of
from grafu.segmentation.division import FacePiece
from grafu.segmentation.surface_config import CreaseConfig
from grafu.vocabulary import PartLabel


def ids_of_pieces(pieces: list[tuple[Part, FacePiece | None]]) -> list[str]:
    """Returns an id for each piece; parts that are not cut, and what is left of those that are, keep theirs."""
    order = sorted(range(len(pieces)), key=lambda k: _is_new(pieces[k][1]))
    found = unique_ids((_stem(*pieces[k]), _is_handle(*pieces[k])) for k in order)
    named = dict(zip(order, found, strict=True))
    return [named[k] for k in range(len(pieces))]


def part_of_piece(part: Part, piece: FacePiece | None, name: str, T: Mat4, is_case: bool) -> Part:
    """Returns a part of the faces of a piece; None: the part that is not cut, under this name.

    Args:
        part: what was cut.
        piece: what it was cut into.
        name: the id of the new part.
        T: turns the input upright.
        is_case: whether the rest, which no name tells, is the case of the fronts.
    """
    if piece is None:
        return replace(part, id=name)
    keeps = piece.role in ("body", "on front") or (
        part.label.is_movable == (piece.role == "front") and piece.role != "handle"
    )
    label, by = (part.label, part.labelled_by) if keeps else (PartLabel.UNKNOWN, "none")
    if piece.role == "on front" and label is PartLabel.UNKNOWN:
        label = PartLabel.MISC  # whatever it is, it is no front
    if piece.role == "rest" and label is PartLabel.UNKNOWN and is_case:
        label, by = BODY, "shape"
    if piece.role == "lid":
        label, by = PartLabel.DOOR, "name"
    surfaces = faces_of_part(part, piece.faces)
    if piece.is_sheet and piece.towards is not None:
        surfaces = (*surfaces, _back(part, surfaces, piece.towards, T))
    return replace(part, id=name, surfaces=surfaces, label=label, labelled_by=by)


def freed(part: Part, cut: set[str]) -> Part:
    """Returns the part attached to nothing where its carrier was cut: contact then decides on what."""
    return replace(part, carried_by=None) if part.carried_by in cut else part


def note_on_cut(part: Part, pieces: list[FacePiece]) -> str:
    """Returns in words what a part was cut into."""
    counts = Counter(piece.role for piece in pieces)
    if counts["on front"]:
        rest = " and elsewhere" if counts["rest"] else ""
        return f"{part.source.name} lies on fronts ({counts['on front']}){rest}: a part on each (--parts auto)"
    found = [
        f"{counts[role]} {role}{'s' if counts[role] > 1 else ''}" for role in ("front", "handle", "lid") if counts[role]
    ]
    if counts["body"]:
        return f"{part.source.name} holds {found[0]} drawn in it: parts of their own (--parts auto)"
    rest = " and the rest" if counts["rest"] else ""
    return f"{part.source.name} was cut into {', '.join(found)}{rest} (--parts auto)"


def _is_new(piece: FacePiece | None) -> bool:
    return piece is not None and piece.role in ("front", "handle", "lid")


def _stem(part: Part, piece: FacePiece | None) -> str:
    return part.id if piece is None or not _is_new(piece) else f"{part.id}_{piece.role}"


def _is_handle(part: Part, piece: FacePiece | None) -> bool:
    return piece is None and part.label is PartLabel.HANDLE


def _back(part: Part, surfaces: tuple[Surface, ...], towards: Vec3, T: Mat4) -> Surface:
    """Returns back and rim of a front that was drawn on a part, in the material of most of it; `T` turns it upright."""
    main = max(surfaces, key=lambda surface: surface.mesh.area)
    front = merge_meshes([surface.mesh for surface in surfaces])
    thickness = CreaseConfig().thick * float(part.box.size.max())
    return Surface(back_of(front, T[:3, :3].T @ towards, thickness), main.material)
