"""The metric size of furniture from its shape and labels. The estimate ignores the input's unit, yaw and handedness.

Each measure that is found (depth, door width, drawer height, ...) states how large the unit is, within a spread; the
estimate is their weighted mean on a logarithmic scale, so scaling the input scales nothing but the result's inverse.
"""

import math
from typing import Final, final

import numpy as np

from grafu.asset.labels import is_doorway
from grafu.asset.part import Part
from grafu.asset.reading import Furniture
from grafu.dataclass import dataclass
from grafu.geometry.arrays import median
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.geometry.shells import shell_numbers
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class UsualSize:
    """How large something usually is, in metres, and the spread of its logarithm."""

    metres: float
    spread: float


# Sizes of European and American household furniture as sold; spreads are wide where kinds differ (a sideboard and a
# wardrobe differ in height by three, in depth hardly).
STORAGE: Final[dict[str, UsualSize]] = {
    "height": UsualSize(1.05, 0.6),
    "width": UsualSize(0.95, 0.6),
    "depth": UsualSize(0.45, 0.25),
    "door width": UsualSize(0.42, 0.3),
    "door height": UsualSize(0.80, 0.5),
    "drawer width": UsualSize(0.50, 0.4),
    "drawer height": UsualSize(0.18, 0.35),
    "handle length": UsualSize(0.13, 0.6),
    "panel thickness": UsualSize(0.020, 0.5),
}
TABLE: Final[dict[str, UsualSize]] = {
    "height": UsualSize(0.74, 0.15),
    "width": UsualSize(1.30, 0.4),
    "depth": UsualSize(0.65, 0.3),
    "drawer width": UsualSize(0.45, 0.4),
    "drawer height": UsualSize(0.13, 0.4),
    "panel thickness": UsualSize(0.025, 0.5),
}
# Doors and windows of buildings, with their frames.
DOOR: Final[dict[str, UsualSize]] = {
    "height": UsualSize(2.10, 0.1),
    "width": UsualSize(1.00, 0.4),
    "door height": UsualSize(2.02, 0.1),
}
WINDOW: Final[dict[str, UsualSize]] = {
    "height": UsualSize(1.30, 0.3),
    "width": UsualSize(1.10, 0.4),
}
_USUAL: Final[dict[Furniture, dict[str, UsualSize]]] = {
    "storage": STORAGE,
    "table": TABLE,
    "door": DOOR,
    "window": WINDOW,
}
# A unit in common use, in metres.
UNITS: Final = {"metres": 1.0, "centimetres": 0.01, "millimetres": 0.001, "inches": 0.0254}
_RARE: Final = ("inches",)
_OF_FRONTS: Final = frozenset(("door width", "door height", "drawer width", "drawer height", "handle length"))
_FLAT: Final = frozenset(("height", "width"))
_PANELS = (PartLabel.SIDE_PANEL, PartLabel.TOP_PANEL, PartLabel.BOTTOM_PANEL, PartLabel.SHELF, PartLabel.DIVIDER)


@final
@dataclass(frozen=True, slots=True)
class ScaleConfig:
    """When a size is believed, and when an object was scaled by a data set.

    Raises:
        ValueError: if a number is not above 0.
    """

    spread: float = 2.5
    """Largest factor between a unit in common use and the estimate (ratio)."""
    flat: float = 3.5
    """The same where width and height alone tell, as of what is flat: a frame in a wall has no usual width."""
    rare: float = 1.35
    """By how much farther from the estimate a usual unit may be than a rare one, inches (ratio)."""
    smallest: float = 0.1
    """Least largest side of furniture (metres) ..."""
    largest: float = 6.0
    """... its greatest, where the unit is one in common use (metres) ..."""
    largest_stated: float = 8.0
    """... and where the format states the unit (metres)."""
    contradicted: float = 4.0
    """Factor between the stated unit and the estimate from which on the estimate is believed (ratio)."""
    sides: tuple[float, ...] = (1.0, 2.0)
    """Largest side or diagonal of what was scaled by a data set (in units) ..."""
    exact: float = 1e-3
    """... to this fraction of it."""
    off_floor: float = 0.85
    """Distance of the middle of what hangs about the origin from it (fraction of half the sides)."""
    radii: tuple[float, float] = (0.99, 1.08)
    """Least and greatest radius of the sphere about the origin in which it lies (in units)."""
    plate: float = 0.25
    """Greatest thickness of a panel (fraction of its middle side): a whole case that is called a side is none."""
    doorway: float = 0.4
    """Greatest depth of a door with its frame (fraction of its width)."""
    shallow: float = 0.28
    """What is less deep hangs on a wall or closes a doorway: how deep it is does not tell how large (fraction of its
    width or height, whichever is less)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)

    def distance(self, unit: str, estimate: float) -> float:
        """Returns how far a unit in common use lies from the estimate, on a logarithmic scale."""
        return abs(math.log(UNITS[unit] / estimate)) + (math.log(self.rare) if unit in _RARE else 0.0)

    def is_believed(self, unit: float, size: float, estimate: "Estimate") -> bool:
        """Whether a stated unit makes furniture of that size, and no door, drawer or handle belies it."""
        near = abs(math.log(unit / estimate.scale)) < math.log(self.contradicted)
        return (near or not estimate.rests_on_fronts) and self.smallest <= size * unit <= self.largest_stated


@final
@dataclass(frozen=True)
class Estimate:
    """Metres per input unit, and the measures that it rests on, the weightiest first."""

    scale: float
    kind: Furniture
    measures: tuple[str, ...]

    @property
    def rests_on_fronts(self) -> bool:
        """Whether it rests on doors, drawers or handles, whose sizes differ less than those of rooms and panels."""
        return not _OF_FRONTS.isdisjoint(self.measures)

    @property
    def spread(self) -> float:
        """The standard error of the scale (fraction of it), from the spreads of the sizes that it rests on."""
        usual = _USUAL[self.kind]
        weight = sum(usual[name].spread ** -2 for name in self.measures)
        return math.expm1(weight**-0.5) if weight else math.inf


def estimate_scale(
    parts: tuple[Part, ...], whole: Box, up: int, furniture: Furniture | None, config: ScaleConfig = ScaleConfig()
) -> Estimate:
    """Returns the likely metric scale of a piece of furniture.

    Args:
        parts: labelled parts in input coordinates.
        whole: the box around them.
        up: the index of the vertical axis.
        furniture: what kind it is, where the input states it.
        config: what a doorway and a panel look like.
    """
    kind = furniture or _kind(parts, whole, up, config)
    usual = _USUAL[kind]
    found = {k: v for k, v in _measures(parts, whole, up, config).items() if v > 0}
    known = sorted(set(found) & set(usual), key=lambda k: (usual[k].spread, k))
    weights = np.array([usual[k].spread ** -2 for k in known])
    logs = np.array([math.log(usual[k].metres / found[k]) for k in known])
    return Estimate(float(np.exp(weights @ logs / weights.sum())), kind, tuple(known))


def likely_unit(size: float, estimate: Estimate, config: ScaleConfig = ScaleConfig()) -> tuple[str, float] | None:
    """Returns the unit in common use that makes the object plausible, or None.

    Args:
        size: the largest side in input units.
        estimate: the scale that shape and labels suggest.
        config: the sizes that are believed.
    """
    best = min(UNITS, key=lambda name: config.distance(name, estimate.scale))
    unit = UNITS[best]
    most = config.flat if _FLAT.issuperset(estimate.measures) else config.spread
    is_near = abs(math.log(unit / estimate.scale)) < math.log(most)
    return (best, unit) if is_near and config.smallest <= size * unit <= config.largest else None


def is_normalised(parts: tuple[Part, ...], whole: Box, config: ScaleConfig = ScaleConfig()) -> bool:
    """Whether an object looks scaled by a data set, so that its unit means nothing.

    That is: its largest side or diagonal is 1 unit, or 2 units where it hangs about the origin, or it hangs about the
    origin within a sphere of radius 1 (ShapeNet and PartNet), where real furniture, of 2 m as well, stands on a floor.
    """
    hangs = bool(np.all(np.abs(whole.center) < config.off_floor * whole.half))
    lengths = (float(whole.size.max()), float(whole.diagonal))
    units = config.sides if hangs else config.sides[:1]
    if any(abs(length - unit) < config.exact * unit for length in lengths for unit in units):
        return True
    if not hangs:
        return False
    radius = max(float(np.linalg.norm(p.mesh.vertices, axis=1).max()) for p in parts)
    return config.radii[0] < radius < config.radii[1]


def _kind(parts: tuple[Part, ...], whole: Box, up: int, config: ScaleConfig) -> Furniture:
    labels = {p.label for p in parts}
    if PartLabel.DRAWER not in labels and _is_doorway(parts, whole, up, config):
        return "door"
    if PartLabel.TOP_PANEL not in labels or PartLabel.LEG not in labels:
        return "storage"
    legs = [p.box.size[up] for p in parts if p.label is PartLabel.LEG]
    return "table" if legs and max(legs) > 0.5 * whole.size[up] else "storage"


def _is_doorway(parts: tuple[Part, ...], whole: Box, up: int, config: ScaleConfig) -> bool:
    """Whether a thin object, higher than wide, has a part that is called a door's frame, or one of its jambs."""
    depth, width = np.sort(np.delete(whole.size, up))
    if depth > config.doorway * width or width > whole.size[up]:
        return False
    return any(is_doorway(part.source.name) for part in parts)


def _longest_shell(handle: Part) -> float:
    """Returns the length of a handle; of one object that holds the handles of several fronts, that of its longest."""
    faces, number = handle.mesh.triangles, shell_numbers(handle.mesh)
    shells = [faces[number == k].reshape(-1, 3) for k in range(int(number.max(initial=0)) + 1)]
    return max(float(np.ptp(shell, axis=0).max()) for shell in shells)


def _measures(parts: tuple[Part, ...], whole: Box, up: int, config: ScaleConfig) -> dict[str, float]:
    height, (depth, width) = float(whole.size[up]), np.sort(np.delete(whole.size, up)).tolist()
    found = {"height": height, "width": width}
    if depth >= config.shallow * min(width, height):
        found["depth"] = depth
    for label, noun in ((PartLabel.DOOR, "door"), (PartLabel.DRAWER, "drawer")):
        boxes = [p.box.size for p in parts if p.label is label]
        if boxes:
            found[f"{noun} height"] = median([s[up] for s in boxes])
            found[f"{noun} width"] = median([np.delete(s, up).max() for s in boxes])
    handles = [_longest_shell(p) for p in parts if p.label is PartLabel.HANDLE]
    if handles:
        found["handle length"] = median(handles)
    sizes = [np.sort(p.box.size) for p in parts if p.label in _PANELS]
    panels = [size[0] for size in sizes if size[0] <= config.plate * size[1]]
    if panels:
        found["panel thickness"] = median(panels)
    return found
