"""What is stated of one input as it ends: a line of JSON, a line for people, and its stages. It decides nothing."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any, final

from grafu.cli.job import Failed, JobResult, Succeeded
from grafu.cli.stage_bar import stage_words
from grafu.dataclass import dataclass
from grafu.pipeline.words import counted

if TYPE_CHECKING:
    from grafu.cli.summary import SummaryRow


@final
@dataclass(frozen=True)
class Ended:
    """All that is stated of an input that ended, without its report.

    `why` is why it failed, empty where it did not; `users_fault` whether the input is at fault then.
    """

    name: str
    values: dict[str, Any]
    words: str
    stages: tuple[str, ...]
    row: "SummaryRow"
    why: str = ""
    users_fault: bool = False

    def in_short(self) -> "Ended":
        """Returns it without what was printed of it: of a million models it stays in memory."""
        return replace(self, values={"input": self.values["input"]}, words="", stages=())


def ended_of(result: JobResult, given: str, place: str) -> Ended:
    """Returns what is stated of a result whose input and folder are named as they were given."""
    from grafu.cli.summary import row_of

    values = {**outcome_values(result), "input": given, "folder": place}
    failed = result if isinstance(result, Failed) else None
    return Ended(
        result.job.name,
        values,
        outcome_words(result),
        tuple(stages_of(result)),
        row_of(result),
        failed.why if failed else "",
        bool(failed and failed.users_fault),
    )


def outcome_values(result: JobResult) -> dict[str, Any]:
    """Returns what `--json` prints of one input (docs/outputs.md): a failure has an error and no verdict."""
    job = result.job
    said = {"name": job.name, "input": str(job.input), "folder": str(job.folder)}
    if isinstance(result, Failed):
        nothing: dict[str, Any] = {"verdict": None, "reasons": [], "joints": [], "skipped": [], "seconds": None}
        return {**said, **nothing, "files": [], "error": result.why}
    from grafu.pipeline.verdict import verdict_of

    verdict = verdict_of(result.report)
    return {
        **said,
        "verdict": verdict.colour.value,
        "reasons": [{k: v for k, v in fault.to_json().items() if k != "colour"} for fault in verdict.lines],
        "joints": [
            {"part": j.part, "type": j.type.value, "lower": j.lower, "upper": j.upper} for j in result.report.joints
        ],
        "skipped": [{"request": s.request, "reason": str(s.reason), "why": s.detail} for s in result.report.skipped],
        "seconds": round(result.seconds, 3),
        "files": list(_files(result)),
        "error": None,
    }


def _files(result: Succeeded) -> tuple[str, ...]:
    from grafu.asset.regular_files import MARKER
    from grafu.export.marker import read_marker

    marker = read_marker(result.job.folder)
    return tuple(name for name in marker.files if name != MARKER) if marker else ()


def outcome_words(result: JobResult) -> str:
    """Returns one line on one input, for people."""
    if isinstance(result, Failed):
        return f"{result.job.name}: failed: {result.why}"
    from grafu.pipeline.verdict import verdict_of

    joints = counted(len(result.report.joints), "joint")
    earlier = ", done earlier" if result.earlier else ""
    return f"{result.job.name}: {verdict_of(result.report).colour}, {joints}, {result.seconds:.1f} s{earlier}"


def stages_of(result: JobResult) -> list[str]:
    """Returns a line for each stage of an input that is done, with its seconds, in order."""
    if isinstance(result, Failed):
        return []
    order = sorted(result.report.timings.items(), key=lambda lap: lap[0] != "load")  # it is first, and kept last
    return [f"{result.job.name}: {stage_words(stage)}: {seconds:.2f} s" for stage, seconds in order]
