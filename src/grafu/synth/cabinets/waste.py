"""Base units with bins behind a door at the side, on runners or on the floor of the unit: specimens for tests."""

from dataclasses import replace
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Slide
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door
from grafu.synth.fronts.setting import Mount
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, assemble, plank
from grafu.synth.pieces.finish import PLAIN
from grafu.vocabulary import PartLabel

BASE_UNIT = Case(0.5, 0.8, 0.56)
_WALL = 0.004  # metres: how thick the walls of a bin are
_BESIDE = {"overlay": 0.014, "inset": 0.037}  # metres between a bin and a wall: an open inset door stands there
_PLAY = 0.002  # metres between a bin and a runner
_RUNNER = 0.03  # metres: how high a runner is
_AHEAD = 0.02  # metres between the door and a bin


@final
@dataclass(frozen=True, slots=True)
class WasteUnit:
    """A base unit, metres, with a bin behind its door: `tall` and `deep` over the room there, on runners or not.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    name: str = "base_unit"
    case: Case = BASE_UNIT
    mount: Mount = "overlay"
    tall: float = 0.6
    deep: float = 0.85
    runners: bool = True
    travel: float = 0.7
    bin_name: str = "container"

    def __post_init__(self) -> None:
        if not all(0 < ratio < 1 for ratio in (self.tall, self.deep, self.travel)):
            raise ValueError(
                f"`WasteUnit` needs fractions between 0 and 1: got {self.tall}, {self.deep}, {self.travel}"
            )


def make_waste_unit(spec: WasteUnit) -> Asset:
    """Returns the unit with the true joints of its door and of its bin, which opens after it."""
    cabinet = Cabinet(spec.name, spec.case, Door("left"), spec.mount)
    setting, case = cabinet.setting, spec.case
    beside = _BESIDE[spec.mount]
    x, low = case.width / 2 - case.panel - beside, case.opening.z0 + 0.002
    room = setting.back - setting.inner - _AHEAD
    y = setting.inner + _AHEAD
    high = low + spec.tall * (case.opening.z1 - low)
    span = ((-x, y, low), (x, y + spec.deep * room, high))
    pieces = [*cabinet_pieces(cabinet), _bin(span, spec)]
    if spec.runners:
        pieces += _runners((x + _PLAY, x + beside), (y, setting.back), (low + high) / 2)
    return assemble(spec.name, pieces)


def _bin(span: Span, spec: WasteUnit) -> PieceDraft:
    (x0, y0, z0), (x1, y1, z1) = span
    boards = [
        ((x0, y0, z0), (x1, y1, z0 + _WALL)),
        ((x0, y0, z0), (x0 + _WALL, y1, z1)),
        ((x1 - _WALL, y0, z0), (x1, y1, z1)),
        ((x0, y0, z0), (x1, y0 + _WALL, z1)),
        ((x0, y1 - _WALL, z0), (x1, y1, z1)),
    ]
    axis = Axis(vec3((x0 + x1) / 2, y0, z0), vec3(0.0, -1.0, 0.0))
    motion = PieceMotion(Slide.joint_type, axis, spec.travel * (y1 - y0))
    return replace(plank(PartLabel.MISC, spec.bin_name, PLAIN.metal, *boards), motion=motion)


def _runners(across: tuple[float, float], along: tuple[float, float], z: float) -> list[PieceDraft]:
    """Returns a runner on either wall, over an interval of x on the right and one of y."""
    near, far = across
    spans = (
        ((low, along[0], z - _RUNNER / 2), (high, along[1], z + _RUNNER / 2))
        for low, high in ((-far, -near), (near, far))
    )
    return [plank(PartLabel.MISC, "bin_runner", PLAIN.metal, span) for span in spans]
