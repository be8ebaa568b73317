"""The annotation file of a user's template or handle, and how its coordinates map to a template's frame.

It reads no meshes. `docs/templates.md` describes every field for the people who write such files.
"""

import json
from pathlib import Path
from typing import Annotated, Literal, final

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from grafu.asset.options import Limits
from grafu.asset.resources import ModelFiles
from grafu.errors import AssetError, TemplateError
from grafu.geometry.arrays import Mat4, Vec3, vec3
from grafu.geometry.transform import from_rotation, transform_points
from grafu.templates.template import HandleFamily, SnapPlane
from grafu.vocabulary import MechanismClass

_LIMITS = Limits(max_bytes=2**20)


def read_note(path: Path) -> str:
    """Returns the text of an annotation file.

    Raises:
        TemplateError: if it is missing, no regular file of its template's folder, too large, or not UTF-8.
    """
    try:
        return ModelFiles(path.parent, _LIMITS).read(path).decode("utf-8")
    except (AssetError, UnicodeDecodeError) as error:
        why = error if isinstance(error, AssetError) else f"{path} cannot be read as text (UnicodeDecodeError)"
        raise TemplateError(f"{why}: expected a JSON file") from None


Triple = tuple[float, float, float]
Positive = Annotated[float, Field(gt=0)]
_SQUARE = 0.02  # how far, as a cosine, directions may be off: square ones by one degree, parallel ones by eleven


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


@final
class AxisNote(_Strict):
    """A line in mesh coordinates: the pin, opening by the right-hand rule; or the direction that a drawer slides in."""

    point: Triple = (0.0, 0.0, 0.0)
    direction: Triple


@final
class PlaneNote(_Strict):
    """A snap plane in mesh coordinates: centre, normal towards the part, two half-extent vectors."""

    center: Triple
    normal: Triple
    u: Triple
    v: Triple


@final
class HingeNote(_Strict):
    """`template.json` of a hinge; lengths in mesh units, `unit` metres each."""

    kind: Literal["hinge"]
    mechanism: Literal["C", "F", "P"] = Field(alias="class")
    title: str = ""
    unit: Positive = 1.0
    axis: AxisNote
    opening: Triple
    static_snap: PlaneNote
    dynamic_snap: PlaneNote
    range_deg: Annotated[float, Field(gt=0, lt=360)]
    length: Positive
    leaf: Positive
    thickness: Positive
    radius: Positive


@final
class RailNote(_Strict):
    """`template.json` of a rail; lengths in mesh units, `unit` metres each."""

    kind: Literal["rail"]
    mechanism: Literal["centre-mount", "corner-mount"] = Field(alias="class")
    title: str = ""
    unit: Positive = 1.0
    axis: AxisNote
    static_snap: PlaneNote
    dynamic_snap: PlaneNote
    support_snap: PlaneNote | None = None
    range_share: Annotated[float, Field(gt=0, le=1)]
    length: Positive
    height: Positive
    thickness: Positive


Note = HingeNote | RailNote


@final
class _File(_Strict):
    template: Annotated[Note, Field(discriminator="kind")]


def read_annotation(path: Path) -> Note:
    """Returns a template's annotation.

    Raises:
        TemplateError: if the file cannot be read, is not JSON, or a field is missing, unknown or out of range.
    """
    try:
        text = read_note(path)
        return _File.model_validate_json(f'{{"template": {text}\n}}').template
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        where = ".".join(str(step) for step in first["loc"][2:]) or "the file"
        raise TemplateError(f"{path}: {where}: {first['msg']}; see docs/templates.md") from None


def hinge_frame(note: HingeNote) -> Mat4:
    """Returns T_template_mesh: scales to metres, the pin to +Z through the origin, the opening to +Y.

    Raises:
        TemplateError: if the opening is not square to the pin.
    """
    z, y = _unit(note.axis.direction, "axis.direction"), _unit(note.opening, "opening")
    if abs(float(y @ z)) > _SQUARE:
        raise TemplateError("`opening` must be square to `axis.direction` (where the moving part sets off to)")
    y = y - z * float(y @ z)
    return _frame(np.stack([np.cross(y, z), y, z]), np.array(note.axis.point), note.unit)


def rail_frame(note: RailNote) -> Mat4:
    """Returns T_template_mesh: scales to metres, the slide to -Y, the static snap plane's centre to the origin.

    Raises:
        TemplateError: if the static snap plane is not parallel to the slide.
    """
    y, x = -_unit(note.axis.direction, "axis.direction"), -_unit(note.static_snap.normal, "static_snap.normal")
    if abs(float(y @ x)) > _SQUARE:
        raise TemplateError(
            "`static_snap.normal` must be square to `axis.direction` (the direction in which the drawer slides out)"
        )
    x = x - y * float(x @ y)
    x /= np.linalg.norm(x)
    return _frame(np.stack([x, y, np.cross(x, y)]), np.array(note.static_snap.center), note.unit)


def _frame(R: np.ndarray, origin: Vec3, unit: float) -> Mat4:
    R = R / np.linalg.norm(R, axis=1, keepdims=True)
    return from_rotation(unit * R, -unit * (R @ origin))


def snap_plane(note: PlaneNote, T: Mat4, normal: Vec3, name: str) -> SnapPlane:
    """Returns a noted plane in the template's frame, made exactly square to `normal`, an axis of that frame.

    Raises:
        TemplateError: if the noted normal is more than eleven degrees off, or the rectangle has no extent.
    """
    found = T[:3, :3] @ _unit(note.normal, f"{name}.normal")
    found /= np.linalg.norm(found)
    if float(found @ normal) < 1 - _SQUARE:
        wanted, got = normal.astype(int).tolist(), np.round(found, 3).tolist()
        raise TemplateError(f"`{name}.normal` must be {wanted} in the template's frame (towards the part): got {got}")
    extents = np.abs(T[:3, :3] @ np.array([note.u, note.v]).T).sum(axis=1)
    axes = [k for k in range(3) if abs(normal[k]) < 0.5]
    if min(extents[axes]) < 1e-9:
        raise TemplateError(f"`{name}.u` and `{name}.v` must span a rectangle: got {list(note.u)} and {list(note.v)}")
    center = transform_points(T, np.array([note.center]))[0]
    return SnapPlane(center, normal, *(extents[k] * np.eye(3)[k] for k in axes))


def hinge_normals(mechanism: MechanismClass) -> tuple[Vec3, Vec3]:
    """Returns the normals of the static and the dynamic snap plane of a hinge class."""
    return {
        MechanismClass.C: (vec3(-1.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0)),
        MechanismClass.F: (vec3(0.0, -1.0, 0.0), vec3(0.0, -1.0, 0.0)),
        MechanismClass.P: (vec3(-1.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)),
    }[mechanism]


def _unit(direction: Triple, name: str) -> Vec3:
    vector = np.array(direction)
    length = float(np.linalg.norm(vector))
    if length < 1e-12:
        raise TemplateError(f"`{name}` must be a direction with a length: got {list(direction)}")
    return vector / length


@final
class HandleNote(BaseModel):
    """`template.json` of a handle; lengths in mesh units, `unit` metres each.

    `foot` is a point of the plane that lies on the front, `outwards` points away from the front, `along` along the
    handle's long side (up is square to both, so that `along` x `outwards` points down).
    """

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    kind: Literal["handle"]
    family: HandleFamily
    title: str = ""
    unit: Positive = 1.0
    foot: Triple = (0.0, 0.0, 0.0)
    outwards: Triple
    along: Triple
    longest: Positive | None = None
    turns: bool = True


def is_handle(path: Path) -> bool:
    """Whether a `template.json` states that it is of a handle; what cannot be read states nothing."""
    try:
        found = json.loads(read_note(path))
    except (TemplateError, ValueError, RecursionError):
        return False
    return isinstance(found, dict) and found.get("kind") == "handle"


def read_handle_note(path: Path) -> HandleNote:
    """Returns a handle's annotation.

    Raises:
        TemplateError: if the file cannot be read, is not JSON, or a field is missing, unknown or out of range.
    """
    try:
        return HandleNote.model_validate_json(read_note(path))
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        where = ".".join(str(step) for step in first["loc"]) or "the file"
        raise TemplateError(f"{path}: {where}: {first['msg']}; see docs/templates.md") from None


def handle_frame(note: HandleNote) -> Mat4:
    """Returns T_handle_mesh: scales to metres, the foot plane to y = 0, outwards to -Y, along to +X.

    Raises:
        TemplateError: if a direction has no length, or the two are not square to each other.
    """
    x, y = _unit(note.along, "along"), -_unit(note.outwards, "outwards")
    if abs(float(x @ y)) > _SQUARE:
        raise TemplateError("`along` must be square to `outwards` (the handle lies along the front)")
    x = x - y * float(x @ y)
    x /= np.linalg.norm(x)
    R = np.stack([x, y, np.cross(x, y)])
    return from_rotation(note.unit * R, -note.unit * (R @ np.array(note.foot)))
