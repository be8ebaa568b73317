"""Mass, centre and inertia of links, from the volume of their parts and how their materials are built.

Volume is found for any mesh, also with modelling errors. Watertight surfaces count by what they enclose, filled no
deeper than the walls of their material. Open ones, and sheets without thickness, count as shells: their area, doubled
faces once, times a sheet's thickness. Nothing counts for more than the box around it.
"""

from collections.abc import Callable
from math import inf
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Link
from grafu.articulation.build_material import DEFAULT_MASS_CONFIG, MassConfig, builds_of
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Vec3, cross, freeze_arrays, renumbered
from grafu.geometry.box import Box, yaw_of
from grafu.geometry.components import Patches, patches_of
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.transform import rotation_matrix


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
    wall: float = inf,
) -> Moments:
    """Returns the moments of a mesh.

    `thickness` is that of open shells and of sheets, thinner than `flat`; `wall` is how deep below its surface a closed
    part is filled (metres).
    """
    patches = patches_of(mesh)
    if not len(patches.faces):
        return NO_MOMENTS
    triangles = mesh.vertices[patches.faces]
    R = rotation_matrix(
        np.array([0.0, 0.0, 1.0]), yaw_of(mesh.vertices[renumbered(patches.faces, len(mesh.vertices))[0]])
    )
    sides = _sides(triangles @ R, patches)
    boxes, shell = _box_volumes(sides, thickness, flat), _shell_thickness(sides, thickness, flat)
    sums, spreads = triangles.sum(axis=1), _spreads(triangles)
    solid = _solid_moments(triangles, sums, spreads, patches)
    sheet = _shell_moments(triangles, sums, spreads, patches, shell)
    # closed, but as thin as a sheet: front and back of one sheet, cut into triangles differently
    real = patches.closed & (solid[:, 0] > 0.5 * flat * 0.5 * sheet[:, 0] / shell)
    filled = np.minimum(sheet[:, 0] / shell * wall, solid[:, 0])
    solid = np.where(
        (filled < solid[:, 0])[:, None], sheet * (filled / np.maximum(sheet[:, 0], 1e-300))[:, None], solid
    )
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
    wall: float = inf,
) -> Moments:
    """Returns the moments of as much as the faces of a mesh are boards of `thickness`, all over the box around it.

    It is what a mesh counts for where there is no time to look at its shape; at most the box's volume, and what its
    faces are if each is a `wall`.
    """
    if not len(mesh.faces):
        return NO_MOMENTS
    size, center = mesh.box.size, mesh.box.center
    volume = min(mesh.area / 2.0 * thickness, mesh.area * wall, float(_box_volumes(size[None], thickness, flat)[0]))
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


def _spreads(triangles: np.ndarray) -> np.ndarray:
    """Returns the second moments of the three corners of triangles, and of their sum, about the origin, (n, 3, 3).

    A triangle has a twelfth of that, times its area, a tetrahedron to the origin a twentieth, times its volume.
    """
    corners = np.concatenate([triangles, triangles.sum(axis=1, keepdims=True)], axis=1)
    return np.asarray(corners.swapaxes(1, 2) @ corners)


def _solid_moments(triangles: np.ndarray, sums: np.ndarray, spreads: np.ndarray, patches: Patches) -> np.ndarray:
    """Returns volume, first and second moments of what each patch encloses, (patches, 13); exact where it is closed."""
    volume = np.einsum("nd,nd->n", triangles[:, 0], cross(triangles[:, 1], triangles[:, 2])) / 6.0
    first = volume[:, None] * sums / 4.0
    second = (volume / 20.0)[:, None, None] * spreads
    return _summed(np.column_stack([volume, first, second.reshape(-1, 9)]), patches)


def _shell_moments(
    triangles: np.ndarray, sums: np.ndarray, spreads: np.ndarray, patches: Patches, thickness: np.ndarray
) -> np.ndarray:
    """Returns the moments of each patch as a shell, (patches, 13); its thickness lies half on either side."""
    across = cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(across, axis=1)
    normal = across / np.maximum(length, 1e-300)[:, None]
    t = thickness[patches.patch]
    volume = length / 2.0 * t
    first = volume[:, None] * sums / 3.0
    second = (volume / 12.0)[:, None, None] * spreads
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
    measured: Callable[[TriangleMesh, float, float, float], Moments] = moments_of,
) -> MassProperties:
    """Returns the mass properties of a link in the object frame at rest.

    `measured` finds the moments of a mesh, given the thickness of shells, what counts as flat, and that of walls.
    A link without any volume is a small cube of the least mass in its middle (without faces: at the origin).
    """
    total = NO_MOMENTS
    for visual in link.visuals:
        for build, ratio in builds_of(visual, config).items():  # as if each went evenly over the whole part
            made = measured(visual.mesh, build.sheet, config.flat, build.wall)
            total = total.plus(made.scaled(ratio * build.density))
    if total.volume <= 0:
        center = link.mesh.box.center if len(link.mesh.faces) else np.zeros(3)
        return MassProperties(config.least_mass, center, np.eye(3) * config.least_mass * config.least_size**2 / 6.0)
    extent = link.mesh.box.diagonal
    return _mass_properties(total.scaled(max(1.0, config.least_mass / total.volume)), extent, config.needle)


def _mass_properties(moments: Moments, extent: float, needle: float) -> MassProperties:
    """Turns moments of mass into mass properties; numbers that no body of this extent could have are mended."""
    mass, center = moments.volume, moments.first / moments.volume
    spread = moments.second / mass - np.outer(center, center)
    values, axes = np.linalg.eigh((spread + spread.T) / 2)
    # at least `needle` across and at most the whole extent, so that no solver meets a needle without inertia
    values = np.clip(values, needle**2 / 12.0, extent**2 / 4.0 + needle**2 / 12.0)
    inertia = mass * axes @ np.diag(values.sum() - values) @ axes.T
    return MassProperties(mass, center, (inertia + inertia.T) / 2)
