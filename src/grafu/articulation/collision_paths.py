"""Where collision shapes are while one joint moves, and which of them come near each other: by their bounds alone."""

from collections.abc import Iterable, Mapping
from typing import final

import numpy as np

from grafu.articulation.collision_shapes import ShapeBody
from grafu.articulation.kinematics import REST
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4


@final
@dataclass(frozen=True, slots=True)
class JointPath:
    """One joint's path from rest to full.

    `Ts_object_carried` are the poses of each link that moves with it, (poses, 4, 4); `T_object_still` is where every
    other link stands meanwhile, links at rest left out; `Ts_object_coupled` are the poses of links that it does not
    carry and that move as well, for they are coupled.
    """

    Ts_object_carried: Mapping[str, np.ndarray]
    T_object_still: Mapping[str, Mat4]
    Ts_object_coupled: Mapping[str, np.ndarray]

    def pose_of_other(self, link: str, pose: int) -> Mat4:
        """Returns the pose of a link that is not carried."""
        if link in self.Ts_object_coupled:
            return np.asarray(self.Ts_object_coupled[link][pose])
        return self.T_object_still.get(link, REST)

    def bounds_of_other(self, body: ShapeBody) -> np.ndarray:
        """Returns the bounds of a body that is not carried, (2, 3), or in each pose, (poses, 2, 3)."""
        if body.link in self.Ts_object_coupled:
            return body.bounds_at(self.Ts_object_coupled[body.link])
        T = self.T_object_still.get(body.link)
        return body.bounds if T is None else body.bounds_at(T[None])[0]


@final
@dataclass(frozen=True, eq=False, slots=True)
class ShapeRows:
    """All bodies, in order, with their bounds at rest, (bodies, 2, 3), and the rows of each link."""

    bodies: list[ShapeBody]
    bounds: np.ndarray
    of_link: Mapping[str, list[int]]

    @classmethod
    def of(cls, bodies: list[ShapeBody]) -> "ShapeRows":
        """Returns the rows of some bodies."""
        of_link: dict[str, list[int]] = {}
        for row, body in enumerate(bodies):
            of_link.setdefault(body.link, []).append(row)
        return cls(bodies, np.reshape([body.bounds for body in bodies], (-1, 2, 3)), of_link)

    def near(self, path: JointPath) -> tuple[list[ShapeBody], list[ShapeBody], np.ndarray]:
        """Returns the bodies that move, those that may be met, and the rows (pose, moving body, other body).

        The rows are those in which the bounds of the two overlap, in that order.
        """
        none = np.zeros((0, 3), dtype=np.int64)
        moving = [self.bodies[row] for row in sorted(self._rows(path.Ts_object_carried))]
        if not moving:
            return moving, [], none
        a = np.stack([body.bounds_at(path.Ts_object_carried[body.link]) for body in moving], axis=1)[:, :, None]
        low, high = a[..., 0, :].min(axis=(0, 1, 2)), a[..., 1, :].max(axis=(0, 1, 2))  # of the whole motion
        may = np.all((self.bounds[:, 0] <= high) & (self.bounds[:, 1] >= low), axis=1)
        may[self._rows((*path.T_object_still, *path.Ts_object_coupled))] = True  # they are elsewhere than at rest
        may[self._rows(path.Ts_object_carried)] = False
        still = [self.bodies[row] for row in np.flatnonzero(may).tolist()]
        others = [path.bounds_of_other(body) for body in still]
        ends = [(at[..., 0, :].min(axis=0), at[..., 1, :].max(axis=0)) if at.ndim > 2 else at for at in others]
        swept = np.reshape(ends, (-1, 2, 3))
        near = np.flatnonzero(np.all((swept[:, 0] <= high) & (swept[:, 1] >= low), axis=1))
        if not len(near):
            return moving, still, none
        b = np.stack([np.broadcast_to(others[k], (len(a), 2, 3)) for k in near], axis=1)[:, None]
        rows = np.argwhere(np.all((a[..., 0, :] <= b[..., 1, :]) & (b[..., 0, :] <= a[..., 1, :]), axis=-1))
        rows[:, 2] = near[rows[:, 2]]
        return moving, still, rows

    def _rows(self, links: Iterable[str]) -> list[int]:
        return [row for link in links for row in self.of_link.get(link, ())]
