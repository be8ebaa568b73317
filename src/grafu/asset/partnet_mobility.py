"""PartNet-Mobility folders: `mobility_v2.json` with `result.json`, or `mobility.urdf` alone.

Mesh files are Y up, front +Z, scaled to about a unit sphere. JSON hinge limits are degrees. It settles no frame. Other
makers' `mobility.urdf` is read by what it says.
"""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np

from grafu.asset.bodies import Body, Visual, annotation_of_bodies, drafts_of_visuals
from grafu.asset.drafts import parts_of_drafts
from grafu.asset.json_files import read_json
from grafu.asset.mobility_json import EXPECTED, bodies_from_json
from grafu.asset.options import LoadOptions
from grafu.asset.orientation import spelled
from grafu.asset.part import Part
from grafu.asset.reading import Convention, Furniture, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.urdf import CONVENTION as URDF_CONVENTION
from grafu.asset.urdf import UrdfBodies, read_bodies
from grafu.geometry.box import Box

CONVENTION = Convention("the data set (PartNet-Mobility)", up="+Y", front="+Z", normalised=True)
_ALONG = 0.99  # of a direction along an axis
_ON_FLOOR, _CENTRED = 0.05, 0.15  # shares of a side: how far what stands on 0, or about it, may lie off
_TABLES = frozenset({"table", "desk"})


def is_partnet_mobility(folder: Path) -> bool:
    """Whether the folder is a model of the data set, by the files that it holds."""
    has_json = (folder / "mobility_v2.json").is_file() and (folder / "result.json").is_file()
    return has_json or (folder / "mobility.urdf").is_file()


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
        found = _bodies_from_urdf(folder, files)
    parts = parts_of_drafts(drafts_of_visuals(found.visuals))
    convention = _convention(found, parts)
    up = "XYZ".index((convention.up or convention.usual_up)[1])
    annotation = annotation_of_bodies(list(found.bodies), up)
    said = tuple(dict.fromkeys(found.notes))
    return Reading("partnet-mobility", parts, convention, annotation, _furniture(folder, files), said)


def _convention(found: UrdfBodies, parts: tuple[Part, ...]) -> Convention:
    """Returns what the files say of their coordinates: the data set's, or those of another maker's URDF of that name.

    The data set's base joint turns its meshes, which are Y up, to stand on Z. Another maker's URDF is Z up, unless all
    its meshes are glTF and stand on y = 0 rather than on z = 0.
    """
    up = np.array(found.up)
    if up[1] > _ALONG or not parts:
        return CONVENTION
    is_gltf = all(visual.file.lower().endswith((".glb", ".gltf")) for visual in found.visuals)
    if up[2] > _ALONG and is_gltf and _stands_on_y(Box.enclosing(part.box for part in parts)):
        return Convention("the meshes, which stand on y = 0 (glTF in a URDF)", up="+Y", unit=1.0)
    axis = int(np.argmax(np.abs(up)))
    stated = spelled(axis, bool(up[axis] > 0)) if abs(up[axis]) > _ALONG else None
    return Convention(URDF_CONVENTION.origin, up=stated, unit=1.0, usual_up="+Z")


def _stands_on_y(whole: Box) -> bool:
    lies = np.abs(whole.low) <= _ON_FLOOR * whole.size
    centred = np.abs(whole.center) <= _CENTRED * whole.size
    return bool(lies[1] and centred[2] and not lies[2])


def _furniture(folder: Path, files: ModelFiles) -> Furniture | None:
    path = folder / "meta.json"
    if not path.is_file():
        return None
    meta = read_json(path, files, EXPECTED)
    category = str(meta.get("model_cat", ""))[:100].lower() if isinstance(meta, dict) else ""
    return "table" if category in _TABLES else "storage" if "storage" in category else None


def _bodies_from_urdf(folder: Path, files: ModelFiles) -> UrdfBodies:
    found = read_bodies(folder / "mobility.urdf", files, mesh_frame=True)
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


def _merged(visuals: tuple[Visual, ...]) -> tuple[Visual, ...]:
    """Returns one visual per name: the data set repeats a `name-id` for every mesh file of a part."""
    groups: dict[tuple[str, str], list[Visual]] = {}
    for visual in visuals:
        groups.setdefault((visual.name, visual.link), []).append(visual)
    return tuple(
        Visual(
            name,
            tuple(s for v in group for s in v.surfaces),
            link,
            group[0].file if len(group) == 1 else "",
            group[0].group,
        )
        for (name, link), group in groups.items()
    )
