"""What the networks of an ablation get right on annotated models, kept beside each run, so that it is done once."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

from grafu.cli.train import exported
from grafu.cli.verb import complain

if TYPE_CHECKING:
    from grafu.evaluation.dataset import ModelRef
    from grafu.training.ablation import AblationResult
    from grafu.training.ablation_run import AblationRun

SCHEMA = "grafu.ablation_real/1"
WEIGHTS, FILE = "weights.onnx", "real.json"


def scored_on_real(
    data: Sequence[str], runs: "Sequence[AblationRun]", results: "Mapping[Path, AblationResult]"
) -> "dict[Path, AblationResult]":
    """Returns the results of finished runs with their figure on annotated models.

    Raises:
        FunctionalizationError: if the models cannot be found, or files cannot be read or written.
    """
    from grafu.cli.item_bar import with_progress
    from grafu.evaluation.dataset import find_all_models
    from grafu.training.ablation import REAL

    models = find_all_models(data)
    found = dict(results)
    for run in with_progress([run for run in runs if run.folder in results], len(results), "networks on real models"):
        ratio = _known(run.folder, models)
        ratio = _measured(run.folder, models) if ratio is None else ratio
        if ratio is not None:
            found[run.folder] = replace(found[run.folder], figures={**found[run.folder].figures, REAL: ratio})
    return found


def _measured(folder: Path, models: "Sequence[ModelRef]") -> float | None:
    """Returns the mean over the models of what a run's best weights get right, and keeps it; None: nothing counts."""
    from grafu.errors import AssetError
    from grafu.evaluation.weights_on_models import aligned_ratio
    from grafu.export.whole_file import whole_file, write_whole
    from grafu.training.checkpoint import load_best

    best = load_best(folder)
    with whole_file(folder / WEIGHTS) as fresh:
        fresh.write_bytes(exported(best.network(), best.config.features))
    ratios: list[float] = []
    for ref in models:
        try:
            ratio = aligned_ratio(ref, folder / WEIGHTS)
        except AssetError as error:
            complain(f"{ref.id}: {error}")
            continue
        ratios += [] if ratio is None else [ratio]
    if not ratios:
        return None
    stated = {"schema": SCHEMA, "models": _named(models), "count": len(ratios), "aligned": fmean(ratios)}
    write_whole(json.dumps(stated, indent=1) + "\n", folder / FILE)
    return fmean(ratios)


def _known(folder: Path, models: "Sequence[ModelRef]") -> float | None:
    """Returns what was measured before on the same models."""
    from grafu.asset.json_files import finite, read_own_json

    if not (folder / FILE).is_file():
        return None
    stated = read_own_json(folder / FILE, "figures of an ablation on real models")
    same = isinstance(stated, dict) and (stated.get("schema"), stated.get("models")) == (SCHEMA, _named(models))
    return finite(stated.get("aligned")) if same and isinstance(stated, dict) else None


def _named(models: "Sequence[ModelRef]") -> str:
    return sha256("\n".join(f"{ref.id} {ref.path}" for ref in models).encode()).hexdigest()[:16]
