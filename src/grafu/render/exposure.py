"""One picture being taken: the camera's rays, what they meet, the light from there, outlines, a shadow on the floor.

Everything here is per sample, linear and premultiplied; `picture` averages samples to pixels and develops them. The
light is a studio's: a soft key light by the camera, a bright sky, ambient occlusion, simple reflections. Radiance is
linear RGB. Random directions come from one fixed table in a 4x4 pattern: a picture is the same each time.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from math import radians
from typing import Literal, final

import numpy as np
from jaxtyping import Float32

from grafu.geometry.arrays import Vec3, extremes, frozen_array
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.render.camera import Camera
from grafu.render.ray_scene import Hits, Rays, RayScene, Values

Rgb = Float32[np.ndarray, "n 3"]
Pattern = np.ndarray  # one number in 0..15 per ray: its place in the 4x4 pattern

_KEY_LIGHT = np.array([0.34, -0.72, -0.8])  # from the camera: to the right, up, and back towards it
_KEY, _SKY, _FLOOR = 0.78, 0.5, 0.22  # white under all of it is just white
_KEY_SPREAD = np.tan(radians(5))  # the key light's half angle: how soft a shadow's edge is
_SKY_RAYS = 3  # per sample; four samples a pixel and the smoothing make about 100


def _sphere_points(count: int) -> np.ndarray:
    """Returns points spread evenly over the unit sphere (golden-angle spiral), shuffled in a fixed order."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, k * np.pi * (3 - np.sqrt(5))
    points = np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], axis=1)
    return points[np.random.default_rng(7).permutation(count)].astype(np.float32)


_POINTS = _sphere_points(16 * _SKY_RAYS).reshape(16, _SKY_RAYS, 3)


def key_direction(camera: Camera) -> Vec3:
    """Returns the unit direction towards the key light, which stands up and to the right of the camera."""
    direction = camera.rotation @ _KEY_LIGHT + np.array([0, 0, 0.35])
    return (direction / np.linalg.norm(direction)).astype(np.float32)


def sky_ratio(scene: RayScene, points: Rays, normals: Rays, pattern: Pattern, reach: float) -> Values:
    """Returns how much of the sky each point sees, 0..1, looking as far as `reach` metres."""
    seen = np.zeros(len(points), np.float32)
    for k in range(_SKY_RAYS):
        directions = normals + 0.98 * _POINTS[pattern, k]  # a point on a unit sphere upon the surface: cosine-weighted
        seen += ~scene.blocked(points, directions, reach)
    return seen / _SKY_RAYS


def key_ratio(scene: RayScene, points: Rays, pattern: Pattern, toward: np.ndarray) -> Values:
    """Returns how much of the key light each point sees: 0 or 1, soft once neighbours are averaged."""
    directions = toward + _KEY_SPREAD * _POINTS[pattern, 0]
    return (~scene.blocked(points, directions.astype(np.float32), 1e3)).astype(np.float32)


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


Samples = Float32[np.ndarray, "_ _ 4"]

_LAYERS = 4  # panes of glass that are seen through
_CREASE = float(np.cos(np.radians(38.0)))


@final
@dataclass(frozen=True, slots=True)
class PictureStyle:
    """How a picture is drawn: its background, whether parts are coloured by category, outlines, a shadow below."""

    background: Literal["white", "transparent"] = "white"
    by_category: bool = False
    outlines: bool = True
    shadow: bool = True


@final
class Exposure:
    """One picture being taken: the camera's rays, what they meet, and the light from there."""

    def __init__(self, scene: RayScene, camera: Camera, size: tuple[int, int], style: PictureStyle) -> None:
        self.scene, self.style, self.size, self.toward = scene, style, size, key_direction(camera)
        width, height = size
        self.origins = np.broadcast_to(camera.eye.astype(np.float32), (width * height, 3))
        self.directions = _rays(camera, width, height)
        self.color = np.zeros((width * height, 4), np.float32)
        self.through = np.ones(width * height, np.float32)  # how much of each ray goes on behind the glass so far
        self.pattern = _pattern(width, height)
        corners = scene.triangles.reshape(-1, 3)
        low, high = extremes(corners) if len(corners) else (np.zeros(3), np.ones(3))
        self.low: np.ndarray = low
        self.high: np.ndarray = high
        self.reach = float(0.35 * np.linalg.norm(high - low))
        self.ahead = _rays_to(Box(low, high), camera, size)

    def samples(self) -> Samples:
        """Returns premultiplied linear RGBA per sample, (height, width, 4). To be called once."""
        rays, start = self.ahead, self.origins
        for layer in range(_LAYERS):
            require_time()
            hits = self.scene.cast(start[rays], self.directions[rays])
            self._add(rays[hits.ray], hits, start, outlined=layer == 0)
            glass = hits.alpha < 0.99
            if not glass.any() or layer == _LAYERS - 1:
                break
            start = start.copy()
            behind = rays[hits.ray][glass]
            start[behind] += self.directions[behind] * (hits.distance[glass, None] + 1e-4 * self.reach)
            rays = behind
        if self.style.shadow:
            self.color[:, 3] += self.through * self._shadow(self.through)
        return self.color.reshape(self.size[1], self.size[0], 4)

    def _add(self, rays: np.ndarray, hits: Hits, start: np.ndarray, outlined: bool) -> None:
        """Adds what one layer of hits sends back, in front of what is still to come."""
        points = start[rays] + self.directions[rays] * hits.distance[:, None]
        lifted = points + hits.flat_normal * (3e-4 * self.reach)
        sky = sky_ratio(self.scene, lifted, hits.normal, self.pattern[rays], self.reach)
        key = key_ratio(self.scene, lifted, self.pattern[rays], self.toward)
        near = replace(hits, ray=rays)
        window = _Window.around(rays, self.size)
        if outlined:
            sky, key = _smoothed((sky, key), near, window)
        light = shade(near, self.directions[rays], sky, key, self.toward)
        if outlined and self.style.outlines:
            light *= self._ink(near, points, window)[:, None]
        weight = self.through[rays] * hits.alpha
        self.color[rays, :3] += light * weight[:, None]
        self.color[rays, 3] += weight
        self.through[rays] -= weight

    def _ink(self, hits: Hits, points: np.ndarray, window: "_Window") -> np.ndarray:
        """Returns a factor per hit that darkens borders of parts, creases and silhouettes."""
        visual = window.grid(hits.visual, -1)
        normal = window.grid(hits.normal, 0.0)
        point = window.grid(points, 0.0)
        ink = np.ones(window.shape, np.float32)
        for axis in (0, 1):
            a, b = (slice(None, -1), slice(None)), (slice(1, None), slice(None))
            if axis:
                a, b = (slice(None), slice(None, -1)), (slice(None), slice(1, None))
            border = visual[a] != visual[b]
            turn = np.einsum("hwk,hwk->hw", normal[a], normal[b])
            step = np.abs(np.einsum("hwk,hwk->hw", point[b] - point[a], normal[a] + normal[b]))
            strength = np.where(turn < _CREASE, 0.66, 1.0)
            strength = np.where((step > 0.02 * self.reach) | border, 0.42, strength)
            for side in (a, b):
                ink[side] = np.minimum(ink[side], strength)
        return ink.reshape(-1)[window.place]

    def _shadow(self, through: np.ndarray) -> np.ndarray:
        """Returns how dark the floor is behind each ray, 0..1; found for one sample in four and smoothed."""
        width, height = self.size
        grid = through.reshape(height, width)
        open_blocks = np.maximum(grid[::2], grid[1::2]) > 0.01
        open_blocks = open_blocks[:, ::2] | open_blocks[:, 1::2]
        first = np.arange(width * height).reshape(height, width)[::2, ::2]
        rays, points = self._floor_points(first[open_blocks])
        lifted = points + np.array([0, 0, 1e-4 * self.reach], np.float32)
        up = np.tile(np.array([0, 0, 1], np.float32), (len(rays), 1))
        rows, columns = np.divmod(rays, width)
        pattern = (rows // 2 % 4) * 4 + columns // 2 % 4
        sky = sky_ratio(self.scene, lifted, up, pattern, 1.6 * self.reach)
        key = key_ratio(self.scene, lifted, pattern, self.toward)
        dark, known = np.zeros((2, width * height), np.float32)
        dark[rays], known[rays] = 1 - (1 - 0.24 * (1 - key)) * (1 - 0.42 * (1 - sky)), 1.0
        dark, known = (_box_mean(grid.reshape(height, width)[::2, ::2]) for grid in (dark, known))
        smooth = dark / np.maximum(known, 1e-3)  # what the object hides is not counted in
        return np.repeat(np.repeat(smooth, 2, axis=0), 2, axis=1).reshape(-1)

    def _floor_points(self, rays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns those of the rays that meet the floor near the object, and where they do."""
        down = self.directions[rays, 2]
        rays, down = rays[down < -1e-6], down[down < -1e-6]
        distance = (self.low[2] - self.origins[rays, 2]) / down
        points = self.origins[rays] + self.directions[rays] * distance[:, None]
        margin = 1.2 * (self.high[2] - self.low[2]) + self.reach
        (x, y), (left, front), (right, back) = points.T[:2], self.low[:2] - margin, self.high[:2] + margin
        near = (x > left) & (x < right) & (y > front) & (y < back)
        return rays[near], points[near].astype(np.float32)


@lru_cache(maxsize=1)  # a model's pictures have one camera
def _rays(camera: Camera, width: int, height: int) -> np.ndarray:
    return frozen_array(camera.rays(width, height), np.float32)


@lru_cache(maxsize=1)
def _pattern(width: int, height: int) -> np.ndarray:
    rows, columns = np.divmod(np.arange(width * height), width)
    return frozen_array((rows % 4) * 4 + columns % 4, np.int64)


def _rays_to(box: Box, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """Returns the numbers of the rays that may meet a box, row by row; all, where some of it is not before the eye."""
    width, height = size
    right, down, forward = ((box.corners() - camera.eye) @ camera.rotation).T
    if forward.min() < 1e-6:
        return np.arange(width * height)
    scale = height / (2 * np.tan(camera.fov / 2))
    x, y = width / 2 + scale * right / forward, height / 2 + scale * down / forward
    first, last = np.floor([x.min(), y.min()]) - 1, np.ceil([x.max(), y.max()]) + 1
    (left, top), (end, bottom) = (np.clip(at, 0, size).astype(int) for at in (first, last))
    return (np.arange(top, bottom)[:, None] * width + np.arange(left, end)).reshape(-1)


@final
@dataclass(frozen=True, slots=True)
class _Window:
    """The samples of a picture around those rays that hit something: `place` is where each of them stands in it."""

    shape: tuple[int, int]
    place: np.ndarray

    @classmethod
    def around(cls, rays: np.ndarray, size: tuple[int, int]) -> "_Window":
        """Returns the window of the rays with one sample more at each side, as far as the picture goes."""
        rows, columns = np.divmod(rays, size[0])
        top, left = (max(int(at.min()) - 1, 0) if len(at) else 0 for at in (rows, columns))
        bottom, right = min(int(rows.max(initial=0)) + 2, size[1]), min(int(columns.max(initial=0)) + 2, size[0])
        return cls((bottom - top, right - left), (rows - top) * (right - left) + columns - left)

    def grid(self, values: np.ndarray, empty: float | int) -> np.ndarray:
        """Returns the values of the rays as samples in rows and columns."""
        grid = np.full((self.shape[0] * self.shape[1], *values.shape[1:]), empty, values.dtype)
        grid[self.place] = values
        return grid.reshape(*self.shape, *values.shape[1:])


def _smoothed(values: Sequence[Values], hits: Hits, window: _Window) -> list[Values]:
    """Returns the means over the 4x4 samples around each, of those of one visual and one direction."""
    facing = np.argmax(np.abs(hits.flat_normal), axis=1) * 2 + (hits.flat_normal.sum(axis=1) > 0)
    surface = window.grid(hits.visual * 8 + facing, -1)
    grids = [window.grid(each, 0.0) for each in values]
    totals, count = [grid.copy() for grid in grids], np.ones(window.shape, np.float32)
    for here, there in _neighbours(*window.shape):
        same = surface[here] == surface[there]
        count[here] += same
        for total, grid in zip(totals, grids, strict=True):
            total[here] += grid[there] * same
    return [(total / count).reshape(-1)[window.place] for total in totals]


def _neighbours(height: int, width: int) -> Iterator[tuple[tuple[slice, slice], tuple[slice, slice]]]:
    """Yields for each other step of a 4x4 pattern the samples that have a neighbour there, and these neighbours."""
    for dy, dx in product(range(-2, 2), repeat=2):
        if dx or dy:
            here = (slice(max(0, -dy), height - max(0, dy)), slice(max(0, -dx), width - max(0, dx)))
            yield here, (slice(max(0, dy), height - max(0, -dy)), slice(max(0, dx), width - max(0, -dx)))


def _box_mean(grid: np.ndarray) -> np.ndarray:
    """Returns the mean over the 4x4 samples around each."""
    padded = np.pad(grid, ((2, 1), (2, 1)), mode="edge")
    h, w = grid.shape
    rows = sum(padded[dy : dy + h] for dy in range(4))
    return np.asarray(sum(rows[:, dx : dx + w] for dx in range(4)) / 16)  # type: ignore[index, misc]
