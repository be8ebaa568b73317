"""Plain meshes: a folder with one mesh file per part, or one OBJ with named groups. It settles no frame.

Sweet Home 3D names what moves in its OBJ groups: `sweethome3d_opening_on_hinge_<n>...` turns about the longest extent
of `sweethome3d_hinge_<n>...`; `sweethome3d_opening_on_rail_<n>...` slides along the longest extent of
`sweethome3d_rail_<n>...`. Those groups become annotated joints. Its files are in centimetres, Y up, front +Z.
"""

import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from grafu.articulation.motion_kind import kind_named
from grafu.asset.bodies import Body, BodyVisual, StatedMotion, annotation_of_bodies
from grafu.asset.drafts import PartDraft, parts_of_drafts
from grafu.asset.loose import shell_count
from grafu.asset.mesh_files import MESH_SUFFIXES, read_mesh_file
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.reading import Convention, MeshFile, MeshPiece, Reading
from grafu.asset.regular_files import folders_within
from grafu.asset.resources import ModelFiles
from grafu.errors import UnsegmentedAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import merge_meshes

CONVENTION = Convention("the names (Sweet Home 3D: centimetres, Y up, front +Z)", up="+Y", front="+Z", unit=0.01)
_OWN = re.compile(r"^sweethome3d_(?:opening_on|window_pane|window_mirror)", re.IGNORECASE)
_MOVING = re.compile(r"^sweethome3d_opening_on_(hinge|rail)_(\d+)", re.IGNORECASE)
_GUIDE = re.compile(r"^sweethome3d_(hinge|rail)_(\d+)", re.IGNORECASE)


def is_sweethome(found: MeshFile) -> bool:
    """Whether any group is named as an opening or a pane: fixed windows have panes alone."""
    return any(_OWN.match(piece.name) for piece in found.pieces)


def read_sweethome(path: Path, found: MeshFile) -> Reading:
    """Returns the groups as parts, openings as annotated joints; guide groups are dropped from the shape.

    What an opening is labelled by is the rest of its name: that it opens is its annotation.
    """
    guides = {_key(m): p for p in found.pieces if (m := _GUIDE.match(p.name)) and p.surfaces}
    notes = list(found.notes)
    bodies: list[Body] = []
    moving: dict[tuple[str, str], list[MeshPiece]] = {}
    for piece in found.pieces:
        match = _MOVING.match(piece.name)
        if match and piece.surfaces:
            moving.setdefault(_key(match), []).append(piece)
        elif piece.surfaces and piece not in guides.values():
            bodies.append(
                Body(piece.name, piece.name, (BodyVisual(piece.name, piece.surfaces, piece.name, path.name),))
            )
    for key, pieces in moving.items():
        motion = _motion(key[0], guides.get(key))
        if motion is None:
            notes.append(f"{pieces[0].name} names no {key[0]} group {key[1]}: kept in place")
        visuals = tuple(BodyVisual(p.name, p.surfaces, pieces[0].name, path.name) for p in pieces)
        bodies.append(Body(pieces[0].name, pieces[0].name, visuals, motion))
    solid = [piece for piece in found.pieces if piece.surfaces and piece not in guides.values()]
    parts = parts_of_drafts([_draft(piece, path.name) for piece in solid])
    annotation = annotation_of_bodies(bodies, up=1)
    return Reading("mesh file", parts, CONVENTION, annotation, notes=tuple(dict.fromkeys(notes)))


def _draft(piece: MeshPiece, file: str) -> PartDraft:
    match = _MOVING.match(piece.name)
    own = piece.label_name or piece.name
    spoken = own[match.end() :] or "opening" if match else piece.label_name
    return PartDraft(piece.name, piece.surfaces, label_name=spoken, file=file)


def _key(match: re.Match[str]) -> tuple[str, str]:
    return match[1].lower(), match[2]


def _motion(word: str, guide: MeshPiece | None) -> StatedMotion | None:
    if guide is None:
        return None
    box = merge_meshes([s.mesh for s in guide.surfaces]).box
    direction = np.eye(3)[int(np.argmax(box.size))]
    moves = kind_named("sweethome", word.lower())
    if moves is None:
        return None
    upper = math.pi / 2 if moves.turns else float(box.size.max())
    return StatedMotion(moves.type, Axis(box.center, direction), 0.0, upper, limited=False)


_DIVIDE = "divide it first, an object for each part (Blender: Edit Mode, P, By Loose Parts), and export it as GLB"


def divide(surfaces: Sequence[Surface]) -> str:
    """Returns what to do about one mesh where parts were expected."""
    shells = shell_count(surfaces)
    return f"--parts loose makes parts of its {shells} shells, or {_DIVIDE}" if shells > 1 else _DIVIDE


def looked_for_fronts(surfaces: Sequence[Surface]) -> str:
    """Returns what was tried to find parts in one mesh, in vain."""
    shells = shell_count(surfaces)
    drawn = "none is drawn on it along its creases, materials and texture islands"
    if shells == 1:
        return f"it is one connected shell, in which no front of a door or drawer is found: {drawn}"
    return f"none of its {shells} shells looks like the front of a door or drawer, and {drawn}"


def mesh_files_in(folder: Path) -> list[Path]:
    """Returns the mesh files directly in the folder, or, where there are none, in its only mesh subfolder."""
    found = sorted(p for p in folder.iterdir() if p.suffix.lower() in MESH_SUFFIXES and p.is_file())
    if found:
        return found
    inside = [sorted(p for p in sub.iterdir() if p.suffix.lower() in MESH_SUFFIXES) for sub in folders_within(folder)]
    filled = [files for files in inside if files]
    return filled[0] if len(filled) == 1 else []


def read_mesh_folder(folder: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the meshes of a folder, one part per file; a lone OBJ gives its groups instead.

    Raises:
        UnsegmentedAsset: if there is one part only.
        UnreadableAsset: if a file is damaged.
        AssetTooLarge: if there are more files or faces than the limits allow.
    """
    files = files or ModelFiles(folder, options.limits)
    meshes = mesh_files_in(folder)
    if len(meshes) == 1:
        return read_mesh(meshes[0], options, files)
    check_parts(len(meshes), folder, options.limits)
    drafts: list[PartDraft] = []
    notes: list[str] = []
    for path in meshes:
        found = read_mesh_file(path, files, split=False)
        drafts.append(PartDraft(path.stem, found.surfaces, file=path.name))
        notes += found.notes
    parts = parts_of_drafts(drafts)
    return Reading("mesh folder", parts, _convention(meshes), notes=tuple(dict.fromkeys(notes)))


def read_mesh(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the groups or objects of one mesh file as parts.

    Raises:
        UnsegmentedAsset: if the file is a single piece.
        UnreadableAsset: if the file is damaged.
    """
    found = read_mesh_file(path, files or ModelFiles(path, options.limits))
    if is_sweethome(found):
        return read_sweethome(path, found)
    filled = [piece for piece in found.pieces if piece.surfaces]
    check_parts(len(filled), path, options.limits)
    if len(filled) == 1 and options.parts == "input":
        raise UnsegmentedAsset(_one_piece(path, found))
    drafts = [
        PartDraft(piece.name or path.stem, piece.surfaces, label_name=piece.label_name, file=path.name)
        for piece in filled
    ]
    return Reading("mesh file", parts_of_drafts(drafts), _convention([path]), notes=found.notes)


def _one_piece(path: Path, found: MeshFile) -> str:
    kind = "one group" if path.suffix.lower() == ".obj" else "one mesh"
    faces = sum(len(s.mesh.faces) for s in found.surfaces)
    return (
        f"{path} is {kind} of {faces} faces: expected parts (groups in an OBJ, nodes in a GLB, files in a folder); "
        + divide(found.surfaces)
    )


def _convention(files: list[Path]) -> Convention:
    suffix = files[0].suffix.lower()
    usual = "+Y" if suffix == ".obj" else "+Z"
    return Convention(f"what is usual for {suffix[1:].upper()}: {usual[1]} up", usual_up=usual)
