"""How long one model takes in a fresh process, beside what Blender takes to start, import it and save it.

`bench.py` runs it. Both run in turns, on one core, so that other work on the machine meets both alike; the ratio is of
the medians. Blender is the Python module `bpy` in this environment, or that of the Python that GRAFU_BLENDER_PYTHON
names; where there is none, the table states it and gives no ratio.
"""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from bench_figure import Figure, Section
from bench_table import measured_table

ROOT = Path(__file__).parent.parent
SAMPLE = ROOT / "samples" / "dresser.glb"
BARS = {"cold": 0.9, "import": 0.3, "open": 0.1, "help": 0.5, "ratio": 1.2}
OPTIONS = ("--formats", "glb", "--no-page", "--overwrite")
BLENDER = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[1])
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[2])
"""
NETWORK = """
import time
from grafu.completion.session import SHIPPED_WEIGHTS, NetworkSession, onnx_runtime
onnx_runtime()
began = time.process_time()
NetworkSession(SHIPPED_WEIGHTS)
print(time.process_time() - began)
"""


@dataclass(frozen=True)
class Starting:
    """Seconds of each run, sorted: the processor's (user and system) and the clock's, by what was run."""

    cpu: Mapping[str, list[float]]
    clock: Mapping[str, list[float]]
    in_turn: Mapping[str, list[float]]
    """The clock's seconds in the order of the turns."""
    opening: list[float]
    """Seconds of the processor in which the shipped network is opened, ONNX Runtime being imported."""

    def ratio(self, seconds: Mapping[str, list[float]]) -> float:
        """Returns grafu's seconds over Blender's."""
        return median(seconds["grafu"]) / median(seconds["blender"])


def time_starting(sample: str, repeats: int) -> Starting:
    """Returns how long the command, Blender, and an import of `grafu.functionalize` take in turns, after a first."""
    blender = blender_python()
    with tempfile.TemporaryDirectory() as folder:
        commands: dict[str, Sequence[str]] = {
            "grafu": (sys.executable, "-m", "grafu", "functionalize", sample, "--out", folder, *OPTIONS),
            "import": (sys.executable, "-c", "import grafu; grafu.functionalize"),
            "help": (sys.executable, "-m", "grafu", "--help"),
        }
        if blender:
            commands["blender"] = (blender, "-c", BLENDER, sample, str(Path(folder) / "model.blend"))
        cpu: dict[str, list[float]] = {name: [] for name in commands}
        clock: dict[str, list[float]] = {name: [] for name in commands}
        for turn in range(repeats + 1):
            for name, command in commands.items():
                processor, seconds = spent(command)
                if turn:
                    cpu[name].append(round(processor, 4))
                    clock[name].append(round(seconds, 4))
        opening = [round(float(printed((sys.executable, "-c", NETWORK))), 4) for _ in range(repeats)]
    ordered = [{name: sorted(seconds) for name, seconds in by.items()} for by in (cpu, clock)]
    return Starting(*ordered, clock, sorted(opening))


def blender_python() -> str:
    """Returns the Python that has `bpy`; empty where there is none."""
    for python in filter(None, (os.environ.get("GRAFU_BLENDER_PYTHON"), sys.executable)):
        code = "import importlib.util, sys; sys.exit(importlib.util.find_spec('bpy') is None)"
        if subprocess.run([python, "-c", code], capture_output=True, check=False).returncode == 0:
            return python
    return ""


def spent(command: Sequence[str]) -> tuple[float, float]:
    """Returns the seconds of the processor, user and system, and of the clock that a command takes."""
    before, started = os.times(), time.perf_counter()
    printed(command)
    seconds, after = time.perf_counter() - started, os.times()
    user = after.children_user - before.children_user
    return user + after.children_system - before.children_system, seconds


def printed(command: Sequence[str]) -> str:
    """Returns what a command prints; bytecode is kept, as an installed package has it."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return subprocess.run(command, env=kept, check=True, capture_output=True, text=True).stdout


def starting_section(starting: Starting) -> Section:
    """Returns the figures of a fresh process, and their table."""
    named = {"cold": "grafu", "import": "import", "help": "help"}
    figures = [
        Figure(f"a fresh process: {name}", tuple(starting.cpu[of]), "s", BARS[name]) for name, of in named.items()
    ]
    figures.append(Figure("a fresh process: the network opens", tuple(starting.opening), "s", BARS["open"]))
    if "blender" in starting.clock:
        ratios = zip(starting.in_turn["grafu"], starting.in_turn["blender"], strict=True)
        figures.append(
            Figure(
                "a fresh process over Blender, clock",
                tuple(sorted(round(a / b, 3) for a, b in ratios)),
                "",
                BARS["ratio"],
            )
        )
    return Section(tuple(figures), starting_table(starting))


def starting_table(starting: Starting) -> str:
    """Returns one table in Markdown."""
    rows = [
        (f"{name}: processor", f"{median(runs):.2f} s ({runs[0]:.2f} .. {runs[-1]:.2f})")
        for name, runs in starting.cpu.items()
    ]
    rows += [(f"{name}: clock, median", f"{median(runs):.2f} s") for name, runs in starting.clock.items()]
    rows.append(("the network opens", f"{median(starting.opening):.3f} s"))
    if "blender" in starting.cpu:
        rows.append(("grafu / Blender, clock", f"{starting.ratio(starting.clock):.2f}"))
        rows.append(("grafu / Blender, processor", f"{starting.ratio(starting.cpu):.2f}"))
    else:
        rows.append(("grafu / Blender", "not measured: there is no bpy here (set GRAFU_BLENDER_PYTHON)"))
    command = f"`grafu functionalize {SAMPLE.name} {' '.join(OPTIONS[:-1])}`"
    what = f"{command} in a fresh process, and Blender, which starts, imports it and saves it; medians."
    return measured_table("Starting", what, rows)
