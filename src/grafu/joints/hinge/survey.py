"""What lies around a door's hinge border: gaps and steps to the static body, measured by rays on the real meshes.

All figures are in the border frame (see `border`), metres; infinity where nothing is met. It chooses nothing.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Scalars, median
from grafu.geometry.raycast import RayCaster, robust_median
from grafu.joints.hinge_config import SurveyConfig
from grafu.scene.border import BorderFrame


@final
@dataclass(frozen=True, slots=True)
class BorderSurvey:
    """The static surfaces around a hinge border.

    `side_gap`: from the border outwards (-x) to a face beside the door. `side_top`: the y of that neighbour's front,
    how far it stands out beyond the door's front. `back_gap`: from the door's back (-y) to a face behind the border.
    `side_face`: the x of the outer face of what stands behind the door. `back_width`: how far (+x) the face behind
    reaches from the border inwards, `beside_width` how far it goes on outwards (-x). `side_depth`: how deep (-y, from
    the door's front) the face beside the door reaches. `overhang`: how far the border stands out beyond what the door
    lies on, where nothing is behind the border itself. `meets`: whether another moving body stands beside the border.
    """

    side_gap: float
    side_top: float
    side_depth: float
    back_gap: float
    back_width: float
    side_face: float
    beside_width: float
    overhang: float = float("inf")
    meets: bool = False


def survey(frame: BorderFrame, body: RayCaster, reach: float, config: SurveyConfig) -> BorderSurvey:
    """Returns what rays against the static body find within `reach` metres of the border."""
    probe = _Probe(frame, body, reach, config)
    side_gap = min(probe.side(-depth) for depth in config.beside)
    back_gap, back_width = probe.back()
    return BorderSurvey(
        side_gap=side_gap,
        side_top=probe.side_top(side_gap),
        side_depth=probe.side_depth(side_gap),
        back_gap=back_gap,
        back_width=back_width,
        side_face=probe.side_face(back_gap),
        beside_width=probe.beside_width(back_gap),
        overhang=float("inf") if np.isfinite(back_gap) else probe.overhang(),
    )


@final
class _Probe:
    """Casts rows of rays, one per height, from points of the border frame."""

    def __init__(self, frame: BorderFrame, body: RayCaster, reach: float, config: SurveyConfig) -> None:
        self._frame, self._body, self._reach, self._config = frame, body, reach, config
        self._heights = np.linspace(-config.ends, config.ends, config.heights) * frame.length

    def row(self, x: float, y: float, dx: float, dy: float) -> Scalars:
        """Returns the distances from (x, y) along the direction (dx, dy), one per height."""
        points = np.column_stack([np.full_like(self._heights, x), np.full_like(self._heights, y), self._heights])
        return self._body.along(self._frame.to_object(points), self._frame.direction(dx, dy, 0.0))

    def median_of(self, distances: Scalars, reach: float) -> float:
        """Returns the median of what is met within `reach`; infinity where too little is."""
        return robust_median(distances, reach, self._config.met_at / self._config.heights - 1e-6)

    def side(self, level: float) -> float:
        """Returns the gap beside the door at a level of its thickness (0 front, -1 back)."""
        inside = min(self._config.start * self._frame.thickness, self._config.start_width * self._frame.width)
        distances = self.row(inside, level * self._frame.thickness, -1.0, 0.0)
        return self.median_of(distances, self._reach + inside) - inside

    def side_top(self, side_gap: float) -> float:
        """Returns the y of the front of what stands beside the door, seen from in front of it."""
        if not np.isfinite(side_gap):
            return float("-inf")
        board = self._frame.board
        tops = [self._height_at(-max(side_gap, 0.0) - step * board, board) for step in self._config.in_front]
        found = [top for top in tops if np.isfinite(top)]
        return median(found) if found else float("-inf")

    def _height_at(self, x: float, depth: float) -> float:
        """Returns the y at which rays from the front meet the static body at an x, down to a depth."""
        start = self._reach
        distance = self.median_of(self.row(x, start, 0.0, -1.0), start + depth)
        return start - distance

    def side_depth(self, side_gap: float) -> float:
        """Returns how deep from the door's front the face beside it reaches."""
        if not np.isfinite(side_gap):
            return 0.0
        levels = np.linspace(-self._config.shallowest, -self._config.deepest, self._config.depths)
        gaps = np.array([self.side(level) for level in levels])
        near = np.abs(gaps - side_gap) < self._config.even * max(1.0, self._frame.width)
        return float(-levels[near].min() * self._frame.board) if near.any() else 0.0

    def back(self) -> tuple[float, float]:
        """Returns the smallest gap behind the border and how far inwards the face there reaches."""
        inside, on_border = self._config.start * self._frame.thickness, self._config.on_border
        steps = np.array(self._config.behind) * self._frame.board
        gaps = np.array(
            [
                self.median_of(self.row(x, inside - self._frame.thickness, 0.0, -1.0), self._reach + inside) - inside
                for x in steps
            ]
        )
        if not np.isfinite(gaps[:on_border]).any():
            return self._edge_behind(), self._frame.board
        gap = float(gaps[:on_border].min())
        near = gaps < gap + self._config.even_behind * self._frame.board + self._config.rounding
        end = int(np.argmin(near)) if not near.all() else len(near)
        return gap, float(steps[max(end - 1, int(np.argmax(near)))])

    def _edge_behind(self) -> float:
        """Returns the gap to a panel that stands edge-on behind the border: a sheet has no front to be met by a ray."""
        for step in self._config.edge:
            gap = step * self._frame.board
            start = -self._reach / 2
            distance = self.median_of(self.row(start, -self._frame.thickness - gap, 1.0, 0.0), self._reach)
            if start + distance <= self._config.edge_inwards * self._frame.board:
                return gap
        return float("inf")

    def side_face(self, back_gap: float) -> float:
        """Returns the x of the outer side of what stands behind the door, seen from beside it."""
        if not np.isfinite(back_gap):
            return float("-inf")
        faces = []
        for step in self._config.outside:
            y = -self._frame.thickness - max(back_gap, 0.0) - step * self._frame.board
            distance = self.median_of(self.row(-self._reach, y, 1.0, 0.0), self._reach + self._frame.board)
            faces.append(distance - self._reach)
        found = [x for x in faces if np.isfinite(x)]
        return median(found) if found else float("-inf")

    def beside_width(self, back_gap: float) -> float:
        """Returns how far outwards of the border the face behind the door goes on at one level."""
        if not np.isfinite(back_gap):
            return 0.0
        level = -self._frame.thickness - back_gap
        play = self._config.even_behind * self._frame.board + self._config.rounding
        steps = np.array(self._config.aside) * self._frame.board
        even = np.array([abs(self._height_at(-x, play - level) - level) <= play for x in steps])
        end = int(np.argmin(even)) if not even.all() else len(even)
        return float(steps[end - 1]) if end else 0.0

    def overhang(self) -> float:
        """Returns how far inwards of the border the outer side lies of what the door lies on."""
        board, thickness, farthest = self._frame.board, self._frame.thickness, self._config.overhang
        below = (self.row(0.0, -thickness - self._reach - step * board, 1.0, 0.0) for step in self._config.outside)
        found = [x for distances in below if np.isfinite(x := self.median_of(distances, farthest))]
        if not found:
            return float("inf")
        x, start = median(found), self._config.start * thickness
        gap = self.median_of(
            self.row(x + self._config.outside[0] * board, start - thickness, 0.0, -1.0), self._reach + start
        )
        return x if np.isfinite(gap) else float("inf")
