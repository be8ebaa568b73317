"""`model.blend`, written by a process of its own: Blender's state is global and it may hang. It never imports `bpy`."""

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.sweep import opening_stages
from grafu.errors import ExportError
from grafu.export.blend.transport import packed
from grafu.export.files import ExportFiles

INTERPRETER_VARIABLE = "GRAFU_BLENDER_PYTHON"
"""Names a Python with `grafu[blender]`, for those whose own Python is one that `bpy` is not made for."""
SECONDS = 300.0  # a model of 1 000 000 faces takes some 20: whoever needs more hangs
_SAID = 300  # characters of Blender's own last words


def export_blend(articulated: ArticulatedObject) -> ExportFiles:
    """Returns `model.blend`.

    Raises:
        ExportError: if there is no `bpy`, or Blender fails or hangs.
        ArticulationError: if joints wait for one another.
    """
    interpreter = find_interpreter()
    opening_stages(articulated)
    with TemporaryDirectory(prefix="grafu_blend_") as folder:
        source, target = Path(folder) / "object.packed", Path(folder) / "model.blend"
        source.write_bytes(packed(articulated))
        _run([interpreter, "-m", "grafu.export.blend.worker", str(source), str(target)], target)
        return ExportFiles({"model.blend": target.read_bytes()})


def find_interpreter() -> str:
    """Returns the Python that has `bpy`: the one that `GRAFU_BLENDER_PYTHON` names, else this one.

    Raises:
        ExportError: if neither has it.
    """
    named = os.environ.get(INTERPRETER_VARIABLE)
    if named:
        if not os.access(named, os.X_OK):
            raise ExportError(f"{INTERPRETER_VARIABLE} must name a Python: got `{named}`, which cannot be run")
        return named
    if find_spec("bpy") is None:
        raise ExportError(
            "the format `blend` needs Blender's Python package: pip install 'grafu[blender]' (for Python 3.11), or let "
            f"{INTERPRETER_VARIABLE} name a Python that has it"
        )
    return sys.executable


def _run(command: list[str], target: Path) -> None:
    try:
        done = subprocess.run(command, capture_output=True, stdin=subprocess.DEVNULL, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired as error:
        raise ExportError(f"Blender did not end within {SECONDS:.0f} s and was stopped: no model.blend") from error
    except OSError as error:
        raise ExportError(f"cannot run `{command[0]}`: {error.strerror}; no model.blend") from error
    if done.returncode or not target.is_file():
        raise ExportError(f"Blender could not write model.blend (exit {done.returncode}): {_last_words(done.stderr)}")


def _last_words(stderr: bytes) -> str:
    lines = [line.strip() for line in stderr.decode(errors="replace").splitlines() if line.strip()]
    return lines[-1][-_SAID:] if lines else "it said nothing"
