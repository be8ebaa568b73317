"""How quickly furniture is made: specimens a second and core, by stage, and how quickly shards of them are read back.

`bench.py` runs it. The whole is timed as it is used (`make_specimen`, 512 points on each part), on the processor's own
time; the stages are timed apart from it, on first draws, so that they do not add up to it exactly.
"""

import tempfile
import time
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from statistics import mean, median

import numpy as np
from bench_figure import Figure, Section
from bench_table import measured_table

POINTS = 512
SEED = 0
RATE = 200.0  # models a second that are asked for
PLACES = (5, 50, 95)  # per cent points of a single model's time


@dataclass(frozen=True)
class Making:
    """How many models were made, their mean parts, and seconds of one core."""

    models: int
    parts: float
    rates: list[float]  # models a second, one for each run, sorted
    milliseconds: list[float]  # of one model, at `PLACES`
    stages: dict[str, float]  # milliseconds of one model, mean
    read: float  # models a second read back from a shard, with their points

    @property
    def rate(self) -> float:
        """Models a second in the median run."""
        return median(self.rates)


def time_making(count: int, repeats: int) -> Making:
    """Returns how quickly this many specimens are made, after some that only warm up."""
    from grafu.synth.generate import make_specimen

    for index in range(10):
        make_specimen(SEED + 1, index, POINTS)
    rates, single, parts = [], [], []
    for _ in range(repeats):
        seconds = []
        for index in range(count):
            started = time.process_time()
            specimen = make_specimen(SEED, index, POINTS)
            seconds.append(time.process_time() - started)
            parts.append(len(specimen.whole.parts))
        rates.append(round(count / sum(seconds), 1))
        single += seconds
    spread = [round(float(1e3 * s), 2) for s in np.percentile(single, PLACES)]
    return Making(count, round(mean(parts), 1), sorted(rates), spread, time_stages(count), time_reading(count))


def time_stages(count: int) -> dict[str, float]:
    """Returns the milliseconds of each stage of one model."""
    from grafu.geometry.sampling import sample_surfaces
    from grafu.synth.families.table import draw_made, make_furniture
    from grafu.synth.noise.modelling_noise import apply_noise
    from grafu.synth.noise.modelling_styles import draw_noise
    from grafu.synth.truth.check import faults_of
    from grafu.synth.truth.true_graph import true_graph

    clock = _Stages()
    for index in range(count):
        rng = np.random.default_rng([SEED, index])
        clock.start()
        blueprint, _ = draw_made(rng)
        clock.stop("draw and build")
        tidy = make_furniture(blueprint)
        clock.stop("build alone")
        faults_of(tidy)
        clock.stop("check")
        whole, _ = apply_noise(tidy, draw_noise(rng, tidy))
        clock.stop("noise")
        true_graph(whole, 0)
        clock.stop("contacts and mounts")
        sample_surfaces([part.mesh for part in whole.parts], POINTS)
        clock.stop("points")
    return {name: round(1e3 * seconds / count, 2) for name, seconds in clock.seconds.items()}


class _Stages:
    """Adds up the processor's time by stage."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self._last = 0.0

    def start(self) -> None:
        self._last = time.process_time()

    def stop(self, stage: str) -> None:
        now = time.process_time()
        self.seconds[stage] += now - self._last
        self._last = now


def time_reading(count: int) -> float:
    """Returns the models a second that are read from a shard of this many."""
    from grafu.data.pair import record_of
    from grafu.data.shards import ShardReader, write_shard
    from grafu.synth.generate import make_specimen

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "shard.zip"
        write_shard((record_of(make_specimen(SEED, index, POINTS)) for index in range(count)), path)
        started = time.process_time()
        read = sum(1 for _ in ShardReader(path))
        return round(read / (time.process_time() - started), 1)


def making_section(making: Making) -> Section:
    """Returns the rate as a figure, and its table."""
    rate = Figure("synthetic models with points", tuple(making.rates), "a second", RATE, at_least=True)
    return Section((rate,), making_table(making))


def making_table(making: Making) -> str:
    """Returns one table in Markdown: the rate, its spread, a single model's time, the stages, reading."""
    low, middle, high = making.milliseconds
    rows = [
        ("models a second and core", f"{making.rate:.1f} ({making.rates[0]:.1f} .. {making.rates[-1]:.1f})"),
        ("parts of a model", f"{making.parts:.1f}"),
        ("milliseconds of one model, 5 / 50 / 95 %", f"{low:.1f} / {middle:.1f} / {high:.1f}"),
        *((f"of which {stage}", f"{value:.2f}") for stage, value in making.stages.items()),
        ("models a second read from a shard", f"{making.read:.0f}"),
    ]
    return measured_table("Making", f"{making.models} specimens, {POINTS} points on each part.", rows)
