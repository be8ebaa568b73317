"""What the page shows of the last build, and what choices may be about then."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any, final

from grafu.dataclass import dataclass
from grafu.editor.known import Known
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class LastBuild:
    """One build: its number, the settings that it was built with, and its state as the page gets it.

    It `is_judged` once masses and collision shapes are known, which the verdict of its report depends on, too. `files`
    are what the page fetches besides, by the names that the state gives their digests.
    """

    number: int
    settings: Settings
    state: dict[str, Any]
    files: dict[str, bytes]
    seconds: float
    is_judged: bool = False

    def judged(self, stated: Mapping[str, Any]) -> "LastBuild":
        """Returns the build with its report as it is now known, and what the page states of it."""
        return replace(self, state={**self.state, **stated}, is_judged=True)

    @cached_property
    def report(self) -> Report:
        """The report."""
        return Report.read(self.state["report"])

    @cached_property
    def motions(self) -> dict[str, MotionChoice]:
        """How the parts move, as far as a choice can state it."""
        return {
            part: MotionChoice(Moves(m["moves"]), m["side"] and Side(m["side"]), m["inwards"])
            for part, m in self.state["motions"].items()
        }

    @property
    def known(self) -> Known:
        """What choices may be about."""
        parts = frozenset(part.id for part in self.report.parts)
        added = {one.part: one for one in self.report.added}
        return Known(
            parts,
            frozenset(added),
            frozenset(joint.part for joint in self.report.joints),
            self.motions,
            len(self.state["compartments"]),
            {part.id: part.category for part in self.report.parts if part.category is not PartLabel.UNKNOWN},
            {name: one.link for name, one in added.items() if one.category is PartLabel.HANDLE},
            {part: ((left, right), (down, up)) for part, ((left, right), (down, up)) in self.state["rooms"].items()},
        )
