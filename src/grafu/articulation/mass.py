"""Mass, centre and inertia of links, from the volume of their parts and stated densities. It knows no file format."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Link, Visual, VisualRole
from grafu.articulation.moments import BOARD_THICKNESS, NO_MOMENTS, Moments, moments_of
from grafu.geometry.appearance import Material
from grafu.geometry.arrays import ArrayValue, Mat3, Vec3, freeze_arrays
from grafu.vocabulary import PartLabel

# kg/m3, by a word in a material's name; the first that fits counts
DENSITY_BY_WORD: Mapping[str, float] = MappingProxyType(
    {"glass": 2500.0, "mirror": 2500.0, "brass": 8500.0, "alumin": 2700.0, "steel": 7800.0, "iron": 7800.0}
    | {"chrome": 7800.0, "metal": 7800.0, "marble": 2700.0, "granite": 2700.0, "stone": 2600.0, "ceramic": 2400.0}
    | {"plastic": 1100.0, "leather": 900.0, "fabric": 300.0, "rattan": 400.0, "wicker": 400.0}
)
_WOOD = 650.0  # particle board and softwood plywood: 600 to 700 kg/m3
_STEEL = 7800.0
_GLASS = 2500.0
_ZINC_AND_WOOD = 2700.0  # handles are hollow zinc, aluminium or wood: aluminium's density lies between


@final
@dataclass(frozen=True)
class MassConfig:
    """Densities in kg/m3, lengths in metres.

    `board_thickness` is that of shells drawn without thickness; `least_mass` (kg) keeps solvers stable.
    """

    default_density: float = _WOOD
    hardware_density: float = _STEEL
    handle_density: float = _ZINC_AND_WOOD
    density_by_word: Mapping[str, float] = field(default_factory=lambda: DENSITY_BY_WORD)
    board_thickness: float = BOARD_THICKNESS
    least_mass: float = 0.01


DEFAULT_MASS_CONFIG = MassConfig()


@final
@dataclass(frozen=True, eq=False, slots=True)
class MassProperties(ArrayValue):
    """Mass in kg, centre of mass in metres, inertia in kg m2 about that centre; axes and origin of the object frame.

    Raises:
        ValueError: if the mass is not positive, or the inertia is not that of a body (positive definite, no principal
            moment above the sum of the other two).
    """

    mass: float
    center: Vec3
    inertia: Mat3

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)
        least, middle, most = np.linalg.eigvalsh(self.inertia)
        if not (self.mass > 0 and least > 0 and most <= (least + middle) * (1 + 1e-9)):
            found = f"mass {self.mass}, principal moments {least}, {middle}, {most}"
            raise ValueError(f"`MassProperties` must be those of a body with extent: got {found}")


def mass_of_link(link: Link, config: MassConfig = DEFAULT_MASS_CONFIG) -> MassProperties:
    """Returns the mass properties of a link in the object frame at rest.

    A link without any volume is a ten-centimetre cube of the least mass in its middle (without faces: at the origin).
    """
    total = NO_MOMENTS
    for visual in link.visuals:
        total = total.plus(moments_of(visual.mesh, config.board_thickness).scaled(density_of(visual, config)))
    if total.volume <= 0:
        center = link.mesh.box.center if len(link.mesh.faces) else np.zeros(3)
        return MassProperties(config.least_mass, center, np.eye(3) * config.least_mass * 0.1**2 / 6.0)
    extent = link.mesh.box.diagonal
    return _mass_properties(total.scaled(max(1.0, config.least_mass / total.volume)), extent)


def density_of(visual: Visual, config: MassConfig = DEFAULT_MASS_CONFIG) -> float:
    """Returns the density of a visual in kg/m3: that of its materials, weighted by area."""
    areas = np.array([surface.mesh.area for surface in visual.surfaces])
    if areas.sum() <= 0:
        return config.default_density
    densities = [_density(surface.material, visual, config) for surface in visual.surfaces]
    return float(areas @ densities / areas.sum())


def _density(material: Material, visual: Visual, config: MassConfig) -> float:
    if visual.role is VisualRole.HARDWARE:
        return config.default_density if visual.name.startswith("support_") else config.hardware_density
    name = material.name.lower()
    for word, density in config.density_by_word.items():
        if word in name:
            return density
    if material.alpha_mode == "BLEND" and material.base_color[3] < 0.7:
        return _GLASS
    return config.handle_density if visual.label is PartLabel.HANDLE else config.default_density


def _mass_properties(moments: Moments, extent: float) -> MassProperties:
    """Turns moments of mass into mass properties; numbers that no body of this extent could have are mended."""
    mass, center = moments.volume, moments.first / moments.volume
    spread = moments.second / mass - np.outer(center, center)
    values, axes = np.linalg.eigh((spread + spread.T) / 2)
    # at least 1 mm across and at most the whole extent, so that no solver meets a needle without inertia
    values = np.clip(values, 1e-3**2 / 12.0, extent**2 / 4.0 + 1e-3**2 / 12.0)
    inertia = mass * axes @ np.diag(values.sum() - values) @ axes.T
    return MassProperties(mass, center, (inertia + inertia.T) / 2)
