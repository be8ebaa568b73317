"""Where and how a gripper with two fingers takes hold of a link: a frame on the link's surface, and its sizes.

The frame is that of grippers in MoveIt and robosuite: z is the approach, from the hand into the piece; y is the closing
axis, along which the fingers move; x completes a right-handed frame and lies along the bar or edge that is held.
"""

from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import ArticulationError
from grafu.geometry.arrays import ArrayValue, Mat3, Mat4, Vec3, freeze_arrays
from grafu.geometry.axis import Axis
from grafu.geometry.box import OrientedBox
from grafu.geometry.transform import from_rotation

GraspKind = Literal["handle", "recess", "edge", "itself"]
FINGER_WIDTH = 0.02
"""A fingertip along the bar, metres."""
FINGER_THICKNESS = 0.01
"""A fingertip along the closing axis, metres."""
FINGER_REACH = 0.02
"""Farthest that a fingertip reaches past the surface point, metres: behind the middle of all usual bars."""
FINGER_GAP = 0.001
"""Between an open finger and what it will hold, metres."""
_RIGHT_ANGLE = 1e-6  # tolerance of dot products of unit vectors


@final
@dataclass(frozen=True, eq=False)
class GraspFrame(ArrayValue):
    """How a link is held, in the object frame at rest; metres.

    `position` lies on the surface of `part` (a visual of the link, or of one that it carries). `width` is what lies
    between the fingers, so a gripper must open a little wider; 0 where closed fingers enter a hollow, and pull at its
    wall towards +`closing`. `depth` is how far past `position`, along `approach`, both fingers have room, at most
    `FINGER_REACH`; 0 where they have none. `approach` and `closing` are perpendicular unit vectors.

    Raises:
        ArticulationError: if they are not, or a size is negative.
    """

    name: str
    link: str
    part: str
    kind: GraspKind
    position: Vec3
    approach: Vec3
    closing: Vec3
    width: float
    depth: float

    def __post_init__(self) -> None:
        freeze_arrays(self, "position", "approach", "closing", dtype=np.float64)
        lengths = (float(np.linalg.norm(self.approach)), float(np.linalg.norm(self.closing)))
        askew = abs(float(self.approach @ self.closing))
        if max(abs(lengths[0] - 1.0), abs(lengths[1] - 1.0), askew) > _RIGHT_ANGLE:
            raise ArticulationError(
                f"the grasp `{self.name}` needs perpendicular unit vectors: got {self.approach} and {self.closing}"
            )
        if not (self.width >= 0.0 and self.depth >= 0.0):
            raise ArticulationError(
                f"sizes of the grasp `{self.name}` must not be negative: got {self.width}, {self.depth}"
            )

    @property
    def rotation(self) -> Mat3:
        """The frame's axes in the object frame, as columns: x, y (closing), z (approach)."""
        return np.column_stack([np.cross(self.closing, self.approach), self.closing, self.approach])

    @property
    def T_object_grasp(self) -> Mat4:
        """Maps the frame's coordinates to the object frame at rest."""
        return from_rotation(self.rotation, np.asarray(self.position))

    @property
    def fingers(self) -> tuple[OrientedBox, ...]:
        """The two open fingertips beside what is held, past the surface point; none where they have no room."""
        if not self.depth or not self.width:
            return ()
        half = np.array([FINGER_WIDTH, FINGER_THICKNESS, self.depth]) / 2
        aside = self.width / 2 + FINGER_GAP + half[1]
        centers = (self.position + self.depth / 2 * self.approach + s * aside * self.closing for s in (-1.0, 1.0))
        return tuple(OrientedBox(center, half, self.rotation) for center in centers)

    def pulled(self, axis: Axis) -> float:
        """Returns the distance of the surface point from a joint's axis: the lever of a pull, metres."""
        return float(np.linalg.norm(self.position - axis.closest_point(np.asarray(self.position))))
