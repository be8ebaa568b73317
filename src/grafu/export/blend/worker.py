"""The process that writes `.blend` files, `python -m grafu.export.blend.worker [PARENT]`: one for each line given.

A line is two paths, apart by a tab: an object as `transport` packs it, and where its file goes. It ends with its
input, or with the process PARENT, and without Blender's own goodbye, which has been seen to hang.
"""

import os
import sys
from pathlib import Path

import bpy

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.export.blend.objects import build_object, set_scene
from grafu.export.blend.process import ANSWER, unpacked
from grafu.processes.lifetime import is_killed_with
from grafu.visible import visible


def write_blend(articulated: ArticulatedObject, path: Path) -> None:
    """Writes an object into an empty scene of its own, and that into a file; what this Blender held before is lost.

    Raises:
        ArticulationError: if joints wait for one another.
        RuntimeError: if Blender cannot write the file.
    """
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    build_object(articulated, scene)
    set_scene(scene)
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)


def _serve() -> None:
    if sys.argv[1:]:
        is_killed_with(int(sys.argv[1]))
    answers = os.dup(sys.stdout.fileno())
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what Blender prints is no answer
    for line in sys.stdin.buffer:
        source, target = map(Path, os.fsdecode(line.rstrip(b"\n")).split("\t"))
        write_blend(unpacked(source.read_bytes()), target)
        os.write(answers, ANSWER)


if __name__ == "__main__":
    code = 1
    try:
        _serve()
        code = 0
    except BaseException as error:  # whatever it is, its one line is what the asker can read
        print(visible(f"{type(error).__name__}: {error}"), file=sys.stderr, flush=True)
    os._exit(code)
