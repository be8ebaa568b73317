"""Sweet Home 3D's naming of moving groups in an OBJ. It knows nothing else of that program.

`sweethome3d_opening_on_hinge_<n>...` turns about the longest extent of `sweethome3d_hinge_<n>...`;
`sweethome3d_opening_on_rail_<n>...` slides along the longest extent of `sweethome3d_rail_<n>...`.
Files are in centimetres, Y up, front +Z.
"""

import math
import re
from pathlib import Path

import numpy as np

from grafu.asset.bodies import Body, StatedMotion, Visual, annotation_of_bodies
from grafu.asset.drafts import PartDraft, parts_of_drafts
from grafu.asset.mesh_pieces import MeshFile, MeshPiece
from grafu.asset.reading import Convention, Reading
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import merge_meshes
from grafu.vocabulary import JointType

CONVENTION = Convention("the names (Sweet Home 3D: centimetres, Y up, front +Z)", up="+Y", front="+Z", unit=0.01)
_MOVING = re.compile(r"^sweethome3d_opening_on_(hinge|rail)_(\d+)", re.IGNORECASE)
_GUIDE = re.compile(r"^sweethome3d_(hinge|rail)_(\d+)", re.IGNORECASE)


def is_sweethome(found: MeshFile) -> bool:
    """Whether any group is named as an opening."""
    return any(_MOVING.match(piece.name) for piece in found.pieces)


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
            bodies.append(Body(piece.name, piece.name, (Visual(piece.name, piece.surfaces, piece.name, path.name),)))
    for key, pieces in moving.items():
        motion = _motion(key[0], guides.get(key))
        if motion is None:
            notes.append(f"{pieces[0].name} names no {key[0]} group {key[1]}: kept in place")
        visuals = tuple(Visual(p.name, p.surfaces, pieces[0].name, path.name) for p in pieces)
        bodies.append(Body(pieces[0].name, pieces[0].name, visuals, motion))
    solid = [piece for piece in found.pieces if piece.surfaces and piece not in guides.values()]
    parts = parts_of_drafts([_draft(piece, path.name) for piece in solid])
    annotation = annotation_of_bodies(bodies, up=1)
    return Reading("mesh file", parts, CONVENTION, annotation, notes=tuple(dict.fromkeys(notes)))


def _draft(piece: MeshPiece, file: str) -> PartDraft:
    match = _MOVING.match(piece.name)
    spoken = piece.name[match.end() :] or "opening" if match else ""
    return PartDraft(piece.name, piece.surfaces, label_name=spoken, file=file)


def _key(match: re.Match[str]) -> tuple[str, str]:
    return match[1].lower(), match[2]


def _motion(kind: str, guide: MeshPiece | None) -> StatedMotion | None:
    if guide is None:
        return None
    box = merge_meshes([s.mesh for s in guide.surfaces]).box
    direction = np.eye(3)[int(np.argmax(box.size))]
    if kind == "hinge":
        return StatedMotion(JointType.REVOLUTE, Axis(box.center, direction), 0.0, math.pi / 2, limited=False)
    return StatedMotion(JointType.PRISMATIC, Axis(box.center, direction), 0.0, float(box.size.max()), limited=False)
