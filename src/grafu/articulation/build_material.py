"""What parts are made of, by their material, role and label: density, how thick its walls are, how thick a sheet is.

Models show the outside of things. A cabinet of steel is folded from sheet, a thick case of wood is built from boards:
neither weighs what a solid of its outline would. Of a mesh it knows only the area.
"""

from collections.abc import Mapping
from dataclasses import field
from types import MappingProxyType
from typing import final

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.visible import ShortRepr
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class MaterialBuild:
    """How parts of a material are built: density in kg/m3, lengths in metres.

    `wall` is how deep below its surface a closed part is filled: what is thinner than two walls is solid. `sheet` is
    how thick what was drawn without thickness is.

    Raises:
        ValueError: if a number is not above 0.
    """

    density: float
    wall: float
    sheet: float

    def __post_init__(self) -> None:
        require_positive(self, "density", "wall", "sheet")


_GLASS = MaterialBuild(2500.0, 0.0025, 0.005)  # panes of 4 to 6 mm
_STEEL = MaterialBuild(7800.0, 0.001, 0.001)  # cabinets of 0.7 to 1.2 mm sheet, tubes with such walls
_TEXTILE = 0.02
_BY_WORD: Mapping[str, MaterialBuild] = MappingProxyType(
    {
        "glass": _GLASS,
        "mirror": _GLASS,
        "plastic": MaterialBuild(1100.0, 0.003, 0.003),
        "rubber": MaterialBuild(1200.0, 0.01, 0.003),
        "brass": MaterialBuild(8500.0, 0.002, 0.001),
        "alumin": MaterialBuild(2700.0, 0.0015, 0.0015),
        "zinc": MaterialBuild(6700.0, 0.002, 0.001),
        "iron": MaterialBuild(7800.0, 0.004, 0.002),
        "steel": _STEEL,
        "chrome": _STEEL,
        "metal": _STEEL,
        "powder": _STEEL,  # only metal is powder-coated
        "marble": MaterialBuild(2700.0, 0.015, 0.02),
        "granite": MaterialBuild(2700.0, 0.015, 0.02),
        "stone": MaterialBuild(2600.0, 0.015, 0.02),
        "ceramic": MaterialBuild(2400.0, 0.005, 0.008),
        "leather": MaterialBuild(900.0, 0.003, 0.003),
        "fabric": MaterialBuild(300.0, _TEXTILE, 0.005),
        "rattan": MaterialBuild(400.0, 0.005, 0.005),
        "wicker": MaterialBuild(400.0, 0.005, 0.005),
    }
)


@final
@dataclass(frozen=True)
class MassConfig(ShortRepr):
    """Densities, thicknesses, and the least that counts as a body.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    default_density: float = 650.0
    """Particle board and softwood plywood weigh 600 to 700 (kg/m3)."""
    board_thickness: float = 0.016
    """Of shells drawn without thickness: furniture boards come in 15 to 19 mm (metres)."""
    solid_wood: float = 0.02
    """Boards up to twice this and posts up to four times this are solid; what is thicker is built from boards with a
    hollow inside (metres)."""
    hardware_density: float = 7800.0
    """Steel (kg/m3)."""
    hardware_wall: float = 0.01
    """Hinges and rails are drawn with their real thickness: pins of 40 mm are solid (metres)."""
    handle_density: float = 2700.0
    """Handles are hollow zinc, aluminium or wood: aluminium's density lies between (kg/m3)."""
    handle_wall: float = 0.003
    """Bars up to 12 mm are solid, knobs are cast hollow (metres)."""
    see_through: float = 0.7
    """What is less opaque than this is glass (alpha)."""
    build_by_word: Mapping[str, MaterialBuild] = field(default_factory=lambda: _BY_WORD)
    """By a word in a material's name; the first that fits counts."""
    flat: float = 0.001
    """A box thinner than this was drawn as a sheet: its thickness is not meant (metres)."""
    least_mass: float = 0.01
    """What keeps solvers stable (kg) ..."""
    least_size: float = 0.1
    """... as a cube with this side, where a link has no volume (metres)."""
    needle: float = 0.001
    """A body is as wide as this at least, so that no solver meets one without inertia (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, *(set(self.__dataclass_fields__) - {"build_by_word"}))
        require_ratios(self, "see_through")


DEFAULT_MASS_CONFIG = MassConfig()


def builds_of(visual: Visual, config: MassConfig = DEFAULT_MASS_CONFIG) -> dict[MaterialBuild, float]:
    """Returns how a visual is built: each kind of build with its ratio (0 to 1) of the visual's area."""
    areas = [surface.mesh.area for surface in visual.surfaces]
    whole = sum(areas)
    if whole <= 0:
        return {_board(config): 1.0}
    ratios: dict[MaterialBuild, float] = {}
    for surface, area in zip(visual.surfaces, areas, strict=True):
        build = _build(surface.material, visual, config)
        ratios[build] = ratios.get(build, 0.0) + area / whole
    return {build: ratio for build, ratio in ratios.items() if ratio > 0}


def _build(material: Material, visual: Visual, config: MassConfig) -> MaterialBuild:
    if visual.role is VisualRole.HARDWARE:
        if visual.name.startswith("support_"):
            return _board(config)
        return MaterialBuild(config.hardware_density, config.hardware_wall, config.hardware_wall)
    name = material.name.lower()
    for word, build in config.build_by_word.items():
        if word in name:
            return build
    if material.alpha_mode == "BLEND" and material.base_color[3] < config.see_through:
        return _GLASS
    if visual.label is PartLabel.HANDLE:
        return MaterialBuild(config.handle_density, config.handle_wall, config.handle_wall)
    return _board(config)


def _board(config: MassConfig) -> MaterialBuild:
    return MaterialBuild(config.default_density, config.solid_wood, config.board_thickness)
