"""A judge of added shelves and dividers that shares nothing with what made them: trimesh's collision manager on meshes.

It looks for panels that float (an end does not rest on anything that stands), pierce (cut into anything at rest) or
block (stand in the way of a mover or of its hardware).
"""

from collections.abc import Sequence
from itertools import product

import numpy as np
import trimesh

from grafu.geometry.mesh import TriangleMesh
from grafu.realization.addition import Addition
from grafu.realization.scene import Scene, Way
from grafu.vocabulary import JointType, PartLabel

POSES = 60
Fault = tuple[str, str, str]


def faults_of_panels(additions: Sequence[Addition], scene: Scene, skin: float | None = None) -> list[Fault]:
    """Returns (panel, fault, other part) for all that is wrong; a cut of less than `skin` metres is a touch."""
    skin = 0.001 * scene.unit if skin is None else skin
    still = {part.id: part.mesh for part in scene.static_parts if len(part.mesh.faces)}
    still |= {visual.name: visual.mesh for owner, visual in scene.hardware if not owner}
    panels = {addition.part.id: addition.part.mesh for addition in additions}
    found: list[Fault] = []
    for addition in additions:
        name = addition.part.id
        others = {**still, **{other: mesh for other, mesh in panels.items() if other != name}}
        found += [(name, "floats", end) for end in _loose_ends(addition, others, 2 * skin)]
        found += [(name, "pierces", other) for other in _pierced(panels[name], {**others, **_moving(scene)}, skin)]
        found += [(name, "blocks", mover) for mover in scene.ways if _is_blocked(panels[name], scene, mover, skin)]
    return found


def _moving(scene: Scene) -> dict[str, TriangleMesh]:
    return {mover: scene.equipped_mesh(mover) for mover in scene.movers}


def _loose_ends(addition: Addition, others: dict[str, TriangleMesh], reach: float) -> list[str]:
    """A panel rests with the front and the back half of both its ends: of one pair of opposite sides at least."""
    mesh = addition.part.mesh
    thin = 2 if addition.part.label is PartLabel.SHELF else int(np.argmin(mesh.box.size))
    manager = _manager(others, mesh, reach)
    loose: dict[int, list[str]] = {}
    for axis in (k for k in range(3) if k != thin):
        other = 3 - thin - axis
        loose[axis] = [
            f"{'xyz'[axis]}{'-+'[side]} {('front', 'back')[half]}"
            for side in (0, 1)
            for half in (0, 1)
            if manager.min_distance_single(_cap(mesh, axis, side, other, half)) > reach
        ]
    return min(loose.values(), key=len)


def _cap(mesh: TriangleMesh, axis: int, side: int, other: int, half: int) -> trimesh.Trimesh:
    """The outer hundredth of a half of one end of a prism with eight corners, in the prism's own shape."""
    corner = {tuple(key): v for key, v in zip(mesh.vertices > mesh.box.center, mesh.vertices, strict=True)}

    def at(u: float, v: float, top: bool) -> np.ndarray:
        """The point at shares along the end's axis and along the other one."""
        point = np.zeros(3)
        for far, farther in product((False, True), repeat=2):
            key = [top] * 3
            key[axis], key[other] = far, farther
            point += (u if far else 1 - u) * (v if farther else 1 - v) * corner[tuple(key)]
        return point

    us, vs = ((0.0, 0.01) if side == 0 else (0.99, 1.0)), ((0.0, 0.5) if half == 0 else (0.5, 1.0))
    return trimesh.convex.convex_hull(np.array([at(u, v, top) for u in us for v in vs for top in (False, True)]))


def _pierced(panel: TriangleMesh, others: dict[str, TriangleMesh], skin: float) -> list[str]:
    shrunk = _shrunk(panel, skin)
    hit, names = _manager(others, panel, 0.0).in_collision_single(shrunk, return_names=True)
    return sorted(names) if hit else []


def _is_blocked(panel: TriangleMesh, scene: Scene, mover: str, skin: float) -> bool:
    way, body = scene.ways[mover], scene.equipped_mesh(mover)
    shrunk = _shrunk(panel, skin)
    manager = trimesh.collision.CollisionManager()
    manager.add_object("mover", body.to_trimesh())
    for value in np.linspace(0.0, way.upper, POSES):
        manager.set_transform("mover", _pose(way, value))
        if manager.in_collision_single(shrunk):
            return True
    return False


def _pose(way: Way, value: float) -> np.ndarray:
    return way.axis.rotation(value) if way.type is JointType.REVOLUTE else way.axis.shift(value)


def _manager(others: dict[str, TriangleMesh], near: TriangleMesh, reach: float) -> trimesh.collision.CollisionManager:
    manager = trimesh.collision.CollisionManager()
    for name, mesh in others.items():
        if len(mesh.faces) and mesh.box.overlaps(near.box, reach + 0.01 * float(near.box.size.max())):
            manager.add_object(name, mesh.to_trimesh())
    return manager


def _shrunk(mesh: TriangleMesh, skin: float) -> trimesh.Trimesh:
    size = mesh.box.size
    factor = np.maximum(size - 2 * skin, 0.1 * size) / size
    return trimesh.Trimesh(mesh.box.center + (mesh.vertices - mesh.box.center) * factor, mesh.faces, process=False)
