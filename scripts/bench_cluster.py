"""How many models a Ray cluster on this machine makes an hour, with one worker and with more, and a million models.

It copies the samples, runs `grafu functionalize` on them with `--cluster local` and without, and prints the measured
table, and from it the arithmetic of docs/cluster.md.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from bench_table import measured_table

SAMPLES = Path(__file__).parent.parent / "samples"
MILLION = 10**6
FORMATS = "glb,urdf,mjcf"
CORE_HOUR, GIGABYTE_MONTH, MILLION_WRITES = 0.04, 0.023, 5.0  # dollars, of a large cloud; put yours here


@dataclass(frozen=True)
class Run:
    """One run: with how many workers, when its first and last model were done, and means for a model."""

    workers: int
    models: int
    first: float  # seconds after the start of the command
    last: float
    seconds: float
    megabytes: float
    files: float

    @property
    def rate(self) -> float:
        """Models an hour, without the start."""
        return 3600.0 * (self.models - 1) / (self.last - self.first)


def copies(count: int, folder: Path) -> list[str]:
    """Returns so many models, the samples in turn."""
    sources = sorted(SAMPLES.glob("*.glb"))
    return [str(shutil.copy(sources[k % len(sources)], folder / f"model_{k}.glb")) for k in range(count)]


def measured(models: list[str], workers: int, out: Path, cluster: bool) -> Run:
    """Returns what one run takes."""
    command = [
        sys.executable,
        "-m",
        "grafu.cli.main",
        "functionalize",
        *models,
        "--out",
        str(out),
        "--jobs",
        str(workers),
    ]
    command += ["--json", "--no-page", "--formats", FORMATS, *(["--cluster", "local"] if cluster else [])]
    environment = {**os.environ, "RAY_worker_niceness": "0"}
    began = time.perf_counter()
    lines, times = [], []
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as running:
        for line in running.stdout or ():
            lines.append(json.loads(line))
            times.append(time.perf_counter() - began)
    files = [path for path in out.rglob("*") if path.is_file()]
    size = sum(path.stat().st_size for path in files) / 1e6
    seconds, count = sum(line["seconds"] for line in lines), len(lines)
    return Run(workers, count, times[0], times[-1], seconds / count, size / count, len(files) / count)


def rows(local: Run, runs: list[Run]) -> list[tuple[str, str]]:
    """Returns the rows of the table."""
    first, best = runs[0], runs[-1]
    hours, terabytes = first.seconds * MILLION / 3600, first.megabytes * MILLION / 1e6
    return [
        ("without a cluster, 1 worker", f"{local.rate:.0f} models an hour"),
        *((f"Ray, {run.workers} worker{'s' * (run.workers > 1)}", f"{run.rate:.0f} models an hour") for run in runs),
        ("until the first model is done", f"{first.first:.0f} s"),
        (f"gain of {best.workers} workers", f"{best.rate / first.rate:.2f} times"),
        ("seconds of a core for a model", f"{first.seconds:.2f}"),
        ("results of a model", f"{first.megabytes:.2f} MB in {first.files:.0f} files"),
        ("a million models", f"{hours:.0f} core-hours"),
        ("a million results", f"{terabytes:.2f} TB in {first.files:.0f} million files"),
        (f"core-hours at ${CORE_HOUR}", f"${hours * CORE_HOUR:.0f}"),
        (f"a month of storage at ${GIGABYTE_MONTH} a GB", f"${1000 * terabytes * GIGABYTE_MONTH:.0f}"),
        (f"writing the files at ${MILLION_WRITES:g} a million", f"${first.files * MILLION_WRITES:.0f}"),
    ]


def main() -> None:
    """Measures and prints."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", type=int, default=12, help="how many models")
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2], help="workers of each run")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        models = copies(options.models, Path(folder))
        local = measured(models, 1, Path(folder) / "local", cluster=False)
        runs = [measured(models, count, Path(folder) / f"out_{count}", cluster=True) for count in options.workers]
    states = f"{options.models} models ({FORMATS}), {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} meanwhile"
    print(measured_table("Models on a cluster of this machine", states, rows(local, runs)))


if __name__ == "__main__":
    main()
