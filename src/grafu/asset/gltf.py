"""glTF scenes: nodes with meshes are parts, in the scene's coordinates. It settles no frame.

Nodes that animations turn or slide are the annotation's moving bodies.
"""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.articulation.articulated_object import VisualRole
from grafu.asset.animated_bodies import animated_bodies, in_scene
from grafu.asset.bodies import annotation_of_bodies
from grafu.asset.drafts import drafts_of_nodes, parts_of_drafts
from grafu.asset.gltf_animations import moved_nodes
from grafu.asset.gltf_buffers import GltfFile, read_gltf_file
from grafu.asset.gltf_meshes import GltfMeshes
from grafu.asset.json_files import JsonObject
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.part import Annotation
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.scene_nodes import Chain, SceneNode
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4
from grafu.geometry.transform import from_rotation, quaternion_matrix

_LARGEST = 1e12  # of a number in a node's transform: products of some of them stay finite
_HIDDEN = 1e-24  # determinant of a node's transform: nothing as small as its cube root is seen
CONVENTION = Convention("the format (glTF: metres, Y up, front +Z)", up="+Y", front="+Z", unit=1.0)


@final
@dataclass(frozen=True)
class _Node:
    """A node with a mesh: its name, the nodes from the scene down to itself, and its pose in the scene."""

    name: str
    chain: Chain
    mesh: int
    T_scene_node: Mat4


def read_gltf(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the scene of a .glb or .gltf file in its own coordinates.

    Raises:
        UnreadableAsset: if the file is missing or damaged, or compressed in a way that is not read.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    file = read_gltf_file(path, files or ModelFiles(path, options.limits))
    meshes, nodes = _counted(file)
    check_parts(len(nodes), path, options.limits)
    by_name = not str(file.document.member("asset").get("generator")).startswith("grafu")  # it writes a node per part
    shapes = [_scene_node(node, meshes) for node in nodes]
    drafts = drafts_of_nodes(shapes, path.name, by_name)
    parts = parts_of_drafts(drafts)
    annotation, notes = _annotation(file, shapes, path)
    return Reading("glb", parts, CONVENTION, annotation, notes=tuple(dict.fromkeys((*notes, *meshes.notes))))


def read_surfaces(path: Path, files: ModelFiles) -> tuple[Surface, ...]:
    """Returns all surfaces of a .glb or .gltf file in its scene's coordinates.

    Raises:
        UnreadableAsset: if the file is missing or damaged, or compressed in a way that is not read.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    return tuple(surface for mesh in read_scene_meshes(path, files)[0] for surface in mesh)


def read_scene_meshes(path: Path, files: ModelFiles) -> tuple[tuple[tuple[Surface, ...], ...], tuple[str, ...]]:
    """Returns the surfaces of each node with a mesh, in the scene's order and coordinates, and notes on what was lost.

    Raises:
        UnreadableAsset: if the file is missing or damaged, or compressed in a way that is not read.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    meshes, nodes = _counted(read_gltf_file(path, files))
    found = tuple(tuple(s.transformed(n.T_scene_node) for s in meshes.get(n.mesh)) for n in nodes)
    return found, tuple(dict.fromkeys(meshes.notes))


def _counted(file: GltfFile) -> tuple[GltfMeshes, list[_Node]]:
    """Returns the document's meshes and nodes, all counted against the limits before any mesh is made."""
    meshes, nodes = GltfMeshes(file), list(_scene_nodes(file))
    for node in nodes:
        meshes.count(node.mesh)
    return meshes, nodes


def _scene_node(node: _Node, meshes: GltfMeshes) -> SceneNode:
    surfaces = meshes.get(node.mesh)
    if not np.array_equal(node.T_scene_node, np.eye(4)):
        surfaces = tuple(s.transformed(node.T_scene_node) for s in surfaces)
    return SceneNode(node.name, node.chain, surfaces)


def _annotation(file: GltfFile, shapes: Sequence[SceneNode], path: Path) -> tuple[Annotation | None, list[str]]:
    """Returns what the animations state about the motions of nodes, and notes on what is left out."""
    moved = moved_nodes(file)
    if not moved:
        return None, []
    above = {index: T_scene_above for index, _, T_scene_above, _ in _placed_nodes(file)}
    moves = {
        index: [[in_scene(above[index], T) for T in run] for run in runs]
        for index, runs in moved.items()
        if index in above and _is_shown(above[index]) and not _is_hardware(file.item("nodes", index))
    }
    links = {index: _ours(file.item("nodes", index)).get("link") for index in moves}
    names = {index: link for index, link in links.items() if isinstance(link, str) and link}
    bodies, notes = animated_bodies(shapes, moves, path.name, names)
    return annotation_of_bodies(bodies, up=1) if bodies else None, notes


def _is_shown(T_scene_above: Mat4) -> bool:
    """Whether no scale of 0 above a node hides it (`_local`)."""
    return bool(abs(np.linalg.det(T_scene_above[:3, :3])) > _HIDDEN)


def _is_hardware(node: JsonObject) -> bool:
    """Whether grafu wrote the node for a piece of hardware, which follows what it is fixed to."""
    return _ours(node).get("role") == VisualRole.HARDWARE.value


def _ours(node: JsonObject) -> Mapping[str, Any]:
    """Returns what grafu wrote about a node; empty of other nodes."""
    extras = node.get("extras")
    ours = extras.get("grafu") if isinstance(extras, dict) else None
    return ours if isinstance(ours, dict) else {}


def _scene_nodes(file: GltfFile) -> Iterator[_Node]:
    for index, chain, T_scene_above, T in _placed_nodes(file):
        node = file.item("nodes", index)
        mesh, name = node.whole("mesh"), chain[-1][1]
        if mesh is not None:
            name = name or file.item("meshes", mesh).text("name") or f"node_{index}"
            yield _Node(name, (*chain[:-1], (index, name)), mesh, T_scene_above @ T)


def _placed_nodes(file: GltfFile) -> Iterator[tuple[int, Chain, Mat4, Mat4]]:
    """Yields each node of the scene: its number, the nodes from the scene down to it, and two transforms.

    The first is that of the node above it in the scene, the second its own in the coordinates of that.
    """
    limits = file.files.limits
    stack: list[tuple[int, Mat4, Chain]] = [(r, np.eye(4), ()) for r in reversed(_roots(file))]
    seen: set[int] = set()
    while stack:
        index, above, chain = stack.pop()
        node = file.item("nodes", index)
        if index in seen:
            raise file.damaged(f"nodes[{index}] has two parents or lies in a cycle")
        seen.add(index)
        limits.require("nodes", len(seen), file.path)
        limits.require("depth", len(chain) + 1, file.path)
        own = _local(node, file)
        T = above @ own
        if not np.abs(T).max() < _LARGEST**2:
            raise file.damaged("the transforms of nodes one below the other grow beyond all furniture")
        chain = (*chain, (index, node.text("name")))
        yield index, chain, above, own
        stack += [(child, T, chain) for child in reversed(node.indices("children"))]


def _roots(file: GltfFile) -> list[int]:
    """Returns the nodes that nothing stands above, of the scene that is shown where there are several."""
    if file.document.array("scenes"):
        return file.item("scenes", file.document.whole("scene", 0)).indices("nodes")
    nodes = file.document.objects("nodes")
    children = {child for node in nodes for child in node.indices("children")}
    return [i for i in range(len(nodes)) if i not in children]


def _local(node: JsonObject, file: GltfFile) -> Mat4:
    matrix = node.numbers("matrix", 16)
    if matrix is not None:
        T = np.array(matrix).reshape(4, 4).T
    else:
        x, y, z, w = node.numbers("rotation", 4, (0.0, 0.0, 0.0, 1.0))
        scale = np.array(node.numbers("scale", 3, (1.0, 1.0, 1.0)))
        R = quaternion_matrix(w, x, y, z) if any((w, x, y, z)) else np.eye(3)
        T = from_rotation(R * scale, np.array(node.numbers("translation", 3, (0.0, 0.0, 0.0))))
    if not np.abs(T).max() < _LARGEST:
        raise file.damaged("a node's transform holds numbers that no furniture has")
    if abs(np.linalg.det(T[:3, :3])) < 1e-30:
        return from_rotation(np.eye(3) * 1e-9, T[:3, 3])  # hidden by a zero scale: no face survives
    return T
