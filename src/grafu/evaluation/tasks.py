"""The work of a run, cut into tasks that know nothing of one another, and the key that says what determines each."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from glob import escape
from hashlib import sha256
from pathlib import Path
from typing import final

from grafu.asset.options import Limits
from grafu.asset.resources import ModelFiles
from grafu.completion.session import SHIPPED_WEIGHTS
from grafu.errors import AssetError
from grafu.evaluation.dataset import ModelRef
from grafu.evaluation.methods import Method
from grafu.version import __version__

FORM = "1"  # of a row's facts: another number makes all rows old
_SMALL = 2_000_000  # bytes: larger files are told apart by their sizes alone


@final
@dataclass(frozen=True, slots=True)
class ModelTask:
    """Look at a model: which parts count, how they truly move, what its geometry and graph are like."""

    model: ModelRef

    def facts(self) -> dict[str, str]:
        """Returns what determines the outcome, in words."""
        return {"task": "model", **_of_model(self.model)}


@final
@dataclass(frozen=True, slots=True)
class MethodTask:
    """Have a method make a model, and measure it: raw, fixed, and its statics."""

    model: ModelRef
    method: Method

    def facts(self) -> dict[str, str]:
        """Returns what determines the outcome, in words."""
        return {"task": "method", **_of_model(self.model), **_of_method(self.method, self.model)}


@final
@dataclass(frozen=True, slots=True)
class MaskTask:
    """Have a method make a model whose labels are hidden in part, and measure its joints."""

    model: ModelRef
    method: Method
    share: float
    seed: int

    def facts(self) -> dict[str, str]:
        """Returns what determines the outcome, in words."""
        drawn = {"share": f"{self.share:g}", "seed": str(self.seed)}
        return {"task": "mask", **_of_model(self.model), **_of_method(self.method, self.model), **drawn}


@final
@dataclass(frozen=True, slots=True)
class TwinTask:
    """Look whether two models are one geometry."""

    model: ModelRef
    other: ModelRef

    def facts(self) -> dict[str, str]:
        """Returns what determines the outcome, in words."""
        other = {f"other_{name}": text for name, text in _of_model(self.other).items()}
        return {"task": "twins", **_of_model(self.model), **other}


@final
@dataclass(frozen=True, slots=True)
class MadeTask:
    """Take the features of one model of our generator, for the distribution that weights are trained on."""

    seed: int
    number: int

    def facts(self) -> dict[str, str]:
        """Returns what determines the outcome, in words."""
        return {"task": "made", "seed": str(self.seed), "number": str(self.number)}


Task = ModelTask | MethodTask | MaskTask | TwinTask | MadeTask


def key_of(task: Task) -> str:
    """Returns a hash of all that determines a task's outcome; the same work has the same key in every run."""
    facts = {**task.facts(), "version": __version__, "form": FORM}
    return sha256(json.dumps(facts, sort_keys=True).encode()).hexdigest()[:24]


def mask_tasks(models: Sequence[ModelRef], method: Method, levels: Sequence[float], seeds: int) -> tuple[MaskTask, ...]:
    """Returns every level with every seed; where all labels are hidden there is nothing to draw, and one seed does."""
    draws = [(share, seed) for share in levels for seed in range(1 if share in (0.0, 1.0) else seeds)]
    return tuple(MaskTask(model, method, share, seed) for model in models for share, seed in draws)


def _of_model(model: ModelRef) -> dict[str, str]:
    return {"model": model.id, "kind": model.kind, "files": _state_of(model.path) if model.path else ""}


def _of_method(method: Method, model: ModelRef) -> dict[str, str]:
    if method.folder is not None:
        entries = sorted(method.folder.glob(f"{escape(model.id)}*"))
        return {"method": method.spelled, "predictions": " ".join(_state_of(entry) for entry in entries)}
    return {"method": method.name, "weights": _weights() if method.name == "network" else ""}


@cache
def _weights() -> str:
    data = SHIPPED_WEIGHTS.read_bytes() if SHIPPED_WEIGHTS.is_file() else b""
    return sha256(data).hexdigest()[:16]


@cache
def _state_of(path: Path) -> str:
    """Returns a hash of the names and sizes of the files at a path (and of small files' contents)."""
    files = sorted(p for p in path.rglob("*") if p.is_file()) if path.is_dir() else [path] if path.is_file() else []
    said = sha256()
    for file in files:
        size = file.stat().st_size
        said.update(f"{file.relative_to(path) if file != path else file.name}\0{size}\0".encode())
        if size <= _SMALL:
            said.update(_content(file, path))
    return said.hexdigest()[:16]


def _content(file: Path, given: Path) -> bytes:
    """Returns what a model's file holds; of one that no reader would open, nothing."""
    try:
        return ModelFiles(given, Limits(max_bytes=_SMALL)).read(file)
    except AssetError:
        return b""
