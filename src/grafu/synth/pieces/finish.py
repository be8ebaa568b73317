"""What synthetic furniture looks like: wood, paint, metal, glass, and texture coordinates by box projection.

The wood texture is drawn by this code, so that it can be shipped and shown anywhere.
"""

import io
from functools import lru_cache
from typing import final

import numpy as np
from PIL import Image

from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Float

TEXTURE_SPAN = 0.5  # metres that one repeat of the texture covers

BEECH = Material("beech", (0.62, 0.44, 0.26, 1.0), roughness=0.7)
OAK = Material("oak", (0.52, 0.33, 0.17, 1.0), roughness=0.6)
BIRCH = Material("birch", (0.72, 0.60, 0.43, 1.0), roughness=0.8)
STEEL = Material("steel", (0.56, 0.57, 0.58, 1.0), metallic=1.0, roughness=0.35)
GLASS = Material("glass", (0.80, 0.90, 0.92, 0.3), roughness=0.05, alpha_mode="BLEND", double_sided=True)


@final
@dataclass(frozen=True, slots=True)
class Finish:
    """The materials of one piece of furniture."""

    case: Material = BEECH
    front: Material = OAK
    inside: Material = BIRCH
    metal: Material = STEEL
    glass: Material = GLASS


PLAIN = Finish()


def textured_finish(seed: int = 0) -> Finish:
    """Returns a finish whose case and fronts carry one drawn wood texture."""
    texture = wood_texture(seed)
    case = Material("oiled beech", (1.0, 0.92, 0.78, 1.0), roughness=0.65, base_color_texture=texture)
    front = Material("oiled oak", (0.95, 0.74, 0.52, 1.0), roughness=0.55, base_color_texture=texture)
    return Finish(case=case, front=front)


@lru_cache(maxsize=8)
def wood_texture(seed: int = 0, size: int = 192) -> Texture:
    """Returns a drawn wood grain as PNG that repeats without a seam; the grain runs along v."""
    rng = np.random.default_rng(seed)
    u, v = np.meshgrid(np.arange(size) / size, np.arange(size) / size)
    wander = sum(_wave(rng, u, v, 1, k) for k in (1, 2)) * 0.008
    rings = sum(_wave(rng, u + wander, v, k, 0) for k in (3, 7, 13, 29)) / 4
    specks = rng.random((size, size)) > 0.985
    pores = np.logical_or.reduce([np.roll(specks, k, axis=0) for k in range(9)])
    tone = np.clip(0.78 + 0.16 * rings - 0.10 * pores, 0.0, 1.0)
    # Few grey levels make a small file: a palette image of 32 tones
    levels = (tone * 31).round().astype(np.uint8)
    image = Image.fromarray(levels, mode=None)
    shades = np.arange(32)[:, None] / 31 * np.array([232.0, 196.0, 150.0])
    image.putpalette(shades.round().astype(np.uint8).tobytes())
    buffer = io.BytesIO()
    image.save(buffer, format="PNG", optimize=True)
    return Texture(f"wood_{seed}", buffer.getvalue(), "image/png")


def surface_of(mesh: TriangleMesh, material: Material) -> Surface:
    """Returns the mesh in that material, with texture coordinates where the material has a texture to show.

    They are projected along each face's main direction, the grain lengthwise. Vertices are split where faces of
    different directions meet, so that every face keeps its own scale.
    """
    if material.base_color_texture is None:
        return Surface(mesh, material)
    main = np.abs(mesh.face_normals).argmax(axis=1)
    key, index = np.unique(mesh.faces * 3 + main[:, None], return_inverse=True)
    vertices, direction = mesh.vertices[key // 3], key % 3
    order = np.argsort(-mesh.box.size, kind="stable")  # the longest side first: the grain follows it
    lengthwise = np.where(direction == order[0], order[1], order[0])
    rows = np.arange(len(key))
    uv = np.column_stack([vertices[rows, 3 - direction - lengthwise], vertices[rows, lengthwise]]) / TEXTURE_SPAN
    return Surface(TriangleMesh(vertices, index.reshape(-1, 3)), material, uv)


def _wave(
    rng: np.random.Generator, u: Float[np.ndarray, "n n"], v: Float[np.ndarray, "n n"], across: int, along: int
) -> Float[np.ndarray, "n n"]:
    return np.sin(2 * np.pi * (across * u + along * v + rng.random()))
