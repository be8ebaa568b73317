"""What a run has to do: which tables are asked for, of which methods, and the tasks that they need. It does none."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, final

from grafu.errors import OptionError
from grafu.evaluation.dataset import ModelRef
from grafu.evaluation.distribution import TRAINING_COUNT, TRAINING_SEED
from grafu.evaluation.methods import LEVELS, Method
from grafu.evaluation.records import ModelFacts, Row
from grafu.evaluation.tasks import MadeTask, MethodTask, ModelTask, Task, TwinTask, key_of, mask_tasks
from grafu.evaluation.twins import alike_pairs

TABLES: Final = ("motion", "masking", "static", "models", "ood")
PREFERRED: Final = ("network", "rule")  # whose labels are hidden, and whose success is set against distance


@final
@dataclass(frozen=True)
class EvaluationPlan:
    """A run: the data as it was given, its models, methods and tables, and how many seeds labels are hidden with.

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

    def __post_init__(self) -> None:
        named = ("models", [m.id for m in self.models]), ("methods", [m.spelled for m in self.methods])
        for name, values in (*named, ("tables", list(self.tables))):
            if not values or len(set(values)) < len(values):
                raise OptionError(f"{name} must be one or more, each once: got {', '.join(values) or 'none'}")
        unknown = [table for table in self.tables if table not in TABLES]
        if unknown:
            raise OptionError(f"a table must be one of {', '.join(TABLES)}: got `{unknown[0]}`")
        if self.seeds < 1 or self.training < 2:
            raise OptionError(f"seeds must be 1 or more, training models 2: got {self.seeds} and {self.training}")
        if "masking" in self.tables and not self.masked_methods:
            raise OptionError("the table `masking` needs the method network or rule: add one to --methods")

    @property
    def masked_methods(self) -> tuple[Method, ...]:
        """The methods whose labels are hidden: the network, or the rule where it is not asked for."""
        by_name = {method.name: method for method in self.methods}
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
                found += mask_tasks(self.models, method, LEVELS, self.seeds)
        if "ood" in self.tables:
            found += [MadeTask(TRAINING_SEED, number) for number in range(self.training)]
        return tuple(found)

    def twin_tasks(self, rows: Mapping[str, Row]) -> tuple[Task, ...]:
        """Returns the pairs of models to compare, once all models were looked at: those whose fingerprints agree."""
        by_id = {model.id: model for model in self.models}
        prints: dict[str, Sequence[float]] = {}
        for model in self.models:
            row = rows.get(key_of(ModelTask(model)))
            if row is not None and isinstance(row.facts, ModelFacts) and row.facts.parts:
                prints[model.id] = row.facts.fingerprint
        return tuple(TwinTask(by_id[a], by_id[b]) for a, b in alike_pairs(prints))
