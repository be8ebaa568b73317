"""What a page of many models is made from: plain tables with kinds of columns, and a run's reports as one. No markup.

A run's table has one row per input, and the figures of all. It reads no files.
"""

from collections import Counter
from collections.abc import Sequence
from typing import Final, Literal, final

from grafu.articulation.motion_kind import motion_kind
from grafu.dataclass import dataclass
from grafu.pipeline.report_schema import Report, VerdictRecord
from grafu.pipeline.verdict import verdict_of
from grafu.pipeline.words import Colour, FaultKind, listed
from grafu.viewer.wording import remaining_deficiencies

Cell = str | int | float | None
ColumnKind = Literal["text", "light", "number", "percent", "seconds"]
WORDS: tuple[ColumnKind, ...] = ("text", "light")
LIGHTS = ("failed", "red", "yellow", "green")


@final
@dataclass(frozen=True, slots=True)
class RunColumn:
    """A column: its heading, how its values are written, whether their spread is drawn, and what it means in words.

    A fraction (0..1) in a column of percents is written as a percentage; a column of lights holds one of `LIGHTS`.
    """

    name: str
    kind: ColumnKind = "text"
    histogram: bool = False
    about: str = ""

    def __post_init__(self) -> None:
        if self.histogram and self.kind in WORDS:
            raise ValueError(f"`RunColumn.histogram` is for numbers: `{self.name}` is a column of text")

    def words(self, value: Cell) -> str:
        """Returns a value as it is written; None is a dash."""
        if value is None:
            return "–"
        if isinstance(value, str):
            return value
        if self.kind == "percent":
            return f"{100 * value:.1f} %"
        if self.kind == "seconds":
            return f"{value:.1f}"
        return str(value) if isinstance(value, int) else f"{value:.3g}"


@final
@dataclass(frozen=True, slots=True)
class RunRow:
    """One row: a cell per column, the first of which is its name.

    `badness` orders the rows, the largest first. `link` is a relative address, `picture` a small WebP file; `flagged`
    calls for a look.
    """

    cells: tuple[Cell, ...]
    badness: float = 0.0
    link: str = ""
    picture: bytes = b""
    flagged: bool = False


@final
@dataclass(frozen=True)
class RunTable:
    """A table of a run, worst first.

    Raises:
        ValueError: if a row has not one cell per column, or a number stands in no number's column.
    """

    title: str
    columns: tuple[RunColumn, ...]
    rows: tuple[RunRow, ...]
    lead: str = ""

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row.cells) != len(self.columns):
                raise ValueError(f"`{self.title}` has {len(self.columns)} columns: a row has {len(row.cells)} cells")
            for column, cell in zip(self.columns, row.cells, strict=True):
                if column.kind not in WORDS and isinstance(cell, str):
                    raise ValueError(f"`{column.name}` is a column of numbers: got `{cell}`")
                if column.kind == "light" and cell not in LIGHTS:
                    raise ValueError(f"`{column.name}` is a column of {', '.join(LIGHTS)}: got `{cell}`")

    @property
    def worst_first(self) -> tuple[RunRow, ...]:
        """The rows by falling badness; equals stay in order."""
        return tuple(sorted(self.rows, key=lambda row: -row.badness))

    def numbers(self, index: int) -> list[float]:
        """Returns the numbers of a column, without what is missing."""
        cells = [row.cells[index] for row in self.rows]
        return [float(cell) for cell in cells if isinstance(cell, int | float)]


@final
@dataclass(frozen=True, slots=True)
class RunFigure:
    """One number of the whole run, and what it counts; `flagged` calls for a look."""

    value: str
    what: str
    flagged: bool = False


@final
@dataclass(frozen=True)
class Run:
    """A whole run: its name, its figures and its tables."""

    title: str
    figures: Sequence[RunFigure]
    tables: Sequence[RunTable]
    lead: str = ""


_COLUMNS = (
    RunColumn("model"),
    RunColumn("verdict", "light", about="red: something does not work; yellow: it works, with something to look at"),
    RunColumn("to look at"),
    RunColumn("doors", "number", about="joints that turn"),
    RunColumn("drawers", "number", about="joints that slide"),
    RunColumn("not built", "number", about="doors and drawers without a joint, and other requests that were not built"),
    RunColumn("restricted", "number", about="joints that open less than 70 % of what they should"),
    RunColumn(
        "collision", "percent", histogram=True, about="the worst joint's fraction of poses that cut into something"
    ),
    RunColumn("gap, mm", "number", histogram=True, about="the widest gap between a link and what carries it"),
    RunColumn("no grasp", "number", about="joints that cannot be grasped"),
    RunColumn("added", "number", histogram=True, about="parts that the input did not have, hinges and rails left out"),
    RunColumn("seconds", "seconds", histogram=True, about="from reading to writing"),
)
# What is worse comes first: the colour above all, then by how much, whatever the numbers below it are.
_FAILED, _COLOURS = 1e12, {Colour.RED: 1e9, Colour.YELLOW: 1e7, Colour.GREEN: 0.0}
_SERIOUS: Final[dict[FaultKind, float]] = {FaultKind.NO_JOINT: 1e4, FaultKind.SHUT: 1e4, FaultKind.LOOSE: 1e4}
_MINOR, _COLLIDES = 1.0, 1e3
_ORDER = (Colour.RED, Colour.YELLOW, Colour.GREEN)


@final
@dataclass(frozen=True)
class RunEntry:
    """One input of a run: its report, or why there is none; its page's relative address, a small picture, seconds."""

    name: str
    report: Report | None
    failure: str = ""
    link: str = ""
    picture: bytes = b""
    seconds: float | None = None


def functionalized_run(title: str, entries: Sequence[RunEntry]) -> Run:
    """Returns the page's content for a run of `functionalize`."""
    rows = tuple(_row(entry) for entry in entries)
    table = RunTable("Models", _COLUMNS, rows, "Worst first; a heading sorts by its column.")
    return Run(title, _figures(entries), (table,))


def _row(entry: RunEntry) -> RunRow:
    if entry.report is None:
        unknown: list[Cell] = [None] * (len(_COLUMNS) - 3)
        return RunRow((entry.name, "failed", f"failed: {entry.failure}", *unknown), _FAILED, flagged=True)
    report, verdict = entry.report, verdict_of(entry.report)
    joints = report.joints
    turning = sum(motion_kind(joint.type).turns for joint in joints)
    faults = Counter(line.kind for line in verdict.lines)
    cells: tuple[Cell, ...] = (
        entry.name,
        verdict.colour.value,
        _to_look_at(report, verdict),
        turning,
        len(joints) - turning,
        faults[FaultKind.NO_JOINT] + faults[FaultKind.NOT_BUILT],
        faults[FaultKind.RESTRICTED] + faults[FaultKind.SHUT],
        max((joint.collision_share for joint in joints), default=None),
        max((1000 * joint.largest_gap for joint in joints), default=None),
        faults[FaultKind.NO_GRASP],
        len(report.added),
        entry.seconds,
    )
    return RunRow(cells, _badness(report, verdict), entry.link, entry.picture, flagged=verdict.colour is Colour.RED)


def _badness(report: Report, verdict: VerdictRecord) -> float:
    faults = sum(_SERIOUS.get(line.kind, _MINOR) for line in verdict.lines)
    return _COLOURS[verdict.colour] + faults + _COLLIDES * sum(joint.collision_share for joint in report.joints)


def _to_look_at(report: Report, verdict: VerdictRecord) -> str:
    """Returns the faults, by kind with the parts of each, and the deficiencies that remain."""
    parts: dict[FaultKind, list[str]] = {}
    for line in verdict.lines:
        parts.setdefault(line.kind, []).append(line.part)
    phrases = [f"{kind}: {listed(dict.fromkeys(names))}" if any(names) else str(kind) for kind, names in parts.items()]
    lacking = {lack.kind.value for lack in remaining_deficiencies(report)} - {"handle", "hinge", "rail", "joint"}
    return "; ".join([*phrases, *([f"still without {listed(sorted(lacking))}"] if lacking else [])])


def _figures(entries: Sequence[RunEntry]) -> list[RunFigure]:
    reports = [entry.report for entry in entries if entry.report is not None]
    verdicts = [verdict_of(report) for report in reports]
    colours = Counter(verdict.colour for verdict in verdicts)
    faults = Counter(line.kind for verdict in verdicts for line in verdict.lines)
    failed, joints = len(entries) - len(reports), sum(len(report.joints) for report in reports)
    return [
        RunFigure(str(len(reports)), "model done" if len(reports) == 1 else "models done"),
        RunFigure(str(failed), "failed", failed > 0),
        *(
            RunFigure(str(colours[colour]), colour.value, colour is Colour.RED and colours[colour] > 0)
            for colour in _ORDER
        ),
        RunFigure(str(joints), "joint built" if joints == 1 else "joints built"),
        RunFigure(str(faults[FaultKind.NO_JOINT]), "doors and drawers that are static", faults[FaultKind.NO_JOINT] > 0),
        RunFigure(str(faults[FaultKind.COLLIDES]), "joints that collide", faults[FaultKind.COLLIDES] > 0),
        RunFigure(str(sum(len(report.added) for report in reports)), "parts added"),
    ]
