"""The tables: means, what is best, and every figure."""

import csv
import io
import math
from dataclasses import fields

from little_runs import LITTLE

from grafu.data.asked import VARIANTS
from grafu.metrics.graph_accuracy import GraphAccuracy
from grafu.training.ablation import Experiment
from grafu.training.ablation_table import MEAN, Result, csv_table, markdown_table


def result(name: str, value: float, seed: int = 1, **others: float) -> Result:
    figures = {f"{variant}/{f.name}": value for variant in VARIANTS for f in fields(GraphAccuracy)}
    return Result(Experiment(name, f"{name} in words", LITTLE), seed, figures | {"score": value} | others)


def cells(table: str, row: int) -> list[str]:
    return [cell.strip() for cell in table.splitlines()[row].strip("|").split("|")]


def test_a_figure_is_the_mean_over_what_has_it() -> None:
    one = result("full", 0.5, **{"natural/added": math.nan, "masked/added": 0.75})
    assert one.of(MEAN)["added"] == 0.625
    assert math.isnan(one.of("natural")["added"])
    none = result("full", 0.5, **{f"{variant}/rail": math.nan for variant in VARIANTS})
    assert math.isnan(none.of(MEAN)["rail"])


def test_the_best_of_a_column_is_bold() -> None:
    table = markdown_table([result("full", 0.9), result("no_parent", 0.8)])
    heads, full, other = (dict(zip(cells(table, 0), cells(table, row), strict=True)) for row in (0, 2, 3))
    assert heads["experiment"] == "experiment"
    assert (full["experiment"], full["hinge F1"], other["hinge F1"]) == ("`full`", "**0.900**", "0.800")
    assert (full["centre ↓"], other["centre ↓"]) == ("0.900", "**0.800**")
    assert "- `no_parent`: no_parent in words" in table


def test_nothing_is_bold_where_all_are_as_good() -> None:
    assert "**" not in markdown_table([result("full", 0.9), result("no_parent", 0.9)])


def test_several_seeds_are_one_row_with_their_deviation() -> None:
    table = markdown_table([result("full", 0.9), result("no_parent", 0.5), result("full", 0.7, seed=2)])
    assert cells(table, 2)[:2] == ["`full`", "**0.800** ± 0.141"]
    assert cells(table, 3)[:2] == ["`no_parent`", "0.500"]
    assert table.count("- `full`") == 1


def test_what_nobody_has_is_left_empty() -> None:
    missing = {f"{variant}/rail": math.nan for variant in VARIANTS}
    table = markdown_table([result("full", 0.9, **missing)])
    assert dict(zip(cells(table, 0), cells(table, 2), strict=True))["rail F1"] == ""


def test_the_csv_has_every_figure_of_every_input() -> None:
    rows = list(csv.DictReader(io.StringIO(csv_table([result("full", 0.25, **{"masked/rail": math.nan})]))))
    assert [row["input"] for row in rows] == [*VARIANTS, MEAN]
    assert set(rows[0]) == {"experiment", "seed", "input", *(f.name for f in fields(GraphAccuracy))}
    assert (rows[0]["rail"], rows[1]["rail"], rows[3]["rail"]) == ("0.25", "", "0.25")


def test_nothing_gives_an_empty_table() -> None:
    assert len(markdown_table([]).splitlines()) == 3
    assert len(csv_table([]).splitlines()) == 1
