"""PartNet-Mobility folders: `mobility_v2.json` with `result.json`, or `mobility.urdf` alone.

Mesh files are Y up, front +Z, scaled to about a unit sphere. JSON hinge limits are degrees. It settles no frame.
"""

import json
import math
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

from grafu.asset.bodies import Body, Motion, Visual, parts_of_bodies
from grafu.asset.mesh_files import check_faces, read_bytes, read_mesh_file
from grafu.asset.options import LoadOptions
from grafu.asset.reading import Convention, Furniture, Reading
from grafu.asset.urdf import UrdfBodies, read_bodies
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType

CONVENTION = Convention("the data set (PartNet-Mobility)", up="+Y", front="+Z", normalised=True)
_TABLES = frozenset({"table", "desk"})
_TYPES = {"hinge": JointType.REVOLUTE, "slider": JointType.PRISMATIC, "slider+": JointType.PRISMATIC}


def is_partnet_mobility(folder: Path) -> bool:
    """Whether the folder is a model of the data set, by the files that it holds."""
    has_json = (folder / "mobility_v2.json").is_file() and (folder / "result.json").is_file()
    return has_json or (folder / "mobility.urdf").is_file()


def read_partnet_mobility(folder: Path, options: LoadOptions) -> Reading:
    """Returns the model in the coordinates of its OBJ files.

    Raises:
        UnreadableAsset: if a file is missing or damaged beyond use.
    """
    if (folder / "mobility_v2.json").is_file() and (folder / "result.json").is_file():
        bodies, notes = _bodies_from_json(folder, options)
    else:
        bodies, notes = _bodies_from_urdf(folder, options)
    made = parts_of_bodies(bodies, up=1)
    said = tuple(dict.fromkeys(notes + made.notes))
    furniture = _furniture(folder, options)
    return Reading("partnet-mobility", made.parts, CONVENTION, made.joints, furniture, said, made.grouped)


def _load_json(path: Path, options: LoadOptions) -> Any:
    try:
        return json.loads(read_bytes(path, options.limits))
    except (ValueError, RecursionError):
        raise UnreadableAsset(f"{path} is not JSON: expected a PartNet-Mobility file; fetch the model again") from None


def _load_list(path: Path, options: LoadOptions) -> list[dict[str, Any]]:
    data = _load_json(path, options)
    if not isinstance(data, list) or not all(isinstance(item, dict) for item in data):
        raise UnreadableAsset(
            f"{path} is not a list of objects: expected the data set's own form; fetch the model again"
        )
    return data


def _furniture(folder: Path, options: LoadOptions) -> Furniture | None:
    path = folder / "meta.json"
    if not path.is_file():
        return None
    meta = _load_json(path, options)
    category = str(meta.get("model_cat", "")).lower() if isinstance(meta, dict) else ""
    return "table" if category in _TABLES else "storage" if "storage" in category else None


def _bodies_from_json(folder: Path, options: LoadOptions) -> tuple[list[Body], list[str]]:
    links, tree = (_load_list(folder / name, options) for name in ("mobility_v2.json", "result.json"))
    try:
        objs = _objs_by_id(tree)
        meshes = _Meshes(folder, options)
        listed = {p["id"] for link in links for p in link["parts"]}
        bodies = [_json_body(link, objs, listed, meshes) for link in links]
    except (KeyError, TypeError, AttributeError, ValueError, RecursionError) as error:
        reason = f"{type(error).__name__}: {str(error).splitlines()[0]}" if str(error) else type(error).__name__
        raise UnreadableAsset(
            f"{folder}: mobility_v2.json or result.json is damaged ({reason}); fetch it again"
        ) from None
    return bodies, meshes.notes


def _objs_by_id(tree: list[dict[str, Any]]) -> dict[int, list[tuple[int, list[str]]]]:
    """Returns for each node id the mesh names at and below it, with the id of the node that lists them."""
    found: dict[int, list[tuple[int, list[str]]]] = {}

    def visit(node: dict[str, Any]) -> list[tuple[int, list[str]]]:
        own = [(node["id"], list(node["objs"]))] if node.get("objs") else []
        for child in node.get("children", ()):
            own = own + visit(child)
        found[node["id"]] = own
        return own

    for root in tree:
        visit(root)
    return found


class _Meshes:
    """Reads the OBJ files of one model; a file that is missing is a note."""

    def __init__(self, folder: Path, options: LoadOptions) -> None:
        self.folder, self.options = folder, options
        self.notes: list[str] = []
        self.faces = 0

    def read(self, stem: str) -> tuple[Surface, ...]:
        path = self.folder / "textured_objs" / f"{stem}.obj"
        if not path.is_file():
            self.notes.append(f"textured_objs/{stem}.obj is missing and was left out")
            return ()
        surfaces = read_mesh_file(path, self.options.limits, split=False)
        self.notes += surfaces.notes
        self.faces += sum(len(s.mesh.faces) for s in surfaces.surfaces)
        check_faces(self.faces, str(self.folder), self.options.limits)
        return surfaces.surfaces


def _json_body(
    link: dict[str, Any], objs: dict[int, list[tuple[int, list[str]]]], listed: set[int], meshes: _Meshes
) -> Body:
    name = f"link_{link['id']}"
    visuals = []
    for part in link["parts"]:
        stems = [s for owner, ss in objs.get(part["id"], ()) if owner == part["id"] or owner not in listed for s in ss]
        surfaces = tuple(s for stem in stems for s in meshes.read(stem))
        if surfaces:
            visuals.append(Visual(f"{part['name']}-{part['id']}", surfaces, name, _file(stems)))
    parent = f"link_{link['parent']}" if link["parent"] is not None and link["parent"] >= 0 else None
    motion = _json_motion(link)
    is_loose = parent is not None and "joint" not in link
    label = f"{link['name']}_{link['id']}" if motion or is_loose else link["name"]
    return Body(label, name, tuple(visuals), motion, parent, is_loose)


def _file(stems: list[str]) -> str:
    return f"textured_objs/{stems[0]}.obj" if len(stems) == 1 else ""


def _json_motion(link: dict[str, Any]) -> Motion | None:
    joint = _TYPES.get(link.get("joint", ""))
    stated = link.get("jointData", {}).get("axis", {})
    direction = _numbers(stated.get("direction"))
    if joint is None or direction is None or not any(direction):
        return None
    limit = link["jointData"].get("limit", {})
    low, high = float(limit.get("a") or 0.0), float(limit.get("b") or 0.0)
    if joint is JointType.REVOLUTE:
        low, high = math.radians(low), math.radians(high)
    origin = _numbers(stated.get("origin")) or [0.0, 0.0, 0.0]
    return Motion(
        joint, Axis(vec3(*origin), vec3(*direction)), low, high, low != high and not limit.get("noLimit", False)
    )


def _numbers(values: Any) -> list[float] | None:
    numbers = [float(v) if v is not None else 0.0 for v in values] if values is not None else []
    return numbers if len(numbers) == 3 and all(math.isfinite(v) for v in numbers) else None


def _bodies_from_urdf(folder: Path, options: LoadOptions) -> tuple[list[Body], list[str]]:
    found: UrdfBodies = read_bodies(folder / "mobility.urdf", options, mesh_frame=True)
    names = _link_names(folder)
    bodies = []
    for body in found.bodies:
        name = names.get(body.link) or _common_name(body)
        bodies.append(replace(body, name=f"{name}_{body.link.removeprefix('link_')}", visuals=_merged(body.visuals)))
    return bodies, list(found.notes)


def _link_names(folder: Path) -> dict[str, str]:
    path = folder / "semantics.txt"
    rows = path.read_text("utf-8", "replace").splitlines() if path.is_file() else []
    return {row.split()[0]: row.split()[2] for row in rows if len(row.split()) >= 3}


def _common_name(body: Body) -> str:
    names = Counter(v.name.rpartition("-")[0] or v.name for v in body.visuals)
    return names.most_common(1)[0][0] if names else body.link


def _merged(visuals: tuple[Visual, ...]) -> tuple[Visual, ...]:
    """Returns one visual per name: the data set repeats a `name-id` for every mesh file of a part."""
    groups: dict[tuple[str, str], list[Visual]] = {}
    for visual in visuals:
        groups.setdefault((visual.name, visual.link), []).append(visual)
    return tuple(
        Visual(name, tuple(s for v in group for s in v.surfaces), link, group[0].file if len(group) == 1 else "")
        for (name, link), group in groups.items()
    )
