"""Objects that hide doors or drawers are cut into parts. What a front is, `segmentation` states.

Inputs whose makers divided them by what moves are left alone: parts segmented by hand, and robots of several links.
What the input states about its motions is not asked: the parts are the same with joints and without.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.cut_pieces import freed, ids_of_pieces, note_on_cut, part_of_piece
from grafu.asset.drawn_cuts import handles_on_plates, with_drawn_fronts
from grafu.asset.grips import face_area
from grafu.asset.labels import is_appliance, is_bed, is_chest, is_doorway, is_washer, is_whole_part, sense_of
from grafu.asset.lying_handles import with_lying_handles
from grafu.asset.names import spoken
from grafu.asset.part import ROBOTS, Frame, Part
from grafu.asset.plausibility import BODY
from grafu.asset.reading import Reading
from grafu.asset.standing import spelled
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, Mat4, Vec3
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.division import FacePiece, divided
from grafu.segmentation.lids import count_held_fronts, lid_of_chest, lid_of_washer
from grafu.segmentation.mesh_shells import MeshShells
from grafu.vocabulary import PartLabel

# What may hide fronts: what no name tells, and what is called by what it holds.
_OPEN: Final = frozenset({PartLabel.UNKNOWN, PartLabel.MISC, PartLabel.FACE_FRAME, PartLabel.DOOR, PartLabel.DRAWER})


# What may lie on several fronts: handles, and what may be some.
_LYING: Final = frozenset({PartLabel.UNKNOWN, PartLabel.MISC, PartLabel.HANDLE})


@final
@dataclass(frozen=True, slots=True)
class CutConfig:
    """Which parts may hide fronts, and which front of an appliance is a door.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    door_height: float = 0.5
    """Least height of an appliance's door (fraction of its width)."""
    plate: float = 0.06
    """What has a smaller face is the plate of a dial, and no door of it (fraction of the appliance's largest front)."""
    only: float = 0.99
    """A microwave has one door: what has a smaller face is the panel beside it (the same)."""
    thick: float = 0.35
    """What is thicker than this is no board (fraction of its middle side) ..."""
    case: float = 0.1
    """... and where it is called by the name of a case, than this: a wardrobe may be shallow."""
    bed_width: float = 0.8
    """What takes this much of a bed's side (fraction) ..."""
    bed_height: float = 0.4
    """... and is as high as this (fraction of its width) is a headboard or footboard, and no front."""
    wall: float = 0.1
    """What takes less of the largest side of a chest is no front of it (fraction)."""
    alike: float = 0.8
    """The fronts of an object that has the name of one door or drawer are what it states if the smallest has this
    fraction of the largest one's width and height: two leaves. Of fronts that differ it states what the first is."""

    def __post_init__(self) -> None:
        require_ratios(
            self, "door_height", "plate", "only", "thick", "case", "bed_width", "bed_height", "wall", "alike"
        )


def cut_where_fronts_appear(reading: Reading, frame: Frame, name: str = "", config: CutConfig = CutConfig()) -> Reading:
    """Returns the reading with objects cut where that makes doors or drawers appear, and a note on each.

    Args:
        reading: what was read.
        frame: how it stands; its unit does not matter.
        name: that of the model: the front of what is called an oven is a door, unless another part is named door.
        config: which parts may hide fronts.
    """
    if not reading.parts or is_divided(reading) or is_doorway(name):
        return reading
    T = turn_of(frame)
    reading = _with_nameless_whole(reading)
    meshes = [part.mesh.transformed(T) for part in reading.parts]
    has_door = any(part.label is PartLabel.DOOR and part.labelled_by == "name" for part in reading.parts)
    open_to = [_may_be_cut(part, has_door, config) and part.carried_by is None for part in reading.parts]
    whole = [part.label.is_movable for part in reading.parts]
    materials = [_materials(part) for part in reading.parts]
    loose = [part.label in _LYING and part.carried_by is None for part in reading.parts]
    shells = MeshShells.of(meshes)
    cuts = divided(meshes, open_to, whole, materials, loose, shells=shells)
    cuts = with_drawn_fronts(cuts, reading.parts, meshes, open_to, materials, shells=shells)
    cuts |= handles_on_plates(cuts, meshes, open_to, materials, shells=shells)
    if is_chest(name) and not any(whole) and _may_have_lid(meshes, cuts, config):
        cuts = lid_of_chest(meshes, open_to) or cuts  # its front wall is a plate, too
    if is_washer(name) and not any(whole):
        cuts = lid_of_washer(meshes, open_to) or cuts
    if not cuts:
        return reading
    model = "" if any(part.label is PartLabel.DOOR for part in reading.parts) else name
    if is_bed(name) or any(is_bed(part.source.name) for part in reading.parts):
        kept = {k: _without_boards(meshes[k], found, _extent_of(meshes), config) for k, found in cuts.items()}
        cuts = {k: found for k, found in kept.items() if found}
    pieces = [(part, piece) for k, part in enumerate(reading.parts) for piece in cuts.get(k, [None])]
    cut = {reading.parts[k].id for k in cuts}
    cases = {reading.parts[k].id for k in _cases_beside_larger(meshes, cuts, config)}
    of_one = {reading.parts[k].id for k in _named_after_one(reading, meshes, cuts, config)}
    bare = ((_without_label(part) if part.id in of_one else part, piece) for part, piece in pieces)
    least = {
        part.id: _least_door(part.source.name, model, mesh, cuts.get(k, ()), config)
        for k, (part, mesh) in enumerate(zip(reading.parts, meshes, strict=True))
    }
    parts = tuple(
        freed(
            _named(part_of_piece(part, piece, new, T, part.id in cases), piece, model, least[part.id], T, config), cut
        )
        for (part, piece), new in zip(bare, ids_of_pieces(pieces), strict=True)
    )
    lying = [piece is not None and piece.role == "on front" for _, piece in pieces]
    parts = with_lying_handles(parts, lying, [_facing(piece, T) for _, piece in pieces])
    notes = (note_on_cut(reading.parts[k], found) for k, found in cuts.items())
    return replace(reading, parts=parts, notes=(*reading.notes, *notes), fronts_face=_side_of_fronts(cuts, T))


def _facing(piece: FacePiece | None, T: Mat4) -> Vec3 | None:
    """Returns where a piece looks in the input; `T` turns the input upright."""
    return None if piece is None or piece.towards is None else T[:3, :3].T @ piece.towards


def _with_nameless_whole(reading: Reading) -> Reading:
    """Returns the reading in which a board is no board where it is all that there is: it has the name of one piece."""
    only = reading.parts[0] if len(reading.parts) == 1 else None
    if only is None or only.labelled_by != "name" or only.label.is_movable or sense_of(only.source.name).is_container:
        return reading
    return replace(reading, parts=(_without_label(only),))


def _extent_of(meshes: list[TriangleMesh]) -> Vec3:
    return np.max([mesh.box.high for mesh in meshes], axis=0) - np.min([mesh.box.low for mesh in meshes], axis=0)


def _may_have_lid(meshes: list[TriangleMesh], cuts: dict[int, list[FacePiece]], config: CutConfig) -> bool:
    """Whether a chest shows one front at most, its front wall: straps and plates of locks are too small for fronts."""
    extent = _extent_of(meshes)
    face = float(extent[:2].max() * extent[2])
    sizes = [meshes[k].with_faces(p.faces).box.size for k, found in cuts.items() for p in found if p.role == "front"]
    wide = [size for size in sizes if np.prod(np.sort(size)[1:]) >= config.wall * face]
    return len(wide) <= 1 and count_held_fronts(meshes) <= 1


def _side_of_fronts(cuts: dict[int, list[FacePiece]], T: Mat4) -> str | None:
    """Returns the direction in the input that all fronts face which were cut out; `T` turns the input upright."""
    facing = [side for found in cuts.values() for p in found if (side := _facing(p, T)) is not None]
    if not facing:
        return None
    axis = int(np.argmax(np.abs(facing[0])))
    return spelled(axis, bool(facing[0][axis] > 0))


def is_divided(reading: Reading) -> bool:
    """Whether the maker of an input divided it by what moves."""
    by_hand = reading.grouped or reading.kind in ("partnet-mobility", "hssd")
    return by_hand or (reading.kind in ROBOTS and len({part.source.link for part in reading.parts}) > 1)


def _may_be_cut(part: Part, has_door: bool, config: CutConfig) -> bool:
    """Whether a part may hide fronts: so may the body of a piece of furniture that is named after that.

    A front that was joined of objects hides none, its handles were objects, too; nor does an appliance that has a door.
    """
    if (part.label.is_movable and part.labelled_by == "shape") or (has_door and is_appliance(part.source.name)):
        return False
    sides = np.sort(part.box.size)
    is_case = part.label is BODY and sense_of(part.source.name).is_container and sides[0] > config.case * sides[1]
    is_bookcase = part.label is PartLabel.SHELF and sides[0] > config.thick * sides[1]  # no board, but shelves
    return part.label in _OPEN or bool(is_case or is_bookcase)


def _cases_beside_larger(
    meshes: list[TriangleMesh], cuts: dict[int, list[FacePiece]], config: CutConfig
) -> Iterator[int]:
    """Yields the objects whose rest is the case of several fronts, and that stand beside a larger object.

    Between larger ones a case looks like a drawer; the largest does not, and needs no label.
    """
    largest = max(meshes, key=lambda mesh: mesh.box.volume)
    for k, pieces in cuts.items():
        rest = [piece.faces for piece in pieces if piece.role == "rest"]
        several = sum(piece.role == "front" for piece in pieces) > 1
        if rest and several and meshes[k] is not largest:
            sides = np.sort(meshes[k].with_faces(rest[0]).box.size)
            if sides[0] > config.case * sides[1]:
                yield k


def _named_after_one(
    reading: Reading, meshes: list[TriangleMesh], cuts: dict[int, list[FacePiece]], config: CutConfig
) -> Iterator[int]:
    """Yields the objects with the name of one door or drawer that several fronts unlike one another were cut from.

    Objects that are joined by their material, as optimisers of glTF do, have the name of the first.
    """
    for k, pieces in cuts.items():
        fronts = [meshes[k].with_faces(piece.faces).box.size for piece in pieces if piece.role == "front"]
        if len(fronts) > 1 and is_whole_part(reading.parts[k].source.name):
            sides = np.sort(fronts, axis=1)[:, 1:]
            if (sides.min(axis=0) < config.alike * sides.max(axis=0)).any():
                yield k


def _without_label(part: Part) -> Part:
    return replace(part, label=PartLabel.UNKNOWN, labelled_by="none")


def _materials(part: Part) -> Indices:
    """Returns the number of the surface of each face of the part's mesh."""
    return np.repeat(np.arange(len(part.surfaces)), [len(surface.mesh.faces) for surface in part.surfaces])


def _without_boards(mesh: TriangleMesh, pieces: list[FacePiece], extent: Vec3, config: CutConfig) -> list[FacePiece]:
    """Returns what a bed's object is cut into, its headboard and footboard with the rest of it; nothing but these."""
    is_board = [piece.role == "front" and _is_board(mesh, piece, extent, config) for piece in pieces]
    if not any(is_board):
        return pieces
    whole = [p.faces for p, board in zip(pieces, is_board, strict=True) if board or p.role == "rest"]
    others = [p for p, board in zip(pieces, is_board, strict=True) if not board and p.role != "rest"]
    return [FacePiece("rest", np.sort(np.concatenate(whole))), *others] if others else []


def _is_board(mesh: TriangleMesh, piece: FacePiece, extent: Vec3, config: CutConfig) -> bool:
    size = mesh.with_faces(piece.faces).box.size
    wide = int(np.argmax(size[:2]))
    return bool(size[wide] >= config.bed_width * extent[wide] and size[2] >= config.bed_height * size[wide])


def turn_of(frame: Frame) -> Mat4:
    """Returns the rotation and reflection of a frame alone."""
    T = np.eye(4)
    T[:3, :3] = np.asarray(frame.input_to_output)[:3, :3] / frame.scale
    return T


def _least_door(name: str, model: str, mesh: TriangleMesh, pieces: Sequence[FacePiece], config: CutConfig) -> float:
    """Returns the least face of a door among the fronts of an object: a microwave has one door, beside its panel."""
    faces = [face_area(mesh.with_faces(piece.faces).box) for piece in pieces if piece.role == "front"]
    has_one = "microwave" in {*spoken(name), *spoken(model)}
    return max(faces, default=0.0) * (config.only if has_one else config.plate)


def _named(part: Part, piece: FacePiece | None, model: str, least: float, T: Mat4, config: CutConfig) -> Part:
    """Returns a new front as a door where object or model are called an oven, a refrigerator or the like.

    It must be too high for a drawer or a control panel, and its face not less than `least`; smaller ones are plates of
    dials and panels, and stay. `T` turns it upright.
    """
    if piece is None or piece.role != "front" or part.label is not PartLabel.UNKNOWN:
        return part
    if not (is_appliance(part.source.name) or is_appliance(model)):
        return part
    box = part.mesh.transformed(T).box
    if face_area(box) < least:
        return replace(part, label=PartLabel.MISC, labelled_by="name")
    is_high = float(box.size[2]) >= config.door_height * float(box.size[:2].max())
    return replace(part, label=PartLabel.DOOR, labelled_by="name") if is_high else part
