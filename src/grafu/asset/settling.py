"""What was read to an asset in the object frame: cleaned, loose pieces joined, cut where fronts appear, placed.

It reads no files.
"""

from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np

from grafu.asset.appliance_fronts import with_appliance_fronts
from grafu.asset.boarded_drawers import with_boarded_drawers
from grafu.asset.bodies_of_faces import with_bodies_of_faces
from grafu.asset.boxes_in_cases import with_boxes_from_cases
from grafu.asset.cutting import cut_where_fronts_appear, is_divided, turn_of
from grafu.asset.door_frames import with_door_frames
from grafu.asset.either_kind import with_either_kind
from grafu.asset.facing_groups import FurnishedScene, facing_groups
from grafu.asset.folder import divide, looked_for_fronts
from grafu.asset.frame import settle_frame, straightened, turned_before, whole_box
from grafu.asset.framed_leaves import with_framed_leaves
from grafu.asset.furniture_pieces import FurniturePiece, told_apart
from grafu.asset.handle_stands import with_handle_stands
from grafu.asset.handles_in_doors import with_handles_of_doors
from grafu.asset.leaf_pieces import with_leaf_pieces
from grafu.asset.lid_names import with_lids_by_name
from grafu.asset.loose import loose_parts, with_split_handles
from grafu.asset.named_fittings import with_named_fittings
from grafu.asset.one_front import has_copies, joined_where_nameless, joined_where_one_name
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.part import IDENTITY_FRAME, Asset, Frame, Part
from grafu.asset.parted_surface import is_parted_surface, with_boards
from grafu.asset.pieces import with_joined_pieces
from grafu.asset.place_names import with_place_names
from grafu.asset.plausibility import with_blind_fronts, with_bodies, with_control_panels, with_plausible_labels
from grafu.asset.reading import Placing, Reading, cleaned
from grafu.asset.ring_seats import with_ring_seats
from grafu.asset.several_pieces import put_together
from grafu.asset.shown_lids import with_shown_lid
from grafu.errors import UnreadableAsset, UnsegmentedAsset
from grafu.geometry.arrays import Mat4
from grafu.vocabulary import PartLabel

EXPECTED: Final = (
    "a PartNet-Mobility folder, an HSSD model, a URDF, SDF or MJCF, a GLB, glTF, COLLADA, OpenUSD, FBX, 3MF, 3DS "
    "or Blender scene, an OBJ with groups, or a folder of meshes"
)
"""What can be read, in words."""


def settled(
    reading: Reading, name: str, path: Path, options: LoadOptions = LoadOptions(), file: Frame | None = None
) -> Asset:
    """Returns what was read as an asset in the object frame, cleaned, its loose pieces joined, its handles carried.

    Of one piece of a file, `file` is the frame that the file has as a whole.

    Raises:
        UnreadableAsset: if it holds no part with faces.
        UnsegmentedAsset: if it is one piece where parts were expected.
        AssetTooLarge: if it exceeds a limit.
        AssetError: if an option contradicts it.
    """
    reading = cleaned(reading)
    if options.parts == "auto" and options.front is None and reading.parts:
        whole, askew = straightened(reading, options)
        seen = _seen(whole, options)
        scene = facing_groups(whole, seen, settle_frame(seen, options, file))
        if scene is not None:
            return _settled_together(whole, scene, (name, path), options, (file, askew))
        return _settled_alone(whole, name, path, options, file, askew=askew)
    return _settled_alone(reading, name, path, options, file)


def _seen(reading: Reading, options: LoadOptions) -> Reading:
    """Returns the reading as its labels tell how it stands: of what is hidden nothing does."""
    return _without_labels(reading) if options.labels == "none" else reading


def _settled_together(
    reading: Reading,
    scene: FurnishedScene,
    place: tuple[str, Path],
    options: LoadOptions,
    stood: tuple[Frame | None, Mat4],
) -> Asset:
    """Returns the groups of a scene, each settled for itself, as one asset.

    `place` is its name and path; it `stood` so: the frame of the file that it is a piece of, and how it was turned.
    """
    (name, path), (file, askew) = place, stood
    furniture = replace(reading, parts=tuple(part for group in scene.groups for part in group.reading.parts))
    whole = settle_frame(_seen(furniture, options), options, file)
    standing = whole.assumed[0]
    if file is None and options.height is None and options.scale is None:  # as with `pieces_in`: of the largest piece
        whole = settle_frame(_seen(scene.groups[0].reading, options), replace(options, up=whole.up))
    own = [replace(options, up=whole.up, front=group.front) for group in scene.groups]
    pieces = [
        _settled_alone(group.reading, name, path, stated, whole, is_all=False)
        for group, stated in zip(scene.groups, own, strict=True)
    ]
    found = tuple(part for piece in pieces for part in piece.parts)
    if len(found) == len(pieces) and len(reading.parts) == 1:
        return _settled_alone(reading, name, path, options, file)  # one mesh that shows no front: it is refused
    check_parts(len(found) + len(scene.others), path, options.limits)
    main = scene.groups[0].front or pieces[0].frame.front
    placed = settle_frame(reading, replace(options, up=whole.up, front=main), whole)
    size = whole.assumed[-1]
    words = f"front is {main}: that of the largest of {len(pieces)} pieces, each of which has its own"
    made = put_together(pieces, scene.others, reading, replace(placed, assumed=(standing, words, size)), str(path))
    return replace(made, frame=turned_before(made.frame, askew))


def _settled_alone(
    reading: Reading,
    name: str,
    path: Path,
    options: LoadOptions,
    file: Frame | None,
    is_all: bool = True,
    askew: Mat4 | None = None,
) -> Asset:
    """Returns one piece of furniture as an asset; where it is not all of a file, it may be one part.

    `askew` is how it was turned so that its walls lie along the axes; None: it was not yet.
    """
    if askew is None:
        reading, askew = straightened(reading, options) if reading.parts else (reading, np.eye(4))
    if options.parts == "loose":
        reading = _taken_apart(reading, path, options)
    elif not reading.grouped and reading.parts:
        reading = _joined(_mended(reading) if options.parts == "auto" else reading)
    if options.parts == "auto" and has_copies(reading):
        reading = joined_where_one_name(reading, settle_frame(reading, options, file))
    if options.parts == "auto" and not reading.grouped and reading.parts:
        reading = _assembled(reading)
    if reading.parts:
        reading = _plausible(reading)
    stands: Frame | None = None
    if options.parts == "auto" and reading.parts:
        hidden = options.labels == "none"  # of what is hidden nothing tells how the piece stands
        stands = settle_frame(_without_labels(reading) if hidden else reading, options, file)
        if is_parted_surface(reading.parts):
            note = "the objects are pieces of one surface: none is cut, and sheets become boards (--parts auto)"
            reading = replace(reading, parts=with_boards(reading.parts), notes=(*reading.notes, note))
        else:
            reading = cut_where_fronts_appear(reading, stands, name)
        reading = joined_where_nameless(reading, stands)
        reading = with_shown_lid(with_boxes_from_cases(reading, stands), stands, name)
        reading = replace(reading, parts=with_appliance_fronts(reading.parts, stands))
        reading = _with_split_handles(reading)
        if is_divided(reading):
            parts = with_handles_of_doors(reading.parts, turn_of(stands), labelled=not hidden)
            reading = replace(reading, parts=parts)
    reading = replace(reading, parts=with_bodies(with_control_panels(reading.parts)))
    if is_all:
        _check_parts(reading, path, options)
    if options.labels == "none":
        reading = _without_labels(reading)
        reading = reading if stands is None else with_shown_lid(reading, stands, name)
    frame = settle_frame(reading, options, file, None if options.labels == "none" else stands)
    place, frame = Placing(frame), turned_before(frame, askew)
    annotation = reading.annotation and place.annotation(reading.annotation)
    placed = place.parts(reading.parts)
    parts, told = with_blind_fronts(placed if options.labels == "none" else with_ring_seats(with_either_kind(placed)))
    return Asset(name, str(path), reading.kind, parts, frame, notes=(*reading.notes, *told), annotation=annotation)


def _check_parts(reading: Reading, path: Path, options: LoadOptions) -> None:
    count = len(reading.parts)
    check_parts(count, path, options.limits)
    lost = next((f" ({note})" for note in reading.notes if note.endswith("was left out")), "")
    if count == 0:
        raise UnreadableAsset(f"{path} holds no part with faces{lost}: expected {EXPECTED}")
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
        held |= {part for joint in annotation.small_joints for part in (joint.part, *joint.members)}
        held |= {part for p in annotation.parts if p.carried_by for part in (p.id, p.carried_by)}
        annotation = replace(annotation, parts=loose_parts(annotation.parts, held, allow))
    return replace(reading, parts=parts, annotation=annotation, notes=(*reading.notes, note))


def _mended(reading: Reading) -> Reading:
    """Returns the reading with the faces of bodies joined that the file has as objects of their own."""
    parts, notes = with_bodies_of_faces(reading.parts)
    return replace(reading, parts=parts, notes=(*reading.notes, *notes))


def _joined(reading: Reading) -> Reading:
    framed, found = with_door_frames(reading.parts)
    whole = whole_box(framed)
    fronts, told = with_leaf_pieces(framed, whole)
    parts, notes = with_joined_pieces(fronts, whole)
    return replace(reading, parts=parts, notes=(*reading.notes, *found, *told, *notes))


def _assembled(reading: Reading) -> Reading:
    """Returns the reading with the boards of leaves and of drawers joined that no names tell."""
    whole = whole_box(reading.parts)
    leaves, frames = with_framed_leaves(with_handle_stands(reading.parts, whole), whole)
    parts, boards = with_boarded_drawers(leaves, whole)
    return replace(reading, parts=parts, notes=(*reading.notes, *frames, *boards))


def _plausible(reading: Reading) -> Reading:
    opened, places = with_place_names(with_lids_by_name(reading.parts))
    judged, notes = with_plausible_labels(opened)
    judged, told = with_named_fittings(judged)
    return _with_split_handles(replace(reading, parts=judged, notes=(*reading.notes, *places, *notes, *told)))


def _with_split_handles(reading: Reading) -> Reading:
    parts, notes = with_split_handles(reading.parts)
    return replace(reading, parts=parts, notes=(*reading.notes, *notes))


def _without_labels(reading: Reading) -> Reading:
    stated = reading.annotation
    annotation = stated and replace(stated, parts=tuple(_unlabelled(p) for p in stated.parts))
    parts = tuple(_unlabelled(p) for p in reading.parts)
    return replace(reading, parts=parts, annotation=annotation, furniture=None)


def _unlabelled(part: Part) -> Part:
    return replace(part, label=PartLabel.UNKNOWN, labelled_by="hidden")


def pieces_in(reading: Reading, options: LoadOptions) -> tuple[tuple[FurniturePiece, ...], Frame]:
    """Returns the pieces of furniture in a file, and the frame of the file: its scale is that of its largest piece."""
    if not reading.parts:
        return (), IDENTITY_FRAME
    whole = settle_frame(reading, options)
    pieces = told_apart(reading, whole)
    if not pieces or options.height is not None or options.scale is not None:
        return pieces, whole
    largest = max(pieces, key=lambda piece: whole_box(piece.reading.parts).diagonal)
    return pieces, settle_frame(largest.reading, replace(options, up=whole.up, front=None))
