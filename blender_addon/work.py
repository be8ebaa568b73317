"""Runs of `grafu` in processes of their own, so that Blender's window goes on: start, look, stop, fetch.

One process stays from run to run, so that a change costs what it changes. Stopping a run ends it at once; the next run
starts another. It ends with Blender, however that ends, and with the add-on. A folder that stays behind all the same is
cleared away at the next start.
"""

import atexit
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from time import monotonic, sleep

from . import leftovers

STAGES = {  # in their order, with what an artist calls them
    "load": "reading the parts",
    "parse": "finding what touches",
    "complete": "finding what moves",
    "plan": "planning joints",
    "close": "closing drawers that are drawn open",
    "body": "building the body",
    "realize": "fitting hinges and rails",
    "fittings": "fitting handles and shelves",
    "export": "making the files",
    "write": "writing",
}
SECONDS = 900.0  # the authors' own limit for a model
PRIVATE = {"ORT_DISABLE_TELEMETRY": "1"}  # no telemetry of ONNX Runtime
_staying = None


class Failed(Exception):
    """A run that gave nothing; the words are for the user."""


class _Process:
    """A process and its folder; what it states goes to a file there."""

    def __init__(self) -> None:
        leftovers.clear()
        self.folder = Path(tempfile.mkdtemp(prefix=leftovers.PREFIX))
        self._output = open(self.folder / "output.txt", "wb")  # noqa: SIM115  closed in `end`
        leftovers.hold(self._output)
        self._running = None

    def start(self, module, arguments) -> None:
        """Starts a module of `grafu`."""
        self._running = subprocess.Popen(
            [sys.executable, "-m", module, *arguments],
            stdin=subprocess.PIPE,
            stdout=self._output,
            stderr=subprocess.STDOUT,
            env={**os.environ, **PRIVATE, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
        )

    @property
    def code(self):
        """Its exit code; None while it runs."""
        return self._running.poll() if self._running is not None else None

    def ask(self, line: str) -> None:
        """Gives it one line; one that is gone states it by its code."""
        try:
            self._running.stdin.write(line.encode() + b"\n")
            self._running.stdin.flush()
        except OSError:
            self._running.wait()

    def printed_from(self, start: int) -> str:
        """Returns what it has printed from the `start`th byte on; nothing once it has been ended."""
        if self._output.closed:
            return ""
        with open(self.folder / "output.txt", "rb") as output:
            output.seek(start)
            return output.read().decode(errors="replace")

    def printed_so_far(self) -> int:
        """Returns how many bytes it has printed."""
        return (self.folder / "output.txt").stat().st_size

    def end(self) -> None:
        """Ends it at once, whatever it does, and clears away its folder."""
        if self._running is not None and self._running.stdin is not None:
            self._running.kill()
            self._running.communicate()
        self._output.close()
        shutil.rmtree(self.folder, ignore_errors=True)


class _Run:
    """The base of all runs: progress and outcome."""

    def __init__(self, process) -> None:
        self._process = process
        self._start = process.printed_so_far()
        self._began = None
        self._is_late = False
        self.folder = process.folder
        self.is_cancelled = False

    @property
    def is_done(self) -> bool:
        """Whether it has ended; one that takes too long is stopped."""
        if self._began is not None and monotonic() - self._began > SECONDS and self._process.code is None:
            self._is_late = True
            self._process.end()
        return self._process.code is not None or self._verdict() is not None

    @property
    def stage(self) -> str:
        """The stage that it is in."""
        stages = [line.split()[1] for line in self._lines() if line.startswith("stage ")]
        return stages[-1] if stages else "start"

    @property
    def ratio(self) -> float:
        """How far it is, 0..1, by stages."""
        return ([*STAGES].index(self.stage) + 1) / (len(STAGES) + 1) if self.stage in STAGES else 0.0

    @property
    def doing(self) -> str:
        """What it does now, in an artist's words."""
        return STAGES.get(self.stage, "starting")

    def wait(self) -> None:
        """Waits for its end."""
        while not self.is_done:
            sleep(0.01)

    def require_success(self) -> None:
        """Raises Failed, with its reason in one line, if it did not end well."""
        if self._is_late:
            raise Failed(f"it took longer than {SECONDS:g} s and was stopped")
        verdict = self._verdict()
        if verdict is None:
            output = [line.strip() for line in self._process.printed_from(0).splitlines() if line.strip()]
            words = [line for line in output if not line.startswith("stage ") and line != "done"]
            raise Failed(f"the process ended by itself ({self._process.code}): {words[-1] if words else 'no word'}")
        if verdict != "done":
            raise Failed(verdict.removeprefix("error "))

    def text(self, name: str) -> str:
        """Returns a file that it wrote."""
        return (self.folder / name).read_text(encoding="utf-8")

    def result(self):
        """Returns the object that it made."""
        from grafu.export.blend.process import unpacked

        return unpacked((self.folder / "object.packed").read_bytes())

    def _verdict(self):
        return next((line for line in self._lines() if line == "done" or line.startswith("error ")), None)

    def _lines(self) -> list:
        output = self._process.printed_from(self._start).split("\n")[:-1]  # the last may be half printed
        return [line.rstrip("\r") for line in output]


class Run(_Run):
    """Functionalizes what `source` holds, in the process that stays."""

    def __init__(self, settings) -> None:
        super().__init__(_stays())
        self.source = self.folder / "model.glb"
        (self.folder / "settings.json").write_text(json.dumps(settings.to_json()))

    def start(self) -> None:
        """Asks the process for it, and does not wait."""
        for old in (*self.folder.glob("*.glb"), *self.folder.glob("*.packed")):
            if old != self.source:
                old.unlink()
        self._start, self._began = self._process.printed_so_far(), monotonic()
        self._process.ask(json.dumps([str(self.source), str(self.folder / "settings.json"), str(self.folder)]))

    def close(self) -> None:
        """Stops it, and its process, where it still runs."""
        if self._began is not None and not self.is_done:
            end()


class Command(_Run):
    """A module of `grafu` in a process and a folder of its own, for one run."""

    def __init__(self) -> None:
        super().__init__(_Process())

    def start(self, module, arguments) -> None:
        """Starts it, and does not wait."""
        self._began = monotonic()
        self._process.start(module, arguments)

    def require_success(self) -> None:
        """Raises Failed, with its reason in one line, if it did not end well."""
        if self._is_late or self._process.code != 0:
            super().require_success()

    def close(self) -> None:
        """Stops it where it still runs, and clears away its folder."""
        self._process.end()


def warm() -> None:
    """Starts the process that stays, if none runs: it is ready sooner."""
    _stays()


def end() -> None:
    """Ends the process that stays; the next run starts another."""
    global _staying
    if _staying is not None:
        _staying.end()
        _staying = None


def _stays():
    global _staying
    if _staying is not None and _staying.code is not None:
        end()
    if _staying is None:
        _staying = _Process()
        _staying.start("grafu.pipeline.worker", [str(_staying.folder)])
        atexit.unregister(end)
        atexit.register(end)
    return _staying
