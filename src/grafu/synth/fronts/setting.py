"""Where fronts sit: their plane, and how far they reach over what surrounds their opening."""

from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.synth.fronts.layout import Cell, Edge, Rect, Side
from grafu.synth.pieces.finish import PLAIN, Finish

Mount = Literal["overlay", "inset"]


@final
@dataclass(frozen=True, slots=True)
class Borders:
    """How much of the case surrounds its whole opening on each side, metres: what overlay fronts may cover."""

    left: float
    right: float
    bottom: float
    top: float


@final
@dataclass(frozen=True, slots=True)
class Setting:
    """Where fronts sit, metres: `plane` is the y of the case's front and `back` that of its back panel's inner face.

    Openings lie `panel` apart; walls behind them stand back by `wall` (half of it on either side of a partition), and
    the case's own sides by `case_wall` (none: by `wall`). An overlay front stands `seat` before the plane and covers at
    most `lap` of a panel, and of the case what `borders` states (none: as of a panel); an inset front is flush. Overlay
    fronts end `reveal` within the case's outer faces (none: by the gap): 0 where they are flush, below 0 where they
    are wider than the case; above and below they never reach beyond it. A frame behind the plane is `frame` deep.
    """

    plane: float
    back: float
    mount: Mount = "overlay"
    thickness: float = 0.018
    gap: float = 0.003
    seat: float = 0.001
    lap: float = 1.0
    panel: float = 0.018
    wall: float = 0.0
    slide_gap: float = 0.0125
    finish: Finish = PLAIN
    borders: Borders | None = None
    case_wall: float | None = None
    frame: float = 0.0
    reveal: float | None = None

    @property
    def front(self) -> float:
        """The y of the fronts' outer faces."""
        return self.plane - self.seat - self.thickness if self.mount == "overlay" else self.plane

    @property
    def behind(self) -> float:
        """The y of the fronts' inner faces."""
        return self.front + self.thickness

    @property
    def inner(self) -> float:
        """The y where the room behind the fronts begins."""
        return max(self.plane + self.frame, self.behind)


def front_rect(cell: Cell, setting: Setting) -> Rect:
    """Returns the outline of a cell's front: its opening moved outwards (overlay) or inwards (inset) edge by edge."""
    o = cell.opening
    left, right = _reach("left", cell, setting), _reach("right", cell, setting)
    return Rect(o.x0 - left, o.x1 + right, o.z0 - _reach("bottom", cell, setting), o.z1 + _reach("top", cell, setting))


def inner_span(cell: Cell, setting: Setting) -> tuple[float, float]:
    """Returns the x between the walls of a cell: behind a face frame they stand further apart than its opening."""
    case_wall = setting.wall if setting.case_wall is None else setting.case_wall
    room = {Edge.CASE: case_wall, Edge.STOP: case_wall, Edge.SHARED: setting.wall / 2, Edge.SEAM: 0.0}
    return cell.opening.x0 - room[cell.edges.left], cell.opening.x1 + room[cell.edges.right]


def _reach(side: Side, cell: Cell, setting: Setting) -> float:
    edge: Edge = getattr(cell.edges, side)
    if edge is Edge.SEAM:
        return -setting.gap / 2
    if setting.mount == "inset" or edge is Edge.STOP:
        return -setting.gap
    if edge is Edge.CASE:
        cover = (getattr(setting.borders, side) if setting.borders else setting.panel) - _spare(side, setting)
    else:
        cover = (setting.panel - setting.gap) / 2
    return min(cover, setting.lap)


def _spare(side: Side, setting: Setting) -> float:
    """Returns how much of the case an overlay front leaves uncovered on one side, below 0 where it juts out."""
    if setting.reveal is None:
        return setting.gap
    return setting.reveal if side in ("left", "right") else max(setting.reveal, 0.0)
