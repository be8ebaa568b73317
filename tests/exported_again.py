"""The same furniture as other tools write it: corners not shared, faces divided or in disorder, other units and places.

trimesh, which writes it, parts meshes of several materials into an object for each.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import trimesh

Drawing = Callable[[trimesh.Trimesh], trimesh.Trimesh]


def drawn_again(sample: Path, draw: Drawing, placed: np.ndarray | None = None) -> trimesh.Scene:
    """Returns the scene of a GLB with each mesh drawn in another way, and the whole moved by a 4x4 matrix."""
    scene = trimesh.load_scene(sample)
    for name, mesh in list(scene.geometry.items()):
        drawn = draw(mesh)
        drawn.visual = mesh.visual
        scene.geometry[name] = drawn
    return scene if placed is None else scene.apply_transform(placed)


def flattened(sample: Path) -> trimesh.Scene:
    """Returns the scene of a GLB with each mesh at the root, under the name of its node."""
    scene, made = trimesh.load_scene(sample), trimesh.Scene()
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        made.add_geometry(scene.geometry[name], node_name=node, geom_name=node, transform=transform)
    return made


def _bare(points: np.ndarray, faces: np.ndarray) -> trimesh.Trimesh:
    return trimesh.Trimesh(points, faces, process=False)


def as_it_is(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Returns the mesh as it is."""
    return _bare(mesh.vertices, mesh.faces)


def with_corners_apart(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Returns the mesh with three corners of its own for each triangle, as flat shading needs them."""
    return _bare(mesh.triangles.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3))


def with_faces_divided(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Returns the mesh with each triangle in four."""
    return _bare(*trimesh.remesh.subdivide(mesh.vertices, mesh.faces))


def with_faces_in_disorder(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Returns the mesh with faces, and the first corner of each, in another order."""
    chance = np.random.default_rng(len(mesh.faces))
    faces = mesh.faces[chance.permutation(len(mesh.faces))]
    turned = (np.arange(3) + chance.integers(0, 3, len(faces))[:, None]) % 3
    return _bare(mesh.vertices, np.take_along_axis(faces, turned, axis=1))


def with_faces_turned_over(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Returns the mesh with every second face turned over, as in models that are drawn from both sides."""
    faces = np.array(mesh.faces)
    faces[::2] = faces[::2, ::-1]
    return _bare(mesh.vertices, faces)


def with_faces_doubled(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Returns the mesh with each face once more, turned over."""
    return _bare(mesh.vertices, np.vstack([mesh.faces, mesh.faces[:, ::-1]]))


def with_rounded_corners(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Returns the mesh with coordinates in steps of 0.01 mm, as they are after quantization."""
    return _bare(np.round(mesh.vertices, 5), mesh.faces)


def with_corners_moved(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Returns the mesh with shared corners, each a tenth of a millimetre elsewhere, as in scans."""
    whole = _bare(mesh.vertices, mesh.faces)
    whole.merge_vertices()
    chance = np.random.default_rng(len(mesh.faces))
    return _bare(whole.vertices + chance.normal(0.0, 1e-4, whole.vertices.shape), whole.faces)


DRAWINGS = (
    as_it_is,
    with_corners_apart,
    with_faces_divided,
    with_faces_in_disorder,
    with_faces_turned_over,
    with_faces_doubled,
    with_rounded_corners,
    with_corners_moved,
)
