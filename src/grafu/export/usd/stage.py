"""An articulated object as one OpenUSD scene: bodies side by side under one prim, joints between them.

The prim of a link stands on its joint's axis, parallel to the object frame at rest (metres, kilograms, Z up, front -Y);
the root's is the object frame, and a fixed joint holds it to the prim above, wherever that is placed, unless the piece
stands freely. Angles of joints are degrees, as OpenUSD has them.
"""

from typing import Any, final

import numpy as np
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdPhysics, UsdSemantics, UsdShade

from grafu.articulation.articulated_object import ArticulatedObject, Coupling, Joint, Link, Visual
from grafu.articulation.base import BaseKind
from grafu.articulation.catch import Catch
from grafu.articulation.catch_kind import CatchKind
from grafu.articulation.joint_dynamics import JointDynamics
from grafu.articulation.mass import MassProperties
from grafu.articulation.motion_kind import MotionKind
from grafu.articulation.physics import physics_of
from grafu.export.usd.config import UsdConfig
from grafu.export.usd.surfaces import Siblings, UsdMaterialWriter, add_collision, add_surface, identifier, quaternion
from grafu.geometry.arrays import Mat3, Vec3
from grafu.version import __version__
from grafu.vocabulary import PartLabel

_WHOLE = {"class": "furniture", "wikidata_qcode": "Q14745"}
"""What the whole is, by taxonomy: SimReady asks for Wikidata's code; parts without a label of their own inherit it."""
_AXES = (UsdPhysics.Tokens.x, UsdPhysics.Tokens.y, UsdPhysics.Tokens.z)


def build_stage(articulated: ArticulatedObject, config: UsdConfig) -> tuple[Usd.Stage, dict[str, bytes]]:
    """Returns the scene, in memory, and the images that it names by relative paths."""
    return _StageBuilder(articulated, config).build()


@final
class _StageBuilder:
    """Fills one scene."""

    def __init__(self, articulated: ArticulatedObject, config: UsdConfig) -> None:
        self._object, self._config = articulated, config
        self._physics = physics_of(articulated, config.physics)
        self._stage = Usd.Stage.CreateInMemory()
        self._top = Sdf.Path.absoluteRootPath.AppendChild(identifier(articulated.name))
        self._materials = UsdMaterialWriter(self._stage, self._top.AppendChild("Looks"))
        siblings = Siblings("Looks", "joints")
        self._paths = {link.id: self._top.AppendChild(siblings.unique(link.id)) for link in articulated.links_from_root}
        joints = Siblings("root_fixed")
        self._joints = {
            j.id: self._top.AppendPath("joints").AppendChild(joints.unique(j.id)) for j in articulated.joints
        }

    def build(self) -> tuple[Usd.Stage, dict[str, bytes]]:
        self._add_top()
        for link in self._object.links_from_root:
            self._add_link(link)
        UsdGeom.Scope.Define(self._stage, self._top.AppendChild("joints"))
        if self._object.base is not BaseKind.FREE:
            self._add_root_joint()
        for joint in self._object.joints:
            self._add_joint(joint)
        for first, second in self._physics.touching:
            filtered = UsdPhysics.FilteredPairsAPI.Apply(self._stage.GetPrimAtPath(self._paths[first]))
            filtered.CreateFilteredPairsRel().AddTarget(self._paths[second])
        return self._stage, self._materials.images

    def _add_top(self) -> None:
        stage = self._stage
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
        UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
        stage.GetRootLayer().customLayerData = {"creator": f"grafu {__version__}"}
        top = self._define(UsdGeom.Xform, self._top, self._object.name)
        stage.SetDefaultPrim(top)
        Usd.ModelAPI(top).SetKind(Kind.Tokens.component)
        UsdPhysics.ArticulationRootAPI.Apply(top)
        for taxonomy, label in _WHOLE.items():
            UsdSemantics.LabelsAPI.Apply(top, taxonomy).CreateLabelsAttr([label])
        UsdGeom.Scope.Define(stage, self._top.AppendChild("Looks"))
        self._contact = self._materials.new_material("contact")
        made = UsdPhysics.MaterialAPI.Apply(self._contact.GetPrim())
        made.CreateStaticFrictionAttr(self._config.static_friction)
        made.CreateDynamicFrictionAttr(self._config.dynamic_friction)
        made.CreateRestitutionAttr(self._config.restitution)

    def _define(self, schema: Any, path: Sdf.Path, name: str) -> Usd.Prim:
        """Returns a new prim; a name that no prim can have is what it shows to people."""
        prim = schema.Define(self._stage, path).GetPrim()
        if path.name != name and name:
            prim.SetDisplayName(name)
        return prim

    def _add_link(self, link: Link) -> None:
        path, origin = self._paths[link.id], self._physics.origins[link.id]
        prim = self._define(UsdGeom.Xform, path, link.id)
        UsdGeom.Xformable(prim).AddTranslateOp().Set(Gf.Vec3d(*origin.tolist()))
        UsdPhysics.RigidBodyAPI.Apply(prim)
        _add_mass(prim, self._physics.masses[link.id], origin)
        if link.id != self._object.root:
            _add_label(prim, _label_of(link))
        visuals, siblings = UsdGeom.Xform.Define(self._stage, path.AppendChild("visuals")).GetPath(), Siblings()
        for visual in link.rigid_visuals:
            if len(visual.mesh.faces):
                self._add_visual(visuals.AppendChild(siblings.unique(visual.name)), visual, origin)
        self._add_grasps(link, path, origin)
        collisions = UsdGeom.Xform.Define(self._stage, path.AppendChild("collisions"))
        collisions.CreatePurposeAttr(UsdGeom.Tokens.guide)
        binding = UsdShade.MaterialBindingAPI.Apply(collisions.GetPrim())
        binding.Bind(self._contact, UsdShade.Tokens.weakerThanDescendants, "physics")
        for place, shape in enumerate(self._physics.shapes[link.id]):
            add_collision(self._stage, collisions.GetPath().AppendChild(f"collision_{place}"), shape, origin)

    def _add_grasps(self, link: Link, path: Sdf.Path, origin: Vec3) -> None:
        """Adds an empty prim for each grasp of a link: its frame, and its sizes in metres."""
        grasps, siblings = [grasp for grasp in self._object.grasps if grasp.link == link.id], Siblings()
        if not grasps:
            return
        scope = UsdGeom.Scope.Define(self._stage, path.AppendChild("grasps")).GetPath()
        for grasp in grasps:
            prim = self._define(UsdGeom.Xform, scope.AppendChild(siblings.unique(grasp.name)), grasp.name)
            frame = UsdGeom.Xformable(prim)
            frame.AddTranslateOp().Set(Gf.Vec3d(*(grasp.position - origin).tolist()))
            frame.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(quaternion(grasp.rotation))
            prim.CreateAttribute("grafu:grasp:kind", Sdf.ValueTypeNames.Token).Set(grasp.kind)
            for name, value in (("width", grasp.width), ("depth", grasp.depth)):
                prim.CreateAttribute(f"grafu:grasp:{name}", Sdf.ValueTypeNames.Double).Set(value)

    def _add_visual(self, path: Sdf.Path, visual: Visual, origin: Vec3) -> None:
        """Adds a part: one mesh where it has one surface, else a prim with a mesh for each."""
        drawn = [surface for surface in visual.surfaces if not surface.is_empty]
        places = [path] if len(drawn) == 1 else [path.AppendChild(f"surface_{k}") for k in range(len(drawn))]
        prim = self._define(UsdGeom.Mesh if len(drawn) == 1 else UsdGeom.Xform, path, visual.name)
        for place, surface in zip(places, drawn, strict=True):
            add_surface(self._stage, place, surface, origin, self._materials, self._config.crease_angle)
        _add_label(prim, visual.label)
        prim.CreateAttribute("grafu:role", Sdf.ValueTypeNames.Token).Set(visual.role.value)

    def _add_root_joint(self) -> None:
        """Holds the root to the prim above all: with no first body it would stay where the world's origin is."""
        joint = UsdPhysics.FixedJoint.Define(self._stage, self._top.AppendPath("joints/root_fixed"))
        _join(joint, self._top, self._paths[self._object.root], np.zeros(3), np.eye(3))

    def _add_joint(self, joint: Joint) -> None:
        path, still = self._joints[joint.id], not joint.kind.moves or joint.limits.range <= 0
        schema = UsdPhysics.FixedJoint if still else getattr(UsdPhysics, joint.kind.word("usd"))
        prim = self._define(schema, path, joint.id)
        along, R = _frame(joint.axis.direction)
        offset = self._physics.origins[joint.child] - self._physics.origins[joint.parent]
        _join(schema(prim), self._paths[joint.parent], self._paths[joint.child], offset, np.eye(3) if still else R)
        if still:
            return
        made = schema(prim)
        made.CreateAxisAttr(_AXES[along])
        if joint.kind.limited:
            made.CreateLowerLimitAttr(joint.kind.in_degrees(joint.limits.lower))
            made.CreateUpperLimitAttr(joint.kind.in_degrees(joint.limits.upper))
        self._add_resistance(prim, self._physics.dynamics[joint.id], joint.kind)
        if joint.coupling is not None:
            self._add_coupling(prim, joint, joint.coupling)
        _add_catch(prim, joint.catch, self._physics.dynamics[joint.id].catch)
        if joint.after:
            before = prim.CreateRelationship("grafu:after")
            before.SetTargets([self._joints[other] for other in joint.after])

    def _add_coupling(self, prim: Usd.Prim, joint: Joint, coupling: Coupling) -> None:
        """Says which joint this one follows: in radians and metres for everyone, in PhysX's terms for PhysX.

        PhysX keeps `position + gearing * position of the reference joint + offset = 0`, angles in degrees.
        """
        leader = next(other for other in self._object.joints if other.id == coupling.leader)
        target = self._joints[leader.id]
        prim.CreateRelationship("grafu:leader").SetTargets([target])
        for name, value in (("multiplier", coupling.multiplier), ("offset", coupling.offset)):
            prim.CreateAttribute(f"grafu:{name}", Sdf.ValueTypeNames.Double).Set(value)
        if not self._config.physx:
            return
        name, reference = (f"rot{_AXES[_frame(j.axis.direction)[0]]}" for j in (joint, leader))
        prim.AddAppliedSchema(f"PhysxMimicJointAPI:{name}")
        prim.CreateRelationship(f"physxMimicJoint:{name}:referenceJoint", False).SetTargets([target])
        axis = prim.CreateAttribute(
            f"physxMimicJoint:{name}:referenceJointAxis", Sdf.ValueTypeNames.Token, False, Sdf.VariabilityUniform
        )
        axis.Set(reference)
        gearing = -joint.kind.in_degrees(coupling.multiplier) / leader.kind.in_degrees(1.0)
        values = {"gearing": gearing, "offset": -joint.kind.in_degrees(coupling.offset)}
        for key, value in values.items():
            prim.CreateAttribute(f"physxMimicJoint:{name}:{key}", Sdf.ValueTypeNames.Float, False).Set(value)

    def _add_resistance(self, prim: Usd.Prim, dynamics: JointDynamics, kind: MotionKind) -> None:
        """Adds a drive that only damps, and what PhysX knows beside it; with stiffness it becomes a servo.

        The drive of a joint that a spring carries is that spring.
        """
        instance = kind.word("usd drive")
        spring = dynamics.counterbalance.spring if dynamics.counterbalance else None
        stiffness, target = (spring.stiffness, spring.target) if spring else (0.0, 0.0)
        friction = spring.friction if spring else dynamics.friction
        drive = UsdPhysics.DriveAPI.Apply(prim, instance)
        drive.CreateTypeAttr(UsdPhysics.Tokens.force)
        drive.CreateStiffnessAttr(kind.from_degrees(stiffness))  # for each degree
        drive.CreateDampingAttr(kind.from_degrees(dynamics.damping))  # for each degree per second
        drive.CreateMaxForceAttr(dynamics.effort)
        drive.CreateTargetPositionAttr(kind.in_degrees(target))
        drive.CreateTargetVelocityAttr(0.0)
        if not self._config.physx:
            return
        prim.AddAppliedSchema(f"PhysxJointAxisAPI:{instance}")
        values = {
            "staticFrictionEffort": friction,
            "dynamicFrictionEffort": friction,
            "maxJointVelocity": kind.in_degrees(dynamics.velocity),
            "armature": self._config.armature * dynamics.inertia,
        }
        for name, value in values.items():
            prim.CreateAttribute(f"physxJointAxis:{instance}:{name}", Sdf.ValueTypeNames.Float, False).Set(value)


def _add_catch(prim: Usd.Prim, kind: CatchKind, catch: Catch | None) -> None:
    """States a joint's catch for whoever applies its force: drives pull harder the further a joint is open."""
    if catch is None:
        return
    prim.CreateAttribute("grafu:catch:kind", Sdf.ValueTypeNames.Token).Set(kind.value)
    for name in ("effort", "reach", "fade"):
        prim.CreateAttribute(f"grafu:catch:{name}", Sdf.ValueTypeNames.Double).Set(getattr(catch, name))


def _label_of(link: Link) -> PartLabel:
    """Returns what a link is called: the label of its largest part."""
    drawn = [visual for visual in link.visuals if len(visual.mesh.faces)]
    return max(drawn, key=lambda v: v.mesh.box.diagonal).label if drawn else PartLabel.UNKNOWN


def _add_label(prim: Usd.Prim, label: PartLabel) -> None:
    if label is not PartLabel.UNKNOWN:
        UsdSemantics.LabelsAPI.Apply(prim, "class").CreateLabelsAttr([label.value])


def _join(joint: Any, first: Sdf.Path, second: Sdf.Path, offset: Vec3, R: Mat3) -> None:
    """Gives a joint its bodies and its frame, seen from each; the second body stands at `offset` from the first."""
    turn = Gf.Quatf(quaternion(R))
    joint.CreateBody0Rel().SetTargets([first])
    joint.CreateBody1Rel().SetTargets([second])
    joint.CreateLocalPos0Attr(Gf.Vec3f(*offset.tolist()))
    joint.CreateLocalPos1Attr(Gf.Vec3f(0.0))
    joint.CreateLocalRot0Attr(turn)
    joint.CreateLocalRot1Attr(turn)


def _frame(direction: Vec3) -> tuple[int, Mat3]:
    """Returns which axis of a frame points in a direction, and the frame: the object's own where that will do.

    The axis is the one that is nearest; the frame's turn is exact for directions along axes.
    """
    along = int(np.argmax(np.abs(direction)))
    axis = np.eye(3)[along]
    if direction @ axis < 0:  # half a turn about the next axis first
        half = np.diag(np.where(np.arange(3) == (along + 1) % 3, 1.0, -1.0))
        return along, _shortest(-axis, direction) @ half
    return along, _shortest(axis, direction)


def _shortest(start: Vec3, end: Vec3) -> Mat3:
    """Returns the shortest turn from one unit vector to another that is no further than a right angle."""
    v = np.cross(start, end)
    K = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    return np.eye(3) + K + K @ K / (1.0 + float(start @ end))


def _add_mass(prim: Usd.Prim, mass: MassProperties, origin: Vec3) -> None:
    values, axes = np.diag(mass.inertia), np.eye(3)
    if np.abs(mass.inertia - np.diag(values)).max() > 1e-9 * values.max():
        values, axes = np.linalg.eigh(mass.inertia)
        axes = axes * np.sign(np.linalg.det(axes))
    made = UsdPhysics.MassAPI.Apply(prim)
    made.CreateMassAttr(mass.mass)
    made.CreateCenterOfMassAttr(Gf.Vec3f(*(mass.center - origin).tolist()))
    made.CreateDiagonalInertiaAttr(Gf.Vec3f(*values.tolist()))
    made.CreatePrincipalAxesAttr(Gf.Quatf(quaternion(axes)))
