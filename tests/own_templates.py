"""Templates of the user's own, made from built-in ones: exported in millimetres, Y up, shifted."""

import json
from pathlib import Path

import numpy as np
import trimesh

from grafu.geometry.mesh import merge_meshes
from grafu.geometry.transform import from_rotation, transform_points
from grafu.templates.template import HandleTemplate, HingeModel

# Template frame in metres to mesh coordinates in millimetres with Y up, shifted.
R = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
T_mesh_template = from_rotation(1000 * R, np.array([5.0, 40.0, -7.0]))


def point(p):
    return transform_points(T_mesh_template, np.array([p], float))[0].tolist()


def way(d):
    return (R @ np.asarray(d)).tolist()


def plane(snap):
    extents = {k: (1000 * R @ getattr(snap, k)).tolist() for k in ("u", "v")}
    return {"center": point(snap.center), "normal": way(snap.normal), **extents}


def note_of(model):
    template, size = model.build(model.natural), model.natural
    note = {"class": model.mechanism.value, "title": "Mine", "unit": 0.001}
    note |= {"static_snap": plane(template.static.snap), "dynamic_snap": plane(template.dynamic.snap)}
    note |= {name: 1000 * getattr(size, name) for name in size.__slots__}
    if isinstance(model, HingeModel):
        axis = {"point": point([0, 0, 0]), "direction": way([0, 0, 1])}
        return note | {"kind": "hinge", "axis": axis, "opening": way([0, 1, 0]), "range_deg": 90}
    if template.support:
        note["support_snap"] = plane(template.support)
    return note | {"kind": "rail", "axis": {"direction": way([0, -1, 0])}, "range_share": 0.8}


def write(folder, model, suffix="ply", **changes):
    folder = folder / "mine"
    folder.mkdir()
    template = model.build(model.natural)
    meshes = {n: getattr(template, n).mesh.transformed(T_mesh_template).to_trimesh() for n in ("static", "dynamic")}
    if suffix == "one.glb":
        trimesh.Scene(meshes).export(folder / "both.glb")
    else:
        for name, mesh in meshes.items():
            mesh.export(folder / f"{name}.{suffix}")
    note = {k: v for k, v in (note_of(model) | changes).items() if v is not None}
    (folder / "template.json").write_text(json.dumps(note))
    return folder


def write_handle(folder: Path, template: HandleTemplate, suffix: str = "obj", name: str = "mine", **changes) -> Path:
    folder = folder / name
    folder.mkdir(parents=True)
    merge_meshes(template.build()).transformed(T_mesh_template).to_trimesh().export(folder / f"handle.{suffix}")
    note = {
        "kind": "handle",
        "family": template.family,
        "title": "Mine",
        "unit": 0.001,
        "foot": transform_points(T_mesh_template, np.zeros((1, 3)))[0].tolist(),
        "outwards": (R @ (0, -1, 0)).tolist(),
        "along": (R @ (1, 0, 0)).tolist(),
        "longest": 1000 * template.longest,
        "turns": template.turns,
    } | changes
    (folder / "template.json").write_text(json.dumps({k: v for k, v in note.items() if v is not None}))
    return folder
