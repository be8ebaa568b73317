"""Hardware that turns on its own pin as a joint moves: the arms of a concealed hinge, the two halves of a stay.

Such a piece is no body of its own: it weighs little, collides with nothing and closes a loop, which trees of links
cannot have. It is only shown to move. It changes no joint.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import ArticulationError
from grafu.geometry.arrays import ArrayValue, Mat4, Scalars, freeze_arrays
from grafu.geometry.axis import Axis


@final
@dataclass(frozen=True, eq=False, slots=True)
class Swing(ArrayValue):
    """How a piece turns against the link that holds it: by `angles` (radians) about `axis` (object frame at rest).

    It does so as the joint above the link `moving` passes through `values`, from 0 up; in between, angles are
    interpolated. At rest the angle is 0.

    Raises:
        ArticulationError: if there are fewer than two values, they do not increase from 0, or an angle is missing.
    """

    moving: str
    axis: Axis
    values: Scalars
    angles: Scalars

    def __post_init__(self) -> None:
        freeze_arrays(self)
        values, angles = self.values, self.angles
        if len(values) != len(angles) or len(values) < 2 or not np.all(np.isfinite([values, angles])):
            raise ArticulationError(f"a swing needs two values or more, an angle for each: got {values}, {angles}")
        if values[0] != 0 or angles[0] != 0 or not np.all(np.diff(values) > 0):
            raise ArticulationError(f"a swing begins at 0 and its values increase: got {values}, {angles}")

    def angles_at(self, values: Scalars) -> Scalars:
        """Returns the angles in radians at values of the joint; beyond the last value it stays as it is."""
        return np.asarray(np.interp(values, self.values, self.angles))

    def motion(self, value: float) -> Mat4:
        """Returns the 4x4 motion from rest, against the link that holds the piece, at a value of the joint."""
        return self.axis.rotation(float(np.interp(value, self.values, self.angles)))
