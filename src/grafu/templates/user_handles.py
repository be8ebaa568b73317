"""Handles of the user's own: a folder of sub-folders, each with one mesh and a `template.json` of kind "handle".

`docs/templates.md` says what a sub-folder holds. A bar is stretched along its length alone, so that its ends keep their
thickness; knobs and cups grow in height as they do in length. Protrusion is scaled on its own.
"""

from functools import lru_cache
from pathlib import Path

import numpy as np

from grafu.asset.gltf import read_surfaces
from grafu.asset.mesh_files import MESH_SUFFIXES, read_mesh_file
from grafu.asset.options import Limits
from grafu.asset.resources import ModelFiles
from grafu.errors import AssetError, TemplateError
from grafu.geometry.arrays import Mat4
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.templates.annotation import HandleNote, handle_frame, is_handle, read_handle_note
from grafu.templates.handle import HandleSize, HandleTemplate

ANNOTATION = "template.json"
MESH = "handle"
_GLTF = (".glb", ".gltf")
_ON_PLANE = 0.05  # of the protrusion: how far the nearest point of a mesh may lie from the stated foot plane
_BEHIND = 0.5  # of the protrusion: how deep screws may reach behind the foot plane
_LIMITS = Limits(max_bytes=32 * 2**20, max_parts=100, max_faces=50_000)  # a kitchen repeats a handle thirty times
_CACHED = 128


def load_handles(folder: Path) -> dict[str, HandleTemplate]:
    """Returns the handles in the sub-folders of `folder` by id, which is the sub-folder's name; other kinds are left.

    Raises:
        TemplateError: if the folder is not there, or a handle in it is incomplete or contradicts itself.
    """
    if not folder.is_dir():
        raise TemplateError(f"{folder} is not a folder: expected one sub-folder per template; see docs/templates.md")
    notes = sorted(path for path in folder.glob(f"*/{ANNOTATION}") if is_handle(path))
    return {path.parent.name: load_handle(path.parent) for path in notes}


def load_handle(folder: Path) -> HandleTemplate:
    """Returns the handle in one folder.

    Raises:
        TemplateError: if the mesh or the annotation is missing, unreadable, or contradicts the other.
    """
    note = read_handle_note(folder / ANNOTATION)
    try:
        mesh = _centred(_read(folder).transformed(handle_frame(note)))
        return _template(folder.name, note, mesh)
    except (AssetError, TemplateError) as error:
        raise TemplateError(f"template {folder}: {error}; see docs/templates.md") from None


def _read(folder: Path) -> TriangleMesh:
    files = [folder / f"{MESH}{suffix}" for suffix in (*MESH_SUFFIXES, *_GLTF)]
    found = next((file for file in files if file.is_file()), None)
    if found is None:
        raise TemplateError(f"it lacks its mesh: expected {MESH}.obj, .ply, .stl or .glb")
    model = ModelFiles(folder, _LIMITS)
    if found.suffix in _GLTF:
        mesh = merge_meshes([surface.mesh for surface in read_surfaces(found, model)])
    else:
        mesh = merge_meshes([s.mesh for s in read_mesh_file(found, model, split=False).surfaces])
    if not len(mesh.faces):
        raise TemplateError(f"{found.name} has no faces")
    return mesh


def _centred(mesh: TriangleMesh) -> TriangleMesh:
    """Returns the mesh with its middle, along and up, over the origin; the foot plane stays."""
    return mesh.translated(-np.asarray(mesh.box.center) * (1.0, 0.0, 1.0))


def _template(template_id: str, note: HandleNote, mesh: TriangleMesh) -> HandleTemplate:
    low, high = mesh.box.low, mesh.box.high
    protrusion = -float(low[1])
    if protrusion <= 0:
        raise TemplateError("`outwards` must point from the foot plane to the handle: all of the mesh lies behind it")
    if not -_ON_PLANE * protrusion <= float(high[1]) <= _BEHIND * protrusion:
        where = f"{float(high[1]):.3g} m behind it" if high[1] > 0 else f"{-float(high[1]):.3g} m before it"
        raise TemplateError(f"`foot` must be a point of the plane that lies on the front: the mesh ends {where}")
    size = HandleSize(float(mesh.box.size[0]), protrusion)
    longest = size.length if note.longest is None else note.unit * note.longest
    grows = note.family != "bar"

    @lru_cache(_CACHED)
    def shape(length: float, out: float) -> tuple[TriangleMesh, ...]:
        along = length / size.length
        return (mesh.transformed(_scaling(along, out / size.protrusion, along if grows else 1.0)),)

    return HandleTemplate(template_id, note.title or template_id, note.family, size, longest, shape, note.turns)


def _scaling(x: float, y: float, z: float) -> Mat4:
    return np.diag([x, y, z, 1.0])
