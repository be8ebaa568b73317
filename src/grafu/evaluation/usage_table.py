"""What asking language models used up: requests, tokens, price, seconds, and how many replies were of no use."""

from typing import Final

from grafu.evaluation.llm.chat import Usage
from grafu.evaluation.llm.config import LlmConfig
from grafu.evaluation.methods import Method
from grafu.evaluation.results import Failure, Results
from grafu.evaluation.table import Cell, Column, ResultTable

UNKNOWN: Final = "unknown"
_MILLION: Final = 1_000_000
_COLUMNS = (
    Column("method", "Method"),
    Column("models", "Models asked about", "count"),
    Column("not_run", "Not run", "count"),
    Column("failures", "Failures", "count", "less"),
    Column("requests", "Requests", "count"),
    Column("unanswered", "Without reply", "count"),
    Column("tokens_in", "Tokens in", "count"),
    Column("tokens_out", "Tokens out", "count"),
    Column("price", "Price", "number"),
    Column("seconds", "Seconds", "number"),
)
_NOTES = (
    "A failure is a model of which nothing could be made: no reply came, or none that can be used; its parts count as "
    "static.",
    "Requests count the corrections that were asked for, and those that got no reply. Replies that were read from the "
    "folder of recorded replies count as when they were given.",
    "The price is that of the tokens at the prices that the user stated per million, in the user's currency; "
    f"`{UNKNOWN}` if none were stated, or the endpoint states no tokens.",
)


def usage_table(results: Results, methods: tuple[Method, ...]) -> ResultTable:
    """Returns a row for each method that asks a language model."""
    rows = tuple(_row(results, method) for method in methods if method.model is not None)
    return ResultTable("usage", "What asking language models used", _COLUMNS, rows, _NOTES)


def _row(results: Results, method: Method) -> tuple[Cell, ...]:
    made = results.made.get(method.spelled, {})
    failures = sum(isinstance(outcome, Failure) for outcome in made.values())
    not_run = len(results.not_run.get(method.spelled, {}))
    usage = sum(results.usage.get(method.spelled, {}).values(), Usage())
    tokens = tuple(UNKNOWN if count is None else count for count in (usage.tokens_in, usage.tokens_out))
    price = price_of(usage, method.model.config if method.model else LlmConfig())
    counts = len(made), not_run, failures, usage.requests, usage.unanswered
    return (method.spelled, *counts, *tokens, UNKNOWN if price is None else price, round(usage.seconds, 1))


def price_of(usage: Usage, config: LlmConfig) -> float | None:
    """Returns what was used up in the user's currency; None where a price or a number of tokens is unknown."""
    parts = (usage.tokens_in, config.price_in), (usage.tokens_out, config.price_out)
    known = [tokens * price / _MILLION for tokens, price in parts if tokens is not None and price is not None]
    return sum(known) if len(known) == len(parts) else None
