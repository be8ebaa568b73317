"""Meshes and collision shapes as prims, relative to the frame of their link."""

from typing import Any

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

from grafu.articulation.collision_shapes import CollisionShape
from grafu.export.shading import corner_normals
from grafu.export.usd.looks import UsdLooks
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.box import OrientedBox
from grafu.geometry.mesh import TriangleMesh


def add_surface(
    stage: Usd.Stage, path: Sdf.Path, surface: Surface, origin: Vec3, looks: UsdLooks, crease: float
) -> Any:
    """Adds a surface as a mesh with its material and returns it; `crease` is radians."""
    mesh = _add_mesh(stage, path, surface.mesh, origin)
    shading = corner_normals(surface, crease)
    mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(_floats(shading.normals[shading.corners.ravel()])))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.faceVarying)
    mesh.CreateDoubleSidedAttr(surface.material.double_sided)
    primvars = UsdGeom.PrimvarsAPI(mesh)
    if surface.uv is not None:
        uv = np.clip(np.nan_to_num(surface.uv, posinf=0.0, neginf=0.0), -1e6, 1e6)
        st = primvars.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex)
        st.Set(Vt.Vec2fArray.FromNumpy(_floats(uv)))
    _add_color(primvars, surface)
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(looks.material_of(surface))
    return mesh


def add_collision(stage: Usd.Stage, path: Sdf.Path, shape: CollisionShape, origin: Vec3) -> None:
    """Adds a shape that simulators collide with: a box as a cube, any other as a mesh that is its own convex hull."""
    if isinstance(shape, OrientedBox):
        cube = UsdGeom.Cube.Define(stage, path)
        cube.CreateSizeAttr(1.0)
        cube.CreateExtentAttr([Gf.Vec3f(-0.5), Gf.Vec3f(0.5)])
        cube.AddTranslateOp().Set(Gf.Vec3d(*(shape.center - origin).tolist()))
        if not np.array_equal(shape.rotation, np.eye(3)):
            cube.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(quaternion(shape.rotation))
        cube.AddScaleOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*(2.0 * shape.half).tolist()))
        UsdPhysics.CollisionAPI.Apply(cube.GetPrim())
        return
    mesh = _add_mesh(stage, path, shape.mesh, origin)
    UsdPhysics.CollisionAPI.Apply(mesh.GetPrim())
    UsdPhysics.MeshCollisionAPI.Apply(mesh.GetPrim()).CreateApproximationAttr(UsdPhysics.Tokens.convexHull)


def quaternion(R: Mat3) -> Gf.Quatd:
    """Returns a rotation as OpenUSD's quaternion."""
    return Gf.Matrix3d(*R.T.ravel().tolist()).ExtractRotation().GetQuat()


def _add_mesh(stage: Usd.Stage, path: Sdf.Path, source: TriangleMesh, origin: Vec3) -> Any:
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = Vt.Vec3fArray.FromNumpy(_floats(source.vertices - origin))
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(source.faces), 3, np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(source.faces.ravel().astype(np.int32)))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))
    return mesh


def _add_color(primvars: Any, surface: Surface) -> None:
    """What viewers show that know no materials, and what a material shows that has colours of vertices."""
    base = np.array(surface.material.base_color[:3])
    each = UsdGeom.Tokens.constant if surface.colors is None else UsdGeom.Tokens.vertex
    colors = base[None] if surface.colors is None else base * surface.colors[:, :3] / 255.0
    color = primvars.CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, each)
    color.Set(Vt.Vec3fArray.FromNumpy(_floats(colors)))


def _floats(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values + 0.0, dtype=np.float32)  # + 0.0 turns -0.0 into 0.0
