"""The points on each part of a release: from .npy, else .ply, else from the part's box.

PLY files hold points or a mesh, text or binary.
"""

import io
from hashlib import blake2b
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.asset.options import Limits, Tally
from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import array_from, check_declared, library_call
from grafu.errors import UnreadableAsset
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sampling import PointCloud, sample_surface
from grafu.shapes import Float


def read_ply(data: bytes, where: str, tally: Tally | None = None) -> TriangleMesh | Points:
    """Returns the mesh in a PLY file, or its vertices where it has no faces.

    Raises:
        UnreadableAsset: if it is damaged, or states coordinates that are not finite.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    check_declared(data, "ply", where, Tally(_LIMITS) if tally is None else tally)
    import trimesh  # local: it takes a while to import, and most releases have .npy files

    with library_call(where, "PLY with points or a mesh; export it again"):
        loaded: Any = trimesh.load(io.BytesIO(data), file_type="ply", process=False)
        vertices = np.asarray(loaded.vertices, dtype=np.float64).reshape(-1, 3)
        faces = np.asarray(getattr(loaded, "faces", ()), dtype=np.int64).reshape(-1, 3)
    if not np.all(np.isfinite(vertices)) or (len(faces) and not 0 <= faces.min() <= faces.max() < len(vertices)):
        raise UnreadableAsset(f"{where} must hold finite points, and faces between them; export it again")
    return TriangleMesh(vertices, faces) if len(faces) else vertices


_LIMITS = Limits()


@final
class PointFolder:
    """The point files of one model; not a value. It remembers which parts had none.

    Points are drawn with a seed of their own for each part, so they do not depend on what is read when.
    """

    def __init__(self, folder: Path, count: int, seed: int) -> None:
        """Looks in `folder` for `<node>.npy` and `<node>.ply` and draws `count` points for each part."""
        self._folder, self._count, self._seed = folder, count, seed
        self.boxed: list[str] = []

    def points(self, node_id: str, box: Box) -> PointCloud:
        """Returns the points on a part; `box` stands in where there is no file.

        Raises:
            UnreadableAsset: if a file is damaged or holds no points in space.
            AssetTooLarge: if a file exceeds the limits.
        """
        digest = blake2b(f"{self._folder.name}/{node_id}".encode(), digest_size=8).digest()
        seed = (self._seed + int.from_bytes(digest, "little")) % 2**63
        found = self._read(node_id)
        if isinstance(found, TriangleMesh):
            return sample_surface(found, self._count, seed)
        if found is None or not len(found):
            self.boxed.append(node_id)
            return PointCloud(drawn_on_box(box, self._count, np.random.default_rng(seed)))
        return PointCloud(drawn_from(found, self._count, np.random.default_rng(seed)))

    def _read(self, node_id: str) -> TriangleMesh | Points | None:
        if Path(node_id).name != node_id:  # a node's name is no path: it leads to no file
            return None
        array, ply = self._folder / f"{node_id}.npy", self._folder / f"{node_id}.ply"
        if array.is_file():
            return read_npy(ModelFiles(self._folder, _LIMITS).read(array), str(array))
        return read_ply(ModelFiles(self._folder, _LIMITS).read(ply), str(ply)) if ply.is_file() else None


def read_npy(data: bytes, where: str) -> Points:
    """Returns the points in a .npy file.

    Raises:
        UnreadableAsset: if it is damaged, or not (M, 3) finite numbers.
    """
    with library_call(where, "points in a .npy file, float32 (M, 3)"):
        values = array_from(data)
    if values.dtype.kind not in "fiu" or values.ndim != 2 or values.shape[1] != 3 or not np.all(np.isfinite(values)):
        raise UnreadableAsset(f"{where} must hold finite points, float32 (M, 3): got {values.dtype} {values.shape}")
    return values.astype(np.float64)


def drawn_from(points: Points, count: int, rng: np.random.Generator) -> Float[np.ndarray, "count 3"]:
    """Returns `count` of the points: without repetition, or with it where there are fewer."""
    if len(points) == count:  # what we wrote is read as it was
        return points
    return points[rng.choice(len(points), count, replace=len(points) < count)]


def drawn_on_box(box: Box, count: int, rng: np.random.Generator) -> Points:
    """Returns `count` points spread evenly over the faces of a box; a flat box has its two broad faces."""
    size = box.size
    areas = np.array([size[1] * size[2], size[0] * size[2], size[0] * size[1]])
    ratios = areas / areas.sum() if areas.sum() > 0 else np.full(3, 1 / 3)
    axes = rng.choice(3, count, p=ratios)
    places = rng.random((count, 3))
    places[np.arange(count), axes] = rng.integers(0, 2, count)
    return box.low + places * size
