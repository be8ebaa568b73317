"""`mobility_v2.json` with `result.json` to rigid bodies: links, their parts, and the OBJ files of each.

Mesh files are Y up, front +Z. Hinge limits are degrees. It settles no frame.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import final

from grafu.asset.bodies import Body, StatedMotion, Visual
from grafu.asset.json_files import read_json
from grafu.asset.json_shapes import JsonObject, finite, object_of
from grafu.asset.mesh_files import read_mesh_file
from grafu.asset.resources import ModelFiles
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType

EXPECTED = "a PartNet-Mobility file in the data set's own form; fetch the model again"
_TYPES = {"hinge": JointType.REVOLUTE, "slider": JointType.PRISMATIC, "slider+": JointType.PRISMATIC}

Key = int | str
"""The id of a node or part, as JSON has it."""


@final
@dataclass(frozen=True, slots=True)
class _Listed:
    """The mesh names that one node of the tree lists, and the node."""

    owner: Key
    stems: tuple[str, ...]


def bodies_from_json(folder: Path, files: ModelFiles) -> tuple[list[Body], list[str]]:
    """Returns the bodies of a model of the data set, and notes on what was left out.

    Raises:
        UnreadableAsset: if a file is missing or damaged.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    links, tree = (_objects(folder / name, files) for name in ("mobility_v2.json", "result.json"))
    files.limits.require("nodes", len(links), folder)
    objs = _objs_by_id(tree, folder, files)
    listed = {_key(part, "id") for link in links for part in link.objects("parts")}
    files.limits.require("parts", sum(len(link.array("parts")) for link in links), folder)
    meshes = _Meshes(folder, files)
    return [_body(link, objs, listed, meshes) for link in links], meshes.notes


def _objects(path: Path, files: ModelFiles) -> list[JsonObject]:
    values = read_json(path, files, EXPECTED)
    if not isinstance(values, list):
        raise _damaged(path, "it is no list of objects")
    return [object_of(value, f"[{index}]", lambda why: _damaged(path, why)) for index, value in enumerate(values)]


def _damaged(path: Path, why: str) -> UnreadableAsset:
    return UnreadableAsset(f"{path} is damaged ({why}): expected {EXPECTED}")


def _key(holder: JsonObject, name: str) -> Key:
    value = holder.get(name)
    if isinstance(value, bool) or not isinstance(value, int | str):
        raise holder.wrong(name, "a number or a word")
    return value


def _objs_by_id(tree: list[JsonObject], folder: Path, files: ModelFiles) -> dict[Key, tuple[_Listed, ...]]:
    """Returns for each node id the mesh names at and below it, with the id of the node that lists them."""
    found: dict[Key, list[_Listed]] = {}
    steps = 0
    for node, above in _walk(tree, folder, files):
        key = _key(node, "id")
        found.setdefault(key, [])
        stems = tuple(_stem(node, value) for value in node.array("objs"))
        steps += len(above) + 1
        files.limits.require("values", steps, folder)
        if stems:
            for holder in (*above, key):
                found[holder].append(_Listed(key, stems))
    return {key: tuple(lists) for key, lists in found.items()}


def _walk(tree: list[JsonObject], folder: Path, files: ModelFiles) -> Iterator[tuple[JsonObject, tuple[Key, ...]]]:
    """Gives every node, the one above before those below and these in order, with the ids above it."""
    stack: list[tuple[JsonObject, tuple[Key, ...]]] = [(node, ()) for node in reversed(tree)]
    while stack:
        node, above = stack.pop()
        files.limits.require("depth", len(above) + 1, folder)
        yield node, above
        chain = (*above, _key(node, "id"))
        stack += [(child, chain) for child in reversed(node.objects("children"))]


def _stem(node: JsonObject, value: object) -> str:
    if not isinstance(value, str):
        raise node.wrong("objs", "a list of names")
    return value


class _Meshes:
    """Reads the OBJ files of one model; a file that is missing is a note."""

    def __init__(self, folder: Path, files: ModelFiles) -> None:
        self.folder, self.files = folder, files
        self.notes: list[str] = []

    def read(self, stem: str) -> tuple[Surface, ...]:
        sought = self.files.seek(f"textured_objs/{stem}.obj", self.folder)
        if sought.path is None:
            self.notes.append(f"textured_objs/{stem}.obj {sought.why} and was left out")
            return ()
        self.files.tally.add(self.folder, primitives=1)
        found = read_mesh_file(sought.path, self.files, split=False)
        self.notes += found.notes
        return found.surfaces


def _body(link: JsonObject, objs: dict[Key, tuple[_Listed, ...]], listed: set[Key], meshes: _Meshes) -> Body:
    number, name = _key(link, "id"), link.text("name")
    visuals = []
    for part in link.objects("parts"):
        key = _key(part, "id")
        stems = [s for node in objs.get(key, ()) if node.owner == key or node.owner not in listed for s in node.stems]
        surfaces = tuple(s for stem in dict.fromkeys(stems) for s in meshes.read(stem))
        if surfaces:
            visuals.append(Visual(f"{part.text('name')}-{key}", surfaces, f"link_{number}", _file(stems)))
    above = link.whole("parent", -1, least=-1)
    parent = f"link_{above}" if above >= 0 else None
    motion = _motion(link)
    is_loose = parent is not None and "joint" not in link.data
    label = f"{name}_{number}" if motion or is_loose else name
    return Body(label, f"link_{number}", tuple(visuals), motion, parent, is_loose)


def _file(stems: list[str]) -> str:
    return f"textured_objs/{stems[0]}.obj" if len(stems) == 1 else ""


def _motion(link: JsonObject) -> StatedMotion | None:
    joint, data = _TYPES.get(link.text("joint")), link.member("jointData")
    stated = data.member("axis")
    direction = _vector(stated, "direction")
    if joint is None or direction is None or not any(direction):
        return None
    limit = data.member("limit")
    low, high = limit.number("a", 0.0), limit.number("b", 0.0)
    if joint is JointType.REVOLUTE:
        low, high = math.radians(low), math.radians(high)
    axis = Axis(vec3(*(_vector(stated, "origin") or (0.0, 0.0, 0.0))), vec3(*direction))
    return StatedMotion(joint, axis, low, high, low != high and not limit.get("noLimit"))


def _vector(holder: JsonObject, key: str) -> tuple[float, ...] | None:
    """Returns three numbers, null for 0; None where there are none."""
    numbers = [0.0 if value is None else finite(value) for value in holder.array(key)]
    if None in numbers or len(numbers) not in (0, 3):
        return None
    return tuple(value for value in numbers if value is not None) or None
