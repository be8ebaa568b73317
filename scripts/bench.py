"""Measures speed, growth, memory and many models; prints a table and writes bench/bench.json and bench/bench.md.

    python scripts/bench.py [MODELS ...] [--repeats 3] [--out bench] [--quick] [--only SECTION ...]

MODELS are models, or folders of them; without any, the models in the folder that GRAFU_MODELS names, if it names one.
Bars are held against the processor's own time on one core, which is the clock's on a machine that does nothing else.
A fixed piece of work is timed before and after each section: times and rates are compared with those of docs/speed.md
in units of it, so that two machines, or two hours of one, can be compared. `--quick` measures little of each section,
to see that all works. Sections: models, growth, starting, network, synthetic, many, joints.
"""

import argparse
import json
import multiprocessing
import os
import platform
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np
from bench_figure import WORK, Figure, Section, figure_table
from bench_growth import growth_section
from bench_many import many_section
from bench_models import models_section
from bench_network import PARTS, completing_section, time_completing
from bench_same import joints_of_samples, same_section
from bench_start import SAMPLE, starting_section, time_starting
from bench_synth import making_section, time_making
from stated.store import Stored, load_store

W, T = TypeVar("W"), TypeVar("T")
ROOT = Path(__file__).parent.parent
MEASURE = "speed"
FEW = 4  # models of a quick run
MADE, QUICK_MADE = 300, 40  # specimens
STARTS, QUICK_STARTS = 7, 3
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
ROUNDS, WIDE = 4000, 400  # of the fixed piece of work


@dataclass(frozen=True)
class Setup:
    """What is measured, how often, and what was printed last (None: nothing)."""

    models: tuple[str, ...]
    repeats: int
    quick: bool
    page: Stored | None


SECTIONS: dict[str, Callable[[Setup], Section]] = {
    "models": lambda setup: models_section(setup.models, setup.repeats, in_fresh_process),
    "growth": lambda setup: growth_section(setup.quick, setup.repeats, in_fresh_process),
    "starting": lambda setup: starting_section(
        in_fresh_process(time_starting, str(SAMPLE), QUICK_STARTS if setup.quick else STARTS)
    ),
    "network": lambda setup: completing_section(in_fresh_process(time_completing, PARTS, setup.repeats)),
    "synthetic": lambda setup: making_section(
        in_fresh_process(time_making, QUICK_MADE if setup.quick else MADE, setup.repeats)
    ),
    "many": lambda setup: many_section(setup.quick, setup.repeats),
    "joints": lambda setup: same_section(in_fresh_process(joints_of_samples, "", 1), setup.page),
}


def main() -> int:
    """Runs the bench; returns the exit code."""
    options = parse_arguments()
    folders = options.models or [Path(at) for at in filter(None, [os.environ.get("GRAFU_MODELS")])]
    models = tuple(str(path) for path in models_in(folders, options.quick))
    setup = Setup(models, 1 if options.quick else options.repeats, options.quick, load_store().get(MEASURE))
    work, sections = [fixed_work()], []
    for name in options.only or SECTIONS:
        print(f"  {name}", file=sys.stderr, flush=True)
        sections.append(SECTIONS[name](setup))
        work.append(fixed_work())
    figures = [Figure(WORK, tuple(sorted(work)), "s"), *(one for section in sections for one in section.figures)]
    text = page_of(figures, sections, setup.page)
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "bench.json").write_text(json.dumps([asdict(figure) for figure in figures], indent=1) + "\n")
    (options.out / "bench.md").write_text(text)
    print(text)
    return 0


def parse_arguments() -> argparse.Namespace:
    """Returns the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", type=Path, metavar="MODELS")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--out", type=Path, default=ROOT / "bench")
    parser.add_argument("--quick", action="store_true", help="little of each: do they work?")
    parser.add_argument("--only", nargs="+", choices=tuple(SECTIONS), metavar="SECTION", help="these sections")
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error(f"--repeats must be at least 1: got {options.repeats}")
    return options


def models_in(folders: Sequence[Path], quick: bool) -> list[Path]:
    """Returns the models in folders; of many only a few where it has to be `quick`."""
    from grafu.evaluation.dataset import find_models

    found = [ref.path for folder in folders for ref in find_models(folder)]
    return found[:: len(found) // FEW] if quick and len(found) > FEW else found


def in_fresh_process(job: Callable[[W, int], T], what: W, repeats: int) -> T:
    """Returns the result of a job in a new process on one core, so that its peak memory is its own."""
    for name in THREADS:
        os.environ[name] = "1"
    try:
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), initializer=on_one_core) as pool:
            return pool.submit(job, what, repeats).result()
    finally:
        for name in THREADS:
            os.environ.pop(name, None)


def on_one_core() -> None:
    """Keeps this process on one core, where the system can."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def fixed_work() -> float:
    """Returns the processor's seconds of a piece of work that never changes: small and large arrays, and Python."""
    rng = np.random.default_rng(0)
    small, large = rng.normal(size=(3, 3)), rng.normal(size=(WIDE, WIDE))
    started = time.process_time()
    kept: dict[int, float] = {}
    for number in range(ROUNDS):
        turned = np.linalg.inv(small + number * np.eye(3)) @ small
        kept[number % 97] = float(np.linalg.norm(turned)) + sum(kept.values())
    for _ in range(WIDE // 20):
        large = np.sort(large + 0.1 * large[::-1], axis=0)
    return round(time.process_time() - started, 4)


def page_of(figures: Sequence[Figure], sections: Sequence[Section], page: Stored | None) -> str:
    """Returns the tables as Markdown: all figures first, then what each section has to show."""
    machine = (
        f"Python {platform.python_version()}, {os.cpu_count()} cores of {platform.processor() or platform.machine()}"
    )
    return "\n".join(
        ["# Bench\n", f"{machine}\n", figure_table(figures, page), *(section.text for section in sections)]
    )


if __name__ == "__main__":
    sys.exit(main())
