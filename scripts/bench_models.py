"""How long models take from reading to writing, in one warm process on one core, and how much memory the median needs.

`bench.py` runs it. The models are annotated or not, as the folders have them; what is refused as an input is counted
and left out. Of the processor's time the table shows the median model, the 95th percentile and the slowest.
"""

import resource
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from bench_figure import Figure, Section
from bench_table import measured_table

FORMATS = ("glb", "urdf")
BARS = {"median": 0.35, "95th percentile": 1.0, "slowest": 10.0}  # seconds of the processor
TYPICAL_MB = 350.0
SLOW = 5  # of the slowest models, how many are named


@dataclass(frozen=True)
class Timed:
    """One model: sorted seconds of the processor, seconds of each stage in the last run."""

    name: str
    parts: int
    cpu: tuple[float, ...]
    stages: dict[str, float]


@dataclass(frozen=True)
class Set:
    """The models that were timed, and the names of those that were refused."""

    timed: tuple[Timed, ...]
    refused: tuple[str, ...]


def time_models(paths: Sequence[str], repeats: int) -> Set:
    """Returns the timing of each model: `repeats` runs of all in turn, after one model that only warms up."""
    runs: dict[str, list[tuple[float, int, dict[str, float]]]] = {}
    refused: dict[str, None] = {}
    one_run(paths[0])
    for _ in range(repeats):
        for path in paths:
            if path in refused:
                continue
            found = one_run(path)
            if found is None:
                refused[path] = None
            else:
                runs.setdefault(path, []).append(found)
    timed = (
        Timed(Path(path).name, of[-1][1], tuple(sorted(round(run[0], 4) for run in of)), of[-1][2])
        for path, of in runs.items()
    )
    return Set(tuple(timed), tuple(Path(path).name for path in refused))


def one_run(path: str, faces: int = 0) -> tuple[float, int, dict[str, float]] | None:
    """Returns the processor's seconds for one model with its page, its parts and stages; None if it is refused.

    `faces` is the most that are read, where more than usual.
    """
    from grafu.asset.options import Limits, LoadOptions
    from grafu.cli.job import Failed, Job, JobOptions, run_job
    from grafu.pipeline.settings import Settings

    limits = Limits()
    if faces > limits.max_faces:
        limits = Limits(max_faces=faces, max_vertices=2 * faces)
    settings = Settings(reading=LoadOptions(limits=limits))
    with tempfile.TemporaryDirectory() as folder:
        started = time.process_time()
        result = run_job(Job(Path(path), "model", JobOptions(out=Path(folder), formats=FORMATS, settings=settings)))
        seconds = time.process_time() - started
    if isinstance(result, Failed):
        return None
    return seconds, result.report.input.parts, dict(result.report.timings)


def peak_of(path: str, _: int) -> float:
    """Returns the most memory, in MB, that this process had when one model was done."""
    one_run(path)
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)


def models_section(paths: Sequence[str], repeats: int, fresh: Callable[..., object]) -> Section:
    """Returns the figures of models; none where there are no models."""
    if not paths:
        return Section((), "## Models\n\nNot measured: GRAFU_MODELS names no folder of models.\n")
    timed = fresh(time_models, paths, repeats)
    if not isinstance(timed, Set) or not timed.timed:
        return Section((), "## Models\n\nNot measured: every model was refused.\n")
    by_run = np.sort(np.array([one.cpu for one in timed.timed]), axis=1)
    kinds = {"median": 50, "95th percentile": 95, "slowest": 100}
    figures = [
        Figure(f"one model, warm: {name}", _places(by_run, place), "s", BARS[name]) for name, place in kinds.items()
    ]
    order = sorted(timed.timed, key=lambda one: median(one.cpu))
    typical = {Path(path).name: path for path in paths}[order[len(order) // 2].name]
    figures.append(Figure("memory of the median model", (_number(fresh(peak_of, typical, 1)),), "MB", TYPICAL_MB))
    return Section(tuple(figures), models_table(timed, order))


def _places(by_run: np.ndarray, place: int) -> tuple[float, ...]:
    """Returns a percentile over all models, for each run (the quickest of each model, the next, ...)."""
    return tuple(round(float(value), 4) for value in np.percentile(by_run, place, axis=0))


def _number(value: object) -> float:
    return round(float(str(value)), 1)


def models_table(found: Set, order: Sequence[Timed]) -> str:
    """Returns one table in Markdown: how many, the stages' part of the time, the slowest models."""
    total = sum(median(one.cpu) for one in order)
    stages: dict[str, float] = {}
    for one in order:
        for name, seconds in one.stages.items():
            stages[name] = stages.get(name, 0.0) + seconds
    whole = sum(stages.values()) or 1.0
    rows = [
        ("models", f"{len(order)}, and {len(found.refused)} refused"),
        ("parts, median", f"{median(one.parts for one in order):g}"),
        ("all of them", f"{total:.0f} s"),
    ]
    rows += [
        (f"of which {name}", f"{100 * seconds / whole:.0f} %")
        for name, seconds in sorted(stages.items(), key=lambda item: -item[1])
    ]
    rows += [(f"slow: `{one.name}`, {one.parts} parts", f"{median(one.cpu):.2f} s") for one in order[: -SLOW - 1 : -1]]
    return measured_table("Models", f"From reading to {', '.join(FORMATS)} and the page, warm, on one core.", rows)
