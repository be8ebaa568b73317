"""Compiles MJCF for tests; whatever MuJoCo warns of is an error."""

import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco
import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.export.files import ExportFiles, write_files


def compiled(files: ExportFiles, folder: Path) -> mujoco.MjModel:
    warnings: list[str] = []
    write_files(files, folder)
    mujoco.set_mju_user_warning(warnings.append)
    try:
        model = mujoco.MjModel.from_xml_path(str(folder / "model.xml"))
    finally:
        mujoco.set_mju_user_warning(None)
    assert warnings == []
    return model


def posed(model: mujoco.MjModel, values: dict[str, float]) -> mujoco.MjData:
    data = mujoco.MjData(model)
    for joint, value in values.items():
        data.qpos[model.joint(joint).qposadr] = value
    mujoco.mj_forward(model, data)
    return data


def at_keyframe(model: mujoco.MjModel, name: str) -> mujoco.MjData:
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(name).id)
    mujoco.mj_forward(model, data)
    return data


def run(model: mujoco.MjModel, data: mujoco.MjData, seconds: float) -> None:
    mujoco.mj_step(model, data, round(seconds / model.opt.timestep))
    assert not any(warning.number for warning in data.warning)


def pose_of(data: mujoco.MjData, body: str) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = data.body(body).xmat.reshape(3, 3), data.body(body).xpos
    return T


def drawn_vertices(model: mujoco.MjModel, data: mujoco.MjData, geom: str) -> np.ndarray:
    """Returns where the vertices of a mesh stand; MuJoCo keeps them about the mesh's own middle."""
    mesh = model.mesh(model.geom(geom).dataid[0])
    local = model.mesh_vert[mesh.vertadr[0] : mesh.vertadr[0] + mesh.vertnum[0]].astype(np.float64)
    return local @ data.geom(geom).xmat.reshape(3, 3).T + data.geom(geom).xpos


def files_named(files: ExportFiles) -> set[str]:
    """Returns the files that the XML names."""
    root = ET.fromstring(files["model.xml"])
    return {f"meshes/{element.get('file')}" for element in root.iter() if element.get("file")}


def values_at(articulated: ArticulatedObject, ratio: float) -> dict[str, float]:
    """Returns the values of all joints at one fraction of their ranges."""
    joints = articulated.moving_joints
    return {joint.id: joint.limits.lower + ratio * joint.limits.range for joint in joints}
