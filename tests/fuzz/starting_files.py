"""Files of every other kind that is read: predictions, settings, templates, graphs, releases, shards, results."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fuzz.starting_models import MODELS, Maker, grouped_text, plain_obj
from small_assets import write_urdf


def _asset() -> Any:
    from predictions import cabinet

    return cabinet()


def _beside_cabinet(write: Callable[[Path], None]) -> Maker:
    """Returns a maker of a prediction in `pred/` beside the model that it is about."""

    def make(folder: Path) -> str:
        (folder / "cabinet.obj").write_text(grouped_text((part.id, part.mesh) for part in _asset().parts))
        (folder / "pred").mkdir()
        write(folder / "pred")
        return "pred"

    return make


def _singapo(folder: Path) -> None:
    from grafu.export.files import write_files
    from grafu.export.singapo import export_singapo
    from grafu.synth.truth.clashes import articulated_of

    write_files(export_singapo(articulated_of(_asset())), folder, overwrite=True)


def _particulate(folder: Path) -> None:
    from grafu.export.files import write_files
    from grafu.export.particulate import export_particulate
    from grafu.synth.truth.clashes import articulated_of

    write_files(export_particulate(articulated_of(_asset())), folder, overwrite=True)


def _official(folder: Path) -> None:
    from grafu.graph.official_json import functional_to_official, input_to_official
    from grafu.graph.parse import parse_graph
    from grafu.pipeline.complete import complete_by_annotation

    asset = _asset()
    stated = functional_to_official(complete_by_annotation(asset, parse_graph(asset)).completed)
    nodes = {key: {**node, "slot": slot} for slot, (key, node) in enumerate(stated["nodes"].items())}
    (folder / "m_pred.json").write_text(json.dumps({**stated, "nodes": nodes}))
    (folder / "m_input.json").write_text(json.dumps(input_to_official(parse_graph(asset))))


def _robot(folder: Path) -> None:
    write_urdf(folder)


def settings(folder: Path) -> str:
    from grafu.additions.handle.config import HandleChoice
    from grafu.pipeline.settings import Settings
    from grafu.vocabulary import PartLabel

    plain_obj(folder)
    stated = Settings().with_label("shelf_6", PartLabel.SHELF).with_front("drawer_front_9", HandleChoice())
    (folder / "settings.json").write_text(json.dumps(stated.to_json()))
    return "settings.json"


def templates(folder: Path) -> str:
    from grafu.templates.gallery import builtin_gallery
    from grafu.templates.handles import HANDLES
    from own_templates import write, write_handle

    plain_obj(folder)
    own, gallery = folder / "own", builtin_gallery()
    own.mkdir()
    write_handle(own, HANDLES[0], "glb", "knob")
    for index, (model, suffix) in enumerate(
        ((gallery.hinges[0], "obj"), (gallery.hinges[-1], "one.glb"), (gallery.rails[-1], "stl"))
    ):
        write(own, model, suffix).rename(own / f"mine_{index}")
    return "own"


def graph(folder: Path) -> str:
    from grafu.graph.parse import parse_graph
    from grafu.graph.serialize import completion_to_json, dump_json
    from grafu.pipeline.complete import complete_by_annotation

    asset = _asset()
    text = dump_json(completion_to_json(complete_by_annotation(asset, parse_graph(asset))))
    (folder / "graph.json").write_text(text)
    return "graph.json"


def release(folder: Path) -> str:
    from grafu.data.furfun.write import furfun_files, split_files
    from grafu.synth.generate import make_specimen

    specimen = make_specimen(11, 0, points=8)
    contents = {**furfun_files(specimen).contents, **split_files([specimen.id]).contents}
    for name, data in contents.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    return "."


def shards(folder: Path) -> str:
    from grafu.data.pair import record_of
    from grafu.data.shards import write_shard
    from grafu.synth.generate import make_specimen

    write_shard([record_of(make_specimen(11, index, points=8)) for index in range(2)], folder / "shard_000000.npz")
    return "."


def result(folder: Path) -> str:
    """A folder that the command wrote itself, to be read back."""
    from grafu.cli.job import Job, JobOptions, Succeeded, run_job

    source = folder / plain_obj(folder)
    made = run_job(Job(source, "result", JobOptions(folder, page=False)))
    assert isinstance(made, Succeeded), made
    report = folder / "result" / "report.json"
    stated = json.loads(report.read_text())
    stated["input"]["path"], stated["timings"] = "cabinet.obj", dict.fromkeys(stated["timings"], 0.1)
    report.write_text(json.dumps(stated))  # the same in each run
    return "result"


def result_set(folder: Path) -> str:
    """A set of one result in folders: each of its files, and the result in it, is read again."""
    from grafu.dataset.splits import SplitRatio
    from grafu.dataset.write import ResultSetPlan, write_result_set

    made = folder / result(folder)
    out = folder / "set"
    plan = ResultSetPlan(format="folder", ratio=SplitRatio((100.0, 0.0, 0.0)))
    assert all(outcome.row for outcome in write_result_set([made], out, plan))
    shutil.rmtree(made)
    (out / "index.parquet").unlink()  # it states no content that is read
    return "set"


OTHERS: dict[str, Maker] = {
    "prediction of singapo": _beside_cabinet(_singapo),
    "prediction of particulate": _beside_cabinet(_particulate),
    "prediction of graphs": _beside_cabinet(_official),
    "prediction as urdf": _beside_cabinet(_robot),
    "settings": settings,
    "templates": templates,
    "graph": graph,
    "release": release,
    "shards": shards,
    "result": result,
    "set of results": result_set,
}

STARTS: dict[str, Maker] = {**MODELS, **OTHERS}
