"""Groups of models that are nearly the same, found among the nearest neighbours of each: never every pair.

Two models are near-duplicates if their descriptors lie within a radius; a group is what such pairs connect.
"""

from collections.abc import Sequence
from hashlib import blake2b

import numpy as np

from grafu.dataset.config import DescriptorConfig
from grafu.shapes import Float32, Int

Descriptors = Float32[np.ndarray, "models numbers"]


def near_duplicates(
    descriptors: Descriptors, config: DescriptorConfig = DescriptorConfig()
) -> Int[np.ndarray, " models"]:
    """Returns the number of each model's group, from 0; models are the rows, and their order does not count.

    The memory grows with the number of models, not with that of near-duplicates.
    """
    if not len(descriptors):
        return np.zeros(0, dtype=np.int64)
    distinct, which = np.unique(descriptors, axis=0, return_inverse=True)
    return _connected(distinct, config)[which.reshape(-1)]


def group_names(descriptors: Descriptors, groups: Sequence[int] | Int[np.ndarray, " models"]) -> list[str]:
    """Returns the name of each model's group, a digest of the least descriptor in it: names and order do not count."""
    least: dict[int, bytes] = {}
    for row, group in zip(descriptors, groups, strict=True):
        data = row.astype("<f4").tobytes()
        least[int(group)] = min(least.get(int(group), data), data)
    digests = {group: blake2b(data, digest_size=8).hexdigest() for group, data in least.items()}
    return [digests[int(group)] for group in groups]


def _connected(points: Descriptors, config: DescriptorConfig) -> Int[np.ndarray, " models"]:
    """Returns the group of each point: from a point on, all within the radius that have none yet, and so on."""
    from scipy.spatial import cKDTree

    short = _shortened(points, config.tree_axes)
    tree, groups = cKDTree(short), np.full(len(points), -1)
    count = 0
    for start in range(len(points)):
        waiting = [start] if groups[start] < 0 else []
        groups[waiting] = count
        count += len(waiting)
        while waiting:
            here = waiting.pop()
            near = np.array(tree.query_ball_point(short[here], config.radius * (1 + 1e-5)), dtype=np.int64)
            near = near[groups[near] < 0]
            near = near[np.linalg.norm(points[near] - points[here], axis=1) <= config.radius]
            groups[near] = groups[here]
            waiting += near.tolist()
    return groups


def _shortened(points: Descriptors, axes: int) -> Float32[np.ndarray, "models axes"]:
    """Returns the points along the axes on which they spread most: no distance grows, so no neighbour is lost."""
    centred = points - points.mean(axis=0)
    _, directions = np.linalg.eigh((centred.T @ centred).astype(np.float64))
    return np.asarray(centred @ directions[:, -axes:], dtype=np.float32)
