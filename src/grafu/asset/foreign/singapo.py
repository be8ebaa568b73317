"""SINGAPO's and CAGE's `object.json`: a tree of parts with boxes and joints. Y up, front +Z, within about [-1, 1].

Hinge ranges are degrees from 0, slides lengths from 0; the end may be negative. Where the file names meshes of a part
and they lie in its box, they stand for it. It matches nothing.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from grafu.articulation.motion_kind import kind_named
from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart
from grafu.asset.json_files import finite, read_json, spelled
from grafu.asset.labels import label_of
from grafu.asset.mesh_files import read_mesh_file
from grafu.asset.options import LoadOptions
from grafu.asset.resources import MISSING, ModelFiles, Sought
from grafu.errors import AssetError, UnreadableAsset
from grafu.geometry.arrays import Scalars
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import PartLabel

TREES: Final = ("diffuse_tree", "arti_tree")
_WORDS: Final = {"base": PartLabel.UNKNOWN, "tray": PartLabel.DRAWER, "wheel": PartLabel.MISC}
_EXPECTED = "SINGAPO's or CAGE's object.json, whose `diffuse_tree` or `arti_tree` lists parts with `aabb` and `joint`"
_LARGEST = 1e9  # of a coordinate: beyond, a number is none
_ALIKE = 0.5  # least overlap of a part's meshes with its box: meshes in other coordinates overlap far less

Json = Mapping[str, Any]


def read_singapo(path: Path, options: LoadOptions = LoadOptions()) -> ForeignMotions:
    """Returns the prediction of an `object.json`.

    Raises:
        UnreadableAsset: if the file is missing, damaged, or of another form.
    """
    files = ModelFiles(path, options.limits)
    nodes = _nodes(path, files)
    names = _names(nodes, path)
    notes: list[str] = []
    parts, joints = [], []
    for key, node in nodes.items():
        where = f"{path}: part {key}"
        parent = names.get(_id(node.get("parent", -1), where))
        if parent is None and node.get("parent", -1) not in (-1, None):
            raise UnreadableAsset(f"{where} hangs on the part {node['parent']!r}, which is not there")
        box = _box(_object(node, "aabb", where), where)
        mesh = _mesh(node, box, path, files, notes)
        word = str(node.get("name", ""))
        label = _WORDS[word] if word in _WORDS else label_of(word)
        parts.append(ForeignPart(names[key], mesh or TriangleMesh.box_mesh(box), mesh is None, label, parent))
        joint = _joint(names[key], _object(node, "joint", where), where, notes)
        joints += [joint] if joint else []
    try:
        return ForeignMotions("singapo", str(path), tuple(parts), tuple(joints), notes=tuple(notes))
    except AssetError as error:
        raise UnreadableAsset(str(error)) from None


def _nodes(path: Path, files: ModelFiles) -> dict[str, Json]:
    """Returns the nodes of the tree by id, in order."""
    data = read_json(path, files, _EXPECTED)
    tree = next((data[key] for key in TREES if key in data), None) if isinstance(data, dict) else None
    if not isinstance(tree, list) or not tree or not all(isinstance(node, dict) for node in tree):
        raise UnreadableAsset(f"{path} lists no parts: expected {_EXPECTED}")
    files.limits.require("parts", len(tree), path)
    found = {_id(node.get("id", index), f"{path}: part {index}"): node for index, node in enumerate(tree)}
    if len(found) < len(tree):
        raise UnreadableAsset(f"{path}: `id` of parts must be unique: one repeats")
    return found


def _names(nodes: Mapping[str, Json], path: Path) -> dict[str, str]:
    if any(not isinstance(node.get("name", ""), str) for node in nodes.values()):
        raise UnreadableAsset(f"{path}: `name` of a part must be a word (base, door, drawer, handle, ...)")
    return {key: f"{node.get('name') or 'part'}_{key}" for key, node in nodes.items()}


def _id(value: Any, where: str) -> str:
    if isinstance(value, bool) or not isinstance(value, int | str):
        raise UnreadableAsset(f"{where}: `id` and `parent` must be numbers: got {spelled(value)}")
    return str(value)


def _object(node: Json, key: str, where: str) -> Json:
    value = node.get(key)
    if not isinstance(value, dict):
        raise UnreadableAsset(f"{where} has no `{key}`: expected {_EXPECTED}")
    return value


def _vector(data: Json, key: str, count: int, where: str) -> Scalars:
    values = data.get(key)
    numbers = isinstance(values, list) and all(
        (number := finite(v)) is not None and abs(number) < _LARGEST for v in values
    )
    if not isinstance(values, list) or not numbers or len(values) != count:
        raise UnreadableAsset(f"{where}: `{key}` must be {count} finite numbers: got {spelled(values)}")
    return np.array(values, dtype=np.float64)


def _box(aabb: Json, where: str) -> Box:
    center, size = (_vector(aabb, key, 3, where) for key in ("center", "size"))
    if (size < 0).any():
        raise UnreadableAsset(f"{where}: `size` must not be negative: got {size.tolist()}")
    return Box.from_center(center, size / 2)


def _mesh(node: Json, box: Box, path: Path, files: ModelFiles, notes: list[str]) -> TriangleMesh | None:
    """Returns the meshes that a node names, as one, where all can be read and they lie in its box."""
    lists = (node.get(key) for key in ("plys", "objs"))
    listed: list[Any] = next((names for names in lists if isinstance(names, list) and names), [])
    found: list[TriangleMesh] = []
    for name in {str(name): name for name in listed}.values():  # one that is named twice is there once
        sought = files.seek(name, path.parent) if isinstance(name, str) else Sought(None, MISSING)
        if sought.path is None:
            if sought.why != MISSING:
                notes.append(f"a part's box stands for its mesh: {name} {sought.why}")
            return None
        try:
            found += [s.mesh for s in read_mesh_file(sought.path, files, split=False).surfaces]
        except UnreadableAsset as error:
            notes.append(f"a part's box stands for its mesh: {error}")
            return None
    mesh = merge_meshes(found)
    if not len(mesh.faces) or mesh.box.intersection_over_union(box, 0.01 * box.diagonal) < _ALIKE:
        return None
    return mesh


def _joint(part: str, joint: Json, where: str, notes: list[str]) -> ForeignJoint | None:
    kind = joint.get("type")
    kind = kind if isinstance(kind, str) else spelled(kind)
    if kind == "fixed":
        return None
    moves = kind_named("singapo", kind)
    if moves is None:
        if kind != "screw":
            raise UnreadableAsset(
                f"{where}: `type` must be fixed, revolute, prismatic, screw or continuous: got {kind!r}"
            )
        notes.append(f"{part} is predicted to screw, which is not built: left still")
        return None
    axis = _object(joint, "axis", where)
    origin, direction = (_vector(axis, key, 3, where) for key in ("origin", "direction"))
    if not np.linalg.norm(direction) > 1e-9:
        notes.append(f"{part} is predicted to move along an axis without a direction: left still")
        return None
    low, high = _vector(joint, "range", 2, where).tolist()
    limited = kind != "continuous" and low != high
    low, high = moves.from_degrees(low), moves.from_degrees(high)
    return ForeignJoint(part, moves.type, Axis(origin, direction), low, high, limited)
