"""The hinges and rails of a result, one by one, and a close-up of each from where it is seen best.

Hardware stands out by colour, everything else is plain. Where boards hide it from all sides, they are shown faint.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import cos, radians, sin

import numpy as np
from PIL import Image

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual, VisualRole
from grafu.articulation.kinematics import link_poses
from grafu.articulation.sweep import rest_to_full
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.box import Box
from grafu.render.camera import Camera, three_quarter_view
from grafu.render.exposure import PictureStyle
from grafu.render.picture import Picture, box_of, render
from grafu.render.ray_scene import RayScene

Colour = tuple[float, float, float]

ON_FIXED: Colour = (0.80, 0.13, 0.02)
ON_MOVING: Colour = (0.02, 0.17, 0.75)
SUPPORT: Colour = (0.80, 0.55, 0.02)
MOVING_PART: Colour = (0.66, 0.52, 0.36)
OTHER_PART: Colour = (0.66, 0.67, 0.68)
OTHER_HARDWARE: Colour = (0.28, 0.28, 0.30)


@dataclass(frozen=True)
class CloseUpConfig:
    """How near the camera is, and from where it may look."""

    margin: float = 1.5
    """How much larger than the hardware the view is."""
    least_size: float = 0.05
    """Metres: smaller hardware is seen from no nearer, or nothing around it could be recognised."""
    azimuths: int = 12
    elevations: tuple[float, ...] = tuple(radians(degrees) for degrees in (-60, -30, -5, 15, 35, 60))
    grid: int = 28
    """Rays across the view by which the directions are compared."""
    detail: float = 0.75
    """Of the picture's size, how large it is drawn before it is enlarged: close-ups are most of a sheet's time."""
    least_visible: float = 0.3
    """Where less of the hardware is seen than this fraction of its whole outline, what hides it becomes faint ..."""
    least_end: float = 0.15
    """... and where less than this is seen of the end on what is fixed, or of that on what moves."""
    least_seen: float = 0.4
    """A view is good where it shows at least this fraction of what the best view would without anything that hides."""
    least_hiding: float = 0.08
    """What hides a smaller fraction of the hardware's outline is left as it is."""
    faint: float = 0.2
    """How much of what hides hardware remains in the picture."""
    from_front: float = 0.25
    """How much more a view from the front counts than one from behind: people know furniture from there ..."""
    from_above: float = 0.25
    """... and one from above than one from below, where it is dark, too."""
    brightness: float = 1.1
    """The exponent by which a close-up is made lighter: insides of furniture are dark."""


@dataclass(frozen=True)
class Device:
    """One hinge or rail of a joint, by the names of its visuals: on what is fixed, on what moves, and supports.

    A joint without hardware is one device without visuals: the moving part stands for it.
    """

    joint: str
    title: str
    fixed: frozenset[str] = frozenset()
    moving: frozenset[str] = frozenset()
    supports: frozenset[str] = frozenset()

    @property
    def visuals(self) -> frozenset[str]:
        """The names of all its visuals."""
        return self.fixed | self.moving | self.supports


@dataclass(frozen=True)
class CloseUp:
    """A picture of one device, and whether what hides it is drawn faint."""

    picture: Picture
    is_through: bool


@dataclass(frozen=True)
class View:
    """A camera, and how much of a device it sees: as it is, and if nothing hid it.

    `visible` and `whole` are numbers of rays of a grid, one for each visual of the device.
    """

    azimuth: float
    elevation: float
    camera: Camera
    visible: np.ndarray
    whole: np.ndarray

    def score(self, counts: np.ndarray, config: CloseUpConfig) -> float:
        """Returns how good a view is by what it sees of each visual: all of them count more than one large one."""
        balanced = float(counts.sum()) + len(counts) * float(counts.min(initial=counts.sum()))
        front = config.from_front * cos(self.azimuth) * cos(self.elevation)
        return balanced * (1 + front + config.from_above * sin(self.elevation))

    def shows(self, config: CloseUpConfig) -> bool:
        """Whether enough of the device is visible, and something of each of its visuals."""
        return bool(
            self.visible.sum() >= config.least_visible * self.whole.sum()
            and np.all(self.visible >= config.least_end * self.whole)
        )


class Eye:
    """Looks at some visuals among others from any side."""

    def __init__(self, visuals: Sequence[Visual], shown: frozenset[str], aspect: float, config: CloseUpConfig) -> None:
        pieces = [v for v in visuals if v.name in shown]
        self._scene, self._alone = RayScene(visuals), RayScene(pieces)
        self._rows = np.array([k for k, v in enumerate(visuals) if v.name in shown])
        box = box_of(pieces)
        half = np.maximum(box.half, config.least_size / 2)
        self._box, self._cube = Box.from_center(box.center, half), Box.from_center(box.center, np.full(3, half.max()))
        self._aspect, self._config = aspect, config

    def view(self, azimuth: float, elevation: float, near: bool = False) -> View:
        """Returns what is seen from a side, `near` or at the scale that is the same from all sides."""
        box, margin = (self._box, self._config.margin) if near else (self._cube, 1.0)
        camera = three_quarter_view(box, self._aspect, azimuth, elevation, margin)
        directions = camera.rays(self._config.grid, round(self._config.grid / self._aspect))
        origins = np.tile(camera.eye.astype(np.float32), (len(directions), 1))
        met = (scene.cast(origins, directions).visual for scene in (self._scene, self._alone))
        visible, whole = (np.bincount(visual, minlength=self._rows[-1] + 1) for visual in met)
        return View(azimuth, elevation, camera, visible[self._rows], whole[: len(self._rows)])


def devices_of(articulated: ArticulatedObject) -> list[Device]:
    """Returns all hinges and rails, joint by joint; a joint without hardware counts as one."""
    return [device for joint in articulated.moving_joints for device in _devices(articulated, joint)]


def close_up(
    articulated: ArticulatedObject, device: Device, size: tuple[int, int], config: CloseUpConfig = CloseUpConfig()
) -> CloseUp:
    """Returns a device as it is while its joint is open, the joints that it waits for open, all others closed."""
    visuals = painted_visuals(articulated, device, open_pose(articulated, device.joint))
    shown = (device.fixed | device.moving) or _names_below(articulated, device.joint)
    aspect = size[0] / size[1]
    view, is_through = best_view(visuals, shown, aspect, config)
    picture = _rendered(visuals, view.camera, size, config)
    if not is_through:
        return CloseUp(picture, False)
    hidden = hiding(visuals, shown, view.camera, aspect, config)
    bared = _rendered([v for v in visuals if v.name not in hidden], view.camera, size, config)
    mixed = config.faint * picture.astype(float) + (1 - config.faint) * bared.astype(float)
    return CloseUp(np.round(mixed).astype(np.uint8), True)


def open_pose(articulated: ArticulatedObject, joint: str) -> dict[str, float]:
    """Returns the values at which a joint is fully open."""
    return rest_to_full(articulated, joint, 2)[-1]


def painted_visuals(articulated: ArticulatedObject, device: Device, values: Mapping[str, float]) -> list[Visual]:
    """Returns all visuals in a pose, in plain colours that tell apart what moves, what does not, and the hardware."""
    poses = link_poses(articulated, values)
    child = next(joint.child for joint in articulated.joints if joint.id == device.joint)
    return [
        _painted(visual, _colour(visual, device, link.id == child), poses[link.id])
        for link in articulated.links
        for visual in link.visuals
    ]


def best_view(
    visuals: Sequence[Visual], shown: frozenset[str], aspect: float, config: CloseUpConfig
) -> tuple[View, bool]:
    """Returns the view that shows most of some visuals, and whether what hides them must become faint even so."""
    eye = Eye(visuals, shown, aspect, config)
    views = [eye.view(*angles) for angles in _directions(config)]
    best = max(views, key=lambda view: view.score(view.visible, config))
    largest = max(int(view.whole.sum()) for view in views)
    near = eye.view(best.azimuth, best.elevation, near=True)
    if best.visible.sum() >= config.least_seen * largest and near.shows(config):
        return near, False
    best = max(views, key=lambda view: view.score(view.visible, config) + view.score(view.whole, config))
    return eye.view(best.azimuth, best.elevation, near=True), True


def hiding(
    visuals: Sequence[Visual], shown: frozenset[str], camera: Camera, aspect: float, config: CloseUpConfig
) -> frozenset[str]:
    """Returns the names of the visuals that stand between a camera and those that are to be shown."""
    alone = RayScene([v for v in visuals if v.name in shown])
    directions = camera.rays(config.grid, round(config.grid / aspect))
    origins = np.tile(camera.eye.astype(np.float32), (len(directions), 1))
    directions = directions[alone.cast(origins, directions).ray]
    found: set[str] = set()
    while True:
        left = [v for v in visuals if v.name not in found]
        met = RayScene(left).cast(origins[: len(directions)], directions).visual
        found_now, counts = np.unique(met, return_counts=True)
        least = config.least_hiding * len(directions)
        blockers = {left[k].name for k, count in zip(found_now, counts, strict=True) if count > least} - shown
        if not blockers:
            return frozenset(found)
        found |= blockers


def _devices(articulated: ArticulatedObject, joint: Joint) -> list[Device]:
    pattern = re.compile(rf"(hinge|rail|support)_{re.escape(joint.child)}_([a-z0-9]+)_([a-z]+)")
    found: dict[str, dict[str, set[str]]] = {}
    for link in articulated.links:
        for visual in link.visuals:
            match = pattern.fullmatch(visual.name) if visual.role is VisualRole.HARDWARE else None
            if match:
                kind = "supports" if match[1] == "support" else "moving" if link.id == joint.child else "fixed"
                found.setdefault(match[2], {}).setdefault(kind, set()).add(visual.name)
    if not found:
        return [Device(joint.id, "no hardware")]
    named = [(f"hinge {int(k) + 1} of {len(found)}" if k.isdigit() else f"{k} rail", found[k]) for k in sorted(found)]
    return [Device(joint.id, title, **{kind: frozenset(names) for kind, names in of.items()}) for title, of in named]


def _names_below(articulated: ArticulatedObject, joint: str) -> frozenset[str]:
    child = next(j.child for j in articulated.joints if j.id == joint)
    return frozenset(visual.name for visual in articulated.link(child).visuals)


def _colour(visual: Visual, device: Device, moves: bool) -> Colour:
    marked = ((device.fixed, ON_FIXED), (device.moving, ON_MOVING), (device.supports, SUPPORT))
    for names, colour in marked:
        if visual.name in names:
            return colour
    if visual.role is VisualRole.HARDWARE:
        return OTHER_HARDWARE
    return MOVING_PART if moves else OTHER_PART


def _painted(visual: Visual, colour: Colour, pose: np.ndarray) -> Visual:
    """Returns a visual in one colour, moved; what was clear remains so."""
    surfaces = []
    for surface in visual.surfaces:
        alpha = surface.material.base_color[3] if surface.material.alpha_mode == "BLEND" else 1.0
        paint = Material("paint", (*colour, alpha), roughness=0.7, alpha_mode="BLEND" if alpha < 1 else "OPAQUE")
        surfaces.append(Surface(surface.mesh, paint, normals=surface.normals).transformed(pose))
    return replace(visual, surfaces=tuple(surfaces))


def _directions(config: CloseUpConfig) -> Iterator[tuple[float, float]]:
    """Yields azimuths and elevations all around."""
    turns = 2 * np.pi * (np.arange(config.azimuths) + 0.5) / config.azimuths
    return product(turns.tolist(), config.elevations)


def _rendered(visuals: Sequence[Visual], camera: Camera, size: tuple[int, int], config: CloseUpConfig) -> Picture:
    drawn = max(round(config.detail * size[0]), 1), max(round(config.detail * size[1]), 1)
    picture = render(visuals, camera, drawn, PictureStyle(shadow=False))
    picture = np.round(255 * (picture / 255.0) ** (1 / config.brightness)).astype(np.uint8)
    return np.array(Image.fromarray(picture).resize(size, Image.Resampling.LANCZOS))
