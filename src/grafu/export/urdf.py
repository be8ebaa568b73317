"""An articulated object as a URDF with its meshes: one link per moving part, every part its own visual.

All names of files are relative. Link frames stand on their joints' axes, parallel to the object frame at rest, so the
root link's frame is the object frame (metres, Z up, front -Y). Where it is stated that the piece is fixed, a link
`world` stands above the root. What must open first (`Joint.after`) URDF cannot say.
"""

import xml.etree.ElementTree as ET
from dataclasses import field
from typing import Final, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Link
from grafu.articulation.base import BaseKind
from grafu.articulation.collision_shapes import CollisionShape
from grafu.articulation.joint_dynamics import JointDynamics
from grafu.articulation.mass import MassProperties
from grafu.articulation.physics import PhysicsConfig, physics_of
from grafu.dataclass import dataclass
from grafu.export.files import ExportFiles
from grafu.export.names import NameBook, number, numbers, printable
from grafu.export.obj import MESHES, collision_name, obj_set
from grafu.export.shading import CREASE_ANGLE
from grafu.geometry.arrays import Vec3
from grafu.geometry.box import OrientedBox
from grafu.geometry.transform import roll_pitch_yaw
from grafu.visible import ShortRepr

_NEXT_TO_NOTHING: Final = MassProperties(1e-6, np.zeros(3), 1e-10 * np.eye(3))
"""The mass of a frame: kilograms, and kilograms by square metres."""


@final
@dataclass(frozen=True, slots=True)
class UrdfConfig(ShortRepr):
    """What goes into a URDF.

    `mujoco` adds the element that tells MuJoCo where the meshes are; others ignore it. `grasps` adds a link
    for each grasp frame; without them each link is a body that moves, which many readers expect.
    """

    physics: PhysicsConfig = field(default_factory=PhysicsConfig)
    crease_angle: float = CREASE_ANGLE
    mujoco: bool = True
    grasps: bool = False


DEFAULT_URDF_CONFIG = UrdfConfig()
_WORLD = "world"


def export_urdf(articulated: ArticulatedObject, config: UrdfConfig = DEFAULT_URDF_CONFIG) -> ExportFiles:
    """Returns `model.urdf` and what it names under `meshes/`: OBJ, MTL, textures, convex pieces for collision."""
    return _UrdfWriter(articulated, config).to_files()


@final
class _UrdfWriter:
    """Builds one robot element and the folder of meshes beside it."""

    def __init__(self, articulated: ArticulatedObject, config: UrdfConfig) -> None:
        self._object = articulated
        self._config = config
        self._physics = physics_of(articulated, config.physics)
        self._objs = obj_set(articulated, self._physics, config.crease_angle)

    def to_files(self) -> ExportFiles:
        robot = ET.Element("robot", name=printable(self._object.name))
        if self._config.mujoco:
            compiler = {"strippath": "false", "discardvisual": "true"}
            ET.SubElement(ET.SubElement(robot, "mujoco"), "compiler", compiler)
        if self._object.base in (BaseKind.FIXED, BaseKind.WALL):
            self._add_world(robot)
        for link in self._object.links_from_root:
            self._add_link(robot, link)
        for joint in self._object.joints:
            self._add_joint(robot, joint)
        if self._config.grasps:
            self._add_grasps(robot)
        ET.indent(robot)
        text = ET.tostring(robot, encoding="utf-8", xml_declaration=True) + b"\n"
        meshes = {f"{MESHES}/{name}": data for name, data in self._objs.folder.files.items()}
        return ExportFiles({"model.urdf": text} | meshes, notes=self._physics.notes)

    def _add_world(self, robot: ET.Element) -> None:
        """Adds the link that Drake, Gazebo and MoveIt know to be static, and the joint that holds the root to it."""
        taken = NameBook()
        for name in (*(link.id for link in self._object.links), *(joint.id for joint in self._object.joints)):
            taken.unique(name)
        world = taken.unique(_WORLD)
        ET.SubElement(robot, "link", name=world)
        element = ET.SubElement(robot, "joint", name=taken.unique(f"{_WORLD}_fixed"), type="fixed")
        ET.SubElement(element, "origin", xyz="0 0 0", rpy="0 0 0")
        ET.SubElement(element, "parent", link=world)
        ET.SubElement(element, "child", link=self._object.root)

    def _add_link(self, robot: ET.Element, link: Link) -> None:
        element = ET.SubElement(robot, "link", name=link.id)
        _add_inertial(element, self._physics.masses[link.id], self._physics.origins[link.id])
        for visual, file in self._objs.visuals[link.id]:
            _add_mesh(ET.SubElement(element, "visual", name=visual.name), file)
        for place, shape in enumerate(self._physics.shapes[link.id]):
            self._add_collision(element, link.id, place, shape)

    def _add_grasps(self, robot: ET.Element) -> None:
        """Adds each grasp as a link on a fixed joint: a frame, as ROS has them for tools.

        PyBullet gives a link without a mass one kilogram, so these state that they have next to none.
        """
        book = NameBook(case_counts=True)
        for name in (*(link.id for link in self._object.links), *(joint.id for joint in self._object.joints)):
            book.unique(name)
        for grasp in self._object.grasps:
            name = book.unique(grasp.name)
            _add_inertial(ET.SubElement(robot, "link", name=name), _NEXT_TO_NOTHING, np.zeros(3))
            element = ET.SubElement(robot, "joint", name=book.unique(f"{name}_fixed"), type="fixed")
            place = {"xyz": numbers(grasp.position - self._physics.origins[grasp.link])}
            ET.SubElement(element, "origin", place | {"rpy": numbers(roll_pitch_yaw(grasp.rotation))})
            ET.SubElement(element, "parent", link=grasp.link)
            ET.SubElement(element, "child", link=name)

    def _add_collision(self, parent: ET.Element, link: str, place: int, shape: CollisionShape) -> None:
        element = ET.SubElement(parent, "collision", name=collision_name(link, place))
        if isinstance(shape, OrientedBox):
            center = shape.center - self._physics.origins[link]
            ET.SubElement(element, "origin", xyz=numbers(center), rpy=numbers(roll_pitch_yaw(shape.rotation)))
            ET.SubElement(ET.SubElement(element, "geometry"), "box", size=numbers(2 * shape.half))
        else:
            _add_mesh(element, self._objs.pieces[link, place])

    def _add_joint(self, robot: ET.Element, joint: Joint) -> None:
        element = ET.SubElement(robot, "joint", name=joint.id, type=joint.kind.word("urdf"))
        offset = self._physics.origins[joint.child] - self._physics.origins[joint.parent]
        ET.SubElement(element, "origin", xyz=numbers(offset), rpy="0 0 0")
        ET.SubElement(element, "parent", link=joint.parent)
        ET.SubElement(element, "child", link=joint.child)
        if joint.kind.moves:
            ET.SubElement(element, "axis", xyz=numbers(joint.axis.direction))
            _add_dynamics(element, joint, self._physics.dynamics[joint.id])
            _add_mimic(element, joint)


def _add_dynamics(element: ET.Element, joint: Joint, dynamics: JointDynamics) -> None:
    limits = {"lower": joint.limits.lower, "upper": joint.limits.upper}  # ignored of continuous joints, but often read
    limits |= {"effort": dynamics.effort, "velocity": dynamics.velocity}
    ET.SubElement(element, "limit", {key: number(value) for key, value in limits.items()})
    resistance = {"damping": number(dynamics.damping), "friction": number(dynamics.friction)}
    ET.SubElement(element, "dynamics", resistance)


def _add_mimic(element: ET.Element, joint: Joint) -> None:
    if joint.coupling is not None:
        multiplier, offset = number(joint.coupling.multiplier), number(joint.coupling.offset)
        ET.SubElement(element, "mimic", joint=joint.coupling.leader, multiplier=multiplier, offset=offset)


def _add_inertial(link: ET.Element, mass: MassProperties, origin: Vec3) -> None:
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=numbers(mass.center - origin), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=number(mass.mass))
    terms = {f"i{'xyz'[a]}{'xyz'[b]}": number(mass.inertia[a, b]) for a in range(3) for b in range(a, 3)}
    ET.SubElement(inertial, "inertia", terms)


def _add_mesh(element: ET.Element, file: str) -> None:
    ET.SubElement(element, "origin", xyz="0 0 0", rpy="0 0 0")
    ET.SubElement(ET.SubElement(element, "geometry"), "mesh", filename=f"{MESHES}/{file}")
