"""An articulated object as Particulate's evaluation writes a prediction: `eval/pred.npz` and `eval/pred.obj`.

The mesh stays as it is given, all links' faces in a row; the motions are in the normalised frame that `--up_dir`
makes of it. Looks, names and what must open first it cannot say.
"""

import io
from dataclasses import field
from typing import Final, Literal, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.asset.foreign.particulate import UP_ROTATIONS, normalisation
from grafu.dataclass import dataclass
from grafu.errors import ExportError
from grafu.export.files import ExportFiles, not_coupled
from grafu.geometry.arrays import ArrayValue, Mat4, frozen_array
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import is_mirror, scale_of

Direction = Literal["X", "-X", "Y", "-Y", "Z", "-Z"]


@final
@dataclass(frozen=True, eq=False)
class ParticulateConfig(ArrayValue):
    """`T_file_object` maps the object frame to the coordinates of `pred.obj`; `up_dir` counts in these.

    Raises:
        ExportError: if `T_file_object` is a mirror image, or `up_dir` no direction.
    """

    up_dir: Direction = "Z"
    T_file_object: Mat4 = field(default_factory=lambda: np.eye(4))

    def __post_init__(self) -> None:
        object.__setattr__(self, "T_file_object", frozen_array(self.T_file_object))
        if self.up_dir not in UP_ROTATIONS or is_mirror(np.asarray(self.T_file_object)):
            raise ExportError(
                f"`up_dir` must be one of {', '.join(UP_ROTATIONS)}, and `T_file_object` no mirror image: got {self}"
            )


DEFAULT_PARTICULATE_CONFIG: Final = ParticulateConfig()


def export_particulate(
    articulated: ArticulatedObject, config: ParticulateConfig = DEFAULT_PARTICULATE_CONFIG
) -> ExportFiles:
    """Returns `eval/pred.npz` and `eval/pred.obj`; links without faces are left out.

    Raises:
        ExportError: if no link has faces.
    """
    T = np.asarray(config.T_file_object)
    links = [link for link in articulated.links_from_root if len(link.mesh.faces)]
    if not links:
        raise ExportError("Particulate's files need faces: got an object without any")
    meshes = [link.mesh.transformed(T) for link in links]
    whole = merge_meshes(meshes)
    arrays = _arrays(articulated, [link.id for link in links], normalisation(whole.box, config.up_dir) @ T)
    arrays["face_part_ids"] = np.repeat(np.arange(len(links)), [len(mesh.faces) for mesh in meshes])
    stored = io.BytesIO()
    np.savez(stored, **arrays)  # type: ignore[arg-type]
    files = {"eval/pred.npz": stored.getvalue(), "eval/pred.obj": _obj(whole)}
    return ExportFiles(files, notes=not_coupled(articulated, "eval/pred.npz"))


def _arrays(articulated: ArticulatedObject, links: list[str], T: Mat4) -> dict[str, np.ndarray]:
    """Returns the motions of the links by key, mapped by T, as single precision: networks give no more."""
    count = len(links)
    arrays = {
        "is_part_revolute": np.zeros(count, dtype=bool),
        "is_part_prismatic": np.zeros(count, dtype=bool),
        "revolute_plucker": np.zeros((count, 6), np.float32),
        "revolute_range": np.zeros((count, 2), np.float32),
        "prismatic_axis": np.zeros((count, 3), np.float32),
        "prismatic_range": np.zeros((count, 2), np.float32),
    }
    pairs = []
    for k, link in enumerate(links):
        joint = articulated.joint_of.get(link)
        if joint is None:
            continue
        pairs += [(links.index(parent), k) for parent in [_parent(articulated, link, links)] if parent]
        if joint.kind.moves:
            _say(joint, k, arrays, T)
    arrays["motion_hierarchy"] = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    return arrays


def _parent(articulated: ArticulatedObject, link: str, links: list[str]) -> str | None:
    """Returns the nearest link above that is written."""
    joint = articulated.joint_of.get(link)
    while joint is not None and joint.parent not in links:
        joint = articulated.joint_of.get(joint.parent)
    return None if joint is None else joint.parent


def _say(joint: Joint, part: int, arrays: dict[str, np.ndarray], T: Mat4) -> None:
    limits = np.array([joint.limits.lower, joint.limits.upper])
    axis, word = joint.axis.transformed(T), joint.kind.word("particulate")
    arrays[f"is_part_{word}"][part] = True
    arrays[f"{word}_range"][part] = limits * joint.kind.length_scale(scale_of(T))
    if joint.kind.turns:
        arrays[f"{word}_plucker"][part] = [*axis.direction, *np.cross(axis.direction, axis.point)]  # m = l x p
    else:
        arrays[f"{word}_axis"][part] = axis.direction


def _obj(mesh: TriangleMesh) -> bytes:
    points = ("v %.10g %.10g %.10g\n" * len(mesh.vertices)) % tuple(mesh.vertices.ravel().tolist())
    faces = ("f %d %d %d\n" * len(mesh.faces)) % tuple((mesh.faces + 1).ravel().tolist())
    return (points + faces).encode()
