"""Blender files (.blend): objects with meshes are parts, as Blender shows them. It settles no frame.

Blender itself opens the file, in a process of its own and with its scripts off, and hands it on as GLB, which is read
as every other. Modifiers are applied; images, animations and what is hidden are left out. That process is `python -m
grafu.asset.blend SOURCE TARGET [PARENT]`; nothing else here imports `bpy`.

Blender follows every path in a file, wherever it leads. So the list of the file's blocks is read first, and a file with
a block that names other files is refused before Blender sees it. A file begins with `BLENDER`, the size of pointers and
the version; each block has a code, its length, an old address, and two numbers. From Blender 5.0 on both are wider.
"""

import gzip
import json
import os
import struct
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any, Final

from grafu.asset.gltf import read_gltf
from grafu.asset.json_files import read_json
from grafu.asset.options import LoadOptions
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.errors import UnreadableAsset
from grafu.processes.lifetime import is_killed_with, scratch_folder, started_by_main_thread
from grafu.visible import visible

INTERPRETER_VARIABLE: Final = "GRAFU_BLENDER_PYTHON"
"""Names a Python with `grafu[blender]`, for those whose own Python is one that `bpy` is not made for."""
_SECONDS: Final = 300.0  # the limits of the model end it earlier, where there are any
_PLAIN, _ZSTANDARD, _GZIP = _MAGICS = (b"BLENDER", b"\x28\xb5\x2f\xfd", b"\x1f\x8b")
_MOST_UNPACKED: Final = 2_000_000_000  # bytes
_NAMES_FILES: Final = {
    b"LI": "other .blend files",
    b"CF": "caches",
    b"VO": "volumes",
    b"SO": "sounds",
    b"MC": "films",
    b"VF": "fonts",
}
"""What Blender opens when it opens a file, by the code of the block that names it."""
_EXPECTED: Final = "a file of Blender; or export it as GLB"
_SAID: Final = 300  # characters of Blender's own last words
_LINKED: Final = 3  # exit code: the file names other files, and the last line states which


def read_blend(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the meshes of a .blend file that are shown, in Blender's coordinates.

    Raises:
        UnreadableAsset: if the file is missing or damaged, links to other .blend files, or there is no `bpy`.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    data = files.read(path)
    if not data.startswith(_MAGICS):
        raise UnreadableAsset(f"{path} is no file of Blender: expected {_EXPECTED}")
    interpreter = _interpreter(path)
    with scratch_folder() as folder:
        source, target = Path(folder) / "scene.blend", Path(folder) / "scene.glb"
        source.write_bytes(data)  # a copy: what it names beside itself is not there
        _run(path, [interpreter, "-m", "grafu.asset.blend", str(source), str(target)])
        found = read_gltf(target, options, ModelFiles(target, options.limits))
        about = read_json(target.with_suffix(".json"), ModelFiles(target, options.limits), "facts of a scene")
    unit, images = float(about["unit"]), int(about["images"])
    left_out = (f"{images} images of materials were left out: export the file as GLB to keep them",) if images else ()
    convention = Convention(f"the file (Blender: {unit:g} m per unit, Z up)", up="+Z", front="-Y", unit=unit)
    parts = tuple(replace(p, source=replace(p.source, file=path.name)) for p in found.parts)
    return replace(found, parts=parts, convention=convention, notes=(*found.notes, *left_out))


def _interpreter(path: Path) -> str:
    """Returns the Python that has `bpy`: the one that `GRAFU_BLENDER_PYTHON` names, else this one."""
    named = os.environ.get(INTERPRETER_VARIABLE)
    if named and os.access(named, os.X_OK):
        return named
    if named or find_spec("bpy") is None:
        raise UnreadableAsset(
            f"{path} is a file of Blender, which is read by Blender's Python package: pip install 'grafu[blender]' "
            f"(for Python 3.11), let {INTERPRETER_VARIABLE} name a Python that has it, or export the file as GLB"
        )
    return sys.executable


def _run(path: Path, command: list[str]) -> None:
    parent = [str(os.getpid())] if started_by_main_thread() else []
    with TemporaryFile() as errors:
        try:
            done = subprocess.run(
                [*command, *parent],
                stdin=subprocess.DEVNULL,
                stdout=errors,
                stderr=errors,
                timeout=_SECONDS,
                check=False,
            )
        except OSError as error:
            raise UnreadableAsset(f"{path} cannot be read: `{command[0]}` does not run ({error.strerror})") from None
        except subprocess.TimeoutExpired:
            raise UnreadableAsset(f"{path} took Blender more than {_SECONDS:g} s: expected {_EXPECTED}") from None
        errors.seek(0)
        said = " ".join(errors.read().decode("utf-8", "replace").split())[-_SAID:]
        if done.returncode == _LINKED:
            raise UnreadableAsset(
                f"{path} names {said}, which are not opened: make them local (Object > Relations > Make Local > All) "
                "or remove them, or export the file as GLB"
            )
        if done.returncode:
            raise UnreadableAsset(f"{path} could not be opened by Blender ({visible(said)}): expected {_EXPECTED}")


def _hand_on(source: str, target: Path) -> int:
    """Writes what a file shows as GLB, and facts about it beside that; returns the exit code."""
    named = sorted(
        {_NAMES_FILES[code] for code in _block_codes(_unpacked(Path(source).read_bytes())) & {*_NAMES_FILES}}
    )
    if named:
        print(", ".join(named))
        return _LINKED
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=source, load_ui=False, use_scripts=False)
    left_out = ("export_animations", "export_skins", "export_morph", "export_cameras", "export_lights", "export_extras")
    how: dict[str, Any] = dict.fromkeys(left_out, False)
    how |= {"export_apply": True, "use_visible": True, "export_yup": False, "export_image_format": "NONE"}
    bpy.ops.export_scene.gltf(filepath=str(target), export_format="GLB", **how)
    nodes = (node for look in bpy.data.materials if look.node_tree for node in look.node_tree.nodes)
    images = {node.image.name for node in nodes if node.type == "TEX_IMAGE" and node.image}
    about = {"unit": bpy.context.scene.unit_settings.scale_length, "images": len(images)}
    target.with_suffix(".json").write_text(json.dumps(about))
    return 0


def _unpacked(data: bytes) -> bytes:
    """Returns the bytes of a file as they are when it is not packed.

    Raises:
        ValueError: if there are too many of them, or the file is damaged.
    """
    if data.startswith(_GZIP):
        with gzip.open(BytesIO(data)) as stream:
            unpacked = stream.read(_MOST_UNPACKED + 1)
    elif data.startswith(_ZSTANDARD):
        import zstandard  # of the extra `blender`

        with zstandard.ZstdDecompressor().stream_reader(data, read_across_frames=True) as stream:
            unpacked = stream.read(_MOST_UNPACKED + 1)
    else:
        return data
    if len(unpacked) > _MOST_UNPACKED:
        raise ValueError(f"it has more than {_MOST_UNPACKED:,} bytes when it is unpacked")
    return unpacked


def _block_codes(data: bytes) -> set[bytes]:
    """Returns the codes of all blocks of a file, without the zeros that fill them.

    Raises:
        ValueError: if the file is damaged, or of a format that is not known.
    """
    return {code.rstrip(b"\0") for code in _blocks(data)}


def _blocks(data: bytes) -> Iterator[bytes]:
    if data[:12] == b"BLENDER17-01":  # Blender 5.0 and later: the header has 17 bytes
        place, head, length_at = 17, "<4si8xqq", 2
    elif data[:7] == _PLAIN and data[7:8] in (b"-", b"_") and data[8:9] == b"v":
        place, head, length_at = 12, "<4si8xii" if data[7:8] == b"-" else "<4si4xii", 1
    else:
        raise ValueError("the header is not that of a file of Blender")
    size = struct.calcsize(head)
    while True:
        if place + size > len(data):
            raise ValueError("the list of its blocks is cut off")
        found = struct.unpack_from(head, data, place)
        code, length = found[0], found[length_at]
        if code == b"ENDB":
            return
        if length < 0:
            raise ValueError("a block has a negative length")
        yield code
        place += size + length


if __name__ == "__main__":
    code = 1
    try:
        if sys.argv[3:]:
            is_killed_with(int(sys.argv[3]))
        code = _hand_on(sys.argv[1], Path(sys.argv[2]))
    except BaseException as error:  # whatever it is, its one line is what the asker can read
        print(visible(f"{type(error).__name__}: {error}"), file=sys.stderr, flush=True)
    os._exit(code)  # Blender's own goodbye has been seen to hang
