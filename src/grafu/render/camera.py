"""A pinhole camera: where it stands, what it sees, how it is moved to see a whole box. It draws nothing."""

from math import cos, radians, sin, tan
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Vec3, freeze_arrays, vec3
from grafu.geometry.box import Box
from grafu.shapes import Float

Directions = Float[np.ndarray, "n 3"]


@final
@dataclass(frozen=True, eq=False, slots=True)
class Camera(ArrayValue):
    """A pinhole at `eye` (metres) that looks at `target` with +Z up; `fov` is the vertical angle of view, radians.

    Raises:
        ValueError: if eye and target coincide or lie on one vertical, or the angle is not in (0, pi).
    """

    eye: Vec3
    target: Vec3
    fov: float = radians(28)

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)
        if not 0 < self.fov < np.pi:
            raise ValueError(f"`Camera.fov` must be in (0, pi) radians: got {self.fov}")
        if np.linalg.norm((self.target - self.eye)[:2]) < 1e-12:
            raise ValueError(f"`Camera` must not look straight up or down: got eye {self.eye}, target {self.target}")

    @property
    def rotation(self) -> Mat3:
        """The camera's axes in the object frame as columns: right, down, forward."""
        forward = (self.target - self.eye) / np.linalg.norm(self.target - self.eye)
        right = np.cross(forward, vec3(0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        return np.stack([right, np.cross(forward, right), forward], axis=1)

    def rays(self, width: int, height: int) -> Directions:
        """Returns a unit direction through the middle of each pixel, row by row from the top left."""
        half = tan(self.fov / 2)
        x = (np.arange(width, dtype=np.float32) + 0.5 - width / 2) * (2 * half / height)
        y = (np.arange(height, dtype=np.float32) + 0.5 - height / 2) * (2 * half / height)
        right, down, forward = self.rotation.T.astype(np.float32)
        grid = (x[:, None] * right + forward)[None] + (y[:, None] * down)[:, None]
        grid /= np.sqrt(1 + x[None, :] ** 2 + y[:, None] ** 2)[..., None]
        return grid.reshape(-1, 3)


def three_quarter_view(
    box: Box, aspect: float = 4 / 3, azimuth: float = radians(-32), elevation: float = radians(18), margin: float = 1.06
) -> Camera:
    """Returns a camera that sees a whole box from the front (-Y), turned aside and raised.

    `azimuth` is radians from straight ahead, negative towards -X; `elevation` radians above the horizon, `aspect` the
    picture's width over its height, `margin` how much larger than the box the view is.
    """
    away = vec3(sin(azimuth) * cos(elevation), -cos(azimuth) * cos(elevation), sin(elevation))
    unit = Camera(box.center + away, box.center)
    half_y = tan(unit.fov / 2) / margin
    # A corner at (right, down, forward) from the centre is seen from distance d if |right| <= half (d + forward).
    right, down, forward = (np.asarray(box.corners() - box.center) @ unit.rotation).T
    distances = np.maximum(np.abs(right) / (half_y * aspect), np.abs(down) / half_y) - forward
    distance = max(float(distances.max()), 1e-6)
    return Camera(box.center + away * distance, box.center, unit.fov)
