"""PartNet-Mobility folders: `mobility_v2.json` with `result.json`, or `mobility.urdf` alone.

Mesh files are Y up, front +Z, scaled to about a unit sphere. JSON hinge limits are degrees. It settles no frame.
"""

from collections import Counter
from dataclasses import replace
from pathlib import Path

from grafu.asset.bodies import Body, Visual, annotation_of_bodies, drafts_of_visuals
from grafu.asset.drafts import parts_of_drafts
from grafu.asset.json_files import read_json
from grafu.asset.mobility_json import EXPECTED, bodies_from_json
from grafu.asset.options import LoadOptions
from grafu.asset.reading import Convention, Furniture, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.urdf import UrdfBodies, read_bodies

CONVENTION = Convention("the data set (PartNet-Mobility)", up="+Y", front="+Z", normalised=True)
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
        found = UrdfBodies(tuple(bodies), tuple(v for body in bodies for v in body.visuals), tuple(notes))
    else:
        found = _bodies_from_urdf(folder, files)
    parts = parts_of_drafts(drafts_of_visuals(found.visuals))
    annotation = annotation_of_bodies(list(found.bodies), up=1)
    said = tuple(dict.fromkeys(found.notes))
    return Reading("partnet-mobility", parts, CONVENTION, annotation, _furniture(folder, files), said)


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
    return UrdfBodies(tuple(bodies), _merged(found.visuals), found.notes)


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
