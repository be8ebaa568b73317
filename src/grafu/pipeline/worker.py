"""A process that keeps running while the user works on a model: `python -m grafu.pipeline.worker FOLDER`.

Every line on stdin is a JSON list of three paths: input, settings and the folder for results. There go `object.packed`
(`grafu.export.blend.process`), `report.json`, `graph.json` and `interior.json` (the compartments). It answers on stdout
with `stage NAME` as a stage begins, and then `done` or `error WHY`. What a change does not touch is not made again; the
answer is the same as a fresh process gives. When its input ends, it ends at once, whatever it is doing, and takes
FOLDER, which is the asker's for passing things, with it.
"""

import json
import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from queue import Queue
from threading import Thread
from typing import Any

import numpy as np

from grafu.additions.interior.turned import compartments_of
from grafu.asset.json_files import read_own
from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.errors import FunctionalizationError
from grafu.export.blend.process import packed
from grafu.geometry.transform import transform_points
from grafu.graph.serialize import completion_to_json, dump_json
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import settings_from_bytes
from grafu.processes.cache import CACHED_VALUES, NO_CACHE, Cache
from grafu.templates.gallery import builtin_gallery
from grafu.visible import visible


def run(source: Path, settings_file: Path, folder: Path, cache: Cache = NO_CACHE) -> Functionalized:
    """Functionalizes one input as the settings say and writes what the module's docstring names.

    What the `cache` holds of earlier runs is not computed again.

    Raises:
        FunctionalizationError: if the input or a setting is at fault.
    """
    settings = settings_from_bytes(read_own(settings_file, "settings of grafu"), settings_file)
    _say("stage load")
    asset = load_asset(source, settings.reading)
    asset = cache.value("asset", _itself, asset)  # the same object: what was worked out on its meshes stays
    result = functionalize(asset, settings.motion, builtin_gallery(), PipelineConfig(settings), _tell, cache)
    _say("stage write")
    (folder / "object.packed").write_bytes(packed(result.object))
    for name, values in (
        ("report", report_of(result).to_json()),
        ("graph", completion_to_json(result.completion)),
        ("interior", compartments_to_json(result)),
    ):
        (folder / f"{name}.json").write_text(dump_json(values), encoding="utf-8")
    return result


def compartments_to_json(result: Functionalized) -> dict[str, Any]:
    """Returns the compartments by number, each with its corners (metres, object frame) and moving bodies before it."""
    found, T = compartments_of(result.before_panels)
    corners = [np.round(transform_points(T, compartment.box.corners()), 6).tolist() for compartment in found]
    boxes = zip(corners, found, strict=True)
    return {"compartments": [{"corners": eight, "behind": list(one.behind)} for eight, one in boxes]}


def _itself(asset: Asset) -> Asset:
    return asset


def _tell(stage: str) -> None:
    _say(f"stage {stage}")


def serve(lines: Iterator[str], cache: Cache) -> None:
    """Answers one line after another; an input or a setting at fault is an answer, too."""
    for line in lines:
        try:
            source, settings, folder = map(Path, json.loads(line))
            run(source, settings, folder, cache)
            _say("done")
        except FunctionalizationError as error:
            _say("error " + " ".join(str(error).split()))


def _lines(folder: Path) -> Iterator[str]:
    """Yields lines as they come; a thread reads them, so that their end ends the process even amid work."""
    lines: Queue[str] = Queue()

    def read() -> None:
        for line in sys.stdin:
            lines.put(line)
        shutil.rmtree(folder, ignore_errors=True)
        os._exit(0)

    Thread(target=read, daemon=True).start()
    while True:
        yield lines.get()


def _say(what: str) -> None:
    print(visible(what), flush=True)


if __name__ == "__main__":
    try:
        serve(_lines(Path(sys.argv[1])), Cache(CACHED_VALUES))
    except Exception as error:  # a fault of ours: one line, and the next line needs a new process
        _say(f"error internal fault: {type(error).__name__}: {' '.join(str(error).split())}")
        os._exit(1)
