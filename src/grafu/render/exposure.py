"""One picture being taken: the camera's rays, what they meet, the light from there, outlines, a shadow on the floor.

Everything here is per sample, four to a pixel, linear and premultiplied; `picture` averages samples to pixels and
develops them. Pixels are looked at once, in their middle; those on a border, or on glass, then with all their samples.
Light is found for the middles of pixels and smoothed over each surface.
"""

from dataclasses import replace
from functools import lru_cache
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import frozen_array
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.render.camera import Camera
from grafu.render.light import key_direction, key_ratio, shade, sky_ratio
from grafu.render.pixel_window import (
    Grid,
    PixelWindow,
    any_in_blocks,
    bend_and_step,
    box_mean,
    enlarged,
    smoothed,
    surfaces_of,
)
from grafu.render.ray_scene import Hits, Rays, RayScene, Values
from grafu.shapes import Float32, Int

Met = Float32[np.ndarray, "hits 3"]  # where rays met something
Samples = Float32[np.ndarray, "_ _ 4"]

SIDE = 2  # samples a side of each pixel
_BLOCK = 2  # samples a side of each block for which the shadow on the floor is found once
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
    """One picture being taken, `size` in pixels: the camera's rays, what they meet, and the light from there."""

    def __init__(self, scene: RayScene, camera: Camera, size: tuple[int, int], style: PictureStyle) -> None:
        self.scene, self.style, self.toward, self.camera = scene, style, key_direction(camera), camera
        self.pixels, self.size = size, (size[0] * SIDE, size[1] * SIDE)
        count = self.size[0] * self.size[1]
        self.eye = camera.eye.astype(np.float32)
        self.directions = _rays(camera, *self.size)
        self.color = np.zeros((count, 4), np.float32)
        self.through = np.ones(count, np.float32)  # how much of each ray goes on behind the glass so far
        self.low: np.ndarray = scene.low
        self.high: np.ndarray = scene.high
        self.reach = float(0.35 * np.linalg.norm(self.high - self.low))

    def samples(self) -> Samples:
        """Returns premultiplied linear RGBA per sample, (height, width, 4). To be called once."""
        hits, points = self._add_front()
        for _ in range(_LAYERS - 1):
            require_time()
            glass = hits.alpha < 0.99
            if not glass.any():
                break
            rays = hits.ray[glass]
            start = points[glass] + self.directions[rays] * np.float32(1e-4 * self.reach)
            hits, points = self._cast(rays, start)
            self._add(hits, self._lit(hits, *self._light(hits, points)))
        if self.style.shadow:
            self.color[:, 3] += self.through * self._shadow(self.through)
        return self.color.reshape(self.size[1], self.size[0], 4)

    def _cast(self, rays: Int[np.ndarray, " n"], start: Rays) -> tuple[Hits, Met]:
        """Returns what samples' rays meet from `start` on, `Hits.ray` being the sample, and where."""
        directions = self.directions[rays]
        hits = self.scene.cast(start, directions)
        points = start[hits.ray] + directions[hits.ray] * hits.distance[:, None]
        return replace(hits, ray=rays[hits.ray]), points

    def _add_front(self) -> tuple[Hits, Rays]:
        """Adds what is in front; returns what the samples of pixels on borders meet, and where."""
        require_time()
        directions = _rays(self.camera, *self.pixels)
        ahead = _rays_to(Box(self.low, self.high), self.camera, self.pixels)
        hits = self.scene.cast(np.broadcast_to(self.eye, (len(ahead), 3)), directions[ahead])
        hits = replace(hits, ray=ahead[hits.ray])
        points = self.eye + directions[hits.ray] * hits.distance[:, None]
        window = PixelWindow.around(hits.ray, self.pixels)
        surface = window.grid(surfaces_of(hits), -1)
        sky, key = smoothed([window.grid(each, 0.0) for each in self._light(hits, points, SIDE)], surface)
        border = window.on_borders(hits, points, self.reach)
        self._fill(hits, directions, window, (sky, key), ~border.reshape(-1)[window.place])
        pixels = window.pixels(border)
        rays = self._samples_of(pixels).reshape(-1)
        return self._add_borders(rays, np.repeat(pixels, SIDE * SIDE), window, surface, (sky, key))

    def _fill(
        self, hits: Hits, directions: Rays, window: PixelWindow, light: tuple[Grid, Grid], plain: np.ndarray
    ) -> None:
        """Adds what plain pixels send back, to all their samples alike."""
        near, place = hits.chosen(plain), window.place[plain]
        sky, key = (grid.reshape(-1)[place] for grid in light)
        seen = shade(near, directions[near.ray], sky, key, self.toward) * near.alpha[:, None]
        rows, columns = np.divmod(near.ray, self.pixels[0])
        grid = self.color.reshape(self.pixels[1], SIDE, self.pixels[0], SIDE, 4)
        grid[rows, :, columns] = np.column_stack([seen, near.alpha])[:, None, None]
        self.through[self._samples_of(near.ray)] = 1 - near.alpha[:, None]

    def _add_borders(
        self,
        rays: Int[np.ndarray, " n"],
        pixels: Int[np.ndarray, " n"],
        window: PixelWindow,
        surface: Grid,
        light: tuple[Grid, Grid],
    ) -> tuple[Hits, Met]:
        """Adds what samples on borders send back; light is that of pixels beside them which show the same surface."""
        hits, points = self._cast(rays, np.broadcast_to(self.eye, (len(rays), 3)))
        row = np.full(self.size[0] * self.size[1], -1)
        row[rays] = np.arange(len(rays))
        found = window.nearest(surface, pixels[row[hits.ray]], surfaces_of(hits))
        sky, key = (grid.reshape(-1)[found] for grid in light)
        alone = np.flatnonzero(found < 0)
        sky[alone], key[alone] = self._light(hits.chosen(alone), points[alone])
        lit = self._lit(hits, sky, key)
        if self.style.outlines:
            lit *= self._ink(hits, points, rays)[:, None]
        self._add(hits, lit)
        return hits, points

    def _light(self, hits: Hits, points: Rays, side: int = 1) -> tuple[Values, Values]:
        """Returns how much of the sky and of the key light is seen from hits of samples, or of pixels `side` wide."""
        rows, columns = np.divmod(hits.ray, self.size[0] // side)
        pattern = rows % 4 * 4 + columns % 4
        lifted = points + hits.flat_normal * np.float32(3e-4 * self.reach)
        sky = sky_ratio(self.scene, lifted, hits.normal, pattern, self.reach)
        return sky, key_ratio(self.scene, lifted, pattern, self.toward)

    def _lit(self, hits: Hits, sky: Values, key: Values) -> Rays:
        return shade(hits, self.directions[hits.ray], sky, key, self.toward)

    def _add(self, hits: Hits, lit: Rays) -> None:
        """Adds what samples send back, in front of what is still to come."""
        weight = self.through[hits.ray] * hits.alpha
        self.color[hits.ray, :3] += lit * weight[:, None]
        self.color[hits.ray, 3] += weight
        self.through[hits.ray] -= weight

    def _samples_of(self, pixels: Int[np.ndarray, " n"]) -> Int[np.ndarray, "n 4"]:
        """Returns the numbers of the samples of pixels, given by number."""
        rows, columns = np.divmod(pixels, self.pixels[0])
        inside = np.arange(SIDE)[:, None] * self.size[0] + np.arange(SIDE)
        return np.asarray((rows * self.size[0] + columns)[:, None] * SIDE + inside.reshape(-1))

    def _ink(self, hits: Hits, points: Met, rays: Int[np.ndarray, " n"]) -> np.ndarray:
        """Returns a factor per hit that darkens borders of parts, creases and silhouettes, of samples cast together."""
        number = np.full(self.size[0] * (self.size[1] + 1) + 1, -2)  # none beyond the last row and sample
        number[rays] = -1  # samples that meet nothing are all the last row below
        number[hits.ray] = np.arange(len(hits.ray))
        visual = np.append(hits.visual, -1)
        normal, point = (np.concatenate([each, np.zeros((1, 3), np.float32)]) for each in (hits.normal, points))
        ink = np.ones(len(visual), np.float32)
        for step in (1, self.size[0]):
            first = rays if step > 1 else rays[rays % self.size[0] < self.size[0] - 1]
            a, b = number[first], number[first + step]
            shown = (b > -2) & ((a >= 0) | (b >= 0))
            a, b = a[shown], b[shown]
            bend, off = bend_and_step(normal[a], normal[b], point[b] - point[a])
            strength = np.where(bend < _CREASE, np.float32(0.66), np.float32(1.0))
            strength[(off > 0.02 * self.reach) | (visual[a] != visual[b])] = 0.42
            for side in (a, b):
                ink[side] = np.minimum(ink[side], strength)
        return ink[:-1]

    def _shadow(self, through: np.ndarray) -> np.ndarray:
        """Returns how dark the floor is behind each ray, 0..1; found for one sample in a block and smoothed."""
        width, height = self.size
        first = np.arange(width * height).reshape(height, width)[::_BLOCK, ::_BLOCK]
        rays, points = self._floor_points(first[any_in_blocks(through.reshape(height, width) > 0.01, _BLOCK)])
        lifted = points + np.array([0, 0, 1e-4 * self.reach], np.float32)
        up = np.broadcast_to(np.array([0, 0, 1], np.float32), (len(rays), 3))
        rows, columns = np.divmod(rays, width)
        pattern = (rows // _BLOCK % 4) * 4 + columns // _BLOCK % 4
        sky = sky_ratio(self.scene, lifted, up, pattern, 1.6 * self.reach)
        key = key_ratio(self.scene, lifted, pattern, self.toward)
        dark, known = np.zeros((2, width * height), np.float32)
        dark[rays], known[rays] = 1 - (1 - 0.24 * (1 - key)) * (1 - 0.42 * (1 - sky)), 1.0
        dark, known = (box_mean(grid.reshape(height, width)[::_BLOCK, ::_BLOCK]) for grid in (dark, known))
        smooth = dark / np.maximum(known, 1e-3)  # what the object hides is not counted in
        return enlarged(smooth, _BLOCK)[:height, :width].reshape(-1)

    def _floor_points(self, rays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns those of the rays that meet the floor near the object, and where they do."""
        ahead = self.directions[rays]
        below = ahead[:, 2] < -1e-6
        rays, ahead = (rays, ahead) if below.all() else (rays[below], ahead[below])
        distance = (self.low[2] - self.eye[2]) / ahead[:, 2]
        points = self.eye + ahead * distance[:, None]
        margin = 1.2 * (self.high[2] - self.low[2]) + self.reach
        (x, y), (left, front), (right, back) = points.T[:2], self.low[:2] - margin, self.high[:2] + margin
        near = (x > left) & (x < right) & (y > front) & (y < back)
        return rays[near], points[near].astype(np.float32)


@lru_cache(maxsize=2)  # a model's pictures have one camera; rays of samples, and of pixels
def _rays(camera: Camera, width: int, height: int) -> np.ndarray:
    return frozen_array(camera.rays(width, height), np.float32)


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
