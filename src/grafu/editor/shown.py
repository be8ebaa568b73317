"""What the page of an editor shows of a build besides its view and tables: what can be chosen of what, and how far."""

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any, Final, final

import numpy as np

from grafu.additions.interior.making import named_in
from grafu.additions.interior.turned import compartments_of
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.editor.rooms import Room, rooms_on
from grafu.errors import OptionError
from grafu.geometry.transform import invert, transform_points
from grafu.joints.motion_choice import TURNING_SIDES, Moves, Side, axis_of_motion, choice_in_words
from grafu.metrics.collision import TOLERANT, CollisionConfig, first_collisions
from grafu.pipeline.functionalize import Functionalized
from grafu.pipeline.motion_choices import motions_of
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings
from grafu.processes.cache import Cache
from grafu.vocabulary import PartLabel

_PULLED: Final = (str(Moves.SLIDES), str(Side.FRONT))
_EDGES: Final = frozenset(map(str, (Side.LEFT, Side.RIGHT, Side.TOP, Side.BOTTOM)))


@final
@dataclass(frozen=True)
class Shown:
    """One build, as the page shows it."""

    made: Functionalized
    name: str
    cache: Cache
    settings: Settings

    @cached_property
    def compartments(self) -> list[dict[str, Any]]:
        """By number the corners of the compartments (metres, object frame), and the moving bodies before each.

        Also how many shelves were added to each, and why no more (empty: as many as were wanted).
        """
        found, T = compartments_of(self.made.before_panels)
        fittings = self.made.fittings
        shelves = [one.part.box.center for one in fittings.additions if one.part.label is PartLabel.SHELF]
        places = transform_points(invert(T), np.array(shelves).reshape(-1, 3))
        whys = {one.part: str(one) for one in reversed(fittings.refusals)}
        return [
            {
                "corners": np.round(transform_points(T, one.box.corners()), 6).tolist(),
                "behind": list(one.behind),
                "shelves": int(((places > one.box.low) & (places < one.box.high)).all(axis=1).sum()),
                "why": whys.get(named_in(number, PartLabel.SHELF), ""),
            }
            for number, one in enumerate(found)
        ]

    @property
    def motions(self) -> dict[str, dict[str, Any]]:
        """How the parts move, as far as a choice can state it."""
        motions = motions_of(self.made.object)
        return {
            part: {"moves": str(choice.moves), "side": choice.side and str(choice.side), "inwards": choice.inwards}
            for part, choice in motions.items()
        }

    @property
    def collisions(self) -> dict[str, dict[str, Any]]:
        """By part, of joints that collide: at which value first (radians or metres), and which visuals it cuts into."""
        counted = CollisionConfig(tolerance=TOLERANT.tolerance, moving_bodies=True)
        clashing = {done.joint: done.moving for done in self.made.report.installed if done.collision_share > 0}
        found = self.cache.value("collisions", first_collisions, self.made.object, clashing, counted)
        return {clashing[joint]: {"value": one.value, "others": list(one.others)} for joint, one in found.items()}

    @property
    def sides(self) -> dict[str, list[str]]:
        """By part the borders that it can turn about."""
        return self.cache.value("sides", sides_of, self.made.asset)

    @cached_property
    def upright(self) -> list[str]:
        """Fronts that stand upright and look to the front: there X is aside and Z is up.

        So does that of a drawer which is pulled out to the front, however deep its box is.
        """
        pulled = {part for part, how in self.motions.items() if (how["moves"], how["side"]) == _PULLED}
        return [part for part, sides in self.sides.items() if part in pulled or set(sides) >= _EDGES]

    def rooms(self, items: Iterable[Mapping[str, Any]], report: Report) -> dict[str, Room]:
        """By moving part how far its handles that were added can be moved over it; `items` are those of the view."""
        handles = {one.part: one.link for one in report.added if one.category is PartLabel.HANDLE}
        offsets = {part: front.offset for part, front in self.settings.additions.fronts.items()}
        return rooms_on(items, handles, self.upright, offsets)


def sides_of(asset: Asset) -> dict[str, list[str]]:
    """Returns by part the borders that it can turn about, as words."""
    return {part.id: [side for side in TURNING_SIDES if _can_turn(part.id, side, asset)] for part in asset.parts}


def _can_turn(part: str, side: str, asset: Asset) -> bool:
    try:
        axis_of_motion(asset.part(part), choice_in_words(side), asset.box)
    except OptionError:
        return False
    return True
