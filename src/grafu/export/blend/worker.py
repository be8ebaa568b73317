"""The process that writes one `.blend`: `python -m grafu.export.blend.worker OBJECT OUT` (`transport` packs OBJECT).

It ends without Blender's own goodbye, which has been seen to hang.
"""

import os
import sys
from pathlib import Path

import bpy

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.export.blend.objects import build_object, set_scene
from grafu.export.blend.transport import unpacked


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


if __name__ == "__main__":
    source, target = map(Path, sys.argv[1:])
    write_blend(unpacked(source.read_bytes()), target)
    sys.stdout.flush()
    os._exit(0)
