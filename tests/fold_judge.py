"""A judge of folding doors: where the inner leaf's free edge goes, what cuts into what, what hardware is loose."""

from itertools import combinations

import numpy as np

import grafu
from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual, VisualRole
from grafu.articulation.kinematics import link_poses
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.swept_body import SweptBody
from grafu.scene.border import part_axes

TOUCH = 0.0005  # metres on each side by which a mesh is made smaller before it may cut into another


def opened(made: ArticulatedObject, ratio: float) -> dict[str, float]:
    """Values of all joints, each so far open; those that follow are left out."""
    return {j.id: ratio * j.limits.upper for j in made.joints if j.coupling is None and j.limits is not None}


def pairs_of(made: ArticulatedObject) -> list[tuple[Joint, Joint]]:
    """The joints of the leaves that fold, the outer one first."""
    by_id = {joint.id: joint for joint in made.joints}
    return [(by_id[j.coupling.leader], j) for j in made.joints if j.coupling is not None]


def along_leaf(made: ArticulatedObject, inner: Joint, direction: np.ndarray) -> np.ndarray:
    """The level unit direction along the inner leaf, closed, that is nearest to one."""
    leaf = next(v for v in made.link(inner.child).visuals if v.name == inner.child).mesh
    axes = part_axes(leaf)
    nearest = max(range(2), key=lambda k: abs(float(axes[:, k] @ direction)))
    return np.asarray(axes[:, nearest] * np.sign(float(axes[:, nearest] @ direction)))


def guide_of(made: ArticulatedObject, outer: Joint, inner: Joint) -> np.ndarray:
    """The point of the inner leaf that mirrors the outer leaf's pivot across the seam, closed."""
    pivot, hinge = np.asarray(outer.axis.point), np.asarray(inner.axis.point)
    side = along_leaf(made, inner, hinge - pivot)
    return np.asarray(pivot + 2 * float((hinge - pivot) @ side) * side)


def off_plane(made: ArticulatedObject, outer: Joint, inner: Joint, point: np.ndarray, poses: int = 25) -> float:
    """How far a point of the inner leaf leaves the plane that it lies in, closed, metres: level, across the opening."""
    side = along_leaf(made, inner, np.asarray(inner.axis.point - outer.axis.point))
    across = np.cross(side, (0.0, 0.0, 1.0))
    start, most = np.append(point, 1.0), 0.0
    for value in np.linspace(0.0, outer.limits.upper, poses):
        moved = link_poses(made, {outer.id: float(value)})[inner.child] @ start
        most = max(most, abs(float((moved[:3] - point) @ across)))
    return most


def free_edge(made: ArticulatedObject, outer: Joint, inner: Joint) -> np.ndarray:
    """The point of the inner leaf's free edge at the depth of the outer leaf's pivot, closed."""
    guide = guide_of(made, outer, inner)
    side = along_leaf(made, inner, guide - np.asarray(outer.axis.point))
    leaf = next(v for v in made.link(inner.child).visuals if v.name == inner.child).mesh
    return guide + side * (float((leaf.vertices @ side).max()) - float(guide @ side))


def cuts(made: ArticulatedObject, values: dict[str, float], leave_out: frozenset[str] = frozenset()) -> set:
    """The pairs of visuals of different links that cut into one another by more than a millimetre.

    The two ends of one hinge or pivot have one pin, and a guide runs in its own track.
    """
    poses = link_poses(made, values)
    found = [(link.id, v) for link in made.links for v in link.visuals if v.name not in leave_out]
    bodies = [(link, v, MeshCollider(v.mesh).posed(poses[link])) for link, v in found]
    cutting = set()
    for (link, one, collider), (other, two, its) in combinations(bodies, 2):
        if link == other or is_one_hinge(one, two) or not collider.box.overlaps(its.box):
            continue
        swept = SweptBody(one.mesh, TOUCH)
        swept.place(poses[link])
        back = SweptBody(two.mesh, TOUCH)
        back.place(poses[other])
        if swept.penetrates(its) and back.penetrates(collider):
            cutting.add((one.name, two.name))
    return cutting


def is_one_hinge(one: Visual, two: Visual) -> bool:
    """Whether two pieces are the ends of one hinge, pivot or track."""
    if VisualRole.PART in (one.role, two.role):
        return False
    stems = [v.name.removesuffix("_static").removesuffix("_dynamic").partition("_")[2] for v in (one, two)]
    return stems[0].removesuffix("_plate") == stems[1].removesuffix("_plate")


def cutting_over_sweep(made: ArticulatedObject, poses: int = 9) -> set:
    """All that cuts in over the sweep and not at rest already."""
    at_rest = cuts(made, opened(made, 0.0))
    found = set()
    for ratio in np.linspace(0.0, 1.0, poses)[1:]:
        found |= cuts(made, opened(made, float(ratio)))
    return found - at_rest


def loose(result: grafu.Result, within: float = 0.0015) -> set[str]:
    """The hardware that touches no part and no other hardware of its own link."""
    found = set()
    for link in result.object.links:
        for one in link.visuals:
            if one.role is not VisualRole.HARDWARE:
                continue
            others = [v for v in link.visuals if v is not one and v.mesh.box.overlaps(one.mesh.box, within)]
            if not any(MeshCollider(one.mesh).is_within(within, MeshCollider(v.mesh)) for v in others):
                found.add(one.name)
    return found
