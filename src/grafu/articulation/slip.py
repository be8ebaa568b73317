"""What a link does beside its joint's motion where its true guide is a linkage: small shifts, shown and not simulated.

A door on concealed hinges turns and shifts at once. Simulators get one revolute joint; GLB, .blend, pages and pictures
add the shift. It changes no joint.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import ArticulationError
from grafu.geometry.arrays import ArrayValue, Scalars, Vec3, freeze_arrays
from grafu.shapes import Float


@final
@dataclass(frozen=True, eq=False, slots=True)
class Slip(ArrayValue):
    """Shifts, (n, 3) in metres, of a joint's child in its parent's frame at increasing `values`; none at rest.

    In between, shifts are interpolated.

    Raises:
        ArticulationError: if there are fewer than two values, they do not increase from 0, or the first shift is not 0.
    """

    values: Scalars
    shifts: Float[np.ndarray, "n 3"]

    def __post_init__(self) -> None:
        freeze_arrays(self)
        values, shifts = self.values, self.shifts
        if len(values) < 2 or values[0] != 0 or not np.all(np.diff(values) > 0):
            raise ArticulationError(f"a slip needs two values or more that increase from 0: got {values}")
        if np.any(shifts[0]) or not np.all(np.isfinite(shifts)):
            raise ArticulationError(f"a slip begins with none and is finite: got {shifts}")

    def shifts_at(self, values: Scalars) -> Float[np.ndarray, "k 3"]:
        """Returns the shifts at values of the joint, one per row; beyond the last value they stay as they are."""
        return np.column_stack([np.interp(values, self.values, self.shifts[:, k]) for k in range(3)])

    def largest(self, upper: float) -> float:
        """Returns the length of the largest shift up to a value of the joint, metres."""
        values = np.append(self.values[self.values < upper], upper)
        return float(np.linalg.norm(self.shifts_at(values), axis=1).max())

    def shift(self, value: float) -> Vec3:
        """Returns the shift at one value of the joint."""
        return np.asarray(self.shifts_at(np.array([value]))[0])
