"""An articulated object as MuJoCo's own format: one body per link, each part its own geom, joints as the URDF has them.

Body frames stand on their joints' axes, parallel to the object frame at rest; the root's is the object frame (metres,
radians, Z up, front -Y); it is static, or has a free joint where the piece stands freely. What must open first is text
that MuJoCo keeps and does not obey.
The XML is written here: MuJoCo's `MjSpec` writes MJCF too, but needs MuJoCo (99 MB), which the base install leaves out.
"""

import xml.etree.ElementTree as ET
from dataclasses import field
from typing import Final, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Link, Visual
from grafu.articulation.base import BaseKind
from grafu.articulation.collision_shapes import CollisionShape
from grafu.articulation.kinematics import with_coupled
from grafu.articulation.mass import MassProperties
from grafu.articulation.open_together import open_together
from grafu.articulation.physics import PhysicsConfig, physics_of
from grafu.articulation.sweep import JointValues
from grafu.dataclass import dataclass
from grafu.export.files import ExportFiles
from grafu.export.mjcf_catches import MjcfCatches
from grafu.export.mjcf_materials import MjcfMaterials, drawn_meshes
from grafu.export.mjcf_springs import MjcfSprings, add_spring_defaults
from grafu.export.names import NameBook, number, numbers, printable
from grafu.export.obj import MESHES, collision_name, obj_set
from grafu.export.shading import CREASE_ANGLE
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.box import OrientedBox
from grafu.geometry.budget import within
from grafu.geometry.transform import quaternion_of
from grafu.visible import ShortRepr

VISUAL_GROUP, COLLISION_GROUP, GRASP_GROUP = "2", "3", "4"  # the first is shown by default, the others are not
_FREE_JOINT, _AT_REST = "root_free", (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)  # position, quaternion
_FOR_POSE = 0.3  # of the time that is left
_STIFF = "0.999 0.9995 0.001"
"""MuJoCo's dry friction yields a little all the time: flaps that it holds would creep open, 0.3 degrees in 2 s."""

_IN_STEP = "0.005 1"
"""How fast a coupled joint is brought in step: a quarter of MuJoCo's usual 20 ms, two and a half of its time steps."""


@final
@dataclass(frozen=True, slots=True)
class MjcfConfig(ShortRepr):
    """What goes into an MJCF file.

    `armature` is a fraction of the inertia (or mass) that a joint moves, added to it: it steadies light parts.
    `actuators` adds a position servo to every joint; without them furniture is passive. A servo has its greatest effort
    at an error of `servo_error` of the joint's range. `keyframes` adds the poses `closed` and `open`, in which
    every joint is as far open as the others leave room.
    """

    physics: PhysicsConfig = field(default_factory=PhysicsConfig)
    crease_angle: float = CREASE_ANGLE
    armature: float = 0.01
    actuators: bool = False
    servo_error: float = 0.1
    keyframes: bool = True

    def __post_init__(self) -> None:
        if not (self.armature >= 0 and self.servo_error > 0):
            raise ValueError(
                f"`armature` must not be negative, `servo_error` positive: got {self.armature}, {self.servo_error}"
            )


DEFAULT_MJCF_CONFIG: Final = MjcfConfig()


def export_mjcf(articulated: ArticulatedObject, config: MjcfConfig = DEFAULT_MJCF_CONFIG) -> ExportFiles:
    """Returns `model.xml` and what it names under `meshes/`: OBJ files, those of a URDF where they will do, and PNGs.

    A joint without range is welded: MuJoCo would take it for one without limits.
    """
    return _MjcfWriter(articulated, config).to_files()


@final
class _MjcfWriter:
    """Builds one `mujoco` element and picks the files that it names."""

    def __init__(self, articulated: ArticulatedObject, config: MjcfConfig) -> None:
        self._object = articulated
        self._config = config
        self._physics = physics_of(articulated, config.physics)
        self._objs = obj_set(articulated, self._physics, config.crease_angle)
        self._asset = ET.Element("asset")
        self._materials = MjcfMaterials(self._asset, self._objs.folder)
        self._used: set[str] = set()
        self._geoms, self._sites = NameBook(case_counts=True), NameBook(case_counts=True)
        self._bodies = _names([link.id for link in articulated.links], taken="world")
        self._is_free = articulated.base is BaseKind.FREE
        self._joints = _names([joint.id for joint in articulated.joints], taken=_FREE_JOINT if self._is_free else "")
        self._moving: list[Joint] = []
        self._springs = MjcfSprings(articulated, self._physics, self._joints)
        self._catches = MjcfCatches(articulated.moving_joints, self._physics, self._joints)
        self._notes: list[str] = []

    def to_files(self) -> ExportFiles:
        name = printable(self._object.name)
        model = ET.Element("mujoco", model=name)
        ET.SubElement(model, "compiler", angle="radian", meshdir=MESHES, texturedir=MESHES, autolimits="true")
        ET.SubElement(model, "option", integrator="implicitfast")
        self._catches.add_defaults(_add_defaults(model), GRASP_GROUP)
        model.append(self._asset)
        root = self._body(self._object.link(self._object.root))
        root.set("childclass", "furniture")
        ET.SubElement(model, "worldbody").append(root)
        self._add_contacts(model)
        self._add_couplings(model)
        self._springs.add_tendons(model)
        if (self._config.actuators and self._moving) or self._catches:
            self._add_actuators(ET.SubElement(model, "actuator"))
        if self._config.keyframes and self._moving:
            self._add_keyframes(ET.SubElement(model, "keyframe"))
        self._add_order(model)
        ET.indent(model)
        text = ET.tostring(model, encoding="utf-8", xml_declaration=True) + b"\n"
        named = {name: data for name, data in self._objs.folder.files.items() if name in self._used}
        meshes = {f"{MESHES}/{n}": d for n, d in (named | self._materials.images).items()}
        return ExportFiles({"model.xml": text} | meshes, notes=(*self._physics.notes, *self._notes))

    def _body(self, link: Link) -> ET.Element:
        """Returns the body of a link with all that hangs on it; joints are noted in the order in which they stand."""
        joint, origin = self._object.joint_of.get(link.id), self._physics.origins[link.id]
        body = ET.Element("body", name=self._bodies[link.id])
        if joint is None and self._is_free:
            ET.SubElement(body, "freejoint", name=_FREE_JOINT)
        if joint is not None:
            body.set("pos", numbers(origin - self._physics.origins[joint.parent]))
            self._add_joint(body, joint)
        self._springs.add_sites(body, link.id)
        _add_inertial(body, self._physics.masses[link.id], origin)
        for visual, file in self._objs.visuals[link.id]:
            self._add_visual(body, visual, file, origin)
        self._add_grasps(body, link.id, origin)
        for place, shape in enumerate(self._physics.shapes[link.id]):
            self._add_collision(body, link.id, place, shape)
        below = [other.child for other in self._object.joints if other.parent == link.id]
        body.extend(self._body(self._object.link(child)) for child in below)
        return body

    def _add_joint(self, body: ET.Element, joint: Joint) -> None:
        if not joint.kind.moves or joint.limits.range <= 0:
            return
        self._moving.append(joint)
        dynamics = self._physics.dynamics[joint.id]
        attributes = {
            "name": self._joints[joint.id],
            "type": joint.kind.word("mjcf"),
            "axis": numbers(joint.axis.direction),
            "damping": number(dynamics.damping),
            "frictionloss": number(dynamics.friction_with_spring),
            "armature": number(self._config.armature * dynamics.inertia),
            "actuatorfrcrange": numbers([-dynamics.effort, dynamics.effort]),
        }
        limits = {"range": numbers([joint.limits.lower, joint.limits.upper])} if joint.kind.limited else {}
        ET.SubElement(body, "joint", attributes | limits)

    def _add_visual(self, body: ET.Element, visual: Visual, file: str, origin: Vec3) -> None:
        for drawn in drawn_meshes(visual, file, origin, self._objs.folder):
            mesh = self._mesh(drawn.file, "visual")
            name = self._geoms.unique(printable(visual.name))
            attributes = {
                "class": "visual",
                "name": name,
                "mesh": mesh,
                "material": self._materials.name_of(drawn.material),
            }
            ET.SubElement(body, "geom", attributes)

    def _add_grasps(self, body: ET.Element, link: str, origin: Vec3) -> None:
        """Adds a site for each grasp of a link, and for the first the names that robosuite and robocasa look for."""
        for place, grasp in enumerate(g for g in self._object.grasps if g.link == link):
            names = [printable(grasp.name)]
            if not place:
                names.append(f"{printable(link)}_handle")
                names += ["handle"] if grasp is self._object.grasps[0] else []
            pose = {"pos": numbers(grasp.position - origin), "quat": numbers(quaternion_of(grasp.rotation))}
            for name in names:
                ET.SubElement(body, "site", {"class": "grasp", "name": self._sites.unique(name)} | pose)

    def _add_collision(self, body: ET.Element, link: str, place: int, shape: CollisionShape) -> None:
        attributes = {"class": "collision", "name": self._geoms.unique(collision_name(printable(link), place))}
        if isinstance(shape, OrientedBox):
            center = shape.center - self._physics.origins[link]
            attributes |= {"type": "box", "size": numbers(shape.half), "pos": numbers(center)}
            if not np.array_equal(shape.rotation, np.eye(3)):
                attributes["xyaxes"] = numbers(shape.rotation[:, :2].T.ravel())
        else:
            attributes |= {"type": "mesh", "mesh": self._mesh(self._objs.pieces[link, place], "collision")}
        ET.SubElement(body, "geom", attributes)

    def _mesh(self, file: str, kind: str) -> str:
        name = file.removesuffix(".obj")
        self._used.add(file)
        ET.SubElement(self._asset, "mesh", {"class": kind, "name": name, "file": file})
        return name

    def _add_contacts(self, model: ET.Element) -> None:
        """What a joint holds together does not push itself apart, and neither does what touches at rest."""
        pairs = [(joint.parent, joint.child) for joint in self._object.joints]
        joined = {*pairs}
        pairs += [pair for pair in self._physics.touching if pair not in joined and pair[::-1] not in joined]
        contact = ET.SubElement(model, "contact")
        for a, b in pairs:
            ET.SubElement(contact, "exclude", body1=self._bodies[a], body2=self._bodies[b])

    def _add_couplings(self, model: ET.Element) -> None:
        """A constraint between two joints: MuJoCo's polynomial counts from their values at rest, which are zero."""
        coupled = [joint for joint in self._moving if joint.coupling is not None]
        equality = ET.SubElement(model, "equality") if coupled else model
        for joint in coupled:
            assert joint.coupling is not None
            names = {"joint1": self._joints[joint.id], "joint2": self._joints[joint.coupling.leader]}
            polynomial = numbers([joint.coupling.offset, joint.coupling.multiplier, 0.0, 0.0, 0.0])
            ET.SubElement(equality, "joint", names | {"polycoef": polynomial, "solref": _IN_STEP})

    def _add_actuators(self, element: ET.Element) -> None:
        """A servo on each joint that moves by itself, where they are wanted (coupled ones follow); then catches."""
        for joint in self._served():
            effort = self._physics.dynamics[joint.id].effort
            name = self._joints[joint.id]
            attributes = {"name": name, "joint": name, "dampratio": "1"}
            attributes |= {"kp": number(effort / (self._config.servo_error * joint.limits.range))}
            attributes |= {"ctrlrange": numbers([joint.limits.lower, joint.limits.upper])}
            ET.SubElement(element, "position", attributes | {"forcerange": numbers([-effort, effort])})
        self._catches.add_actuators(element)

    def _served(self) -> list[Joint]:
        return [joint for joint in self._moving if joint.coupling is None] if self._config.actuators else []

    def _add_keyframes(self, element: ET.Element) -> None:
        free = {joint.id: joint.limits.lower for joint in self._object.free_joints}
        closed = with_coupled(self._object, free)
        for name, pose in (("closed", closed), *self._open_pose()):
            values = [*(_AT_REST if self._is_free else ()), *(pose[joint.id] for joint in self._moving)]
            key = ET.SubElement(element, "key", name=name, qpos=numbers(values))
            if self._config.actuators:
                controls = (*(pose[joint.id] for joint in self._served()), *[0.0] * len(self._catches))
                key.set("ctrl", numbers(controls))

    def _open_pose(self) -> list[tuple[str, JointValues]]:
        """Returns the pose `open`; none where there is no time to find out how far all can be open together."""

        def found() -> list[tuple[str, JointValues]]:
            return [("open", open_together(self._object, self._physics.shapes))]

        def noted(why: str) -> list[tuple[str, JointValues]]:
            self._notes.append(f"model.xml has no keyframe `open`: {why}")
            return []

        return within(_FOR_POSE, found, noted)

    def _add_order(self, model: ET.Element) -> None:
        waiting = [joint for joint in self._moving if joint.after]
        if not waiting:
            return
        custom = ET.SubElement(model, "custom")
        for joint in waiting:
            data = " ".join(self._joints[other] for other in joint.after)
            ET.SubElement(custom, "text", name=f"{self._joints[joint.id]}_after", data=data)


def _names(ids: list[str], taken: str = "") -> dict[str, str]:
    """Returns a name for each id, the id itself wherever XML can hold it."""
    book = NameBook(case_counts=True)
    book.unique(taken)
    return {own: book.unique(printable(own)) for own in ids}


def _add_defaults(model: ET.Element) -> ET.Element:
    """Adds the classes of all that a model has, and returns the one above them."""
    top = ET.SubElement(ET.SubElement(model, "default"), "default", {"class": "furniture"})
    ET.SubElement(top, "joint", solimpfriction=_STIFF)
    visual = ET.SubElement(top, "default", {"class": "visual"})
    ET.SubElement(visual, "mesh", inertia="shell")  # sheets have no volume, and only the inertials count
    ET.SubElement(visual, "geom", type="mesh", contype="0", conaffinity="0", group=VISUAL_GROUP, mass="0")
    collision = ET.SubElement(top, "default", {"class": "collision"})
    ET.SubElement(collision, "geom", group=COLLISION_GROUP, mass="0")
    grasp = ET.SubElement(top, "default", {"class": "grasp"})
    ET.SubElement(grasp, "site", group=GRASP_GROUP, size="0.01")
    add_spring_defaults(top, GRASP_GROUP)
    return top


def _add_inertial(body: ET.Element, mass: MassProperties, origin: Vec3) -> None:
    attributes = {"pos": numbers(mass.center - origin), "mass": number(mass.mass)}
    ET.SubElement(body, "inertial", attributes | {"fullinertia": numbers(_six(mass.inertia))})


def _six(inertia: Mat3) -> list[float]:
    """Returns MuJoCo's order of the moments: xx, yy, zz, xy, xz, yz."""
    return [float(inertia[place]) for place in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
