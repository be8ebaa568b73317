"""An articulated object as SINGAPO and CAGE write one: `object.json` with the tree of parts, and their meshes.

Y up, front +Z, centred, half the diagonal 1. Joints have their direction made positive along its largest component, as
the authors' loader makes it, so that a range may run from 0 to below 0. Looks it does not say.
"""

import json
from collections.abc import Iterable
from typing import Any, Final, Literal, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Link, Visual
from grafu.dataclass import dataclass
from grafu.errors import ExportError
from grafu.export.files import ExportFiles, not_coupled
from grafu.export.obj import ObjFolder
from grafu.geometry.arrays import Mat4
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import from_rotation, scale_of
from grafu.vocabulary import PartLabel

_Z_UP_TO_Y_UP = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
_WORDS: Final = {PartLabel.DOOR: "door", PartLabel.DRAWER: "drawer", PartLabel.SHELF: "shelf"}


@final
@dataclass(frozen=True, slots=True)
class SingapoConfig:
    """`tree` is the key of the parts (`arti_tree` in older files); without `meshes` only boxes are written."""

    tree: Literal["diffuse_tree", "arti_tree"] = "diffuse_tree"
    meshes: bool = True


DEFAULT_SINGAPO_CONFIG: Final = SingapoConfig()


def export_singapo(articulated: ArticulatedObject, config: SingapoConfig = DEFAULT_SINGAPO_CONFIG) -> ExportFiles:
    """Returns `object.json` and, under `objs/`, the mesh of each part. Handles are parts fixed to what carries them.

    Raises:
        ExportError: if the object has no faces, or a joint does not start closed, which the format cannot say.
    """
    late = [joint.id for joint in articulated.moving_joints if joint.limits.lower != 0]
    if late:
        raise ExportError(f"SINGAPO's ranges start at 0: got joints that do not: {', '.join(late)}")
    links = [link for link in articulated.links_from_root if len(link.mesh.faces)]
    if not links:
        raise ExportError("SINGAPO's files need boxes: got an object without faces")
    T = _normalised(merge_meshes([link.mesh for link in links]).box)
    folder = ObjFolder(0.0)
    nodes: list[dict[str, Any]] = []
    place: dict[str, int] = {}
    for link in links:
        _add_link(articulated, link, T, nodes, place, folder if config.meshes else None)
    for node in nodes:
        node["children"] = [other["id"] for other in nodes if other["parent"] == node["id"]]
    text = json.dumps({"meta": {}, config.tree: nodes}, indent=1)
    files = {"object.json": text.encode()} | {f"objs/{name}": data for name, data in folder.files.items()}
    return ExportFiles(files, notes=not_coupled(articulated, "object.json"))


def _normalised(box: Box) -> Mat4:
    scale = 2.0 / max(box.diagonal, 1e-12)
    R = scale * _Z_UP_TO_Y_UP
    return from_rotation(R, -R @ box.center)


def _add_link(
    articulated: ArticulatedObject,
    link: Link,
    T: Mat4,
    nodes: list[dict[str, Any]],
    place: dict[str, int],
    folder: ObjFolder | None,
) -> None:
    """Appends the node of a link and one for each handle on it; `place` keeps the node's id by link."""
    joint = articulated.joint_of.get(link.id)
    handles = [v for v in link.rigid_visuals if v.label is PartLabel.HANDLE and len(v.mesh.faces) and joint is not None]
    body = [v for v in link.rigid_visuals if v not in handles and len(v.mesh.faces)]
    if not body:
        body, handles = handles, []
    above = joint
    while above is not None and above.parent not in place:
        above = articulated.joint_of.get(above.parent)
    place[link.id] = len(nodes)
    parent = -1 if above is None else place[above.parent]
    nodes.append(_node(len(nodes), _word(body, joint), parent, body, T, _joint(joint, T), folder))
    for handle in handles:
        nodes.append(_node(len(nodes), "handle", place[link.id], [handle], T, _joint(None, T), folder))


def _word(body: Iterable[Visual], joint: Joint | None) -> str:
    """Returns the format's word for a link: its main label's, or else what its joint makes it."""
    if joint is None:
        return "base"
    spoken = [_WORDS[v.label] for v in body if v.label in _WORDS]
    if spoken or not joint.kind.moves:
        return spoken[0] if spoken else "base"
    return _WORDS.get(joint.kind.label, "knob")


def _node(
    number: int,
    word: str,
    parent: int,
    visuals: list[Visual],
    T: Mat4,
    joint: dict[str, Any],
    folder: ObjFolder | None,
) -> dict[str, Any]:
    mesh = merge_meshes([v.mesh for v in visuals]).transformed(T)
    box = mesh.box
    node = {"id": number, "name": word, "parent": parent, "children": [], "joint": joint}
    node["aabb"] = {"center": box.center.tolist(), "size": box.size.tolist()}
    node["objs"] = [] if folder is None else [f"objs/{_added(folder, number, mesh)}"]
    return node


def _added(folder: ObjFolder, number: int, mesh: TriangleMesh) -> str:
    return folder.add_mesh(f"part_{number}", mesh, np.zeros(3))


def _joint(joint: Joint | None, T: Mat4) -> dict[str, Any]:
    if joint is None or not joint.kind.moves:
        axis = {"direction": [0.0, 0.0, 0.0], "origin": [0.0, 0.0, 0.0]}
        return {"type": "fixed", "range": [0.0, 0.0], "axis": axis}
    placed = joint.axis.transformed(T)
    end = joint.kind.in_degrees(joint.limits.upper) * joint.kind.length_scale(scale_of(T))
    largest = int(np.argmax(np.abs(placed.direction)))
    if placed.direction[largest] < 0:
        placed, end = placed.reversed(), -end
    axis = {"direction": placed.direction.tolist(), "origin": placed.point.tolist()}
    return {"type": joint.kind.word("singapo"), "range": [0.0, end], "axis": axis}
