"""One run for a program that shows what comes back: `python -m grafu.pipeline.interactive INPUT SETTINGS FOLDER`.

Into FOLDER go `object.packed` (`grafu.export.blend.process`), `report.json`, `graph.json` and `interior.json`
(the compartments). Every line on stdout is `stage NAME` as a stage begins, or `error WHY` at the end of a run that
failed; the exit code is then 2. It writes nothing else, and can be killed at any time.
"""

import sys
from pathlib import Path
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
from grafu.pipeline.functionalize import Functionalized, PipelineConfig, functionalize
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import settings_from_bytes
from grafu.processes.cache import NO_CACHE, Cache
from grafu.templates.gallery import builtin_gallery
from grafu.visible import visible


def run(source: Path, settings_file: Path, folder: Path, cache: Cache = NO_CACHE) -> Functionalized:
    """Functionalizes one input as the settings say and writes what the module's docstring lists.

    What the `cache` holds of earlier runs is not computed again.

    Raises:
        FunctionalizationError: if the input or a setting is at fault.
    """
    settings = settings_from_bytes(read_own(settings_file, "settings of grafu"), settings_file)
    _say("load")
    asset = load_asset(source, settings.reading)
    asset = cache.value("asset", _itself, asset)  # the same object: what was worked out on its meshes stays
    result = functionalize(asset, settings.motion, builtin_gallery(), PipelineConfig(settings), _say, cache)
    _say("write")
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


def _say(stage: str) -> None:
    print("stage", stage, flush=True)


if __name__ == "__main__":
    try:
        run(Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]))
    except FunctionalizationError as error:
        print("error", visible(" ".join(str(error).split())), flush=True)
        sys.exit(2)
