"""Whether results are still those of the page: the joints of the samples, beside the joints that were printed last.

`bench.py` runs it. Whoever makes something faster sees here what it changed: angles between axes, distances between
their lines, ends of ranges, and joints that are gone, new or of another type. The page's joints are printed with few
digits: a hundredth of a millimetre.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bench_figure import Figure, Section
from stated.store import Stored

SAMPLES = Path(__file__).parent.parent / "samples"
HEAD = ("joint", "type", "axis", "origin, m", "range")
DIGITS = 5
DEGREES, MILLIMETRES = 0.1, 1.0  # what may differ
SLIDES = "prismatic"
SECTION = "Joints of the samples"


@dataclass(frozen=True)
class Joint:
    """A joint as the table states it: unit axis, a point on it in metres, range in radians or metres."""

    kind: str
    axis: tuple[float, ...]
    origin: tuple[float, ...]
    limits: tuple[float, ...]

    def cells(self) -> tuple[str, ...]:
        """Returns the cells after the name."""
        return self.kind, *(_printed(numbers) for numbers in (self.axis, self.origin, self.limits))

    @staticmethod
    def of(cells: Sequence[str]) -> "Joint":
        """Returns the joint that stands in these cells."""
        axis, origin, limits = (tuple(float(word) for word in cell.split()) for cell in cells[1:])
        return Joint(cells[0], axis, origin, limits)


def _printed(numbers: Sequence[float]) -> str:
    return " ".join(f"{round(number, DIGITS) + 0.0:.{DIGITS}f}" for number in numbers)


def joints_of_samples(_: str, __: int) -> dict[str, Joint]:
    """Returns every joint of the samples' results, by sample and part."""
    import grafu

    found = {}
    for path in sorted(SAMPLES.glob("*.glb")):
        for joint in grafu.functionalize(path).report.joints:
            limits = (joint.lower, joint.upper)
            found[f"{path.stem}: {joint.part}"] = Joint(joint.type.value, joint.axis, joint.origin, limits)
    return found


def same_section(found: Mapping[str, Joint], page: Stored | None) -> Section:
    """Returns how far the joints lie from the page's, and the table of them; no figures where no page has it."""
    rows = "\n".join(f"| {' | '.join((name, *joint.cells()))} |" for name, joint in found.items())
    text = f"## {SECTION}\n\n| {' | '.join(HEAD)} |\n{'|---' * len(HEAD)}|\n{rows}\n"
    then = joints_of(page)
    if not then:
        return Section((), text)
    both = [(joint, then[name]) for name, joint in found.items() if name in then and joint.kind == then[name].kind]
    others = len(found) + len(then) - 2 * len(both)
    figures = (
        Figure("joints that are other than the page's", (float(others),), bar=0.0),
        Figure("axes: largest angle to the page's", (_most(angle, both),), "degrees", DEGREES),
        Figure("axes: largest distance from the page's", (_most(distance, both),), "mm", MILLIMETRES),
        Figure("ranges: largest difference, degrees", (_most(turn_difference, both),), "degrees", DEGREES),
        Figure("ranges: largest difference, mm", (_most(slide_difference, both),), "mm", MILLIMETRES),
    )
    return Section(figures, text)


def joints_of(page: Stored | None) -> dict[str, Joint]:
    """Returns the joints that were printed last."""
    tables = page.tables if page else []
    rows = next((table[1:] for table in tables if tuple(table[0]) == HEAD), [])
    return {row[0]: Joint.of(row[1:]) for row in rows}


def _most(measure: Callable[[Joint, Joint], float], both: Sequence[tuple[Joint, Joint]]) -> float:
    return round(max((measure(now, then) for now, then in both), default=0.0), 3)


def angle(now: Joint, then: Joint) -> float:
    """Returns the angle between two axes, degrees: a reversed axis is 180."""
    sine = np.linalg.norm(np.cross(now.axis, then.axis))
    return float(np.degrees(np.arctan2(sine, np.dot(now.axis, then.axis))))


def distance(now: Joint, then: Joint) -> float:
    """Returns how far the hinge's line has moved, mm; 0 for a slide, which has none."""
    if now.kind == SLIDES:
        return 0.0
    apart = np.subtract(now.origin, then.origin)
    return 1e3 * float(np.linalg.norm(apart - np.dot(apart, then.axis) * np.asarray(then.axis)))


def turn_difference(now: Joint, then: Joint) -> float:
    """Returns the larger difference of the two ends of a range of turning, degrees; 0 for a slide."""
    return 0.0 if now.kind == SLIDES else float(np.degrees(np.abs(np.subtract(now.limits, then.limits)).max()))


def slide_difference(now: Joint, then: Joint) -> float:
    """Returns the larger difference of the two ends of a slide, mm; 0 for what turns."""
    return 1e3 * float(np.abs(np.subtract(now.limits, then.limits)).max()) if now.kind == SLIDES else 0.0
