"""The work of a run: the tables that are asked for, of which methods, cut into tasks that know nothing of one another.

A task has a key that states what determines it. None is done here.
"""

import json
from collections.abc import Mapping, Sequence
from functools import cache
from glob import escape
from hashlib import sha256
from pathlib import Path
from typing import Final, final

from grafu.asset.options import Limits
from grafu.asset.resources import ModelFiles
from grafu.completion.session import SHIPPED_WEIGHTS
from grafu.dataclass import dataclass
from grafu.errors import AssetError, OptionError, did_you_mean
from grafu.evaluation.dataset import ModelRef, files_of_model
from grafu.evaluation.distribution import TRAINING_COUNT, TRAINING_SEED
from grafu.evaluation.llm.baselines import prompt_hash
from grafu.evaluation.methods import LEVELS, Method
from grafu.evaluation.programs.running import program_hash
from grafu.evaluation.records import ModelFacts, ResultRow
from grafu.evaluation.twins import alike_pairs
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
    ratio: float
    seed: int

    def facts(self) -> dict[str, str]:
        """Returns what determines the outcome, in words."""
        drawn = {"share": f"{self.ratio:g}", "seed": str(self.seed)}
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
    draws = [(ratio, seed) for ratio in levels for seed in range(1 if ratio in (0.0, 1.0) else seeds)]
    return tuple(MaskTask(model, method, ratio, seed) for model in models for ratio, seed in draws)


def _of_model(model: ModelRef) -> dict[str, str]:
    files = " ".join(map(_state_of, files_of_model(model)))
    return {"model": model.id, "kind": model.kind, "files": files}


def _of_method(method: Method, model: ModelRef) -> dict[str, str]:
    if method.folder is not None:
        entries = sorted(method.folder.glob(f"{escape(model.id)}*"))
        return {"method": method.spelled, "predictions": " ".join(_state_of(entry) for entry in entries)}
    if method.program is not None:
        return {"method": method.spelled, "program": program_hash(method.program)}
    if method.model is not None:
        return {"method": method.spelled, "prompt": prompt_hash(method.name, method.model)}
    weights = method.weights or SHIPPED_WEIGHTS
    return {"method": method.name, "weights": _hash_of(weights) if method.name == "network" else ""}


@cache
def _hash_of(weights: Path) -> str:
    data = weights.read_bytes() if weights.is_file() else b""
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


TABLES: Final = ("motion", "outcomes", "masking", "static", "models", "ood")
PREFERRED: Final = ("network", "rule")  # whose labels are hidden, and whose success is set against distance


@final
@dataclass(frozen=True)
class EvaluationPlan:
    """A run: the data as it was given, its models, methods and tables; which fractions of labels are hidden, how often.

    Raises:
        OptionError: if there is no model, method or table, one is given twice, or a table needs a method that is
            not there.
    """

    data: str
    models: tuple[ModelRef, ...]
    methods: tuple[Method, ...]
    tables: tuple[str, ...] = TABLES
    seeds: int = 5
    training: int = TRAINING_COUNT
    levels: tuple[float, ...] = LEVELS

    def __post_init__(self) -> None:
        named = ("models", [m.id for m in self.models]), ("methods", [m.spelled for m in self.methods])
        for name, values in (*named, ("tables", list(self.tables))):
            if not values or len(set(values)) < len(values):
                raise OptionError(f"{name} must be one or more, each once: got {', '.join(values) or 'none'}")
        unknown = [table for table in self.tables if table not in TABLES]
        if unknown:
            near = did_you_mean(unknown[0], TABLES)
            raise OptionError(f"a table must be one of {', '.join(TABLES)}: got `{unknown[0]}`{near}")
        if self.seeds < 1 or self.training < 2:
            raise OptionError(f"seeds must be 1 or more, training models 2: got {self.seeds} and {self.training}")
        if not all(0 < level <= 1 for level in self.levels) or len(set(self.levels)) < len(self.levels):
            raise OptionError(f"rates of hidden labels must be above 0, at most 100 %, each once: got {self.levels}")
        if "masking" in self.tables and not self.masked_methods:
            raise OptionError("the table `masking` needs the method network or rule: add one to --methods")

    @property
    def masked_methods(self) -> tuple[Method, ...]:
        """The methods whose labels are hidden: the network, or the rule where it is not asked for."""
        by_name = {method.name: method for method in reversed(self.methods)}
        return tuple(by_name[name] for name in PREFERRED if name in by_name)[:1]

    @property
    def ranked_method(self) -> Method:
        """The method whose success is set against the distance from the training distribution."""
        return (*self.masked_methods, *self.methods)[0]

    def first_tasks(self) -> tuple[Task, ...]:
        """Returns the tasks that need no other's outcome: models first, then methods, then hidden labels."""
        found: list[Task] = [ModelTask(model) for model in self.models]
        found += [MethodTask(model, method) for method in self.methods for model in self.models]
        if "masking" in self.tables:
            for method in self.masked_methods:
                found += mask_tasks(self.models, method, self.levels, self.seeds)
        if "ood" in self.tables:
            found += [MadeTask(TRAINING_SEED, number) for number in range(self.training)]
        return tuple(found)

    def twin_tasks(self, rows: Mapping[str, ResultRow]) -> tuple[Task, ...]:
        """Returns the pairs of models to compare, once all models were looked at: those whose fingerprints agree."""
        by_id = {model.id: model for model in self.models}
        prints: dict[str, Sequence[float]] = {}
        for model in self.models:
            row = rows.get(key_of(ModelTask(model)))
            if row is not None and isinstance(row.facts, ModelFacts) and row.facts.parts:
                prints[model.id] = row.facts.fingerprint
        return tuple(TwinTask(by_id[a], by_id[b]) for a, b in alike_pairs(prints))
