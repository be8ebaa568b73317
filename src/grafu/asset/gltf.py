"""glTF scenes: nodes with meshes are parts, in world coordinates, hierarchy used. It settles no frame.

Nodes below a node that is named as one whole door or drawer (`drawer_1` over `front`, `side`, ...) become one part;
handles among them ride on it. Every other node with a mesh is a part of its own.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.asset.drafts import PartDraft, parts_of_drafts
from grafu.asset.gltf_buffers import GltfFile, read_gltf_file
from grafu.asset.gltf_meshes import GltfMeshes
from grafu.asset.labels import is_whole_mover, label_of
from grafu.asset.options import Limits, LoadOptions, check_parts
from grafu.asset.reading import Convention, Reading
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4
from grafu.geometry.transform import from_rotation
from grafu.vocabulary import PartLabel

CONVENTION = Convention("the format (glTF: metres, Y up, front +Z)", up="+Y", front="+Z", unit=1.0)


@final
@dataclass(frozen=True)
class _Node:
    """A node with a mesh: its name, the nodes from the scene down to itself, and its pose in the scene."""

    name: str
    chain: tuple[tuple[int, str], ...]
    mesh: Any
    T_scene_node: Mat4


def read_gltf(path: Path, options: LoadOptions) -> Reading:
    """Returns the scene of a .glb or .gltf file in its own coordinates.

    Raises:
        UnreadableAsset: if the file is missing, damaged, or compressed.
        AssetTooLarge: if it has more bytes or faces than the limits allow.
    """
    file = read_gltf_file(path, options.limits)
    meshes = GltfMeshes(file, options.limits)
    with file.guarded():
        nodes = list(_scene_nodes(file))
        check_parts(len(nodes), path, options.limits)
        wholes = _whole_nodes(file, nodes)
        drafts = [_draft(node, meshes, wholes) for node in nodes]
        notes = (["animations are not read as joints"] if file.items("animations") else []) + meshes.notes
    parts = parts_of_drafts(drafts)
    return Reading("glb", parts, CONVENTION, notes=tuple(dict.fromkeys(notes)))


def read_surfaces(path: Path, limits: Limits) -> tuple[Surface, ...]:
    """Returns all surfaces of a .glb or .gltf file in its scene's coordinates.

    Raises:
        UnreadableAsset: if the file is missing, damaged, or compressed.
    """
    return tuple(surface for mesh in read_scene_meshes(path, limits)[0] for surface in mesh)


def read_scene_meshes(path: Path, limits: Limits) -> tuple[tuple[tuple[Surface, ...], ...], tuple[str, ...]]:
    """Returns the surfaces of each node with a mesh, in the scene's order and coordinates, and notes on what was lost.

    Raises:
        UnreadableAsset: if the file is missing, damaged, or compressed.
    """
    file = read_gltf_file(path, limits)
    meshes = GltfMeshes(file, limits)
    with file.guarded():
        found = tuple(tuple(s.transformed(n.T_scene_node) for s in meshes.get(n.mesh)) for n in _scene_nodes(file))
    return found, tuple(dict.fromkeys(meshes.notes))


def _draft(node: _Node, meshes: GltfMeshes, wholes: set[int]) -> PartDraft:
    identity = np.array_equal(node.T_scene_node, np.eye(4))
    surfaces = meshes.get(node.mesh)
    surfaces = surfaces if identity else tuple(s.transformed(node.T_scene_node) for s in surfaces)
    file = meshes.file.path.name
    group = next(((i, name) for i, name in node.chain if i in wholes), None)
    if group is not None:
        return PartDraft(node.name, surfaces, group=f"node {group[0]}", group_name=group[1], file=file)
    # Exporters often name a mesh's parent and not the mesh; the scene's own root says nothing of its parts.
    parent = node.chain[-2][1] if len(node.chain) > 2 else ""
    borrowed = parent if label_of(node.name) is PartLabel.UNKNOWN else ""
    return PartDraft(node.name, surfaces, label_name=borrowed, file=file)


def _whole_nodes(file: GltfFile, nodes: list[_Node]) -> set[int]:
    """Returns the nodes that stand over the pieces of one door or drawer: well named, and not over several such."""
    if str(file.document["asset"].get("generator", "")).startswith("grafu"):
        return set()  # grafu writes one node per part below its links
    above = {i for node in nodes for i, _ in node.chain[:-1]}
    below: dict[int, set[int]] = {}
    for node in nodes:
        chain = [i for i, name in node.chain if is_whole_mover(name)]
        for upper, lower in pairwise(chain):
            below.setdefault(upper, set()).add(lower)
    named = {i for node in nodes for i, name in node.chain if is_whole_mover(name)}
    return {i for i in named & above if len(below.get(i, ())) < 2}


def _scene_nodes(file: GltfFile) -> Iterator[_Node]:
    nodes = file.items("nodes")
    scenes = file.items("scenes")
    if scenes:
        roots = file.item("scenes", file.document.get("scene", 0)).get("nodes", [])
    else:
        children = {c for node in nodes for c in node.get("children", ())}
        roots = [i for i in range(len(nodes)) if i not in children]
    stack: list[tuple[Any, Mat4, tuple[tuple[int, str], ...]]] = [(r, np.eye(4), ()) for r in reversed(roots)]
    seen: set[int] = set()
    while stack:
        index, T, above = stack.pop()
        node = file.item("nodes", index)
        if index in seen:
            raise file.damaged(f"nodes[{index}] has two parents or lies in a cycle")
        seen.add(index)
        T = T @ _local(node, file)
        name = str(node.get("name") or "")
        if node.get("mesh") is not None:
            mesh_name = str(file.item("meshes", node["mesh"]).get("name") or "")
            name = name or mesh_name or f"node_{index}"
            yield _Node(name, (*above, (index, name)), node["mesh"], T)
        stack += [(child, T, (*above, (index, name))) for child in reversed(node.get("children", ()))]


def _local(node: dict[str, Any], file: GltfFile) -> Mat4:
    try:
        if "matrix" in node:
            T = np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
        else:
            x, y, z, w = (float(v) for v in node.get("rotation", (0, 0, 0, 1)))
            scale = np.array(node.get("scale", (1, 1, 1)), dtype=np.float64).reshape(3)
            offset = np.array(node.get("translation", (0, 0, 0)), dtype=np.float64).reshape(3)
            T = from_rotation(_rotation(w, x, y, z) * scale, offset)
    except (ValueError, TypeError):
        raise file.damaged("a node's transform is not numbers") from None
    if not np.isfinite(T).all():
        raise file.damaged("a node's transform is not finite")
    if abs(np.linalg.det(T[:3, :3])) < 1e-30:
        return from_rotation(np.eye(3) * 1e-9, T[:3, 3])  # hidden by a zero scale: no face survives
    return T


def _rotation(w: float, x: float, y: float, z: float) -> np.ndarray:
    n = (w * w + x * x + y * y + z * z) ** 0.5 or 1.0
    w, x, y, z = w / n, x / n, y / n, z / n
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
