"""Whether a piece tips over: statics of the polygon on which it stands, with every joint closed and wide open.

What leans on a wall tips while it is closed. The polygon is around all points of collision shapes that touch the floor.
A pull at a grip, along the grip's own path, tips the piece about a side of the polygon where its moment is larger than
that of the weight. Friction does not help: a piece that slides before it tips is judged as if it were held at its feet.
"""

from collections.abc import Mapping
from math import inf
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.collision_shapes import CollisionShape, corners_of
from grafu.articulation.counterbalance import GRAVITY
from grafu.articulation.floor_clearance import carrying_links, floor_below
from grafu.articulation.grip_point import grip_point
from grafu.articulation.kinematics import link_poses
from grafu.articulation.mass import MassProperties
from grafu.articulation.sweep import all_open, values_before
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, Points, Vec3
from grafu.geometry.config_checks import require_positive
from grafu.geometry.transform import transform_points

_LEAST_ARM = 1e-9  # metres


@final
@dataclass(frozen=True, slots=True)
class StabilityConfig:
    """What a piece must bear; lengths in metres, forces in newtons.

    Raises:
        ValueError: if a number is not above 0.
    """

    on_floor: float = 0.012
    """What reaches no higher than this above the lowest point stands on the floor: feet are drawn up to a centimetre
    apart, and the piece leans until they meet it."""
    turning_pull: float = 20.0
    """The pull at a door's grip that must not tip the piece ..."""
    sliding_pull: float = 30.0
    """... and that at a drawer's."""
    least_side: float = 0.01
    """A polygon that is narrower holds nothing."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_STABILITY_CONFIG = StabilityConfig()


@final
@dataclass(frozen=True, slots=True)
class Stability:
    """How safely a piece stands, closed and with everything open; masses in kg, forces in newtons, lengths in metres.

    `margin` is the least that its centre of mass is inside the polygon on which it stands, negative outside;
    `closed_margin` is the same with every joint closed.
    `tipping_force` is the least pull at a grip that tips it, 0 where it tips by itself, infinite where none can;
    `tipping_joint` is that grip's (empty: none). `weight_needed` is the least mass, low down at the far side of the
    polygon, and `wall_force` the pull of a wall mount at its upper edge, with which it bears the usual pulls; 0: it
    does without.
    """

    mass: float
    margin: float
    closed_margin: float
    tipping_force: float
    tipping_joint: str
    weight_needed: float
    wall_force: float

    @property
    def is_safe(self) -> bool:
        """Whether it bears the usual pull at every grip with everything open."""
        return self.weight_needed == 0.0


@final
@dataclass(frozen=True, slots=True)
class _Pull:
    """A pull along a unit direction at a point; `usual` is its strength (N)."""

    joint: str
    point: Vec3
    direction: Vec3
    usual: float


def stability_of(
    articulated: ArticulatedObject,
    masses: Mapping[str, MassProperties],
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: StabilityConfig = DEFAULT_STABILITY_CONFIG,
) -> Stability | None:
    """Returns how safely a piece stands on a level floor with all joints closed, and with all at their upper limits.

    About each side of the polygon the worse of the two holds. Each grip is pulled where it is while its joint is
    closed, and where it is while that is open. `masses` and `shapes` are those of all links by id, object frame at
    rest. None: it has no width on which it could stand.
    """
    feet = standing_points(articulated, shapes, config)
    polygon = _polygon(feet, config.least_side)
    if polygon is None:
        return None
    total = sum(masses[link.id].mass for link in articulated.links)
    centers = [_center(masses, link_poses(articulated, values)) for values in ({}, all_open(articulated))]
    top = max(float(corners_of(shape)[:, 2].max()) for held in shapes.values() for shape in held)
    pulls = [pull for joint in articulated.free_joints for pull in _pulls(articulated, joint, config)]
    return _judged(polygon, float(feet[:, 2].min()), top, total, np.stack(centers), pulls)


def _center(masses: Mapping[str, MassProperties], poses: Mapping[str, Mat4]) -> Vec3:
    """Returns the centre of mass of the whole with links in these poses."""
    total = sum(held.mass for held in masses.values())
    moved = (held.mass * transform_points(poses[k], held.center[None])[0] for k, held in masses.items())
    return np.asarray(sum(moved, start=np.zeros(3)) / total)


def standing_points(
    articulated: ArticulatedObject,
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: StabilityConfig = DEFAULT_STABILITY_CONFIG,
) -> Points:
    """Returns the corners of all shapes that carry the piece on the floor, (n, 3), object frame at rest.

    A door that ends just above the floor carries nothing: where the root stands on it, moving links do not count.
    """
    corners = {link: [corners_of(shape) for shape in held] for link, held in shapes.items()}
    floor = floor_below(shapes)
    carry = carrying_links(articulated, shapes, floor) | {articulated.root}
    points = np.vstack([np.zeros((0, 3)), *(points for link in carry for points in corners[link])])
    return points[points[:, 2] <= floor + config.on_floor]


def _polygon(points: Points, least_side: float) -> np.ndarray | None:
    """Returns the corners (x, y) of the convex polygon around points, counter-clockwise; None: it has no width."""
    from scipy.spatial import ConvexHull, QhullError  # local: it takes 0.3 s to import, and a GLB alone needs no hull

    if len(points) < 3:
        return None
    try:
        hull = ConvexHull(points[:, :2])
    except QhullError:
        return None
    corners = points[hull.vertices, :2]
    normals = _normals(corners)
    width = min(float(np.ptp(corners @ normal)) for normal in normals)
    return corners if width >= least_side else None


def _normals(corners: np.ndarray) -> np.ndarray:
    """Returns the outward unit normals of the sides that begin at each corner."""
    along = np.roll(corners, -1, axis=0) - corners
    out = np.column_stack([along[:, 1], -along[:, 0]])
    return np.asarray(out / np.linalg.norm(out, axis=1)[:, None])


def _pulls(articulated: ArticulatedObject, joint: Joint, config: StabilityConfig) -> list[_Pull]:
    """Returns the pull at a joint's grip while it is closed, and while it is open."""
    if joint.limits.range <= 0:
        return []
    usual = config.turning_pull if joint.kind.turns else config.sliding_pull
    before = values_before(articulated, joint.id)
    others = {other.id: before[other.id] for other in articulated.free_joints}
    found = []
    for value in (joint.limits.lower, joint.limits.upper):
        grip = grip_point(articulated, joint, {**others, joint.id: value})
        if np.linalg.norm(grip.direction) > 0:
            found.append(_Pull(joint.id, grip.point, grip.direction, usual))
    return found


def _judged(
    polygon: np.ndarray, floor: float, top: float, mass: float, centers: Points, pulls: list[_Pull]
) -> Stability:
    weight, normals = GRAVITY * mass, _normals(polygon)
    apart = np.einsum("nk,nk->n", polygon, normals) - centers[:, :2] @ normals.T  # of each centre from each side
    inside = apart.min(axis=0)
    across = (polygon @ normals.T).max(axis=0) - (polygon @ normals.T).min(axis=0)
    least, which = (0.0, "") if inside.min() < 0 else (inf, "")
    lacking = -weight * inside
    for pull in pulls:
        moments = _moments(pull, polygon, normals, floor)
        tips = moments > _LEAST_ARM
        force = float((weight * inside[tips] / moments[tips]).min(initial=inf))
        if max(force, 0.0) < least:
            least, which = max(force, 0.0), pull.joint
        lacking = np.maximum(lacking, pull.usual * moments - weight * inside)
    lack = np.maximum(lacking, 0.0)
    needed, held = float((lack / (GRAVITY * across)).max()), float(lack.max()) / max(top - floor, _LEAST_ARM)
    return Stability(mass, float(inside.min()), float(apart[0].min()), least, which, needed, held)


def _moments(pull: _Pull, polygon: np.ndarray, normals: np.ndarray, floor: float) -> np.ndarray:
    """Returns the tipping moment about each side of the polygon for each newton of a pull (m)."""
    beyond = np.einsum("nk,nk->n", pull.point[:2] - polygon, normals)  # outside of each side, metres
    return np.asarray(normals @ pull.direction[:2] * (pull.point[2] - floor) - pull.direction[2] * beyond)
