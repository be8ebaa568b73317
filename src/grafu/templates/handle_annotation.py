"""The annotation file of a user's handle, and how its coordinates map to a handle's frame. It reads no meshes."""

import json
from pathlib import Path
from typing import Annotated, Literal, final

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from grafu.errors import TemplateError
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.transform import from_rotation
from grafu.templates.handle import HandleFamily
from grafu.templates.note_files import read_note

Triple = tuple[float, float, float]
Positive = Annotated[float, Field(gt=0)]
_SQUARE = 0.02  # how far, as a cosine, the two directions may be from square: one degree


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
    """Whether a `template.json` says that it is of a handle; what cannot be read says nothing."""
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


def _unit(direction: Triple, name: str) -> Vec3:
    vector = np.array(direction)
    length = float(np.linalg.norm(vector))
    if length < 1e-12:
        raise TemplateError(f"`{name}` must be a direction with a length: got {list(direction)}")
    return vector / length
