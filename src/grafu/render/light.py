"""The light of a picture: a soft key light by the camera, a bright sky, what both leave dark, simple reflections.

Radiance is linear RGB. Random directions come from one fixed table in a 4x4 pattern: a picture is the same each time.
"""

from math import radians

import numpy as np

from grafu.geometry.arrays import Vec3
from grafu.geometry.directions import directions_around
from grafu.render.camera import Camera
from grafu.render.ray_scene import Hits, Rays, RayScene, Values
from grafu.shapes import Float32

Rgb = Float32[np.ndarray, "n 3"]
Pattern = np.ndarray  # one number in 0..15 per ray: its place in the 4x4 pattern

_KEY_LIGHT = np.array([0.34, -0.72, -0.8])  # from the camera: to the right, up, and back towards it
_KEY, _SKY, _FLOOR = 0.78, 0.5, 0.22  # white under all of it is just white
_KEY_SPREAD = np.tan(radians(5))  # the key light's half angle: how soft a shadow's edge is
_SKY_RAYS = 3  # per pixel; what is smoothed over 4x4 pixels has 48


_ROW, _COLUMN = np.divmod(np.arange(16), 4)
_SPREAD = (_ROW + _COLUMN) % 4 * 4 + _ROW  # each row and each column of the 4x4 pattern has all heights
_SKY_POINTS = 0.98 * directions_around(16 * _SKY_RAYS).astype(np.float32).reshape(_SKY_RAYS, 16, 3)[:, _SPREAD]
_KEY_POINTS = directions_around(16).astype(np.float32)[_SPREAD]


def key_direction(camera: Camera) -> Vec3:
    """Returns the unit direction towards the key light, which stands up and to the right of the camera."""
    direction = camera.rotation @ _KEY_LIGHT + np.array([0, 0, 0.35])
    return (direction / np.linalg.norm(direction)).astype(np.float32)


def sky_ratio(scene: RayScene, points: Rays, normals: Rays, pattern: Pattern, reach: float) -> Values:
    """Returns how much of the sky each point sees, 0..1, looking as far as `reach` metres."""
    seen = np.zeros(len(points), np.float32)
    for around in _SKY_POINTS:
        directions = normals + around[pattern]  # a point on a unit sphere upon the surface: cosine-weighted
        seen += ~scene.blocked(points, directions, reach)
    return seen / _SKY_RAYS


def key_ratio(scene: RayScene, points: Rays, pattern: Pattern, toward: np.ndarray) -> Values:
    """Returns how much of the key light each point sees: 0 or 1, soft once neighbours are averaged."""
    directions = (toward + _KEY_SPREAD * _KEY_POINTS).astype(np.float32)[pattern]
    return (~scene.blocked(points, directions, 1e3)).astype(np.float32)


def shade(hits: Hits, directions: Rays, sky: Values, key: Values, toward: np.ndarray) -> Rgb:
    """Returns the light that each hit sends back along its ray, whose unit direction is given per hit."""
    view = -directions
    facing = np.einsum("nk,nk->n", hits.normal, view)
    mirror = 2 * facing[:, None] * hits.normal - view
    lambert = np.maximum(hits.normal @ toward, 0.0)
    up = 0.5 + 0.5 * hits.normal[:, 2]
    diffuse = _KEY * key * lambert + sky * (_FLOOR + (_SKY - _FLOOR) * up)
    fresnel = 0.04 + 0.5 * (1 - np.clip(facing, 0, 1)) ** 5 * (1 - hits.roughness)
    gloss = _surroundings(mirror, hits.roughness, toward) * (0.35 + 0.65 * sky)
    matt = hits.color * diffuse[:, None] + (fresnel * (1 - hits.roughness) * gloss)[:, None]
    metal = hits.color * (1.15 * gloss + 0.3 * diffuse)[:, None]
    return matt + hits.metallic[:, None] * (metal - matt)


def _surroundings(mirror: Rays, roughness: Values, toward: np.ndarray) -> Values:
    """Returns what a mirror direction shows: a floor, a bright horizon, a sky and a soft box at the key light."""
    blur = 0.1 + 0.7 * roughness
    above = np.clip(0.5 + 0.5 * mirror[:, 2] / blur, 0, 1)
    box = np.clip((mirror @ toward - 1 + blur) / blur, 0, 1)
    strip = np.clip(1 - np.abs(mirror[:, 0] - 0.35) / (0.6 * blur), 0, 1) * above
    return 0.22 + 0.62 * above + (1.15 - roughness) * (1.1 * box * box + 0.55 * strip)


def displayed(radiance: np.ndarray) -> np.ndarray:
    """Returns 8-bit sRGB of linear radiance; what is brighter than white is rolled off."""
    x = np.clip(radiance, 0, None)
    x = np.where(x > 0.7, 0.7 + 0.3 * np.tanh((x - 0.7) / 0.3), x)
    encoded = np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-8) ** (1 / 2.4) - 0.055)
    return np.round(np.clip(encoded, 0, 1) * 255).astype(np.uint8)
