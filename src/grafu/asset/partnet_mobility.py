"""PartNet-Mobility folders: `mobility_v2.json` with `result.json`, or `mobility.urdf` alone, to rigid bodies.

Mesh files are Y up, front +Z, scaled to about a unit sphere. JSON hinge limits are degrees. It settles no frame. Other
makers' `mobility.urdf` is read by what it states.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import final

import numpy as np

from grafu.articulation.motion_kind import kind_named
from grafu.asset.bodies import Body, BodyVisual, StatedMotion, annotation_of_bodies, drafts_of_visuals
from grafu.asset.drafts import parts_of_drafts
from grafu.asset.json_files import JsonObject, finite, object_of, read_json
from grafu.asset.mesh_files import read_mesh_file
from grafu.asset.options import LoadOptions
from grafu.asset.part import Part
from grafu.asset.reading import Convention, Furniture, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.standing import spelled
from grafu.asset.urdf import CONVENTION as URDF_CONVENTION
from grafu.asset.urdf import UrdfBodies, read_bodies, read_urdf
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios

EXPECTED = "a PartNet-Mobility file in the data set's own form; fetch the model again"

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
            visuals.append(BodyVisual(f"{part.text('name')}-{key}", surfaces, f"link_{number}", _file(stems)))
    above = link.whole("parent", -1, least=-1)
    parent = f"link_{above}" if above >= 0 else None
    motion = _motion(link)
    is_loose = parent is not None and "joint" not in link.data
    label = f"{name}_{number}" if motion or is_loose else name
    return Body(label, f"link_{number}", tuple(visuals), motion, parent, is_loose)


def _file(stems: list[str]) -> str:
    return f"textured_objs/{stems[0]}.obj" if len(stems) == 1 else ""


def _motion(link: JsonObject) -> StatedMotion | None:
    kind, data = kind_named("partnet", link.text("joint")), link.member("jointData")
    stated = data.member("axis")
    direction = _vector(stated, "direction")
    if kind is None or direction is None or not any(direction):
        return None
    limit = data.member("limit")
    low, high = (kind.from_degrees(limit.number(end, 0.0)) for end in ("a", "b"))
    axis = Axis(vec3(*(_vector(stated, "origin") or (0.0, 0.0, 0.0))), vec3(*direction))
    return StatedMotion(kind.type, axis, low, high, low != high and not limit.get("noLimit"))


def _vector(holder: JsonObject, key: str) -> tuple[float, ...] | None:
    """Returns three numbers, null for 0; None where there are none."""
    numbers = [0.0 if value is None else finite(value) for value in holder.array(key)]
    if None in numbers or len(numbers) not in (0, 3):
        return None
    return tuple(value for value in numbers if value is not None) or None


CONVENTION = Convention("the data set (PartNet-Mobility)", up="+Y", front="+Z", normalised=True)
_KINDS: Mapping[str, Furniture] = MappingProxyType(
    {"table": "table", "desk": "table", "door": "door", "window": "window"}
)


@final
@dataclass(frozen=True, slots=True)
class StandingConfig:
    """What tells which way up the meshes of a `mobility.urdf` are.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    along: float = 0.99
    """Least part of a direction along an axis (cosine)."""
    on_floor: float = 0.05
    """How far what stands on 0 may lie off it (fraction of the side) ..."""
    centred: float = 0.15
    """... and the middle of what stands about 0 (fraction of the side)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def read_partnet_mobility(folder: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the model in the coordinates of its OBJ files.

    Raises:
        UnreadableAsset: if a file is missing or damaged beyond use.
    """
    files = files or ModelFiles(folder, options.limits)
    if (folder / "mobility_v2.json").is_file() and (folder / "result.json").is_file():
        bodies, notes = bodies_from_json(folder, files)
        visuals = tuple(v for body in bodies for v in body.visuals)
        found = UrdfBodies(tuple(bodies), visuals, tuple(notes), (0.0, 1.0, 0.0))
    else:
        stated = read_bodies(folder / "mobility.urdf", files, mesh_frame=True)
        if _is_robot(stated, folder):
            return read_urdf(folder / "mobility.urdf", options, files)
        found = _named(stated, folder, files)
    parts = parts_of_drafts(drafts_of_visuals(found.visuals))
    convention = _convention(found, parts)
    up = "XYZ".index((convention.up or convention.usual_up)[1])
    annotation = annotation_of_bodies(list(found.bodies), up)
    said = tuple(dict.fromkeys(found.notes))
    return Reading("partnet-mobility", parts, convention, annotation, _furniture(folder, files), said)


def _is_robot(found: UrdfBodies, folder: Path) -> bool:
    """Whether another maker's URDF has that name: it stands on Z and has boxes or cylinders, not only meshes."""
    is_drawn_in_shapes = any(not visual.file for visual in found.visuals)
    return is_drawn_in_shapes and found.up[2] > StandingConfig().along and not (folder / "semantics.txt").is_file()


def _convention(found: UrdfBodies, parts: tuple[Part, ...], config: StandingConfig = StandingConfig()) -> Convention:
    """Returns what the files say of their coordinates: the data set's, or those of another maker's URDF of that name.

    The data set's base joint turns its meshes, which are Y up, to stand on Z. Another maker's URDF is Z up, unless all
    its meshes are glTF and stand on y = 0 rather than on z = 0.
    """
    up = np.array(found.up)
    if up[1] > config.along or not parts:
        return CONVENTION
    is_gltf = all(visual.file.lower().endswith((".glb", ".gltf")) for visual in found.visuals)
    if up[2] > config.along and is_gltf and _stands_on_y(Box.enclosing(part.box for part in parts), config):
        return Convention("the meshes, which stand on y = 0 (glTF in a URDF)", up="+Y", unit=1.0)
    axis = int(np.argmax(np.abs(up)))
    stated = spelled(axis, bool(up[axis] > 0)) if abs(up[axis]) > config.along else None
    return Convention(URDF_CONVENTION.origin, up=stated, unit=1.0, usual_up="+Z")


def _stands_on_y(whole: Box, config: StandingConfig) -> bool:
    lies = np.abs(whole.low) <= config.on_floor * whole.size
    centred = np.abs(whole.center) <= config.centred * whole.size
    return bool(lies[1] and centred[2] and not lies[2])


def _furniture(folder: Path, files: ModelFiles) -> Furniture | None:
    path = folder / "meta.json"
    if not path.is_file():
        return None
    meta = read_json(path, files, EXPECTED)
    category = str(meta.get("model_cat", ""))[:100].lower() if isinstance(meta, dict) else ""
    return _KINDS.get(category, "storage" if "storage" in category else None)


def _named(found: UrdfBodies, folder: Path, files: ModelFiles) -> UrdfBodies:
    names = _link_names(folder, files)
    bodies = []
    for body in found.bodies:
        name = names.get(body.link) or _common_name(body)
        bodies.append(replace(body, name=f"{name}_{body.link.removeprefix('link_')}", visuals=_merged(body.visuals)))
    return UrdfBodies(tuple(bodies), _merged(found.visuals), found.notes, found.up)


def _link_names(folder: Path, files: ModelFiles) -> dict[str, str]:
    path = folder / "semantics.txt"
    rows = files.read(path).decode("utf-8", "replace").splitlines() if path.is_file() else []
    return {row.split()[0]: row.split()[2] for row in rows if len(row.split()) >= 3}


def _common_name(body: Body) -> str:
    names = Counter(v.name.rpartition("-")[0] or v.name for v in body.visuals)
    return names.most_common(1)[0][0] if names else body.link


def _merged(visuals: tuple[BodyVisual, ...]) -> tuple[BodyVisual, ...]:
    """Returns one visual per name: the data set repeats a `name-id` for every mesh file of a part."""
    groups: dict[tuple[str, str], list[BodyVisual]] = {}
    for visual in visuals:
        groups.setdefault((visual.name, visual.link), []).append(visual)
    return tuple(
        BodyVisual(
            name,
            tuple(s for v in group for s in v.surfaces),
            link,
            group[0].file if len(group) == 1 else "",
            group[0].group,
        )
        for (name, link), group in groups.items()
    )
