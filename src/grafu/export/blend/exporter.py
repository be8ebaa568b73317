"""`model.blend`, written by a process of its own: Blender's state is global and it may hang. It never imports `bpy`."""

import os
import sys
from importlib.util import find_spec
from pathlib import Path

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.sweep import opening_stages
from grafu.asset.blend import INTERPRETER_VARIABLE
from grafu.errors import ExportError
from grafu.export.blend.process import blender_process, packed
from grafu.export.files import ExportFiles
from grafu.processes.lifetime import scratch_folder

SECONDS = 300.0  # a model of 1 000 000 faces takes some 20: a model that takes longer hangs


def export_blend(articulated: ArticulatedObject) -> ExportFiles:
    """Returns `model.blend`.

    Raises:
        ExportError: if there is no `bpy`, or Blender fails or hangs.
        ArticulationError: if joints wait for one another.
    """
    interpreter = find_interpreter()
    opening_stages(articulated)
    with scratch_folder() as folder:
        source, target = Path(folder) / "object.packed", Path(folder) / "model.blend"
        source.write_bytes(packed(articulated))
        blender_process(interpreter).write(source, target, SECONDS)
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
