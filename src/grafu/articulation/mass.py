"""Mass, centre and inertia of links, from the volume of their parts and stated densities.

Volume is found for any mesh, also with modelling errors. Watertight surfaces count by what they enclose. Open ones, and
sheets without thickness, count as shells: their area, doubled faces once, times a board's thickness. Nothing counts for
more than the box around it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Link, Visual, VisualRole
from grafu.geometry.appearance import Material
from grafu.geometry.arrays import ArrayValue, Mat3, Vec3, freeze_arrays
from grafu.geometry.box import Box, yaw_of
from grafu.geometry.components import Patches, patches_of
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.transform import rotation_matrix
from grafu.visible import ShortRepr
from grafu.vocabulary import PartLabel

_BY_WORD: Mapping[str, float] = MappingProxyType(
    {"glass": 2500.0, "mirror": 2500.0, "brass": 8500.0, "alumin": 2700.0, "steel": 7800.0, "iron": 7800.0}
    | {"chrome": 7800.0, "metal": 7800.0, "marble": 2700.0, "granite": 2700.0, "stone": 2600.0, "ceramic": 2400.0}
    | {"plastic": 1100.0, "leather": 900.0, "fabric": 300.0, "rattan": 400.0, "wicker": 400.0}
)


@final
@dataclass(frozen=True)
class MassConfig(ShortRepr):
    """Densities, and the least that counts as a body.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    default_density: float = 650.0
    """Particle board and softwood plywood weigh 600 to 700 (kg/m3)."""
    hardware_density: float = 7800.0
    """Steel (kg/m3)."""
    handle_density: float = 2700.0
    """Handles are hollow zinc, aluminium or wood: aluminium's density lies between (kg/m3)."""
    glass_density: float = 2500.0
    """Of what can be seen through (kg/m3)."""
    see_through: float = 0.7
    """What is less opaque than this is glass (alpha)."""
    density_by_word: Mapping[str, float] = field(default_factory=lambda: _BY_WORD)
    """By a word in a material's name; the first that fits counts (kg/m3)."""
    board_thickness: float = 0.015
    """Of shells drawn without thickness: furniture boards come in 15 to 19 mm (metres)."""
    flat: float = 0.001
    """A box thinner than this was drawn as a sheet: its thickness is not meant (metres)."""
    least_mass: float = 0.01
    """What keeps solvers stable (kg) ..."""
    least_size: float = 0.1
    """... as a cube with this side, where a link has no volume (metres)."""
    needle: float = 0.001
    """A body is as wide as this at least, so that no solver meets one without inertia (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, *(set(self.__dataclass_fields__) - {"density_by_word"}))
        require_ratios(self, "see_through")


DEFAULT_MASS_CONFIG = MassConfig()
_TETRAHEDRON = (np.ones((4, 4)) + np.eye(4)) / 20.0  # second moments of a unit tetrahedron in its corners
_TRIANGLE = (np.ones((3, 3)) + np.eye(3)) / 12.0


@final
@dataclass(frozen=True, eq=False, slots=True)
class Moments(ArrayValue):
    """Volume (cubic metres) with its first and second moments about the object frame's origin.

    `first` is the integral of x, `second` of x times x transposed.
    """

    volume: float
    first: Vec3
    second: Mat3

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)

    def scaled(self, factor: float) -> "Moments":
        """Returns the moments of `factor` times as much of everything (as by a density)."""
        return Moments(self.volume * factor, self.first * factor, self.second * factor)

    def plus(self, other: "Moments") -> "Moments":
        """Returns the moments of both bodies together."""
        return Moments(self.volume + other.volume, self.first + other.first, self.second + other.second)


NO_MOMENTS = Moments(0.0, np.zeros(3), np.zeros((3, 3)))


def moments_of(
    mesh: TriangleMesh,
    thickness: float = DEFAULT_MASS_CONFIG.board_thickness,
    flat: float = DEFAULT_MASS_CONFIG.flat,
) -> Moments:
    """Returns the moments of a mesh; `thickness` is that of open shells and of sheets, thinner than `flat` (metres)."""
    patches = patches_of(mesh)
    if not len(patches.faces):
        return NO_MOMENTS
    triangles = mesh.vertices[patches.faces]
    R = rotation_matrix(np.array([0.0, 0.0, 1.0]), yaw_of(mesh.vertices[np.unique(patches.faces)]))
    sides = _sides(triangles @ R, patches)
    boxes, shell = _box_volumes(sides, thickness, flat), _shell_thickness(sides, thickness, flat)
    solid = _solid_moments(triangles, patches)
    sheet = _shell_moments(triangles, patches, shell)
    # closed, but as thin as a sheet: front and back of one sheet, cut into triangles differently
    real = patches.closed & (solid[:, 0] > 0.5 * flat * 0.5 * sheet[:, 0] / shell)
    sheet[patches.closed] *= 0.5
    chosen = np.where(real[:, None], solid, sheet)
    chosen *= np.minimum(1.0, boxes / np.maximum(chosen[:, 0], 1e-300))[:, None]
    total = chosen.sum(axis=0)
    whole = _box_volumes(Box.around((triangles @ R).reshape(-1, 3)).size[None], thickness, flat)[0]
    total *= min(1.0, whole / max(total[0], 1e-300))
    return Moments(float(total[0]), total[1:4], total[4:].reshape(3, 3))


def moments_of_box(
    mesh: TriangleMesh,
    thickness: float = DEFAULT_MASS_CONFIG.board_thickness,
    flat: float = DEFAULT_MASS_CONFIG.flat,
) -> Moments:
    """Returns the moments of as much as the faces of a mesh are boards of `thickness`, all over the box around it.

    It is what a mesh counts for where there is no time to look at its shape; at most the box's volume.
    """
    if not len(mesh.faces):
        return NO_MOMENTS
    size, center = mesh.box.size, mesh.box.center
    volume = min(mesh.area / 2.0 * thickness, float(_box_volumes(size[None], thickness, flat)[0]))
    second = np.diag(size**2 / 12.0) + np.outer(center, center)
    return Moments(volume, volume * center, volume * second)


def _sides(triangles: np.ndarray, patches: Patches) -> np.ndarray:
    """Returns the side lengths of each patch's box, (patches, 3)."""
    order = np.argsort(patches.patch, kind="stable")
    starts = np.searchsorted(patches.patch[order], np.arange(len(patches.closed)))
    lows, highs = triangle_bounds(triangles)
    low = np.minimum.reduceat(lows[order], starts, axis=0)
    high = np.maximum.reduceat(highs[order], starts, axis=0)
    return high - low


def _shell_thickness(sides: np.ndarray, thickness: float, flat: float) -> np.ndarray:
    thin = sides.min(axis=1)
    return np.where(thin < flat, thickness, np.minimum(thickness, thin))


def _box_volumes(sides: np.ndarray, thickness: float, flat: float) -> np.ndarray:
    """Returns the volumes of boxes; one that is flat is taken to be `thickness` thick."""
    return np.prod(
        np.where(sides < flat, np.minimum(thickness, sides.max(axis=1, keepdims=True)), sides),
        axis=1,
    )


def _solid_moments(triangles: np.ndarray, patches: Patches) -> np.ndarray:
    """Returns volume, first and second moments of what each patch encloses, (patches, 13); exact where it is closed."""
    volume = np.einsum("nd,nd->n", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6.0
    first = volume[:, None] * triangles.sum(axis=1) / 4.0
    corners = np.concatenate([triangles, np.zeros((len(triangles), 1, 3))], axis=1)
    second = np.einsum("n,nid,ij,nje->nde", volume, corners, _TETRAHEDRON, corners, optimize=True)
    return _summed(np.column_stack([volume, first, second.reshape(-1, 9)]), patches)


def _shell_moments(triangles: np.ndarray, patches: Patches, thickness: np.ndarray) -> np.ndarray:
    """Returns the moments of each patch as a shell, (patches, 13); its thickness lies half on either side."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(cross, axis=1)
    normal = cross / np.maximum(length, 1e-300)[:, None]
    t = thickness[patches.patch]
    volume = length / 2.0 * t
    first = volume[:, None] * triangles.sum(axis=1) / 3.0
    second = np.einsum("n,nid,ij,nje->nde", volume, triangles, _TRIANGLE, triangles, optimize=True)
    second += (volume * t**2 / 12.0)[:, None, None] * normal[:, :, None] * normal[:, None, :]
    return _summed(np.column_stack([volume, first, second.reshape(-1, 9)]), patches)


def _summed(rows: np.ndarray, patches: Patches) -> np.ndarray:
    count = len(patches.closed)
    return np.column_stack([np.bincount(patches.patch, column, count) for column in rows.T])


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


def mass_of_link(
    link: Link,
    config: MassConfig = DEFAULT_MASS_CONFIG,
    measured: Callable[[TriangleMesh, float, float], Moments] = moments_of,
) -> MassProperties:
    """Returns the mass properties of a link in the object frame at rest.

    `measured` finds the moments of a mesh, given the thickness of boards and that of sheets.
    A link without any volume is a small cube of the least mass in its middle (without faces: at the origin).
    """
    total = NO_MOMENTS
    for visual in link.visuals:
        total = total.plus(
            measured(visual.mesh, config.board_thickness, config.flat).scaled(density_of(visual, config))
        )
    if total.volume <= 0:
        center = link.mesh.box.center if len(link.mesh.faces) else np.zeros(3)
        return MassProperties(config.least_mass, center, np.eye(3) * config.least_mass * config.least_size**2 / 6.0)
    extent = link.mesh.box.diagonal
    return _mass_properties(total.scaled(max(1.0, config.least_mass / total.volume)), extent, config.needle)


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
    if material.alpha_mode == "BLEND" and material.base_color[3] < config.see_through:
        return config.glass_density
    return config.handle_density if visual.label is PartLabel.HANDLE else config.default_density


def _mass_properties(moments: Moments, extent: float, needle: float) -> MassProperties:
    """Turns moments of mass into mass properties; numbers that no body of this extent could have are mended."""
    mass, center = moments.volume, moments.first / moments.volume
    spread = moments.second / mass - np.outer(center, center)
    values, axes = np.linalg.eigh((spread + spread.T) / 2)
    # at least `needle` across and at most the whole extent, so that no solver meets a needle without inertia
    values = np.clip(values, needle**2 / 12.0, extent**2 / 4.0 + needle**2 / 12.0)
    inertia = mass * axes @ np.diag(values.sum() - values) @ axes.T
    return MassProperties(mass, center, (inertia + inertia.T) / 2)
