"""One run of `grafu` in a process of its own, so that Blender's window goes on: start, look, stop, fetch."""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from time import monotonic, sleep

STAGES = ("load", "parse", "complete", "plan", "body", "realize", "fittings", "write")
SECONDS = 900.0  # the authors' own limit for a model


class Failed(Exception):
    """A run that gave nothing; the words are for the user."""


class Run:
    """A process that functionalizes one GLB; not a value."""

    def __init__(self, settings) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="grafu_")
        self.folder = Path(self._folder.name)
        self.source = self.folder / "model.glb"
        (self.folder / "settings.json").write_text(json.dumps(settings.to_json()))
        self._process = None
        self._began = 0.0
        self.is_cancelled = False

    def start(self, module: str = "grafu.pipeline.interactive", arguments=None) -> None:
        """Starts the process: what `source` holds is functionalized, unless other arguments are given."""
        usual = [str(self.source), str(self.folder / "settings.json"), str(self.folder)]
        self._said = open(self.folder / "said.txt", "wb")  # noqa: SIM115  closed in `close`
        self._began = monotonic()
        self._process = subprocess.Popen(
            [sys.executable, "-m", module, *(usual if arguments is None else arguments)],
            stdout=self._said,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
        )

    @property
    def is_done(self) -> bool:
        """Whether it has ended; one that takes too long is stopped."""
        if monotonic() - self._began > SECONDS:
            self._process.kill()
        return self._process.poll() is not None

    @property
    def stage(self) -> str:
        """The stage that it is in."""
        stages = [line.split()[1] for line in self._lines() if line.startswith("stage ")]
        return stages[-1] if stages else "start"

    @property
    def share(self) -> float:
        """How far it is, 0..1, by stages."""
        return (STAGES.index(self.stage) + 1) / (len(STAGES) + 1) if self.stage in STAGES else 0.0

    def wait(self) -> None:
        """Waits for its end."""
        while not self.is_done:
            sleep(0.02)

    def require_success(self) -> None:
        """Raises Failed if it did not end well."""
        if self._process.returncode:
            errors = [line.removeprefix("error ") for line in self._lines() if line.strip()]
            raise Failed(errors[-1] if errors else f"it ended with {self._process.returncode}")

    def text(self, name: str) -> str:
        """Returns a file that it wrote."""
        return (self.folder / name).read_text(encoding="utf-8")

    def result(self):
        """Returns the object that it made."""
        from grafu.export.blend.transport import unpacked

        return unpacked((self.folder / "object.packed").read_bytes())

    def close(self) -> None:
        """Stops it where it still runs, and clears away its files."""
        if self._process is not None and self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        if self._process is not None:
            self._said.close()
        self._folder.cleanup()

    def _lines(self) -> list:
        return (self.folder / "said.txt").read_text(errors="replace").splitlines()
