"""How many models two worker processes make over one, and how many steps a second training takes.

`bench.py` runs it. The models are copies of the samples through `grafu functionalize --jobs`, timed from the first
finished model to the last, so that starting counts for neither. Training is `grafu train --config base` on all cores.
"""

import csv
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from bench_figure import Figure, Section
from bench_table import measured_table

ROOT = Path(__file__).parent.parent
SAMPLES = ROOT / "samples"
MODELS, QUICK_MODELS = 48, 6
STEPS, QUICK_STEPS = 80, 40
SKIPPED = 1  # rows of train.csv: the first steps wait for models
WORKERS_GAIN, STEPS_A_SECOND = 1.9, 2.0  # two workers, within 5 per cent of twice one


def many_section(quick: bool, repeats: int) -> Section:
    """Returns the gain of a second worker, and the rate of training where torch is installed."""
    count = QUICK_MODELS if quick else MODELS
    with tempfile.TemporaryDirectory() as folder:
        models = copies(count, Path(folder))
        rates = {
            workers: [rate(models, workers, Path(folder) / f"out_{workers}_{turn}") for turn in range(repeats)]
            for workers in (1, 2)
        }
    gains = tuple(sorted(round(two / one, 3) for one, two in zip(rates[1], rates[2], strict=True)))
    figures = [Figure("two workers over one", gains, bar=WORKERS_GAIN, at_least=True)]
    rows = [
        (f"{workers} worker{'s' * (workers > 1)}", f"{median(of):.0f} models an hour") for workers, of in rates.items()
    ]
    steps = training_rates(QUICK_STEPS if quick else STEPS)
    if steps:
        figures.append(Figure("training, 16 graphs a step", steps, "a second", STEPS_A_SECOND, at_least=True))
    else:
        rows.append(("training", "not measured: it needs grafu[train]"))
    return Section(tuple(figures), measured_table("Many", f"{count} copies of the samples, without pages.", rows))


def copies(count: int, folder: Path) -> list[Path]:
    """Returns so many models, the samples in turn."""
    sources = sorted(SAMPLES.glob("*.glb"))
    paths = [folder / f"model_{number}.glb" for number in range(count)]
    for number, path in enumerate(paths):
        path.write_bytes(sources[number % len(sources)].read_bytes())
    return paths


def rate(models: list[Path], workers: int, out: Path) -> float:
    """Returns models an hour, from the first that is finished to the last."""
    command = (sys.executable, "-m", "grafu", "functionalize", *map(str, models), "--out", str(out))
    options = ("--jobs", str(workers), "--json", "--no-page", "--formats", "glb,urdf")
    times = []
    with subprocess.Popen(
        (*command, *options), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as running:
        for line in running.stdout or ():
            json.loads(line)
            times.append(time.perf_counter())
    if len(times) != len(models):
        raise SystemExit(f"{len(models)} models were asked for with {workers} workers: {len(times)} are finished")
    return 3600.0 * (len(times) - workers) / (times[-1] - times[workers - 1])


def training_rates(steps: int) -> tuple[float, ...]:
    """Returns the steps a second of each twenty steps but the first, sorted; nothing where torch is not installed."""
    with tempfile.TemporaryDirectory() as folder:
        command = (sys.executable, "-m", "grafu", "train", "--config", "base", "--out", folder, "--steps", str(steps))
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        logged = Path(folder) / "train.csv"
        if done.returncode or not logged.is_file():
            return ()
        with logged.open(encoding="utf-8") as rows:
            rates = [float(row["steps_per_second"]) for row in csv.DictReader(rows)]
    return tuple(sorted(round(value, 3) for value in rates[SKIPPED:]))
