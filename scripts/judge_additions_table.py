"""What `judge_additions.py` finds on one piece, and the table of many."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

INTERIORS = ("shelves=2", "dividers=1", "auto")
COVERED = 0.97  # fraction of the plan that a top must cover
KINDS = ("top", "grasp", "handle", "interior", "joint")


@dataclass(frozen=True)
class Verdict:
    """The figures of one piece; no list of faults should hold any."""

    name: str
    kinds: list[str]  # what was looked at
    tops: int  # added
    covered: float | None  # fraction of the plan under the top that replaces its own; None: it has none to take away
    top_faults: list[str]
    moving_bodies: int
    handles: int
    grips: int
    grasp_faults: list[str]  # not graspable, or several handles where one is enough
    handle_faults: list[str]  # cut into something along the path
    panels: list[int]  # per request of `INTERIORS`
    refusals: list[str]  # why something that was asked for inside was not built
    rooms: list[str]  # empty rooms that rays find where no request brought any panel
    interior_faults: list[str]
    boards: int  # of drawer boxes
    waiting: int  # joints that wait for another one, which got a handle
    joint_faults: list[str]  # lost, or opening less, for the sake of additions
    seconds: float
    crash: str = ""  # why it could not be judged

    @property
    def faults(self) -> list[str]:
        """All faults."""
        found = [fault for kind in KINDS for fault in getattr(self, f"{kind}_faults")]
        return [self.crash, *found] if self.crash else found


def crashed(name: str, error: BaseException) -> Verdict:
    """Returns the figures of a piece that could not be judged, with the reason."""
    why = f"{type(error).__name__}: {error}"
    nothing: dict[str, Any] = {"top_faults": [], "grasp_faults": [], "handle_faults": [], "joint_faults": []}
    inside: dict[str, Any] = {"panels": [0] * len(INTERIORS), "refusals": [], "rooms": [], "interior_faults": []}
    counts: dict[str, Any] = {"tops": 0, "moving bodies": 0, "handles": 0, "grips": 0, "boards": 0, "waiting": 0}
    return Verdict(name, [], covered=None, seconds=0.0, crash=why, **counts, **nothing, **inside)


def table(found: Sequence[Verdict], whole: bool) -> str:
    """Returns the figures as a table, and summed up; `whole`: also those without a fault."""
    head = "| piece | tops | cover | moving bodies | handles | grips | panels | boards | s | faults |"
    lines = [head, "|---" * 10 + "|"]
    for one in found:
        if whole or one.faults:
            cover = "" if one.covered is None else f"{one.covered:.1%}"
            counts = " / ".join(map(str, one.panels))
            cells = [one.name, one.tops, cover, one.moving_bodies, one.handles, one.grips, counts, one.boards]
            lines.append(f"| {' | '.join(map(str, cells))} | {one.seconds:.2f} | {'; '.join(one.faults)} |")
    topped = [one.covered for one in found if one.covered is not None]
    seconds = [one.seconds for one in found]
    panels = [sum(one.panels[k] for one in found) for k in range(len(INTERIORS))]
    looked_into = [one for one in found if "interior" in one.kinds]
    empty = [one for one in looked_into if not any(one.panels)]
    refusals = Counter(_kind_of(why) for one in found for why in one.refusals)
    moving_bodies, tops = sum(one.moving_bodies for one in found), sum(one.tops for one in found)
    lines += [
        "",
        f"- {sum(bool(one.crash) for one in found)} could not be judged.",
        f"- {len(found)} pieces, {moving_bodies} moving bodies, {tops} tops added.",
        f"- Without their own tops: {sum(c >= COVERED for c in topped)} of {len(topped)} get one that covers "
        f"{COVERED:.0%} (least {min(topped, default=1.0):.1%}).",
        f"- Panels for {', '.join(INTERIORS)}: {', '.join(map(str, panels))}.",
        f"- {sum(one.waiting for one in found)} moving bodies with a new handle wait for another to open.",
        f"- {len(looked_into) - len(empty)} pieces get panels, {len(empty)} none; rays find an empty room in "
        f"{sum(bool(one.rooms) for one in empty)} of those:",
        *(
            f"  - {one.name}: {'; '.join(one.rooms)} ({'; '.join(dict.fromkeys(one.refusals))})"
            for one in empty
            if one.rooms
        ),
        "- Not built inside, and why:",
        *(f"  - {count} x {why}" for why, count in refusals.most_common()),
        *(
            f"- {kind} faults: {sum(len(getattr(o, f'{kind}_faults')) for o in found)} "
            f"on {sum(kind in o.kinds for o in found)} pieces."
            for kind in KINDS
        ),
        f"- Seconds for additions: median {np.median(seconds):.2f}, 90 % {np.quantile(seconds, 0.9):.2f}, "
        f"most {max(seconds):.2f}.",
    ]
    return "\n".join(lines)


def _kind_of(why: str) -> str:
    """Returns a reason without the names and numbers of one piece."""
    return re.sub(r"\d+(\.\d+)?", "N", re.sub(r"`[^`]*`", "`...`", why))
