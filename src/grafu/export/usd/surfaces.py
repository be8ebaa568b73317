"""Meshes, collision shapes and materials as prims; meshes are relative to the frame of their link.

Materials are UsdPreviewSurface, which every viewer shows; images stay byte for byte.

Prims are named as OpenUSD takes it everywhere, with the name that was wished where it differs.
"""

import re
from typing import Any, final

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

from grafu.articulation.collision_shapes import CollisionShape
from grafu.export.names import NameBook
from grafu.export.output_names import file_safe
from grafu.export.shading import corner_normals
from grafu.geometry.appearance import Material, Surface, Texture, selected
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.box import OrientedBox
from grafu.geometry.mesh import TriangleMesh


def identifier(name: str) -> str:
    """Returns a name of letters, digits and `_` that does not begin with a digit and is never empty."""
    safe = re.sub(r"[^A-Za-z0-9_]", "_", name) or "unnamed"
    return f"_{safe}" if safe[0].isdigit() else safe


@final
class Siblings:
    """Hands out the names of the children of one prim."""

    def __init__(self, *taken: str) -> None:
        self._book = NameBook(case_counts=True)
        for name in taken:
            self._book.unique(name)

    def unique(self, wish: str) -> str:
        """Returns the wished name where a prim can have it, else the nearest one that is free."""
        return self._book.unique(identifier(wish))


_SUFFIX = {"image/png": ".png", "image/jpeg": ".jpg"}
_FLOAT, _COLOR, _TOKEN = Sdf.ValueTypeNames.Float, Sdf.ValueTypeNames.Color3f, Sdf.ValueTypeNames.Token
Key = tuple[Material, bool, bool]


@final
class UsdMaterialWriter:
    """Writes each material, and each image, once."""

    def __init__(self, stage: Usd.Stage, scope: Sdf.Path) -> None:
        self.images: dict[str, bytes] = {}
        self._stage, self._scope = stage, scope
        self._siblings, self._files = Siblings(), NameBook()
        self._made: dict[Key, UsdShade.Material] = {}
        self._file_of: dict[tuple[bytes, str], str] = {}

    def material_of(self, surface: Surface) -> UsdShade.Material:
        """Returns the material of a surface; without coordinates in images it has no images.

        Colours of vertices (`displayColor`) stand for its colour where no image does.
        """
        textured = surface.uv is not None
        pictured = textured and surface.material.base_color_texture is not None
        key = (surface.material, textured, surface.colors is not None and not pictured)
        if key not in self._made:
            self._made[key] = _Shading(self, key).material
        return self._made[key]

    def new_material(self, name: str) -> UsdShade.Material:
        """Returns a new, empty material."""
        material = UsdShade.Material.Define(self._stage, self._scope.AppendChild(self._siblings.unique(name)))
        if material.GetPrim().GetName() != name and name:
            material.GetPrim().SetDisplayName(name)
        return material

    def shader(self, material: UsdShade.Material, name: str, kind: str) -> UsdShade.Shader:
        """Returns a new node of a material."""
        shader = UsdShade.Shader.Define(self._stage, material.GetPath().AppendChild(name))
        shader.CreateIdAttr(kind)
        return shader

    def file_of(self, texture: Texture) -> str:
        """Returns the name of an image's file, relative to the scene's."""
        key = (texture.data, texture.mime)
        if key not in self._file_of:
            stem = file_safe(texture.name.removesuffix(_SUFFIX[texture.mime]))
            self._file_of[key] = f"textures/{self._files.unique(stem)}{_SUFFIX[texture.mime]}"
            self.images[self._file_of[key]] = texture.data
        return self._file_of[key]


@final
class _Shading:
    """One material being built."""

    def __init__(self, looks: UsdMaterialWriter, key: Key) -> None:
        source, self._textured, from_vertices = key
        self._looks = looks
        self.material = looks.new_material(source.name)
        self._surface = looks.shader(self.material, "surface", "UsdPreviewSurface")
        self.material.CreateSurfaceOutput().ConnectToSource(self._surface.ConnectableAPI(), "surface")
        self._st: UsdShade.Shader | None = None
        self._add_color(source, from_vertices)
        self._add_gloss(source)
        self._add_normal(source.normal_texture)
        self._add_occlusion(source.occlusion_texture)
        self._add_emission(source)

    def _add_color(self, source: Material, from_vertices: bool) -> None:
        r, g, b, alpha = source.base_color
        opaque = source.alpha_mode == "OPAQUE"
        image = self._image("color", source.base_color_texture, Gf.Vec4f(r, g, b, 1.0 if opaque else alpha), "sRGB")
        color = self._surface.CreateInput("diffuseColor", _COLOR)
        if image is not None:
            color.ConnectToSource(image.ConnectableAPI(), "rgb")
        elif from_vertices:
            reader = self._looks.shader(self.material, "vertex_color", "UsdPrimvarReader_float3")
            reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("displayColor")
            reader.CreateOutput("result", Sdf.ValueTypeNames.Float3)
            color.ConnectToSource(reader.ConnectableAPI(), "result")
        else:
            color.Set(Gf.Vec3f(r, g, b))
        if opaque:
            return
        opacity = self._surface.CreateInput("opacity", _FLOAT)
        if image is not None:
            image.CreateOutput("a", _FLOAT)
            opacity.ConnectToSource(image.ConnectableAPI(), "a")
        else:
            opacity.Set(alpha)
        if source.alpha_mode == "MASK":
            self._surface.CreateInput("opacityThreshold", _FLOAT).Set(source.alpha_cutoff)

    def _add_gloss(self, source: Material) -> None:
        roughness, metallic = source.roughness, source.metallic
        image = self._image("gloss", source.metallic_roughness_texture, Gf.Vec4f(1.0, roughness, metallic, 1.0), "raw")
        for name, value, channel in (("roughness", roughness, "g"), ("metallic", metallic, "b")):
            slot = self._surface.CreateInput(name, _FLOAT)
            if image is None:
                slot.Set(value)
            else:
                image.CreateOutput(channel, _FLOAT)
                slot.ConnectToSource(image.ConnectableAPI(), channel)

    def _add_normal(self, texture: Texture | None) -> None:
        image = self._image("normal", texture, Gf.Vec4f(2.0, 2.0, 2.0, 1.0), "raw")
        if image is not None:
            image.CreateInput("bias", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(-1.0, -1.0, -1.0, 0.0))
            slot = self._surface.CreateInput("normal", Sdf.ValueTypeNames.Normal3f)
            slot.ConnectToSource(image.ConnectableAPI(), "rgb")

    def _add_occlusion(self, texture: Texture | None) -> None:
        image = self._image("occlusion", texture, Gf.Vec4f(1.0), "raw")
        if image is not None:
            image.CreateOutput("r", _FLOAT)
            self._surface.CreateInput("occlusion", _FLOAT).ConnectToSource(image.ConnectableAPI(), "r")

    def _add_emission(self, source: Material) -> None:
        image = self._image("emission", source.emissive_texture, Gf.Vec4f(*source.emissive, 1.0), "sRGB")
        if image is not None:
            slot = self._surface.CreateInput("emissiveColor", _COLOR)
            slot.ConnectToSource(image.ConnectableAPI(), "rgb")
        elif any(source.emissive):
            self._surface.CreateInput("emissiveColor", _COLOR).Set(Gf.Vec3f(*source.emissive))

    def _image(self, name: str, texture: Texture | None, scale: Any, space: str) -> UsdShade.Shader | None:
        """Returns the node of an image; None where there is none, or no coordinates to lay it on."""
        if texture is None or not self._textured:
            return None
        image = self._looks.shader(self.material, name, "UsdUVTexture")
        file = image.CreateInput("file", Sdf.ValueTypeNames.Asset)
        file.Set(Sdf.AssetPath(f"./{self._looks.file_of(texture)}"))
        image.CreateInput("sourceColorSpace", _TOKEN).Set(space)
        for wrap in ("wrapS", "wrapT"):
            image.CreateInput(wrap, _TOKEN).Set("repeat")
        image.CreateInput("scale", Sdf.ValueTypeNames.Float4).Set(scale)
        image.CreateOutput("rgb", Sdf.ValueTypeNames.Float3)
        slot = image.CreateInput("st", Sdf.ValueTypeNames.Float2)
        slot.ConnectToSource(self._coordinates().ConnectableAPI(), "result")
        return image

    def _coordinates(self) -> UsdShade.Shader:
        if self._st is None:
            self._st = self._looks.shader(self.material, "coordinates", "UsdPrimvarReader_float2")
            self._st.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
            self._st.CreateOutput("result", Sdf.ValueTypeNames.Float2)
        return self._st


def add_surface(
    stage: Usd.Stage, path: Sdf.Path, surface: Surface, origin: Vec3, looks: UsdMaterialWriter, crease: float
) -> Any:
    """Adds a surface as a mesh with its material and returns it; `crease` is radians.

    Points that no face uses are left out: validators count them as failures.
    """
    if len(np.unique(surface.mesh.faces)) < len(surface.mesh.vertices):
        surface = selected(surface, np.arange(len(surface.mesh.faces)))
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
    mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(_floats(shape.mesh.face_normals)))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.uniform)
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
