"""OpenUSD scenes of the small cabinet, written by our own code as text."""

from pathlib import Path

import numpy as np

from small_assets import AS_IT_IS, CABINET, mesh_of

HEADER = '#usda 1.0\n(\n    metersPerUnit = {metres}\n    upAxis = "{up}"\n)\n'
LOOKS = """
def Scope "Looks" {
    def Material "wood" {
        token outputs:surface.connect = </Looks/wood/shader.outputs:surface>
        def Shader "shader" {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor.connect = </Looks/wood/image.outputs:rgb>
            token outputs:surface
        }
        def Shader "image" {
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @textures/wood.png@
            float3 outputs:rgb
        }
    }
    def Material "glass" {
        token outputs:surface.connect = </Looks/glass/shader.outputs:surface>
        def Shader "shader" {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.2, 0.4, 0.6)
            float inputs:opacity = 0.25
            token outputs:surface
        }
    }
}
"""


def prim_of(name: str, matrix: np.ndarray, extra: str = "", left_handed: bool = False) -> str:
    """A mesh whose place is a translation of its prim."""
    mesh = mesh_of(name)
    at = mesh.vertices[0]
    points = ", ".join(f"({x}, {y}, {z})" for x, y, z in (mesh.vertices - at) @ matrix.T)
    faces = mesh.faces[:, ::-1] if left_handed else mesh.faces
    x, y, z = matrix @ at
    turned = 'uniform token orientation = "leftHanded"' if left_handed else ""
    corners = ", ".join("(0, 1)" for _ in faces.ravel())
    return f"""def Mesh "{name.replace("-", "_")}" {{
        {turned}
        point3f[] points = [{points}]
        int[] faceVertexCounts = [{", ".join("3" for _ in faces)}]
        int[] faceVertexIndices = [{", ".join(map(str, faces.ravel()))}]
        texCoord2f[] primvars:st = [{corners}] ( interpolation = "faceVarying" )
        double3 xformOp:translate = ({x}, {y}, {z})
        uniform token[] xformOpOrder = ["xformOp:translate"]
        {extra}
    }}
"""


def scene_of(matrix: np.ndarray = AS_IT_IS, metres: float = 1.0, up: str = "Z", **extra: str) -> str:
    """The small cabinet as a scene; `extra` are properties of single prims, by name."""
    prims = "".join(
        prim_of(name, matrix, extra.get(name.replace("-", "_"), ""), left_handed=k % 2 == 1)
        for k, name in enumerate(CABINET)
    )
    return HEADER.format(metres=metres, up=up) + LOOKS + f'def Xform "cabinet" {{\n{prims}}}\n'


def write_usd(folder: Path, text: str, image: bytes) -> Path:
    (folder / "textures").mkdir(parents=True, exist_ok=True)
    (folder / "textures" / "wood.png").write_bytes(image)
    (folder / "cabinet.usda").write_text(text)
    return folder / "cabinet.usda"
