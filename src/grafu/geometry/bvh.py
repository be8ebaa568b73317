"""A mesh as FCL's tree of triangles (BVH), built once for all that asks: for a mesh, its copies, and its equals.

To build one takes longer than most questions that are put to it. Large meshes are divided into blocks first (`blocks`).
"""

from dataclasses import field, replace
from itertools import count
from typing import final
from weakref import finalize

import fcl
import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, Mat4, Vec3
from grafu.geometry.components import repeated_faces
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.remembered import RememberedByContent
from grafu.geometry.transform import translation
from grafu.shapes import Int

_numbers = count()
_MANY = 100  # faces: below, looking for repeated ones costs more than it spares
_REMEMBERED = 150_000  # faces of BVHs kept by content: 75 MB
_SAME = 1e11  # of one metre: meshes whose corners lie alike to so small a step are the same


@final
@dataclass(frozen=True, slots=True)
class MeshTree:
    """A BVH, and for each face of its mesh the face that stands for it in the BVH (none: each stands for itself).

    Real furniture draws most faces twice, front and back; once is enough to be hit. `pose` is where the BVH stands when
    the mesh is at rest (none: where it was built).
    """

    bvh: fcl.BVHModel
    kept: Indices
    stand_in: Int[np.ndarray, " faces"] | None
    pose: Mat4 | None = None
    number: int = field(default_factory=_numbers.__next__)  # no other mesh ever gets the same

    def faces(self, hit: set[int]) -> set[int]:
        """Returns the mesh's faces that the BVH's faces stand for."""
        if self.stand_in is None:
            return hit
        return set(np.flatnonzero(np.isin(self.stand_in, self.kept[list(hit)])).tolist())


def next_number() -> int:
    """Returns a number that no other mesh ever gets."""
    return next(_numbers)


_models: dict[int, MeshTree] = {}
_by_content: RememberedByContent[tuple[MeshTree, Vec3]] = RememberedByContent(_REMEMBERED)


def model_of(mesh: TriangleMesh) -> MeshTree:
    """Returns the mesh's BVH, built once in the mesh's life."""
    key = id(mesh)
    if key not in _models:
        _models[key] = _known(mesh) if len(mesh.faces) else _built(mesh)
        finalize(mesh, _models.pop, key, None)
    return _models[key]


def _known(mesh: TriangleMesh) -> MeshTree:
    """Returns the BVH that was built of the same mesh lately, here or elsewhere, or else builds it."""
    origin = mesh.vertices[0]
    steps = np.round((mesh.vertices - origin) * _SAME).astype(np.int64)
    model, first = _by_content.of(lambda: (_built(mesh), origin), len(mesh.faces), steps, mesh.faces)
    shift = origin - first
    return replace(model, pose=translation(shift) if shift.any() else None, number=next(_numbers))


def share_shape(copy: TriangleMesh, original: TriangleMesh, T: Mat4) -> None:
    """Lets `copy`, which is `original` mapped by the rotation and shift T, be tested with the original's BVH.

    Building one takes longer than most tests: it spares as many as there are places where a thing is tried.
    """
    model = model_of(original)
    pose = T if model.pose is None else T @ model.pose
    if id(copy) not in _models:
        finalize(copy, _models.pop, id(copy), None)
    _models[id(copy)] = replace(model, pose=pose, number=next(_numbers))


def _built(mesh: TriangleMesh) -> MeshTree:
    faces = len(mesh.faces)
    stand_in = repeated_faces(mesh) if faces > _MANY else None
    kept = np.arange(faces) if stand_in is None else np.flatnonzero(stand_in == np.arange(faces))
    corners, is_used = mesh.faces[kept], np.zeros(len(mesh.vertices), dtype=bool)
    is_used[corners] = True  # FCL takes one vertex after the other: only those that it needs
    number = np.cumsum(is_used) - 1
    bvh = fcl.BVHModel()
    bvh.beginModel(int(is_used.sum()), len(kept))
    bvh.addSubModel(mesh.vertices[is_used], number[corners].tolist())
    bvh.endModel()
    return MeshTree(bvh, kept, stand_in)
