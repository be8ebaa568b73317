"""Triangles with attributes split by planes, one plane each. It knows no solids."""

import numpy as np

NOTHING = 1e-7
"""Metres: what is shorter counts as nothing, and a corner nearer to a plane as lying on it."""


def split_by_planes(
    triangles: np.ndarray, owner: np.ndarray, planes: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Splits triangles (rows of corner attributes) by a plane each: inside, its owners, outside, its owners."""
    side = np.einsum("ncd,nd->nc", triangles[:, :, :3], planes[:, :3]) - planes[:, 3:]
    side = np.where(np.abs(side) < NOTHING, 0.0, side)
    all_in, all_out = np.all(side <= 0, axis=1), np.all(side >= 0, axis=1)
    mixed = ~(all_in | all_out)
    # Coplanar triangles count as outside: faces that merely lie on the solid's border stay.
    all_in &= ~all_out
    inside, outside = [triangles[all_in]], [triangles[all_out]]
    in_owner, out_owner = [owner[all_in]], [owner[all_out]]
    for positive in (True, False):
        lone = (side > 0) if positive else (side < 0)
        pick = mixed & (lone.sum(axis=1) == 1)
        if not positive:
            pick &= (side > 0).sum(axis=1) != 1
        single, pair = _cut_corner(triangles[pick], side[pick], lone[pick])
        lone_side, other_side = (outside, inside) if positive else (inside, outside)
        lone_owner, other_owner = (out_owner, in_owner) if positive else (in_owner, out_owner)
        lone_side.append(single)
        lone_owner.append(owner[pick])
        other_side.append(pair)
        other_owner.append(np.concatenate([owner[pick], owner[pick]]))
    return np.concatenate(inside), np.concatenate(in_owner), np.concatenate(outside), np.concatenate(out_owner)


def _cut_corner(triangles: np.ndarray, side: np.ndarray, lone: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cuts the one corner marked in `lone` off each triangle: the corner piece, and the rest as two triangles."""
    first = np.argmax(lone, axis=1)
    order = (first[:, None] + np.arange(3)) % 3
    t = np.take_along_axis(triangles, order[:, :, None], axis=1)
    s = np.take_along_axis(side, order, axis=1)
    ab = t[:, 0] + (t[:, 1] - t[:, 0]) * (s[:, 0] / (s[:, 0] - s[:, 1]))[:, None]
    ac = t[:, 0] + (t[:, 2] - t[:, 0]) * (s[:, 0] / (s[:, 0] - s[:, 2]))[:, None]
    single = np.stack([t[:, 0], ab, ac], axis=1)
    pair = np.concatenate([np.stack([ab, t[:, 1], t[:, 2]], axis=1), np.stack([ab, t[:, 2], ac], axis=1)])
    return single, pair
