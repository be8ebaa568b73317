"""How far everything can be open at once without one link standing in another, and what meets at rest.

Each joint may open to its limit when it opens alone; a door and the drawer beside it may still be in each other's way.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.collision_shapes import CollisionShape, ShapeBody
from grafu.articulation.kinematics import link_poses, with_coupled
from grafu.articulation.sweep import JointValues, opening_stages
from grafu.geometry.arrays import Mat4
from grafu.geometry.budget import require_time

Shapes = Mapping[str, tuple[CollisionShape, ...]]
Pairs = tuple[tuple[str, str], ...]
_STEPS = 20  # a twentieth of a door's path is some 5 degrees, of a drawer's 2 cm


def met_at_rest(articulated: ArticulatedObject, shapes: Shapes) -> Pairs:
    """Returns the pairs of links whose shapes share a point at rest, in the order of `shapes`."""
    return _met(articulated, _bodies(shapes), {}, frozenset())


def near_at_rest(articulated: ArticulatedObject, shapes: Shapes) -> Pairs:
    """Returns the pairs of links of which the boxes around two shapes overlap at rest: all that could meet."""
    pairs = ((a.link, b.link) for a, b in _near(_bodies(shapes), link_poses(articulated, {})))
    return tuple(dict.fromkeys(pair for pair in pairs if pair[0] != pair[1]))


def open_together(articulated: ArticulatedObject, shapes: Shapes) -> JointValues:
    """Returns a value for each moving joint: its upper limit where the others leave room, else as much as they do.

    Joints open one after another in the order in which they may; who comes later gives way, and what is coupled moves
    together. What meets at rest may meet, and so may what a joint joins; shapes are in the object frame at rest.

    Raises:
        ArticulationError: if joints wait for one another.
    """
    bodies = _bodies(shapes)
    known = _met(articulated, bodies, {}, frozenset())
    allowed = frozenset(frozenset(pair) for pair in (*known, *((j.parent, j.child) for j in articulated.joints)))
    joints = {joint.id: joint for joint in articulated.free_joints}
    values = {joint.id: joint.limits.lower for joint in joints.values()}
    for name in (name for stage in opening_stages(articulated) for name in stage if name in joints):
        limits = joints[name].limits
        for step in range(_STEPS, 0, -1):
            wider = {**values, name: limits.lower + limits.range * step / _STEPS}
            if not _met(articulated, bodies, wider, allowed):
                values = wider
                break
    return with_coupled(articulated, values)


def _bodies(shapes: Shapes) -> list[ShapeBody]:
    return [ShapeBody(link, shape) for link, held in shapes.items() for shape in held]


def _met(
    articulated: ArticulatedObject, bodies: list[ShapeBody], values: JointValues, allowed: frozenset[frozenset[str]]
) -> Pairs:
    """Returns the pairs of links that meet with joints at these values, but for those that may."""
    if not bodies:
        return ()
    require_time()
    poses = link_poses(articulated, values)
    met: dict[tuple[str, str], None] = {}
    for a, b in _near(bodies, poses):
        pair = (a.link, b.link)
        if a.link == b.link or pair in met or frozenset(pair) in allowed:
            continue
        require_time()
        a.place(poses[a.link])
        b.place(poses[b.link])
        if a.meets(b):
            met[pair] = None
    return tuple(met)


def _near(bodies: list[ShapeBody], poses: Mapping[str, Mat4]) -> Iterator[tuple[ShapeBody, ShapeBody]]:
    """Yields the pairs of bodies whose bounds overlap, in order."""
    if not bodies:
        return
    low, high = np.stack([body.bounds_at(poses[body.link][None])[0] for body in bodies], axis=1)
    near = np.argwhere(np.all((low[:, None] <= high) & (low <= high[:, None]), axis=-1))
    yield from ((bodies[i], bodies[k]) for i, k in near if i < k)
