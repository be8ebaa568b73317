"""A result in MuJoCo: its file on a floor, with a cube to drop, and what moves it with forces at its grips."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import OptionError, UnreadableAsset
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.simulation.config import CheckConfig

Meshes = Mapping[str, Mapping[str, TriangleMesh]]
_FLOOR, _CUBE = "grafu_check_floor", "grafu_check_cube"
_AWAY = (50.0, 50.0)  # metres: where the cube waits


def require_mujoco() -> Any:
    """Returns the module `mujoco`.

    Raises:
        OptionError: if it is not installed.
    """
    try:
        import mujoco
    except ImportError:
        raise OptionError("a check needs MuJoCo: pip install 'grafu[sim]'") from None
    return mujoco


@final
@dataclass(frozen=True, slots=True)
class SimJoint:
    """A joint that moves by itself between limits, by its number and its child's in the model."""

    name: str
    index: int
    body: int
    slides: bool
    lower: float
    upper: float


@final
class World:
    """One file on a floor, compiled; it is changed by every step. With `free` its root has a free joint.

    Raises:
        OptionError: if MuJoCo is not installed.
        UnreadableAsset: if MuJoCo refuses the file.
    """

    def __init__(self, path: Path, free: bool, config: CheckConfig) -> None:
        self.mujoco = require_mujoco()
        try:
            spec = self.mujoco.MjSpec.from_file(str(path))
            self.model = _compiled(self.mujoco, spec, free, config)
        except ValueError as error:
            raise UnreadableAsset(f"MuJoCo does not load {path}: {' '.join(str(error).split())}") from None
        self.data = self.mujoco.MjData(self.model)
        self.root = next(k for k in range(1, self.model.nbody) if self.model.body(k).name != _CUBE)
        self.joints = tuple(self._joints())
        self.reset()

    def reset(self) -> None:
        """Puts all back where it was: closed, at rest, the cube away."""
        self.mujoco.mj_resetData(self.model, self.data)
        self.mujoco.mj_forward(self.model, self.data)

    def step(self, seconds: float) -> None:
        """Lets time pass; forces at bodies stay as they are."""
        self.mujoco.mj_step(self.model, self.data, max(1, round(seconds / self.model.opt.timestep)))

    @property
    def is_stable(self) -> bool:
        """Whether the solver has not given up."""
        return not any(warning.number for warning in self.data.warning) and bool(np.isfinite(self.data.qpos).all())

    def value(self, joint: SimJoint) -> float:
        """Returns how far a joint is open, fraction of its range."""
        at = float(self.data.qpos[self.model.jnt_qposadr[joint.index]])
        return (at - joint.lower) / (joint.upper - joint.lower)

    def set_open(self, joint: SimJoint) -> None:
        """Puts a joint at its upper limit, at rest; those that follow it take part in the next steps."""
        self.data.qpos[self.model.jnt_qposadr[joint.index]] = joint.upper
        for follower, polynomial in self._followers(joint.index):
            self.data.qpos[self.model.jnt_qposadr[follower]] = polynomial[0] + polynomial[1] * joint.upper
        self.mujoco.mj_forward(self.model, self.data)

    def pose(self, body: int) -> Mat4:
        """Returns where a body stands, 4x4, world frame."""
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = self.data.xmat[body].reshape(3, 3), self.data.xpos[body]
        return T

    def push(self, joint: SimJoint, grip: Vec3, force: float) -> float:
        """Sets the force along a grip's path (N, positive opens), alone in the world; returns the grip's speed (m/s).

        `grip` is in the frame of the joint's body.
        """
        T = self.pose(joint.body)
        point = T[:3, :3] @ grip + T[:3, 3]
        axis, anchor = self.data.xaxis[joint.index], self.data.xanchor[joint.index]
        along = axis if joint.slides else np.cross(axis, point - anchor)
        arm = float(np.linalg.norm(along))
        pulled = force * along / max(arm, 1e-9)
        self.data.xfrc_applied[:] = 0.0
        self.data.xfrc_applied[joint.body, :3] = pulled
        self.data.xfrc_applied[joint.body, 3:] = np.cross(point - self.data.xipos[joint.body], pulled)
        return float(self.data.qvel[self.model.jnt_dofadr[joint.index]]) * arm

    def let_go(self) -> None:
        """Takes all forces away."""
        self.data.xfrc_applied[:] = 0.0

    def place_cube(self, at: Vec3) -> None:
        """Puts the cube's middle at a point of the world, at rest."""
        joint = self.model.body(_CUBE).jntadr[0]
        start, speed = self.model.jnt_qposadr[joint], self.model.jnt_dofadr[joint]
        self.data.qpos[start : start + 7] = [*at, 1.0, 0.0, 0.0, 0.0]
        self.data.qvel[speed : speed + 6] = 0.0
        self.mujoco.mj_forward(self.model, self.data)

    @property
    def cube(self) -> Vec3:
        """The middle of the cube, world frame."""
        return np.array(self.data.body(_CUBE).xpos)

    def _joints(self) -> "list[SimJoint]":
        hinge, slide = int(self.mujoco.mjtJoint.mjJNT_HINGE), int(self.mujoco.mjtJoint.mjJNT_SLIDE)
        found = []
        for k in range(self.model.njnt):
            joint, kind = self.model.joint(k), int(self.model.jnt_type[k])
            if kind in (hinge, slide) and self.model.jnt_limited[k] and not self._follows(k):
                low, high = (float(v) for v in self.model.jnt_range[k])
                body = int(self.model.jnt_bodyid[k])
                found.append(SimJoint(joint.name, k, body, kind == slide, low, high))
        return found

    def _equalities(self) -> "list[tuple[int, int, np.ndarray]]":
        """Returns (follower, leader, polynomial) of joints that are coupled."""
        kind = int(self.mujoco.mjtEq.mjEQ_JOINT)
        rows = [k for k in range(self.model.neq) if int(self.model.eq_type[k]) == kind]
        return [(int(self.model.eq_obj1id[k]), int(self.model.eq_obj2id[k]), self.model.eq_data[k]) for k in rows]

    def _follows(self, joint: int) -> bool:
        return any(follower == joint for follower, _, _ in self._equalities())

    def _followers(self, joint: int) -> "list[tuple[int, np.ndarray]]":
        return [(follower, data) for follower, leader, data in self._equalities() if leader == joint]

    def coupled(self, joint: SimJoint) -> set[int]:
        """Returns the joints that follow a joint."""
        return {follower for follower, _ in self._followers(joint.index)}


def _compiled(mujoco: Any, spec: Any, free: bool, config: CheckConfig) -> Any:
    spec.compiler.fusestatic = False
    root = next(body for body in spec.worldbody.bodies)
    freed = any(joint.type == mujoco.mjtJoint.mjJNT_FREE for joint in root.joints)
    if free and not freed:
        root.add_freejoint()
    elif freed and not free:
        for joint in list(root.joints):
            spec.delete(joint)
    for key in list(spec.keys):
        spec.delete(key)  # the number of joints is another
    floor = {"type": mujoco.mjtGeom.mjGEOM_PLANE, "size": [0, 0, 1], "friction": [config.friction, 0.005, 0.0001]}
    spec.worldbody.add_geom(name=_FLOOR, **floor)
    half = config.cube / 2
    cube = spec.worldbody.add_body(name=_CUBE, pos=[*_AWAY, half])
    cube.add_freejoint()
    cube.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[half] * 3, density=config.cube_density)
    return spec.compile()


def visual_meshes(folder: Path) -> Meshes:
    """Returns the visuals of each link in its own frame, by link and name, as the model's file in a folder names them.

    Raises:
        UnreadableAsset: if a file cannot be read.
    """
    import trimesh  # local: slow to import

    try:
        named = _named_in_urdf(folder) if (folder / "model.urdf").is_file() else _named_in_mjcf(folder)
        found: dict[str, dict[str, TriangleMesh]] = {}
        for link, name, file in named:
            read: Any = trimesh.load(folder / file, force="mesh", process=False)
            mesh = TriangleMesh(np.array(read.vertices, dtype=np.float64), np.array(read.faces))
            found.setdefault(link, {})[name] = mesh
    except (OSError, ET.ParseError, ValueError, AttributeError) as error:
        raise UnreadableAsset(f"the meshes of {folder} cannot be read: {error}") from None
    return found


def _named_in_urdf(folder: Path) -> "list[tuple[str, str, str]]":
    robot = ET.parse(folder / "model.urdf").getroot()
    return [
        (link.attrib["name"], visual.attrib.get("name", ""), mesh.attrib["filename"])
        for link in robot.iter("link")
        for visual in link.iter("visual")
        for mesh in visual.iter("mesh")
    ]


def _named_in_mjcf(folder: Path) -> "list[tuple[str, str, str]]":
    model = ET.parse(folder / "model.xml").getroot()
    files = {
        mesh.attrib["name"]: f"meshes/{mesh.attrib['file']}" for mesh in model.iter("mesh") if "file" in mesh.attrib
    }
    return [
        (body.attrib["name"], geom.attrib["name"], files[geom.attrib["mesh"]])
        for body in model.iter("body")
        for geom in body.findall("geom")
        if geom.attrib.get("class") == "visual"
    ]
