"""The small cabinet as an articulated OpenUSD scene, written by usd-core: bodies side by side, joints between them."""

from collections.abc import Callable
from math import degrees
from pathlib import Path
from typing import Any

import numpy as np

from robot_models import STATIC
from small_assets import AS_IT_IS, DOOR, DRAWER, HINGE, mesh_of

SCENE = "cabinet.usda"
BASE, DOOR_LINK, DRAWER_LINK = "/cabinet/base", "/cabinet/door_link", "/cabinet/drawer_link"
DOOR_JOINT, DRAWER_JOINT = "/cabinet/joints/door_joint", "/cabinet/joints/drawer_joint"


def write_usd_robot(
    folder: Path,
    matrix: np.ndarray = AS_IT_IS,
    metres: float = 1.0,
    up: str = "Z",
    change: Callable[[Any], None] = lambda stage: None,
) -> Path:
    """Writes the cabinet mapped by `matrix`, changed by `change`, which gets the stage."""
    from pxr import Gf, Usd, UsdGeom, UsdPhysics

    folder.mkdir(parents=True, exist_ok=True)
    stage = Usd.Stage.CreateNew(str(folder / SCENE))
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.Xform.Define(stage, "/cabinet")
    hinge = matrix @ np.array(HINGE[0])
    for path, names, at in (
        (BASE, STATIC, np.zeros(3)),
        (DOOR_LINK, DOOR, hinge),
        (DRAWER_LINK, DRAWER, np.zeros(3)),
    ):
        body = UsdGeom.Xform.Define(stage, path)
        body.AddTranslateOp().Set(Gf.Vec3d(*at.tolist()))
        UsdPhysics.RigidBodyAPI.Apply(body.GetPrim())
        for name in names:
            add_mesh(stage, f"{path}/visuals/{name.replace('-', '_')}", name, matrix, at)
    door = UsdPhysics.RevoluteJoint.Define(stage, DOOR_JOINT)
    joined(door, BASE, DOOR_LINK, hinge, np.zeros(3), (0, 0, 1), matrix @ np.array(HINGE[1]))
    door.CreateAxisAttr("Z")
    door.CreateLowerLimitAttr(0.0)
    door.CreateUpperLimitAttr(degrees(1.5))
    drawer = UsdPhysics.PrismaticJoint.Define(stage, DRAWER_JOINT)
    joined(drawer, BASE, DRAWER_LINK, np.zeros(3), np.zeros(3), (1, 0, 0), matrix @ np.array([0.0, -1.0, 0.0]))
    drawer.CreateAxisAttr("X")
    drawer.CreateLowerLimitAttr(0.0)
    drawer.CreateUpperLimitAttr(0.3 / metres)
    change(stage)
    stage.GetRootLayer().Save()
    return folder / SCENE


def add_mesh(stage: Any, path: str, name: str, matrix: np.ndarray = AS_IT_IS, at: np.ndarray | None = None) -> None:
    """Adds a piece of the cabinet as a mesh, its points counted from `at`."""
    from pxr import UsdGeom

    piece, mesh = mesh_of(name), UsdGeom.Mesh.Define(stage, path)
    points = piece.vertices @ matrix.T - (0 if at is None else at)
    mesh.CreatePointsAttr([tuple(map(float, point)) for point in points])
    mesh.CreateFaceVertexCountsAttr([3] * len(piece.faces))
    mesh.CreateFaceVertexIndicesAttr(piece.faces.ravel().tolist())


def joined(
    joint: Any, first: str, second: str, at_0: np.ndarray, at_1: np.ndarray, axis: tuple[int, ...], along: np.ndarray
) -> None:
    """Joins two bodies, whose own axes are those of the world; `axis` of the joint's frame points `along`."""
    from pxr import Gf

    turn = Gf.Rotation(Gf.Vec3d(*axis), Gf.Vec3d(*(along / np.linalg.norm(along)).tolist())).GetQuat()
    for rel, path in ((joint.CreateBody0Rel(), first), (joint.CreateBody1Rel(), second)):
        rel.SetTargets([path] if path else [])
    for made, at in ((joint.CreateLocalPos0Attr(), at_0), (joint.CreateLocalPos1Attr(), at_1)):
        made.Set(Gf.Vec3f(*at.tolist()))
    for made in (joint.CreateLocalRot0Attr(), joint.CreateLocalRot1Attr()):
        made.Set(Gf.Quatf(turn))
