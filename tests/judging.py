"""A judge of realized furniture that shares nothing with realization's own checks.

Parts are swept with trimesh's collision manager (`sweeping`); how deep solids cut into one another is measured by
boolean intersections (manifold3d), which see what lies wholly inside, too.
"""

from functools import cache

import manifold3d
import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual, VisualRole
from grafu.asset.part import AnnotatedJoint, Asset, Part, PartSource
from grafu.geometry.arrays import Mat4
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.realize import Realized, realize
from grafu.synth.samples import KINDS
from grafu.templates.gallery import builtin_gallery
from sweeping import collisions

GALLERY = builtin_gallery()


def realized(asset: Asset, config: RealizationConfig = RealizationConfig()) -> Realized:
    return realize(plan_from_annotation(asset), asset, GALLERY, config)


@cache
def made_kind(name: str) -> Asset:
    return KINDS[name]()


@cache
def realized_kind(name: str) -> Realized:
    return realized(made_kind(name))


def installed(result: Realized) -> dict:
    """The report's installed joints by the part that moves."""
    return {outcome.moving: outcome for outcome in result.report.installed}


def true_joints(asset: Asset) -> dict[str, AnnotatedJoint]:
    return {joint.part: joint for joint in asset.joints}


def hardware(result: Realized, moving_id: str) -> tuple[list[Visual], list[Visual]]:
    """The hardware of one moving body: what moves with it, and what is static."""
    obj = result.object
    moving = [v for v in obj.link(moving_id).visuals if v.role is VisualRole.HARDWARE]
    # static pieces are found by the moving body's name, whole words only: door_1 is not door_10
    still = [v for v in obj.link(obj.root).visuals if v.role is VisualRole.HARDWARE and f"_{moving_id}_" in v.name]
    return moving, still


def swept_collisions(obj: ArticulatedObject, joint: Joint, poses: int = 50) -> dict[str, float]:
    """The static parts that a moving body runs into, with the contact's depth in metres."""
    asset = _without_hardware(obj)
    others = frozenset(
        v.name for link in obj.links if link.id not in (obj.root, joint.child) for v in link.visuals
    )  # other moving bodies: `after` states when they are out of the way
    return collisions(asset, joint.child, np.linspace(0.0, joint.limits.upper, poses), others)


def _without_hardware(obj: ArticulatedObject) -> Asset:
    parts = [
        Part(v.name, v.label, v.surfaces, PartSource(v.name), "none", _carrier(obj, link.id, v.name))
        for link in obj.links
        for v in link.visuals
        if v.role is not VisualRole.HARDWARE
    ]
    joints = [AnnotatedJoint(j.child, j.type, j.axis, 0.0, j.limits.upper) for j in obj.joints]
    return Asset(obj.name, "", "made", tuple(parts), joints=tuple(joints))


def _carrier(obj: ArticulatedObject, link: str, part: str) -> str | None:
    return None if link in (obj.root, part) else link


def deepest_cut(moving: list[Visual], still: list[Visual], joint: Joint, poses: int = 9) -> float:
    """How deep solids of the one side cut into those of the other, metres: the thin side of the largest overlap."""
    bodies = [(s.mesh, solid(s.mesh)) for v in still for s in v.surfaces]
    solids = [(s.mesh, solid(s.mesh)) for v in moving for s in v.surfaces]
    deepest = 0.0
    for value in np.linspace(0.0, joint.limits.upper, poses):
        T = joint.motion(float(value))
        for mesh, body in solids:
            box = mesh.transformed(T).box
            near = [other for still_mesh, other in bodies if still_mesh.box.overlaps(box)]
            turned = body.transform(T[:3])
            deepest = max([deepest, *(_thickness(turned ^ other) for other in near)])
    return deepest


def solid(mesh: TriangleMesh, T: Mat4 | None = None) -> manifold3d.Manifold:
    vertices = mesh.vertices if T is None else mesh.vertices @ T[:3, :3].T + T[:3, 3]
    merged = manifold3d.Mesh(vertices.astype(np.float32), mesh.faces.astype(np.uint32))
    merged.merge()
    return manifold3d.Manifold(merged)


def _thickness(overlap: manifold3d.Manifold) -> float:
    if overlap.is_empty():
        return 0.0
    x0, y0, z0, x1, y1, z1 = overlap.bounding_box()
    return float(min(x1 - x0, y1 - y0, z1 - z0))
