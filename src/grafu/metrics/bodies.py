"""What counts as the moving and as the static body of an articulated object, and how big the object is.

A body is a link with all links that are fixed to it. The static body is the root's.
"""

from collections.abc import Iterable

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual, VisualRole
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes


def rigid_body(articulated: ArticulatedObject, link_id: str) -> tuple[Link, ...]:
    """Returns a link and all links that are fixed to it, directly or through one another."""
    fixed: dict[str, list[str]] = {}
    for joint in articulated.joints:
        if not joint.kind.moves:
            fixed.setdefault(joint.parent, []).append(joint.child)
    found, queue = [], [link_id]
    while queue:
        current = queue.pop(0)
        found.append(articulated.link(current))
        queue += fixed.get(current, [])
    return tuple(found)


def largest_side(articulated: ArticulatedObject) -> float:
    """Returns the largest side of the object at rest without its hardware, metres: the paper's unit cube."""
    boxes = [link.body_mesh.box for link in articulated.links if len(link.body_mesh.faces)]
    return float(_around(boxes).size.max()) if boxes else 0.0


def parts_mesh(links: Iterable[Link]) -> TriangleMesh:
    """Returns parts and additions of a body as one mesh, without hardware."""
    return merge_meshes([link.body_mesh for link in links])


def anchored_mesh(links: Iterable[Link], tolerance: float) -> TriangleMesh:
    """Returns parts, additions and that hardware of a body which is anchored to it.

    A piece of hardware is anchored where it comes within `tolerance` metres of the body's parts, or of hardware that is
    anchored itself: a hinge that floats beside its door holds nothing.
    """
    links = tuple(links)
    meshes = [parts_mesh(links)]
    loose = [v for link in links for v in link.visuals if v.role is VisualRole.HARDWARE and len(v.mesh.faces)]
    newest = meshes[0]
    while len(newest.faces) and loose:
        near, loose = _split(loose, newest, tolerance)
        newest = merge_meshes([v.mesh for v in near])
        meshes.append(newest)
    return merge_meshes(meshes)


def _split(loose: list[Visual], body: TriangleMesh, tolerance: float) -> tuple[list[Visual], list[Visual]]:
    held = MeshCollider(body)
    near = [
        v.mesh.box.overlaps(body.box, tolerance) and MeshCollider(v.mesh).distance(held) <= tolerance for v in loose
    ]
    return (
        [v for v, is_near in zip(loose, near, strict=True) if is_near],
        [v for v, is_near in zip(loose, near, strict=True) if not is_near],
    )


def _around(boxes: list[Box]) -> Box:
    box = boxes[0]
    for other in boxes[1:]:
        box = box.union(other)
    return box
