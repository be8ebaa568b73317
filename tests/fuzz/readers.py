"""How each kind of starting files is read: as a library would, and by the whole command."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import mujoco  # noqa: F401 when it is imported it looks for GLFW in the folders of the system: once, before any case

from fuzz.case import Arguments, Reader
from fuzz.starting_files import OTHERS
from fuzz.starting_models import MODELS

_LITTLE = ("--formats", "urdf", "--no-page")
_TIME = ("--timeout", "6")  # seconds after which a command ends; it is stopped after one and a half times that


def read_model(entry: Path, rng: Random) -> Any:
    from grafu.asset.load import load_asset
    from grafu.asset.options import LoadOptions

    labels, parts = rng.choice(("input", "input", "none")), rng.choice(("input", "input", "input", "loose"))
    pieces = rng.choice(("together", "together", "together", "split"))
    return load_asset(entry, LoadOptions(labels=labels, parts=parts, pieces=pieces))  # type: ignore[arg-type]


def functionalize_model(entry: Path, out: Path, rng: Random) -> list[str]:
    if rng.random() < 0.2:
        return ["inspect", str(entry), *rng.choice(((), ("--json",)))]
    motion = rng.choice(("rule", "rule", "annotation", "auto"))
    page = [] if rng.random() < 0.15 else ["--no-page"]
    formats = rng.choice(("glb,urdf", "glb,urdf", "glb,urdf,mjcf"))
    what = ["--motion", motion, "--formats", formats, *page, *_TIME]
    return ["functionalize", str(entry), "--out", str(out), *what]


def _with_option(option: str, value: Callable[[Path], str]) -> Arguments:
    """Returns the arguments of a run on the cabinet beside an entry, with an option that names the entry."""

    def arguments(entry: Path, out: Path, rng: Random) -> list[str]:
        cabinet = entry.parent / "cabinet.obj"
        return ["functionalize", str(cabinet), "--out", str(out), *_LITTLE, option, value(entry), *_TIME]

    return arguments


def read_prediction(entry: Path, rng: Random) -> Any:
    from grafu.asset.foreign.attach import attach_motions
    from grafu.pipeline.foreign import read_foreign
    from predictions import cabinet

    return attach_motions(cabinet(), read_foreign(entry))


def read_settings(entry: Path, rng: Random) -> Any:
    from grafu.cli.main import build_parser
    from grafu.cli.stated_settings import stated_settings

    arguments = ["functionalize", "x.glb", "--out", "x", "--settings", str(entry)]
    return stated_settings(build_parser().parse_args(arguments))


def read_templates(entry: Path, rng: Random) -> Any:
    from grafu.templates.user import load_gallery, load_handles

    gallery, handles = load_gallery(entry), load_handles(entry)
    return [model.build(model.natural) for model in (*gallery.hinges, *gallery.rails)], handles


def read_graph(entry: Path, rng: Random) -> Any:
    from grafu.data.furfun.graph_files import load_graph_json
    from grafu.graph.serialize import completion_from_json, graph_from_json

    data = load_graph_json(entry)
    return completion_from_json(data) if rng.random() < 0.7 else graph_from_json(data)


def read_release(entry: Path, rng: Random) -> Any:
    from grafu.data.furfun.folder import FurFunFolder
    from grafu.evaluation.dataset import find_models, load_model

    if rng.random() < 0.3:
        return [load_model(model) for model in find_models(entry)[:1]]
    folder = FurFunFolder(entry, points=8)
    return [folder.pair(model) for model in folder.paired[:2]], folder.split("full_split")


def read_shards(entry: Path, rng: Random) -> Any:
    from grafu.data.stream import stream_shards

    return list(stream_shards(entry))


def read_result(entry: Path, rng: Random) -> Any:
    from grafu.pipeline.result_folder import read_result

    return read_result(entry)


def resume_result(entry: Path, out: Path, rng: Random) -> list[str]:
    """The command goes on where it finds results that were changed."""
    if entry.is_symlink():
        (out / "cabinet").symlink_to(os.readlink(entry))
    else:
        shutil.copytree(entry, out / "cabinet", symlinks=True, ignore=_no_plain_file)
    return ["functionalize", str(entry.parent / "cabinet.obj"), "--out", str(out), "--no-page", "--resume", *_TIME]


def read_result_set(entry: Path, rng: Random) -> Any:
    from grafu.dataset import load_dataset

    samples = list(load_dataset(entry, rng.choice((None, "train"))))
    return [(sample.name, sample.report, dict(sample.files)) for sample in samples]


def set_of_results(entry: Path, out: Path, rng: Random) -> list[str]:
    """The command puts results that were changed into a set."""
    return ["dataset", str(entry / "train"), "--out", str(out / "set"), "--format", rng.choice(("tar", "folder"))]


def _no_plain_file(folder: str, names: list[str]) -> list[str]:
    return [n for n in names if not os.path.isfile(os.path.join(folder, n)) or os.path.islink(os.path.join(folder, n))]


_PREDICTIONS = {
    "prediction of singapo": "singapo",
    "prediction of particulate": "particulate",
    "prediction of graphs": "grafu-pred",
    "prediction as urdf": "urdf",
}
_OTHER: dict[str, Reader] = {
    "settings": Reader(read_settings, _with_option("--settings", str)),
    "templates": Reader(read_templates, _with_option("--templates", str)),
    "graph": Reader(read_graph),
    "release": Reader(read_release),
    "shards": Reader(read_shards),
    "result": Reader(read_result, resume_result),
    "set of results": Reader(read_result_set, set_of_results),
}


def _prediction(word: str) -> Reader:
    return Reader(read_prediction, _with_option("--motion", lambda entry: f"{word}:{entry}"))


READERS: dict[str, Reader] = {
    **{name: Reader(read_model, functionalize_model) for name in MODELS},
    **{name: _prediction(word) for name, word in _PREDICTIONS.items()},
    **_OTHER,
}
assert set(READERS) == {*MODELS, *OTHERS}
