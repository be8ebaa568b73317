"""A `model.glb` that `export_glb` wrote, read back as the articulated object that it holds. It reads no other GLB.

Lengths, axes and limits come back as they were, vertices in single precision, normals as they were shown.
"""

from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.articulation.articulated_object import (
    ArticulatedObject,
    Coupling,
    Joint,
    JointLimits,
    Link,
    Visual,
    VisualRole,
)
from grafu.articulation.grasp_frame import GraspFrame
from grafu.asset.gltf_buffers import GltfFile, read_gltf_file
from grafu.asset.gltf_meshes import GltfMeshes
from grafu.asset.options import Limits
from grafu.asset.resources import ModelFiles
from grafu.errors import UnreadableAsset
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import from_rotation
from grafu.vocabulary import JointType, PartLabel

_Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""glTF's frame (Y up, front +Z) to the object frame (Z up, front -Y)."""
_LIMITS = Limits()


def read_glb_object(path: Path, limits: Limits = _LIMITS) -> ArticulatedObject:
    """Returns the object in a GLB of ours, at rest in the object frame.

    Raises:
        UnreadableAsset: if the file is missing, damaged, or none that `export_glb` wrote.
        AssetTooLarge: if it has more bytes or faces than the limits allow.
        ArticulationError: if what it states is no tree.
    """
    file = read_gltf_file(path, ModelFiles(path.parent, limits))
    with file.guarded():
        return _Reader(file).read()


@final
class _Reader:
    """Walks the nodes of one file: links with their joints, and the visuals below them."""

    def __init__(self, file: GltfFile) -> None:
        self._file = file
        self._meshes = GltfMeshes(file)
        self._links: list[Link] = []
        self._joints: list[Joint] = []
        self._grasps: list[GraspFrame] = []
        self._seen: set[int] = set()

    def read(self) -> ArticulatedObject:
        scene = self._file.item("scenes", self._file.document.whole("scene", 0))
        roots = scene.indices("nodes")
        if len(roots) != 1 or "link" not in self._said(roots[0]):
            raise UnreadableAsset(f"{self._file.path} is no model.glb of grafu: its nodes do not say what they are")
        self._add_link(roots[0], None, vec3(0.0, 0.0, 0.0))
        root = self._said(roots[0])["link"]
        return ArticulatedObject(scene.text("name"), root, tuple(self._links), tuple(self._joints), tuple(self._grasps))

    def _add_link(self, index: int, parent: str | None, above: Vec3) -> None:
        if index in self._seen:
            raise self._file.damaged(f"nodes[{index}] has two parents or lies in a cycle")
        self._seen.add(index)
        node, said = self._file.item("nodes", index), self._said(index)
        origin = above + _Z_UP @ np.array(node.numbers("translation", 3, (0.0, 0.0, 0.0)))
        children = node.indices("children")
        below = [child for child in children if "link" in self._said(child)]
        visuals = tuple(self._visual(child, origin) for child in children if "link" not in self._said(child))
        self._links.append(Link(said["link"], visuals))
        self._grasps += [_grasp(one, said["link"], origin) for one in said.get("grasps", ())]
        if parent is not None:
            self._joints.append(_joint(said["joint"], parent, said["link"], origin))
        for child in below:
            self._add_link(child, said["link"], origin)

    def _visual(self, index: int, origin: Vec3) -> Visual:
        node, said = self._file.item("nodes", index), self._said(index)
        T = from_rotation(_Z_UP, origin)
        if "mesh" in node:
            self._meshes.count(node.get("mesh"))
        surfaces = self._meshes.get(node.get("mesh")) if "mesh" in node else ()
        moved = tuple(surface.transformed(T) for surface in surfaces)
        return Visual(node.text("name"), moved, VisualRole(said["role"]), PartLabel(said["label"]))

    def _said(self, index: Any) -> dict[str, Any]:
        """Returns what a node states about itself, empty where it is none of ours."""
        return dict(self._file.item("nodes", index).member("extras").member("grafu").data)


def _grasp(said: dict[str, Any], link: str, origin: Vec3) -> GraspFrame:
    vectors = np.array([said["position"], said["approach"], said["closing"]], dtype=np.float64) @ _Z_UP.T
    sizes = float(said["width"]), float(said["depth"])
    return GraspFrame(
        said["name"], link, said["part"], said["kind"], origin + vectors[0], vectors[1], vectors[2], *sizes
    )


def _joint(said: dict[str, Any], parent: str, child: str, origin: Vec3) -> Joint:
    direction = _Z_UP @ np.array(said["axis"], dtype=np.float64)
    limits = JointLimits(float(said["lower"]), float(said["upper"]))
    axis, after = Axis(origin, direction), tuple(said["after"])
    coupling = Coupling(**said["coupling"]) if "coupling" in said else None
    return Joint(said["id"], JointType(said["type"]), parent, child, axis, limits, after, coupling)
