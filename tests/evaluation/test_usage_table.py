"""What language models used up, as a table: sums over models, prices where they are known."""

from pathlib import Path

import pytest

from grafu.evaluation.dataset import ModelRef
from grafu.evaluation.llm.chat import Usage
from grafu.evaluation.llm.config import LanguageModel, LlmConfig
from grafu.evaluation.methods import Method
from grafu.evaluation.motion_table import motion_table
from grafu.evaluation.output import build_tables
from grafu.evaluation.records import MethodFacts, ModelFacts, ResultRow, UsageRecord, done
from grafu.evaluation.results import collect
from grafu.evaluation.table import ResultTable
from grafu.evaluation.tasks import EvaluationPlan, MethodTask, ModelTask, key_of
from grafu.evaluation.usage_table import price_of, usage_table

MODELS = tuple(ModelRef(f"made_{k}", "made", seed=1, number=k) for k in range(3))


PRICED = LlmConfig(price_in=2.0, price_out=10.0)


def method(config: LlmConfig = PRICED) -> Method:
    return Method("llm", model=LanguageModel("m", config, Path("replies")))


def table_of(one: Method, *rows: dict[str, object]) -> ResultTable:
    tasks = [MethodTask(model, one) for model in MODELS]
    told = {
        key_of(task): ResultRow.model_validate({"key": key_of(task), "task": task.facts(), "seconds": 0.1, **row})
        for task, row in zip(tasks, rows, strict=True)
    }
    return usage_table(collect(tasks, told), (one,))


def used(requests: int, unanswered: int = 0, tokens: int | None = 1000) -> dict[str, object]:
    return {"usage": UsageRecord.of(Usage(requests, unanswered, tokens, tokens, 1.25))}


GOOD = {"facts": MethodFacts(parts=())}


def test_a_row_counts_models_failures_requests_and_their_price() -> None:
    found = table_of(method(), GOOD | used(1), {"error": "a bad reply"} | used(3, 1), {"not_run": "no endpoint"})
    assert found.rows == (("llm:m", 2, 1, 1, 4, 1, 2000, 2000, pytest.approx(0.024), 2.5),)


def test_what_is_not_stated_is_unknown() -> None:
    (row,) = table_of(method(), GOOD | used(1), GOOD | used(1, tokens=None), GOOD | used(1)).rows
    assert row[6:9] == ("unknown", "unknown", "unknown")
    (row,) = table_of(method(LlmConfig()), *3 * [GOOD | used(1)]).rows
    assert row[6:9] == (3000, 3000, "unknown")
    assert price_of(Usage(1, 0, 10, 10), LlmConfig(price_in=1.0)) is None


def test_the_table_is_written_where_a_language_model_is_asked_alone() -> None:
    for methods, names in (((method(),), ["models", "usage"]), ((Method("rule"),), ["models"])):
        plan = EvaluationPlan("synth:1:3", MODELS, methods, ("models",))
        assert [table.name for table in build_tables(plan, collect((), {}))] == names


def test_a_model_that_was_not_run_counts_in_no_figure() -> None:
    one = method()
    tasks = [*map(ModelTask, MODELS), *(MethodTask(model, one) for model in MODELS)]
    facts = ModelFacts(category="c", parts=(), fingerprint=(), features=())
    found = [{"facts": facts}] * 3 + [GOOD, {"not_run": "first reason"}, {"not_run": "second reason"}]
    rows = {
        key_of(task): ResultRow.model_validate({"key": key_of(task), "task": task.facts(), "seconds": 0.1, **row})
        for task, row in zip(tasks, found, strict=True)
    }
    results = collect(tasks, rows)
    assert list(results.made["llm:m"]) == ["made_0"]
    assert not results.failures
    own = [row[1:4] for row in motion_table(results).rows if row[0] == "llm:m"]
    assert own == [("not run: first reason", "objects", 1), ("not run: second reason", "objects", 1)]
    assert not done(rows, key_of(tasks[-1]))
    assert done(rows, key_of(tasks[-3]))
