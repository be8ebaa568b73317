"""An articulated object as a URDF with its meshes: one link per moving part, every part its own visual.

All names of files are relative. Link frames stand on their joints' axes, parallel to the object frame at rest, so the
root link's frame is the object frame (metres, Z up, front -Y). What must open first (`Joint.after`) URDF cannot say.
"""

import xml.etree.ElementTree as ET
from dataclasses import dataclass, field
from math import atan2, sqrt
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Link
from grafu.articulation.collision_clearance import ClearanceConfig, cleared
from grafu.articulation.collision_shapes import CollisionConfig, CollisionShape, collision_shapes
from grafu.articulation.dynamics import DynamicsConfig, JointDynamics, joint_dynamics
from grafu.articulation.link_frames import link_origins
from grafu.articulation.mass import MassConfig, MassProperties, mass_of_link
from grafu.export.files import ExportFiles
from grafu.export.obj import ObjFolder
from grafu.export.shading import CREASE_ANGLE
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.box import OrientedBox
from grafu.vocabulary import JointType


@final
@dataclass(frozen=True, slots=True)
class UrdfConfig:
    """What goes into a URDF. `mujoco` adds the element that tells MuJoCo where the meshes are; others ignore it."""

    mass: MassConfig = field(default_factory=MassConfig)
    collision: CollisionConfig = field(default_factory=CollisionConfig)
    clearance: ClearanceConfig = field(default_factory=ClearanceConfig)
    dynamics: DynamicsConfig = field(default_factory=DynamicsConfig)
    crease_angle: float = CREASE_ANGLE
    mujoco: bool = True


DEFAULT_URDF_CONFIG = UrdfConfig()


def export_urdf(articulated: ArticulatedObject, config: UrdfConfig = DEFAULT_URDF_CONFIG) -> ExportFiles:
    """Returns `model.urdf` and what it names under `meshes/`: OBJ, MTL, textures, convex pieces for collision."""
    return _UrdfWriter(articulated, config).to_files()


@final
class _UrdfWriter:
    """Builds one robot element and the folder of meshes beside it."""

    def __init__(self, articulated: ArticulatedObject, config: UrdfConfig) -> None:
        self._object = articulated
        self._config = config
        self._origins = link_origins(articulated)
        self._masses = {link.id: mass_of_link(link, config.mass) for link in articulated.links}
        shapes = {link.id: collision_shapes(link, config.collision) for link in articulated.links}
        self._shapes = cleared(articulated, shapes, config.clearance)
        self._meshes = ObjFolder(config.crease_angle)

    def to_files(self) -> ExportFiles:
        name = "".join(c if c.isprintable() else "_" for c in self._object.name)  # XML has no control characters
        robot = ET.Element("robot", name=name)
        if self._config.mujoco:
            compiler = {"strippath": "false", "discardvisual": "true"}
            ET.SubElement(ET.SubElement(robot, "mujoco"), "compiler", compiler)
        for link in self._object.links_from_root:
            self._add_link(robot, link)
        for joint in self._object.joints:
            self._add_joint(robot, joint)
        ET.indent(robot)
        text = ET.tostring(robot, encoding="utf-8", xml_declaration=True) + b"\n"
        return ExportFiles({"model.urdf": text} | {f"meshes/{name}": d for name, d in self._meshes.files.items()})

    def _add_link(self, robot: ET.Element, link: Link) -> None:
        element = ET.SubElement(robot, "link", name=link.id)
        origin = self._origins[link.id]
        _add_inertial(element, self._masses[link.id], origin)
        for visual in link.visuals:
            if len(visual.mesh.faces):
                child = ET.SubElement(element, "visual", name=visual.name)
                _add_mesh(child, self._meshes.add_visual(visual, origin))
        for number, shape in enumerate(self._shapes[link.id]):
            self._add_collision(element, f"{link.id}_collision_{number}", shape, origin)

    def _add_collision(self, link: ET.Element, name: str, shape: CollisionShape, origin: Vec3) -> None:
        element = ET.SubElement(link, "collision", name=name)
        if isinstance(shape, OrientedBox):
            place = {"xyz": _numbers(shape.center - origin), "rpy": _numbers(_roll_pitch_yaw(shape.rotation))}
            ET.SubElement(element, "origin", place)
            ET.SubElement(ET.SubElement(element, "geometry"), "box", size=_numbers(2 * shape.half))
        else:
            _add_mesh(element, self._meshes.add_mesh(name, shape.mesh, origin))

    def _add_joint(self, robot: ET.Element, joint: Joint) -> None:
        element = ET.SubElement(robot, "joint", name=joint.id, type=joint.type.value)
        offset = self._origins[joint.child] - self._origins[joint.parent]
        ET.SubElement(element, "origin", xyz=_numbers(offset), rpy="0 0 0")
        ET.SubElement(element, "parent", link=joint.parent)
        ET.SubElement(element, "child", link=joint.child)
        if joint.type is not JointType.FIXED:
            ET.SubElement(element, "axis", xyz=_numbers(joint.axis.direction))
            dynamics = joint_dynamics(self._object, joint, self._masses, self._config.dynamics)
            _add_dynamics(element, joint, dynamics)


def _add_dynamics(element: ET.Element, joint: Joint, dynamics: JointDynamics) -> None:
    limits = {"lower": joint.limits.lower, "upper": joint.limits.upper}
    limits |= {"effort": dynamics.effort, "velocity": dynamics.velocity}
    ET.SubElement(element, "limit", {key: _number(value) for key, value in limits.items()})
    resistance = {"damping": _number(dynamics.damping), "friction": _number(dynamics.friction)}
    ET.SubElement(element, "dynamics", resistance)


def _add_inertial(link: ET.Element, mass: MassProperties, origin: Vec3) -> None:
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=_numbers(mass.center - origin), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=_number(mass.mass))
    terms = {f"i{'xyz'[a]}{'xyz'[b]}": _number(mass.inertia[a, b]) for a in range(3) for b in range(a, 3)}
    ET.SubElement(inertial, "inertia", terms)


def _add_mesh(element: ET.Element, file: str) -> None:
    ET.SubElement(element, "origin", xyz="0 0 0", rpy="0 0 0")
    ET.SubElement(ET.SubElement(element, "geometry"), "mesh", filename=f"meshes/{file}")


def _roll_pitch_yaw(R: Mat3) -> Vec3:
    """Returns URDF's angles: rotations about the fixed X, then Y, then Z axis, radians."""
    pitch = atan2(-R[2, 0], sqrt(R[0, 0] ** 2 + R[1, 0] ** 2))
    return np.array([atan2(R[2, 1], R[2, 2]), pitch, atan2(R[1, 0], R[0, 0])])


def _numbers(values: Vec3) -> str:
    return " ".join(_number(value) for value in values)


def _number(value: float) -> str:
    return f"{value if abs(value) > 1e-12 else 0.0:.10g}"
