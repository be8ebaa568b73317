"""A Blender process that stays while this one writes several models: starting it takes longer than most models.

Whatever goes wrong ends the process; the next model gets a new one.

An articulated object travels as bytes, for the other process may have an older numpy: values as what made them, without
what was worked out meanwhile, and they check themselves again.
"""

import atexit
import io
import os
import pickle
import subprocess
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryFile
from threading import Event, Lock, Timer
from typing import IO, Any, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.errors import ExportError
from grafu.processes.lifetime import started_by_main_thread


def packed(articulated: ArticulatedObject) -> bytes:
    """Returns an object as bytes for `unpacked`."""
    stream = io.BytesIO()
    _Packer(stream, pickle.HIGHEST_PROTOCOL).dump(articulated)
    return stream.getvalue()


def unpacked(data: bytes) -> ArticulatedObject:
    """Returns the object that `packed` was given; bytes of another source must not be given, for they may run code."""
    articulated: ArticulatedObject = pickle.loads(data)
    return articulated


@final
class _Packer(pickle.Pickler):
    def reducer_override(self, value: Any) -> Any:
        if isinstance(value, np.ndarray):
            return _array, (np.ascontiguousarray(value).tobytes(), value.dtype.str, value.shape)
        if is_dataclass(value) and not isinstance(value, type):
            return type(value), tuple(getattr(value, field.name) for field in fields(value) if field.init)
        return NotImplemented


def _array(data: bytes, dtype: str, shape: tuple[int, ...]) -> np.ndarray:
    return np.frombuffer(data, np.dtype(dtype)).reshape(shape)


ANSWER = b"written\n"
MODELS = 100  # then a fresh process: Blender keeps some memory of every model
_SAID = 300  # characters of Blender's own last words


@cache
def blender_process(interpreter: str) -> "BlenderProcess":
    """Returns the one process of an interpreter; it starts when it is first asked, and ends with this one."""
    parent = [str(os.getpid())] if started_by_main_thread() else []
    process = BlenderProcess([interpreter, "-m", "grafu.export.blend.worker", *parent])
    atexit.register(process.stop)
    return process


@final
class BlenderProcess:
    """Starts `command` when needed; to each pair of paths that it is given it answers `ANSWER` when all is written."""

    def __init__(self, command: list[str]) -> None:
        self._command = command
        self._lock = Lock()
        self._running: subprocess.Popen[bytes] | None = None
        self._errors: IO[bytes] | None = None  # of the one that runs
        self._written = 0

    def write(self, source: Path, target: Path, seconds: float) -> None:
        """Has the object in `source` written to `target`, within so many seconds.

        Raises:
            ExportError: if Blender cannot be run, fails, or takes longer.
        """
        with self._lock:
            if self._written == MODELS:
                self._end()
            answer, late = self._ask(f"{source}\t{target}\n".encode(), seconds)
            if answer == ANSWER and target.is_file():
                self._written += 1
                return
            code, said = self._end()
        if late:
            raise ExportError(f"Blender did not end within {seconds:g} s and was stopped: no model.blend")
        raise ExportError(f"Blender could not write model.blend (exit {code}): {said}")

    def stop(self) -> None:
        """Ends the process, if one runs."""
        with self._lock:
            self._end()

    def _ask(self, question: bytes, seconds: float) -> tuple[bytes, bool]:
        """Returns the answer, empty where none came, and whether the time ran out."""
        running = self._running or self._start()
        assert running.stdin is not None
        assert running.stdout is not None
        late = Event()

        def end() -> None:
            late.set()
            running.kill()

        watch = Timer(seconds, end)
        watch.daemon = True
        watch.start()
        try:
            running.stdin.write(question)
            running.stdin.flush()
            answer = running.stdout.readline()
        except OSError:  # it is gone already
            answer = b""
        watch.cancel()
        return answer, late.is_set()

    def _start(self) -> "subprocess.Popen[bytes]":
        errors, pipe = TemporaryFile(), subprocess.PIPE  # noqa: SIM115  # it is closed when the process has ended
        try:
            self._running = subprocess.Popen(self._command, stdin=pipe, stdout=pipe, stderr=errors)
        except OSError as error:
            errors.close()
            raise ExportError(f"cannot run `{self._command[0]}`: {error.strerror}; no model.blend") from error
        self._written, self._errors = 0, errors
        return self._running

    def _end(self) -> tuple[int | None, str]:
        """Closes the process's input, at which it ends, or else ends it; returns its exit code and last words."""
        running, errors, self._running, self._errors = self._running, self._errors, None, None
        if running is None or errors is None:
            return None, ""
        try:
            running.communicate(timeout=2.0)
        except (subprocess.TimeoutExpired, OSError):
            running.kill()
            running.communicate()
        with errors:
            return running.returncode, _last_words(errors)


def _last_words(errors: IO[bytes]) -> str:
    errors.seek(0)
    lines = [line.strip() for line in errors.read().decode(errors="replace").splitlines() if line.strip()]
    return lines[-1][-_SAID:] if lines else "it said nothing"
