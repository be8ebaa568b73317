"""A pin, with what a sweep of its door states about it."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.joints.hinge.candidates import PinCandidate


@final
@dataclass(frozen=True)
class JudgedPin:
    """A pin with what the sweep of the door without hardware states about it; lower ranks are better.

    `free` is the opening before the door runs into the static body or the floor; `neighbours` are the moving bodies
    that it meets at rest; `is_clear` states that the door opens about it as wanted, or nearly so, past everything. The
    floor counts in `rank` and `is_clear` only where it leaves the opening restricted.
    """

    pin: PinCandidate
    axis: Axis
    free: float
    neighbours: tuple[str, ...]
    rank: tuple[float, int, int, float]
    is_clear: bool
