"""Rigid bodies and joints of an OpenUSD scene (UsdPhysics), with their frames in the world. It decides nothing.

A joint's frame on each of its two bodies is where its local position and rotation lead. Values are those of UsdPhysics:
`body1` moves against `body0` about or along the axis, by the right-hand rule; angles here are radians, lengths are in
the scene's unit. How far a joint stands open as drawn is what lies between its two frames.
"""

from collections.abc import Iterator
from math import degrees, isfinite
from typing import Any, Final, final

import numpy as np

from grafu.articulation.motion_kind import MotionKind, kind_named
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Mat4
from grafu.geometry.transform import from_rotation, invert, quaternion_matrix

FIXED: Final = "fixed"
LOOSE: Final = "floating"  # a URDF's word for what moves in some other way
_AXES: Final = {"X": 0, "Y": 1, "Z": 2}
_FREEDOMS: Final = ("transX", "transY", "transZ", "rotX", "rotY", "rotZ")  # of a joint of no special kind


@final
@dataclass(frozen=True)
class PhysicsJoint:
    """One joint of the scene.

    Attributes:
        path: its prim.
        name: the name of that prim.
        kind: a URDF's word for its type.
        bodies: the paths of `body0` and `body1`; empty for the world.
        frames: its frame in the world, as it is on each of them.
        axis: 0, 1 or 2: the axis of these frames about or along which it moves.
        limits: radians or units of the scene; None where it is not limited.
        mimic: the path of the joint that it follows, multiplier and offset in radians and units of the scene.
        is_apart: whether the scene states that it is no joint of the tree.
    """

    path: str
    name: str
    kind: str
    bodies: tuple[str, str]
    frames: tuple[Mat4, Mat4]
    axis: int = 2
    limits: tuple[float, float] | None = None
    mimic: tuple[str, float, float] | None = None
    is_apart: bool = False

    @property
    def drawn(self) -> float:
        """The joint's value as drawn, radians or units of the scene; 0 of one that has none."""
        kind = kind_named("urdf", self.kind)
        if kind is None:
            return 0.0
        T = invert(self.frames[0]) @ self.frames[1]
        if kind.slides:
            return float(T[self.axis, 3])
        first, second = (self.axis + 1) % 3, (self.axis + 2) % 3
        return float(np.arctan2(T[second, first], T[first, first]))


def bodies_of(stage: Any) -> dict[str, bool]:
    """Returns the paths of the rigid bodies, in order, each with whether an articulation starts there."""
    from pxr import UsdPhysics

    found = {}
    for prim in _prims(stage):
        if prim.HasAPI(UsdPhysics.RigidBodyAPI) and UsdPhysics.RigidBodyAPI(prim).GetRigidBodyEnabledAttr().Get():
            found[str(prim.GetPath())] = bool(prim.HasAPI(UsdPhysics.ArticulationRootAPI))
    return found


def body_above(path: str, bodies: dict[str, bool]) -> str:
    """Returns the rigid body that a prim is part of, itself or above it; empty where it is of none."""
    while path and path != "/":
        if path in bodies:
            return path
        path = path.rpartition("/")[0]
    return ""


def joints_of(stage: Any, poses: Any, bodies: dict[str, bool]) -> Iterator[PhysicsJoint]:
    """Yields the joints that are enabled and join two bodies, or one with the world.

    Args:
        stage: the scene.
        poses: a `UsdGeom.XformCache` for the moment that counts.
        bodies: the rigid bodies (`bodies_of`).
    """
    from pxr import UsdPhysics

    for prim in _prims(stage):
        joint = UsdPhysics.Joint(prim) if prim.IsA(UsdPhysics.Joint) else None
        if joint is None or joint.GetJointEnabledAttr().Get() is False:
            continue
        ends = [_end(stage, rel) for rel in (joint.GetBody0Rel(), joint.GetBody1Rel())]
        of = tuple(body_above(str(end.GetPath()), bodies) if end else "" for end in ends)
        if of[0] == of[1]:
            continue
        at = (joint.GetLocalPos0Attr().Get(), joint.GetLocalPos1Attr().Get())
        turned = (joint.GetLocalRot0Attr().Get(), joint.GetLocalRot1Attr().Get())
        frames = [_frame(end, poses, p, q) for end, p, q in zip(ends, at, turned, strict=True)]
        kind, axis, limits = _motion(prim)
        yield PhysicsJoint(
            str(prim.GetPath()),
            str(prim.GetName()),
            kind,
            (of[0], of[1]),
            (frames[0], frames[1]),
            axis,
            limits,
            _mimic(prim, kind_named("urdf", kind)),
            bool(joint.GetExcludeFromArticulationAttr().Get()),
        )


def _prims(stage: Any) -> Iterator[Any]:
    from pxr import Usd

    predicate = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
    return iter(Usd.PrimRange(stage.GetPseudoRoot(), predicate))


def _end(stage: Any, relationship: Any) -> Any:
    """Returns the prim that a joint is fixed to at one end; None for the world."""
    targets = relationship.GetTargets()
    prim = stage.GetPrimAtPath(targets[0]) if targets else None
    return prim if prim is not None and prim.IsValid() else None


def _frame(prim: Any, poses: Any, position: Any, rotation: Any) -> Mat4:
    """Returns a joint's frame in the world; its position is in the prim's own, scaled, coordinates."""
    T = np.eye(4) if prim is None else np.array(poses.GetLocalToWorldTransform(prim)).T
    own = np.array([0.0, 0.0, 0.0] if position is None else list(position), dtype=np.float64)
    w, (x, y, z) = (1.0, (0.0, 0.0, 0.0)) if rotation is None else (rotation.GetReal(), rotation.GetImaginary())
    R = quaternion_matrix(w, x, y, z) if any((w, x, y, z)) else np.eye(3)
    return from_rotation(_turn_of(T[:3, :3]) @ R, T[:3, :3] @ own + T[:3, 3])


def _turn_of(linear: Mat3) -> Mat3:
    """Returns the rotation in a transform that also scales; a mirror image is turned back."""
    if not np.isfinite(linear).all() or abs(np.linalg.det(linear)) < 1e-30:
        return np.eye(3)
    lengths = np.linalg.norm(linear, axis=0)
    U, _, V = np.linalg.svd(linear / lengths)
    R = np.asarray(U @ V)
    return R if np.linalg.det(R) > 0 else -R


def _motion(prim: Any) -> tuple[str, int, tuple[float, float] | None]:
    """Returns a URDF's word for how a joint moves, its axis and its limits."""
    from pxr import UsdPhysics

    name = str(prim.GetTypeName())
    if name == "PhysicsFixedJoint":
        return FIXED, 2, None
    kind = kind_named("usd", name.removeprefix("Physics"))
    if kind is None:
        return _motion_of_freedoms(prim) if name == "PhysicsJoint" else (LOOSE, 2, None)
    joint = getattr(UsdPhysics, name.removeprefix("Physics"))(prim)
    axis = _AXES.get(str(joint.GetAxisAttr().Get()), 0)
    ends = joint.GetLowerLimitAttr().Get(), joint.GetUpperLimitAttr().Get()
    return _limited(kind, axis, ends)


def _motion_of_freedoms(prim: Any) -> tuple[str, int, tuple[float, float] | None]:
    """Returns how a joint of no special kind moves: where all freedoms but one are locked, about or along that one."""
    from pxr import UsdPhysics

    free, limits = [], {}
    for name in _FREEDOMS:
        limit = UsdPhysics.LimitAPI.Get(prim, name) if prim.HasAPI(UsdPhysics.LimitAPI, name) else None
        ends = (-np.inf, np.inf) if limit is None else (limit.GetLowAttr().Get(), limit.GetHighAttr().Get())
        if ends[0] <= ends[1]:
            free.append(name)
            limits[name] = ends
    if not free:
        return FIXED, 2, None
    if len(free) > 1:
        return LOOSE, 2, None
    kind = kind_named("usd drive", "linear" if free[0].startswith("trans") else "angular")
    assert kind is not None, "the table of motion kinds has both"
    return _limited(kind, _AXES[free[0][-1]], limits[free[0]])


def _limited(
    kind: MotionKind, axis: int, ends: tuple[float | None, float | None]
) -> tuple[str, int, tuple[float, float] | None]:
    lower, upper = ends
    if lower is None or upper is None or not (isfinite(lower) and isfinite(upper)):
        return "continuous" if kind.turns else kind.word("urdf"), axis, None
    return kind.word("urdf"), axis, (kind.from_degrees(lower), kind.from_degrees(upper))


def _mimic(prim: Any, kind: MotionKind | None) -> tuple[str, float, float] | None:
    """Returns which joint a joint follows: by what grafu writes, else by what PhysX reads."""
    leader = _target(prim, "grafu:leader")
    if leader:
        multiplier, offset = (prim.GetAttribute(f"grafu:{name}").Get() for name in ("multiplier", "offset"))
        return leader, float(multiplier or 0.0), float(offset or 0.0)
    for relationship in prim.GetRelationships():
        schema, _, about = str(relationship.GetName()).partition(":")
        name, _, what = about.partition(":")
        if schema != "physxMimicJoint" or what != "referenceJoint" or kind is None:
            continue
        leader = _target(prim, str(relationship.GetName()))
        gearing, offset = (prim.GetAttribute(f"{schema}:{name}:{key}").Get() for key in ("gearing", "offset"))
        turned = str(prim.GetAttribute(f"{schema}:{name}:referenceJointAxis").Get()).startswith("rot")
        multiplier = -kind.from_degrees(float(gearing or 0.0))
        return leader, degrees(multiplier) if turned else multiplier, -kind.from_degrees(float(offset or 0.0))
    return None


def _target(prim: Any, name: str) -> str:
    relationship = prim.GetRelationship(name)
    targets = relationship.GetTargets() if relationship else ()
    return str(targets[0]) if targets else ""
