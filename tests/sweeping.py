"""A plain judge of synthetic furniture: moves each part by its own true joint and counts what it runs into.

It is written on trimesh's collision manager, apart from the product's own sweep, so that the two check each other.
"""

from functools import lru_cache

import numpy as np
import trimesh

from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.geometry.arrays import Mat4
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType


def joint_motion(joint: AnnotatedJoint, value: float) -> Mat4:
    return joint.axis.rotation(value) if joint.type is JointType.REVOLUTE else joint.axis.shift(value)


def moving_bodies(asset: Asset, part_id: str) -> list[Part]:
    return [p for p in asset.parts if p.id == part_id or p.carried_by == part_id]


@lru_cache(maxsize=256)  # a part of furniture is asked for with each of its joints, and whether it is convex takes long
def solid(mesh: TriangleMesh) -> trimesh.Trimesh:
    return mesh.to_trimesh()


def manager(parts: list[Part]) -> trimesh.collision.CollisionManager:
    found = trimesh.collision.CollisionManager()
    for part in parts:
        found.add_object(part.id, solid(part.mesh))
    return found


def collisions(asset: Asset, part_id: str, values=None, ignored: frozenset[str] = frozenset()) -> dict[str, float]:
    """Returns the parts hit and the deepest penetration in metres, over joint values (default 12 from 3 % to full)."""
    joint = next(j for j in asset.joints if j.part == part_id)
    values = np.linspace(0.03, 1.0, 12) * joint.upper if values is None else values
    moving = moving_bodies(asset, part_id)
    still = [part for part in asset.parts if part not in moving and part.id not in ignored]
    body, others = manager(moving), manager(still)  # each mesh is prepared once for all poses
    names = {part.id for part in still}
    hit: dict[str, float] = {}
    for value in values:
        for part in moving:
            body.set_transform(part.id, joint_motion(joint, float(value)))
        _, contacts = others.in_collision_other(body, return_data=True)
        for contact in contacts:
            for name in contact.names & names:
                hit[name] = max(hit.get(name, 0.0), float(contact.depth))
    return hit
