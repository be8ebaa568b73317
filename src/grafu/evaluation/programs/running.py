"""One run of an installed copy of another system on one model: its input written, its time limited, its output read.

What it wrote is kept with the command that wrote it: the same model is not run again by the same command.
"""

import json
import os
import shutil
import signal
import subprocess
from collections.abc import Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any, BinaryIO, Final

import numpy as np

from grafu.asset.foreign.motions import ForeignMotions
from grafu.asset.json_files import read_own_json
from grafu.asset.part import Asset
from grafu.errors import AssetError, NotRun, UnreadableAsset
from grafu.evaluation.programs.config import OutsideProgram, ProgramConfig
from grafu.evaluation.still_picture import picture_of
from grafu.export.files import ExportFiles, write_files
from grafu.export.obj import ObjFolder
from grafu.export.output_names import file_safe
from grafu.export.whole_file import write_whole
from grafu.geometry.mesh import merge_meshes
from grafu.pipeline.foreign import read_foreign
from grafu.visible import visible

_OF_PYTHON: Final = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "__PYVENV_LAUNCHER__")  # of this Python, not of its
_SAID: Final = 200  # characters of a program's last words
_MESH, _PICTURE, _DONE = "model.obj", "picture.png", "run.json"


def predicted_by(program: OutsideProgram, asset: Asset, model_id: str) -> ForeignMotions:
    """Returns what a program predicts for an asset, from its run, or from an earlier run of the same command.

    Raises:
        NotRun: if the program is not installed.
        UnreadableAsset: if it fails, takes too long, or writes nothing that is read.
        AssetError: if what it wrote is damaged.
        ExportError: if its input cannot be written.
    """
    folder = (program.outputs / f"{program.system}-{program_hash(program)}" / file_safe(model_id)).absolute()
    given = _input_files(asset)
    key = sha256(given[_MESH]).hexdigest()[:24]
    out = folder / "output"
    if not _is_done(folder / _DONE, key):
        _require_installed(program)
        write_files(ExportFiles(given), folder / "input", overwrite=True)
        shutil.rmtree(out, ignore_errors=True)  # of a run that failed
        out.mkdir(parents=True, exist_ok=True)
        _run(program.config, folder, model_id)
        motions = _read(program, out)
        write_whole(json.dumps({"input": key}) + "\n", folder / _DONE)
        return motions
    return _read(program, out)


def program_hash(program: OutsideProgram) -> str:
    """Returns a hash of what determines a program's output beside the model."""
    config = program.config
    said = program.system, config.command, str(config.folder), config.result, sorted(config.environment.items())
    return sha256(repr(said).encode()).hexdigest()[:12]


def _is_done(file: Path, key: str) -> bool:
    try:
        held = read_own_json(file, "the facts of a run") if file.is_file() else None
    except AssetError:
        return False
    return isinstance(held, dict) and held.get("input") == key


def _input_files(asset: Asset) -> dict[str, bytes]:
    """Returns a model's faces as one OBJ file, and a picture of it."""
    obj = ObjFolder(0.0)
    name = obj.add_mesh("model", merge_meshes([part.mesh for part in asset.parts]), np.zeros(3))
    return {_MESH: obj.files[name], _PICTURE: picture_of(asset)}


def _environment(config: ProgramConfig) -> dict[str, str]:
    """Returns the variables of a program: the user's, but for those that are of our own Python."""
    kept = {name: value for name, value in os.environ.items() if name not in _OF_PYTHON}
    return kept | config.environment


def _require_installed(program: OutsideProgram) -> None:
    config = program.config
    if config.folder is not None and not config.folder.is_dir():
        raise NotRun(f"{program.system} is not installed: `folder` of {program.path}, {config.folder}, does not exist")
    place = config.command[0] if config.folder is None else str(config.folder / config.command[0])
    found = shutil.which(config.command[0], path=_environment(config).get("PATH")) or shutil.which(place)
    if found is None:
        raise NotRun(f"{program.system} is not installed: `command` of {program.path}, {config.command[0]}, is not "
                     "there or cannot be run")  # fmt: skip


def _run(config: ProgramConfig, folder: Path, model_id: str) -> None:
    given, out = folder / "input", folder / "output"
    places = {"mesh": given / _MESH, "picture": given / _PICTURE, "out": out, "id": model_id}
    command = [text.format(**{word: str(place) for word, place in places.items()}) for text in config.command]
    with TemporaryFile() as said:
        try:
            process = subprocess.Popen(
                command,
                cwd=config.folder,
                env=_environment(config),
                stdin=subprocess.DEVNULL,
                stdout=said,
                stderr=said,
                start_new_session=True,
            )
        except OSError as error:
            raise UnreadableAsset(f"`{command[0]}` does not run ({error.strerror})") from None
        try:
            code = process.wait(config.timeout)
        except subprocess.TimeoutExpired:
            raise UnreadableAsset(f"`{command[0]}` took more than {config.timeout:g} s") from None
        finally:
            _end(process)
        if code:
            raise UnreadableAsset(f"`{command[0]}` ended with exit code {code}{_last_words(said)}")


def _end(process: "subprocess.Popen[bytes]") -> None:
    """Ends a program with all that it started."""
    with suppress(OSError):
        if os.name == "posix":
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    process.wait()


def _last_words(said: BinaryIO | Any) -> str:
    said.seek(0)
    words = " ".join(said.read().decode("utf-8", "replace").split())[-_SAID:]
    return f": {visible(words)}" if words else ""


def _read(program: OutsideProgram, out: Path) -> ForeignMotions:
    result = program.config.result
    found: Sequence[Path] = [out] if result == "." else sorted(out.glob(result))
    if not found or not any(out.iterdir()):
        raise UnreadableAsset(f"`{program.config.command[0]}` wrote no `{result}` into {out}")
    return read_foreign(found[0], program.system)
