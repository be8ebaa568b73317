"""What is stated of one input as it ends: a line of JSON, a line for people, and its stages. It decides nothing."""

from typing import Any

from grafu.cli.job import Failed, JobResult, Succeeded
from grafu.cli.stage_bar import stage_words
from grafu.pipeline.words import counted


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
        "reasons": [fault.model_dump(mode="json", exclude={"colour"}) for fault in verdict.lines],
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
