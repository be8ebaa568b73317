"""Measures speed, growth, start and memory; prints a table and writes bench/bench.json and bench/bench.md.

    python scripts/bench.py [MODELS ...] [--repeats 3] [--out bench] [--quick]

MODELS are inputs with annotated joints; without any, those in the folder that GRAFU_MODELS names, else in
../shared/models. Every model runs in a fresh process on one core, once to warm up (and to import) and then `--repeats`
times, from reading to writing. Bars are held against the processor's own time, which on one core is the clock's on a
machine that does nothing else; the clock's spread stands beside it. `--quick` runs each once and leaves out what takes
longest. Synthetic furniture is timed by the model (`bench_synth.py`), the network by the graph (`bench_network.py`),
a fresh process beside Blender (`bench_start.py`).
"""

import argparse
import json
import multiprocessing
import os
import platform
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from typing import TypeVar

import numpy as np
from bench_network import PARTS, completing_table, time_completing
from bench_start import SAMPLE, starting_table, time_starting
from bench_synth import making_table, time_making

W, T = TypeVar("W"), TypeVar("T")
ROOT = Path(__file__).parent.parent
SIZES = (10, 20, 40, 80, 120, 200)
QUICK_SIZES = (10, 80)
MADE, QUICK_MADE = 300, 40  # specimens
BARS = {"median_s": 1.5, "p95_s": 5.0, "growth_exponent": 1.3, "help_s": 0.5, "peak_mb": 600.0, "made_s": 0.05}
BARS |= {"completed_s": 0.15}  # 30 parts, by the network
BARS |= {
    "cold_s": 0.9,
    "import_s": 0.3,
    "open_s": 0.1,
    "cold_ratio": 1.2,
}  # a fresh process; over Blender, by the clock
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True)
class Timing:
    """One model: sorted seconds of its runs on the clock and on the processor, stages of the median run, memory."""

    name: str
    parts: int
    runs: list[float]
    cpu: list[float]
    stages: dict[str, float]
    peak_mb: float

    @property
    def seconds(self) -> float:
        """The processor's time in the median run."""
        return median(self.cpu)


def main() -> int:
    """Runs the bench; returns the exit code."""
    options = parse_arguments()
    inputs = options.models or development_models()
    repeats, sizes = (1, QUICK_SIZES) if options.quick else (options.repeats, SIZES)
    models = [in_fresh_process(time_model, str(path), repeats) for path in inputs]
    walls = [in_fresh_process(time_wall, str(parts), repeats) for parts in sizes]
    making = in_fresh_process(time_making, QUICK_MADE if options.quick else MADE, repeats)
    completing = in_fresh_process(time_completing, PARTS, repeats)
    starting = in_fresh_process(time_starting, str(SAMPLE), 3 if options.quick else 7)
    figures = summary(models, walls) | {"made_s": round(1 / making.rate, 4), "completed_s": completing.median}
    figures |= {name: round(value, 3) for name, value in starting.figures.items()}
    options.out.mkdir(parents=True, exist_ok=True)
    rows = {
        "figures": figures,
        "models": [asdict(m) for m in models],
        "growth": [asdict(w) for w in walls],
        "making": asdict(making),
        "completing": asdict(completing),
        "starting": asdict(starting),
    }
    (options.out / "bench.json").write_text(json.dumps(rows, indent=1) + "\n")
    more = making_table(making), completing_table(completing), starting_table(starting)
    text = page(figures, models, walls, more)
    (options.out / "bench.md").write_text(text)
    print(text)
    return 0


def parse_arguments() -> argparse.Namespace:
    """Returns the options of the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("models", nargs="*", type=Path, metavar="MODELS")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--out", type=Path, default=ROOT / "bench")
    parser.add_argument("--quick", action="store_true", help="each once, and walls of a few sizes only")
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error(f"--repeats must be at least 1: got {options.repeats}")
    return options


def development_models() -> list[Path]:
    """Returns the annotated models at hand; none, where there is no such folder."""
    folder = Path(os.environ.get("GRAFU_MODELS", ROOT.parent / "shared" / "models")) / "pnm"
    return sorted(p for p in folder.glob("*") if p.is_dir())


def in_fresh_process(job: Callable[[W, int], T], what: W, repeats: int) -> T:
    """Returns the timing of a job in a new process on one core, so that its peak memory is its own."""
    print(f"  {what}", file=sys.stderr)
    for name in THREADS:
        os.environ[name] = "1"
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), initializer=on_one_core) as pool:
        return pool.submit(job, what, repeats).result()


def on_one_core() -> None:
    """Keeps this process on one core, where the system can."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def time_model(path: str, repeats: int) -> Timing:
    """Returns the timing of one input, from reading to writing."""
    from grafu.cli.job import Failed, Job, JobOptions, run_job

    def run() -> tuple[float, int, dict[str, float]]:
        with tempfile.TemporaryDirectory() as folder:
            started = time.perf_counter()
            result = run_job(Job(Path(path), "model", JobOptions(out=Path(folder))))
            seconds = time.perf_counter() - started
        if isinstance(result, Failed):
            raise SystemExit(f"{path}: {result.why}")
        return seconds, result.report.input.parts, result.report.timings

    return repeated(Path(path).name, run, repeats)


def time_wall(parts: str, repeats: int) -> Timing:
    """Returns the timing of a made wall of doors and drawers, pipeline and exports, without files."""
    from grafu.export.formats import export
    from grafu.pipeline.functionalize import functionalize
    from grafu.pipeline.motion_source import MotionSource
    from grafu.synth.samples import furniture_of
    from grafu.templates.gallery import builtin_gallery

    asset = furniture_of(int(parts))

    def run() -> tuple[float, int, dict[str, float]]:
        started = time.perf_counter()
        result = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery())
        exporting = time.perf_counter()
        export(result.object, ("glb", "urdf"))
        ended = time.perf_counter()
        return ended - started, len(asset.parts), dict(result.timings) | {"export": ended - exporting}

    return repeated(asset.name, run, repeats)


def repeated(name: str, run: Callable[[], tuple[float, int, dict[str, float]]], repeats: int) -> Timing:
    """Returns the timing of `repeats` runs after one that only warms up."""
    run()
    runs, cpu = [], []
    for _ in range(repeats):
        started = time.process_time()
        runs.append(run())
        cpu.append(round(time.process_time() - started, 4))
    runs.sort(key=lambda r: r[0])
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)
    middle = runs[len(runs) // 2]
    return Timing(name, middle[1], [round(r[0], 4) for r in runs], sorted(cpu), middle[2], round(peak, 1))


def summary(models: list[Timing], walls: list[Timing]) -> dict[str, float]:
    """Returns the figures that have a bar; those of the models are left out where there are none."""
    seconds = [m.seconds for m in models]
    logs = np.log([w.parts for w in walls]), np.log([w.seconds for w in walls])
    figures = {"growth_exponent": float(np.polyfit(*logs, 1)[0]), "help_s": help_seconds()}
    if seconds:
        figures |= {"median_s": median(seconds), "p95_s": float(np.percentile(seconds, 95))}
    figures["peak_mb"] = max(t.peak_mb for t in (*models, *walls))
    return {name: round(value, 3) for name, value in figures.items()}


def help_seconds() -> float:
    """Returns the median time of `grafu --help`, in seconds."""

    def run() -> float:
        started = time.perf_counter()
        subprocess.run([sys.executable, "-m", "grafu.cli.main", "--help"], check=True, capture_output=True)
        return time.perf_counter() - started

    return median(run() for _ in range(7))


def page(figures: dict[str, float], models: list[Timing], walls: list[Timing], more: tuple[str, ...]) -> str:
    """Returns the tables as Markdown."""
    verdicts = [
        f"| {name} | {value:g} | {BARS[name]:g} | {'yes' if value <= BARS[name] else 'NO'} |"
        for name, value in figures.items()
    ]
    head = f"Python {platform.python_version()}, one core of {platform.processor() or platform.machine()}\n"
    bars = "| figure | measured | bar | met |\n|---|---|---|---|\n" + "\n".join(verdicts) + "\n"
    tables = (table("Models", models), table("Growth", walls), *more)
    return "\n".join(["# Bench\n", head, bars, *tables])


def table(title: str, timings: list[Timing]) -> str:
    """Returns one table: the processor's time in the median run, the spread on the clock, memory, the stages."""
    rows = [
        f"| {t.name} | {t.parts} | {t.seconds:.2f} | {t.runs[0]:.2f} .. {t.runs[-1]:.2f} | {t.peak_mb:.0f} "
        f"| {stages(t)} |"
        for t in timings
    ]
    head = f"## {title}\n\n| name | parts | seconds | on the clock | peak MB | stages |\n{'|---' * 6}|\n"
    return head + "\n".join(rows) + "\n"


def stages(timing: Timing) -> str:
    """Returns the stages' seconds in words."""
    return ", ".join(f"{name} {seconds:.2f}" for name, seconds in timing.stages.items() if seconds >= 0.005)


if __name__ == "__main__":
    sys.exit(main())
