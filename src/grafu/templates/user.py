"""Templates and handles of the user's own: folders of sub-folders with meshes and an annotation. It checks no motion.

`docs/templates.md` states what a sub-folder holds. A user's hinge keeps its barrel round: it is scaled equally in every
direction square to the pin, as much as fits the size asked for, and freely along the pin. What was built is in the
template's `size`. A user's rail is stretched to exactly the size asked for.

A bar handle is stretched along its length alone, so that its ends keep their thickness; knobs and cups grow in height
as they do in length. Protrusion is scaled on its own.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from math import radians
from pathlib import Path

import numpy as np

from grafu.asset.gltf import read_gltf, read_surfaces
from grafu.asset.mesh_files import MESH_SUFFIXES, read_mesh_file
from grafu.asset.options import Limits, LoadOptions
from grafu.asset.resources import ModelFiles
from grafu.errors import AssetError, TemplateError
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.templates.annotation import (
    HandleNote,
    HingeNote,
    RailNote,
    handle_frame,
    hinge_frame,
    hinge_normals,
    is_handle,
    rail_frame,
    read_annotation,
    read_handle_note,
    snap_plane,
)
from grafu.templates.template import (
    Gallery,
    HandleSize,
    HandleTemplate,
    HingeModel,
    HingeSize,
    HingeTemplate,
    RailModel,
    RailSize,
    RailTemplate,
    SnapPlane,
    TemplateEnd,
)
from grafu.vocabulary import MechanismClass

ANNOTATION = "template.json"
MESH = "handle"
_GLTF = (".glb", ".gltf")
_ON_PLANE = 0.05  # of the protrusion: how far the nearest point of a mesh may lie from the stated foot plane
_BEHIND = 0.5  # of the protrusion: how deep screws may reach behind the foot plane
_HANDLE_LIMITS = Limits(
    max_bytes=32 * 2**20, max_parts=100, max_faces=50_000
)  # a kitchen repeats a handle thirty times
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
    model = ModelFiles(folder, _HANDLE_LIMITS)
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


_FIT = 0.05  # how far stated lengths may differ from the meshes and snap planes
_LIMITS = Limits(max_bytes=32 * 2**20, max_parts=100, max_faces=200_000)  # hardware is repeated: keep it light

Ends = tuple[TemplateEnd, TemplateEnd]


def load_gallery(folder: Path) -> Gallery:
    """Returns the templates in the sub-folders of `folder` that hold a `template.json`; a template's id is its folder.

    Handles are left to `user_handles`.

    Raises:
        TemplateError: if there is none, or one of them is incomplete or contradicts itself.
    """
    if not folder.is_dir():
        raise TemplateError(f"{folder} is not a folder: expected one sub-folder per template; see docs/templates.md")
    notes = sorted(folder.glob(f"*/{ANNOTATION}"))
    models = [load_template(path.parent) for path in notes if not is_handle(path)]
    if not notes:
        raise TemplateError(f"{folder} holds no template: expected <id>/{ANNOTATION}; see docs/templates.md")
    hinges = tuple(m for m in models if isinstance(m, HingeModel))
    return Gallery(hinges, tuple(m for m in models if isinstance(m, RailModel)))


def load_template(folder: Path) -> HingeModel | RailModel:
    """Returns the template in one folder.

    Raises:
        TemplateError: if a mesh or the annotation is missing, unreadable or contradicts the other.
    """
    note = read_annotation(folder / ANNOTATION)
    static, dynamic = _end_surfaces(folder, "static"), _end_surfaces(folder, "dynamic")
    with _naming(folder):
        if isinstance(note, HingeNote):
            return _hinge_model(folder.name, note, static, dynamic)
        return _rail_model(folder.name, note, static, dynamic)


@contextmanager
def _naming(folder: Path) -> Iterator[None]:
    """Puts the template's folder before the message of an error inside."""
    try:
        yield
    except TemplateError as error:
        raise TemplateError(f"template {folder}: {error}; see docs/templates.md") from None


def _end_surfaces(folder: Path, end: str) -> tuple[Surface, ...]:
    """Returns the surfaces of `static.*` or `dynamic.*`, else of the node of that name in the folder's one GLB."""
    files = [folder / f"{end}{suffix}" for suffix in (*MESH_SUFFIXES, *_GLTF) if (folder / f"{end}{suffix}").is_file()]
    scenes = sorted(p for p in folder.iterdir() if p.suffix.lower() in _GLTF)
    try:
        if files:
            surfaces = _file_surfaces(files[0], folder)
        elif len(scenes) == 1:
            parts = read_gltf(scenes[0], LoadOptions(), ModelFiles(folder, _LIMITS)).parts
            surfaces = tuple(s for p in parts if p.source.name.lower() == end for s in p.surfaces)
        else:
            surfaces = ()
    except AssetError as error:
        raise TemplateError(f"template {folder}: {error}") from None
    if not any(len(s.mesh.faces) for s in surfaces):
        wanted = f"{end}.obj, .ply, .stl or .glb, or one GLB with a mesh node `{end}`"
        raise TemplateError(f"template {folder} lacks its {end} end: expected {wanted}; see docs/templates.md")
    return surfaces


def _file_surfaces(path: Path, folder: Path) -> tuple[Surface, ...]:
    files = ModelFiles(folder, _LIMITS)
    if path.suffix in _GLTF:
        return read_surfaces(path, files)
    return read_mesh_file(path, files, split=False).surfaces


def _hinge_model(
    template_id: str, note: HingeNote, static: tuple[Surface, ...], dynamic: tuple[Surface, ...]
) -> HingeModel:
    mechanism = MechanismClass(note.mechanism)
    T, (toward_static, toward_dynamic) = hinge_frame(note), hinge_normals(mechanism)
    ends = (
        _placed(static, T, snap_plane(note.static_snap, T, toward_static, "static_snap")),
        _placed(dynamic, T, snap_plane(note.dynamic_snap, T, toward_dynamic, "dynamic_snap")),
    )
    natural = HingeSize(*(note.unit * value for value in (note.length, note.leaf, note.thickness, note.radius)))
    placed = _centred_along_pin(ends)
    _check_hinge(mechanism, placed, natural)

    @lru_cache(maxsize=64)
    def build(size: HingeSize) -> HingeTemplate:
        across = min(size.leaf / natural.leaf, size.thickness / natural.thickness, size.radius / natural.radius)
        S = np.diag([across, across, size.length / natural.length, 1.0])
        built = HingeSize(size.length, *(across * v for v in (natural.leaf, natural.thickness, natural.radius)))
        static_end, dynamic_end = (end.transformed(S) for end in placed)
        return HingeTemplate(template_id, mechanism, static_end, dynamic_end, radians(note.range_deg), built)

    return HingeModel(template_id, note.title or template_id, mechanism, natural, build)


def _rail_model(
    template_id: str, note: RailNote, static: tuple[Surface, ...], dynamic: tuple[Surface, ...]
) -> RailModel:
    mechanism, T = MechanismClass(note.mechanism), rail_frame(note)
    placed = (
        _placed(static, T, snap_plane(note.static_snap, T, vec3(-1.0, 0.0, 0.0), "static_snap")),
        _placed(dynamic, T, snap_plane(note.dynamic_snap, T, vec3(1.0, 0.0, 0.0), "dynamic_snap")),
    )
    support = snap_plane(note.support_snap, T, vec3(0.0, 0.0, 1.0), "support_snap") if note.support_snap else None
    if (support is None) is (mechanism is MechanismClass.CORNER):
        raise TemplateError("`support_snap` must be given for class corner-mount, and for that alone")
    natural = RailSize(*(note.unit * value for value in (note.length, note.height, note.thickness)))
    _agree("`length`", natural.length, float(max(end.mesh.box.size[1] for end in placed)), "the longer mesh")
    _agree("`thickness`", natural.thickness, float(placed[1].snap.center[0]), "dynamic_snap's distance")

    @lru_cache(maxsize=64)
    def build(size: RailSize) -> RailTemplate:
        factors = [size.thickness / natural.thickness, size.length / natural.length, size.height / natural.height]
        S = np.diag([*factors, 1.0])
        static_end, dynamic_end = (end.transformed(S) for end in placed)
        carrier = None if support is None else support.transformed(S)
        travel = note.range_share * size.length
        return RailTemplate(template_id, mechanism, static_end, dynamic_end, travel, size, carrier)

    return RailModel(template_id, note.title or template_id, mechanism, natural, build)


def _placed(surfaces: tuple[Surface, ...], T: Mat4, snap: SnapPlane) -> TemplateEnd:
    """Returns an end whose meshes are mapped by T to where its snap plane already is."""
    return TemplateEnd(tuple(s.transformed(T) for s in surfaces), snap)


def _centred_along_pin(ends: Ends) -> Ends:
    """Returns both ends shifted along Z so that together they are centred on the origin."""
    low = min(float(end.mesh.box.low[2]) for end in ends)
    high = max(float(end.mesh.box.high[2]) for end in ends)
    T = np.eye(4)
    T[2, 3] = -(low + high) / 2
    return ends[0].transformed(T), ends[1].transformed(T)


def _check_hinge(mechanism: MechanismClass, ends: Ends, natural: HingeSize) -> None:
    boxes = [end.mesh.box for end in ends]
    _agree("`length`", natural.length, float(boxes[0].union(boxes[1]).size[2]), "the meshes' extent along the pin")
    flat = natural.thickness if mechanism is MechanismClass.C else natural.radius
    name = "`thickness`" if mechanism is MechanismClass.C else "`radius`"
    for end, side in zip(ends, ("static_snap", "dynamic_snap"), strict=True):
        _agree(name, flat, float(end.snap.center @ end.snap.normal), f"{side}'s distance from the pin")
    if natural.leaf <= natural.radius:
        raise TemplateError(f"`leaf` must exceed `radius`: got {natural.leaf:g} and {natural.radius:g} m")


def _agree(name: str, stated: float, measured: float, what: str) -> None:
    if abs(stated - measured) > _FIT * max(stated, measured):
        raise TemplateError(f"{name} must agree with {what} within 5 %: got {stated:g} m and {measured:g} m")
