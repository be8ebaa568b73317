"""Cuts the panels of one compartment, one after another: dividers, then the shelves between them.

Each is tried near its place until it stands free of all that is there and moves; if none does, it is refused.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.additions.interior.arrangement import Arrangement, most_that_fit, spaced
from grafu.additions.interior.compartments import Compartment
from grafu.additions.interior.config import InteriorConfig, Sizes
from grafu.additions.interior.outline import FreeSpace
from grafu.additions.interior.panels import Clearing, PanelPlace, WallRays, cut_panel, moved_to
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.refusal import Asked, Reason, Refusal
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class Panel:
    """One panel of the compartment of a number, and where it was placed."""

    compartment: int
    label: PartLabel
    mesh: TriangleMesh
    place: PanelPlace


def named_in(compartment: int | None, label: PartLabel | None) -> str:
    """Returns what panels of a kind (None: of any) in a compartment (None: in all) are called in a report."""
    what = "interior" if label is None else label.value
    return what if compartment is None else f"{what} of compartment {compartment + 1}"


@final
class PanelMaker:
    """Cuts the panels of one compartment, one after another; not a value."""

    def __init__(
        self,
        number: int,
        compartment: Compartment,
        walls: WallRays,
        clearing: Clearing,
        space: FreeSpace,
        sizes: Sizes,
        config: InteriorConfig,
    ) -> None:
        self._number = number
        self._whole = compartment
        self._clearing = clearing
        self._sizes = sizes
        self._config = config
        self._walls = walls
        self._space = space
        self._boards: list[TriangleMesh] = []

    def panels(self, wanted: Arrangement) -> Iterator[Panel | Refusal]:
        """Yields the dividers, then the shelves between them, or why one is missing."""
        dividers = []
        for outcome in self._row(self._whole, PartLabel.DIVIDER, wanted.dividers, wanted.divider_at):
            if isinstance(outcome, Panel):
                dividers.append(outcome)
            yield outcome
        for panel in dividers:
            self._walls = self._walls.and_also(panel.mesh)
            self._boards.append(panel.mesh)
        for cell in _between(self._whole, [panel.mesh.box for panel in dividers]):
            yield from self._row(cell, PartLabel.SHELF, wanted.shelves, wanted.shelf_at, wanted.angle)

    def _row(
        self, compartment: Compartment, label: PartLabel, count: int, at: Sequence[float], angle: float = 0.0
    ) -> Iterator[Panel | Refusal]:
        """Yields panels of one kind in one compartment: at given middles, else `count` equally spaced."""
        if not (count or at):
            return
        axis = PanelPlace(compartment, label, 0.0, 0.0).stack
        drop = float(np.tan(angle)) * (float(compartment.box.size[compartment.depth_axis]) - self._sizes.inset)
        low, high = float(compartment.box.low[axis]) + drop / 2, float(compartment.box.high[axis]) - drop / 2
        count = min(count, most_that_fit(high - low, self._sizes.thickness, self._sizes.least_pitch))
        middles = list(at) or spaced(low, high, count, self._sizes.thickness)
        room = min(np.diff([low, *middles, high])) if middles else 0.0
        for middle in middles:
            made = self._tried(PanelPlace(compartment, label, middle, self._sizes.inset, angle), float(room))
            if isinstance(made, Refusal):
                yield made.of(named_in(self._number, label), Asked.INTERIOR)
            else:
                self._clearing.add(f"{label.value}", made.mesh)
                yield made

    def _tried(self, place: PanelPlace, room: float) -> Panel | Refusal:
        """Returns the panel at the place or near it, or why there is none near it."""
        depth = float(place.compartment.box.size[place.compartment.depth_axis])
        deepest = max(self._config.deepest_inset * depth, self._sizes.inset)
        first: Refusal | None = None
        for inset in np.linspace(self._sizes.inset, deepest, self._config.insets):
            for nudge in self._config.nudges:
                tried = moved_to(place, place.at + nudge * room, float(inset))
                for mesh in self._cut(tried):
                    if isinstance(mesh, Refusal):
                        first = first or mesh
                        continue
                    blocker = self._clearing.blocker(mesh)
                    if not blocker:
                        return Panel(self._number, place.label, mesh, tried)
                    first = first or Refusal("", Reason.IN_THE_WAY, f"`{blocker}` is in its way")
        return first or Refusal("", Reason.NO_ROOM)

    def _cut(self, place: PanelPlace) -> list[TriangleMesh | Refusal]:
        """Returns the panels that fit a place, the best first, or why none does."""
        if place.angle:
            return [self._space.slanted(place, self._boards, self._sizes.thickness)]
        plain = cut_panel(place, self._walls, self._sizes, self._config)
        shaped = self._space.better(place, plain, self._boards, self._sizes.thickness)
        return [plain] if shaped is None else [shaped, plain]


def _between(compartment: Compartment, dividers: list[Box]) -> list[Compartment]:
    """Returns the parts of a compartment that dividers leave (the whole, without any)."""
    axis = compartment.side_axis
    found = []
    low = compartment.box.low.copy()
    for divider in sorted(dividers, key=lambda box: float(box.low[axis])):
        high = compartment.box.high.copy()
        high[axis] = divider.low[axis]
        found.append(replace(compartment, box=Box(low, high)))
        low = low.copy()
        low[axis] = divider.high[axis]
    return [*found, replace(compartment, box=Box(low, compartment.box.high))]
