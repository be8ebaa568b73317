"""An articulated object as an SDF model for Gazebo: the links, joints, masses and shapes of the URDF, and more.

SDF has what URDF lacks: springs of lids, and frames, which carry the grasps. Link frames stand on their joints' axes,
parallel to the object frame at rest (metres, Z up, front -Y); the meshes are those that a URDF names. Materials are
those of the OBJ files. What must open first SDF cannot say.
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
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.box import OrientedBox
from grafu.geometry.transform import roll_pitch_yaw
from grafu.visible import ShortRepr

VERSION, VERSION_OF_MIMIC = "1.9", "1.11"
"""Of the format: Gazebo Fortress and newer read the first; joints that follow others came with the second."""
ROOT_JOINT: Final = "root_fixed"
_WORLD = "world"


@final
@dataclass(frozen=True, slots=True)
class SdfConfig(ShortRepr):
    """What goes into an SDF file. `fixed` holds the root to the world, wherever a world has it, unless it is free."""

    physics: PhysicsConfig = field(default_factory=PhysicsConfig)
    crease_angle: float = CREASE_ANGLE
    fixed: bool = True


DEFAULT_SDF_CONFIG = SdfConfig()


def export_sdf(articulated: ArticulatedObject, config: SdfConfig = DEFAULT_SDF_CONFIG) -> ExportFiles:
    """Returns `model.sdf` and what it names under `meshes/`: the files of a URDF."""
    return _SdfWriter(articulated, config).to_files()


@final
class _SdfWriter:
    """Builds one model element and the folder of meshes beside it."""

    def __init__(self, articulated: ArticulatedObject, config: SdfConfig) -> None:
        self._object = articulated
        self._config = config
        self._physics = physics_of(articulated, config.physics)
        self._objs = obj_set(articulated, self._physics, config.crease_angle)
        book = NameBook(case_counts=True)
        for taken in (_WORLD, ROOT_JOINT):
            book.unique(taken)
        self._links = {link.id: book.unique(_allowed(link.id)) for link in articulated.links}
        self._joints = {joint.id: book.unique(_allowed(joint.id)) for joint in articulated.joints}
        self._grasps = [(book.unique(_allowed(grasp.name)), grasp) for grasp in articulated.grasps]

    def to_files(self) -> ExportFiles:
        coupled = any(joint.coupling is not None for joint in self._object.moving_joints)
        root = ET.Element("sdf", version=VERSION_OF_MIMIC if coupled else VERSION)
        model = ET.SubElement(root, "model", name=_allowed(self._object.name))
        for link in self._object.links_from_root:
            self._add_link(model, link)
        for name, grasp in self._grasps:
            frame = ET.SubElement(model, "frame", name=name, attached_to=self._links[grasp.link])
            _add_pose(frame, grasp.position - self._physics.origins[grasp.link], grasp.rotation)
        if self._config.fixed and self._object.base is not BaseKind.FREE:
            _add_joint(model, ROOT_JOINT, "fixed", _WORLD, self._links[self._object.root])
        for joint in self._object.joints:
            self._add_joint(model, joint)
        ET.indent(root)
        text = ET.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"
        meshes = {f"{MESHES}/{name}": data for name, data in self._objs.folder.files.items()}
        return ExportFiles({"model.sdf": text} | meshes, notes=self._physics.notes)

    def _add_link(self, model: ET.Element, link: Link) -> None:
        element, origin = ET.SubElement(model, "link", name=self._links[link.id]), self._physics.origins[link.id]
        _add_pose(element, origin)
        _add_inertial(element, self._physics.masses[link.id], origin)
        book = NameBook(case_counts=True)
        for visual, file in self._objs.visuals[link.id]:
            _add_mesh(ET.SubElement(element, "visual", name=book.unique(_allowed(visual.name))), file)
        for place, shape in enumerate(self._physics.shapes[link.id]):
            self._add_collision(element, link.id, place, shape)

    def _add_collision(self, parent: ET.Element, link: str, place: int, shape: CollisionShape) -> None:
        element = ET.SubElement(parent, "collision", name=collision_name(_allowed(link), place))
        if isinstance(shape, OrientedBox):
            _add_pose(element, shape.center - self._physics.origins[link], shape.rotation)
            _add_text(ET.SubElement(ET.SubElement(element, "geometry"), "box"), "size", numbers(2 * shape.half))
        else:
            _add_mesh(element, self._objs.pieces[link, place])

    def _add_joint(self, model: ET.Element, joint: Joint) -> None:
        """Adds a joint; its frame is its child's. SDF's words for kinds of joints are a URDF's."""
        ends = self._links[joint.parent], self._links[joint.child]
        element = _add_joint(model, self._joints[joint.id], joint.kind.word("urdf"), *ends)
        if not joint.kind.moves:
            return
        axis, dynamics = ET.SubElement(element, "axis"), self._physics.dynamics[joint.id]
        _add_text(axis, "xyz", numbers(joint.axis.direction))
        limit = ET.SubElement(axis, "limit")
        if joint.kind.limited:
            _add_text(limit, "lower", number(joint.limits.lower))
            _add_text(limit, "upper", number(joint.limits.upper))
        _add_text(limit, "effort", number(dynamics.effort))
        _add_text(limit, "velocity", number(dynamics.velocity))
        _add_resistance(ET.SubElement(axis, "dynamics"), dynamics)
        if joint.coupling is not None:
            mimic = ET.SubElement(axis, "mimic", joint=self._joints[joint.coupling.leader])
            _add_text(mimic, "multiplier", number(joint.coupling.multiplier))
            _add_text(mimic, "offset", number(joint.coupling.offset))
            _add_text(mimic, "reference", "0")


def _add_resistance(element: ET.Element, dynamics: JointDynamics) -> None:
    """Adds damping and friction; a heavy lid has a spring, which is the straight line nearest to gravity's torque."""
    spring = dynamics.counterbalance.spring if dynamics.counterbalance else None
    _add_text(element, "damping", number(dynamics.damping))
    _add_text(element, "friction", number(spring.friction if spring else dynamics.friction))
    if spring:
        _add_text(element, "spring_reference", number(spring.target))
        _add_text(element, "spring_stiffness", number(spring.stiffness))


def _add_inertial(link: ET.Element, mass: MassProperties, origin: Vec3) -> None:
    inertial = ET.SubElement(link, "inertial")
    _add_pose(inertial, mass.center - origin)
    _add_text(inertial, "mass", number(mass.mass))
    inertia = ET.SubElement(inertial, "inertia")
    for a in range(3):
        for b in range(a, 3):
            _add_text(inertia, f"i{'xyz'[a]}{'xyz'[b]}", number(mass.inertia[a, b]))


def _add_joint(model: ET.Element, name: str, kind: str, parent: str, child: str) -> ET.Element:
    element = ET.SubElement(model, "joint", name=name, type=kind)
    _add_text(element, "parent", parent)
    _add_text(element, "child", child)
    return element


def _add_mesh(element: ET.Element, file: str) -> None:
    _add_text(ET.SubElement(ET.SubElement(element, "geometry"), "mesh"), "uri", f"{MESHES}/{file}")


def _add_pose(element: ET.Element, position: Vec3, R: Mat3 | None = None) -> None:
    angles = np.zeros(3) if R is None else roll_pitch_yaw(R)
    _add_text(element, "pose", numbers([*position, *angles]))


def _add_text(element: ET.Element, tag: str, text: str) -> None:
    ET.SubElement(element, tag).text = text


def _allowed(name: str) -> str:
    """Returns a name that SDF can hold: `::` divides names of models, and `__name__` is kept for the format."""
    plain = printable(name).replace("::", "_") or "unnamed"
    return f"n{plain}" if plain.startswith("__") and plain.endswith("__") else plain
