"""Tables: the four forms say the same, figures are means over objects first, failures count, order is no matter."""

import csv
import io
import json
import random
import re
from dataclasses import replace

import pytest

from grafu.evaluation.bootstrap import Figure
from grafu.evaluation.dataset import ModelRef
from grafu.evaluation.distribution import FEATURE_NAMES
from grafu.evaluation.figures import over_objects, over_parts
from grafu.evaluation.methods import Method
from grafu.evaluation.motion_table import motion_table
from grafu.evaluation.output import build_tables, ood_table, output_files
from grafu.evaluation.records import (
    CompletenessRecord,
    EvaluatedMotion,
    EvaluatedPart,
    GraspRecord,
    HandleRecord,
    MadeFacts,
    MeasureRecord,
    MethodFacts,
    ModelFacts,
    PanelsRecord,
    ResultRow,
    TopRecord,
    TruthRecord,
    TwinFacts,
)
from grafu.evaluation.result_tables import masking_table, models_table, outcomes_table
from grafu.evaluation.results import Results, collect
from grafu.evaluation.static_table import static_table
from grafu.evaluation.table import FORMS, Column, ResultTable, csv_text, json_text, latex, markdown
from grafu.evaluation.tasks import (
    TABLES,
    EvaluationPlan,
    MadeTask,
    MaskTask,
    MethodTask,
    ModelTask,
    Task,
    TwinTask,
    key_of,
)
from grafu.vocabulary import JointType, PartLabel

LEFT = EvaluatedMotion(
    type=JointType.REVOLUTE, point=(-0.5, -0.2, 0.0), direction=(0.0, 0.0, -1.0), center=(0.0, -0.2, 0.3)
)
RIGHT = EvaluatedMotion(
    type=JointType.REVOLUTE, point=(0.5, -0.2, 0.0), direction=(0.0, 0.0, 1.0), center=(0.0, -0.2, 0.3)
)
MODELS = tuple(ModelRef(f"synth_1_{k:07d}", "made", seed=1, number=k) for k in range(3))
RULE, NETWORK = Method("rule"), Method("network")


def measure(found: EvaluatedMotion | None = LEFT, *, aligned: bool = True, collision: float = 0.0, works: bool = True):
    still = found is None
    return MeasureRecord(
        found=found,
        aligned=aligned and not still,
        collision=None if still else collision,
        touch=None if still else 1.0,
        gap=None if still else 0.001,
        opening=0.0 if still else 1.0,
        connected=not still,
        works=works and not still,
    )


def facts(count: int, category: str = "ResultTable") -> ModelFacts:
    parts = tuple(TruthRecord(part=f"door_{k}", label=PartLabel.DOOR, motion=LEFT, reference=1.5) for k in range(count))
    features = tuple(float(count + k) for k in range(len(FEATURE_NAMES)))
    return ModelFacts(category=category, parts=parts, fingerprint=(1.0,), features=features)


def made_of(*measures: MeasureRecord, plausible: bool = False) -> MethodFacts:
    parts = tuple(
        EvaluatedPart(part=f"door_{k}", raw=m, fixed=m, plausible=plausible, skipped="" if m.found else "blocked: by x")
        for k, m in enumerate(measures)
    )
    return MethodFacts(parts=parts, completeness=statics(len(measures)))


def statics(parts: int, *, opened: tuple[float, float] = (0.9, 0.0)) -> CompletenessRecord:
    """Returns the statics of a topless model that is completed; the first of its doors gets a grip, no handle."""
    names = [f"door_{k}" for k in range(parts)]
    return CompletenessRecord(
        top=TopRecord(covered=(0.2, 0.9), opened=opened, added=1),
        handles=tuple(HandleRecord(part=name, before=False, after=k > 0) for k, name in enumerate(names)),
        grasps=tuple(GraspRecord(part=name, before="none", after="recess") for name in names),
        added_handles=parts - 1,
        blocked=min(1, parts - 1),
        panels=PanelsRecord(compartments=2, filled=1, asked=5, placed=2, faulty=1, rooms=0),
    )


def row(task: Task, found=None, error: str = "") -> ResultRow:
    return ResultRow(key=key_of(task), task=task.facts(), seconds=0.0, error=error, facts=found)


def run_of_three() -> dict[Task, ResultRow]:
    """Returns one door that is right; four of which one is wrong; and a model on which the method failed."""
    wrong = measure(RIGHT, aligned=False, collision=0.5, works=False)
    found: dict[Task, ResultRow] = {}
    for model, count, category in zip(MODELS, (1, 4, 2), ("ResultTable", "Storage", "Storage"), strict=True):
        task = ModelTask(model)
        found[task] = row(task, facts(count, category))
    for method in (RULE, NETWORK):
        tasks = [MethodTask(model, method) for model in MODELS]
        found[tasks[0]] = row(tasks[0], made_of(measure()))
        found[tasks[1]] = row(tasks[1], made_of(measure(), measure(), measure(None), wrong))
        found[tasks[2]] = row(tasks[2], error="it did not work")
        for ratio, seed in ((0.5, 0), (0.5, 1), (1.0, 0)):
            for model, count in zip(MODELS, (1, 4, 2), strict=True):
                mask = MaskTask(model, method, ratio, seed)
                found[mask] = row(mask, made_of(*[measure(None if ratio == 1.0 else LEFT)] * count))
    for number in range(4):
        task = MadeTask(0, number)
        features = tuple(float(number + k) for k in range(len(FEATURE_NAMES)))
        found[task] = row(task, MadeFacts(features=features))
    return found


def results() -> Results:
    rows = run_of_three()
    return collect(rows, {r.key: r for r in rows.values()})


def written(plan: EvaluationPlan, found: Results) -> dict[str, bytes]:
    return output_files(plan, found, build_tables(plan, found), "grafu evaluate --data data")


def test_objects_come_first_and_a_failure_counts_as_standing_still() -> None:
    outcomes = results().outcomes("rule")
    aligned = over_objects(outcomes, "aligned")
    assert aligned is not None
    assert aligned.value == pytest.approx((1 + 0.5 + 0) / 3)
    by_parts = over_parts(outcomes, "aligned")
    assert by_parts is not None
    assert by_parts.value == pytest.approx(3 / 7)


def test_what_is_static_hits_nothing_but_is_not_connected() -> None:
    outcomes = results().outcomes("rule")
    collision, connected = over_objects(outcomes, "collision"), over_objects(outcomes, "connected")
    assert collision is not None
    assert connected is not None
    assert collision.value == pytest.approx((0 + 0.5 / 3) / 2)  # the failed model has no figure
    assert connected.value == pytest.approx((1 + 3 / 4 + 0) / 3)


def test_a_twin_and_the_physical_test_make_motions_reasonable() -> None:
    rows = run_of_three()
    twins = TwinTask(MODELS[0], MODELS[1])
    rows[twins] = row(twins, TwinFacts(same=True, for_first={"door_0": LEFT}, for_second={"door_3": RIGHT}))
    lent = collect(rows, {r.key: r for r in rows.values()})
    assert lent.twins == ((MODELS[0].id, MODELS[1].id),)
    aligned, with_twins = (over_objects(lent.outcomes("rule"), name) for name in ("aligned", "twins"))
    assert aligned is not None
    assert with_twins is not None
    assert with_twins.value == pytest.approx(aligned.value + 0.25 / 3)
    outcome = next(o for o in lent.outcomes("rule") if o.truth.part == "door_3" and o.model == MODELS[1].id)
    assert not outcome.aligned
    assert outcome.agrees_with_a_twin
    assert outcome.reasonable
    alone = replace(outcome, alternatives=())
    assert not alone.reasonable
    assert replace(alone, record=outcome.record.model_copy(update={"plausible": True})).reasonable


def test_the_order_of_rows_changes_no_byte() -> None:
    rows = run_of_three()
    plan = EvaluationPlan("data", MODELS, (RULE, NETWORK), TABLES, 2, 4)
    expected = written(plan, collect(rows, {r.key: r for r in rows.values()}))
    shuffled = list(rows.values())
    random.Random(4).shuffle(shuffled)
    assert written(plan, collect(rows, {r.key: r for r in shuffled})) == expected
    assert set(expected) == {"index.md", *(f"{t}.{form}" for t in TABLES for form in FORMS)}


def test_the_page_says_the_command_the_failures_and_every_table() -> None:
    plan = EvaluationPlan("data", MODELS, (RULE,), TABLES, 2, 4)
    index = written(plan, results())["index.md"].decode()
    assert "grafu evaluate --data data" in index
    assert "it did not work" in index
    assert all(f"{table}.md" in index for table in TABLES)


def test_the_worst_models_come_first() -> None:
    rows = [r for r in models_table(results()).rows if r[0] == "rule"]
    assert [r[1] for r in rows] == [MODELS[2].id, MODELS[1].id, MODELS[0].id]
    assert rows[0][-1] == "failed: it did not work"
    assert "door_2: is static (blocked: by x)" in str(rows[1][-1])
    assert "collides in 50% of the poses" in str(rows[1][-1])


def test_masking_is_steady_unless_a_higher_rate_is_better_for_sure() -> None:
    table = masking_table(results())
    names = [column.name for column in table.columns]
    ours = {r[names.index("rate")]: r for r in table.rows if r[0] == "rule"}
    assert list(ours) == [0.0, 0.5, 1.0]
    assert ours[0.5][names.index("seeds")] == 2
    assert ours[1.0][names.index("steady")] is True
    aligned = ours[0.5][names.index("aligned_fixed")]
    assert isinstance(aligned, Figure)
    assert aligned.value == 1.0
    # two of three objects got better, one stayed: the interval of the gain reaches down to 0
    assert ours[0.5][names.index("steady")] is True


def test_statics_are_counted_before_and_after() -> None:
    found = {(r[0], r[1]): r[2:] for r in static_table(results()).rows}
    of, before, after = found["rule", "topless models that are covered (coverage)"]
    assert (of, before.value, after.value) == (2, 0.0, 1.0)
    assert found["rule", "models open from above that are closed"][2].value == 1.0
    assert found["rule", "closed models that get no other top"][0] == 0
    of, before, after = found["rule", "parts with a handle"]
    assert (of, before.value, after.value) == (5, 0.0, pytest.approx(3 / 5))  # grips are no handles
    assert found["rule", "models whose every part has a handle"][2].value == 0.0
    assert found["rule", "models whose every moving body can be grasped"][2].value == 1.0
    assert found["rule", "added handles in the way of nothing"][2].value == pytest.approx(2 / 3)
    assert found["rule", "compartments that take panels"][2].value == 0.5
    assert found["rule", "panels placed of those asked for"][2].value == pytest.approx(2 / 5)
    assert found["rule", "placed panels that are sound"][2].value == 0.5
    assert found["rule", "models whose every compartment is furnished, all panels sound"][2].value == 0.0
    assert found["GraFu (the paper, PN-M)", "models whose every part has a handle"][1:] == (310 / 345, 329 / 345)


def test_a_second_top_on_what_is_closed_is_a_fault() -> None:
    rows = run_of_three()
    task = MethodTask(MODELS[0], RULE)
    again = made_of(measure()).model_copy(update={"completeness": statics(1, opened=(0.1, 0.0))})
    rows[task] = row(task, again)
    found = {(r[0], r[1]): r[2:] for r in static_table(collect(rows, {r.key: r for r in rows.values()})).rows}
    assert found["rule", "closed models that get no other top"][0] == 1
    assert found["rule", "closed models that get no other top"][2].value == 0.0
    assert found["rule", "models open from above that are closed"][0] == 1


def test_a_model_is_as_right_as_its_worst_part() -> None:
    found = {r[0]: r[1:] for r in outcomes_table(results()).rows}
    count, aligned, twins, wrong_twins, physical, wrong_physical = found["rule"]
    assert (count, aligned.value, twins.value, wrong_twins.value) == (3, *(pytest.approx(n / 3) for n in (1, 0, 2)))
    assert (physical.value, wrong_physical.value) == (0.0, pytest.approx(2 / 3))
    assert found["GraFu (the paper, PN-M)"][1:4] == (266 / 345, 62 / 345, 17 / 345)


def test_outcomes_by_twins_and_by_the_physical_test_differ() -> None:
    wrong = measure(RIGHT, aligned=False)
    rows = run_of_three()
    task = MethodTask(MODELS[1], RULE)
    rows[task] = row(task, made_of(measure(), measure(), wrong, measure(), plausible=True))
    task = MethodTask(MODELS[2], RULE)
    rows[task] = row(task, made_of(measure(), wrong))
    twins = TwinTask(MODELS[0], MODELS[2])
    rows[twins] = row(twins, TwinFacts(same=True, for_first={}, for_second={"door_1": RIGHT}))
    found = {r[0]: r[1:] for r in outcomes_table(collect(rows, {r.key: r for r in rows.values()})).rows}
    outcomes = [cell.value for cell in found["rule"][1:]]
    assert outcomes == pytest.approx([1 / 3, 1 / 3, 1 / 3, 2 / 3, 0.0])


def test_the_farthest_models_come_first_with_their_nearest() -> None:
    table = ood_table(results(), "network", top=2)
    distances = [r[3] for r in table.rows]
    assert len(distances) == 2
    assert distances == sorted(distances, reverse=True)
    assert {r[5] for r in table.rows} <= {f"synth_0_{k:07d}" for k in range(4)}


TABLE = ResultTable(
    "odd",
    "A title with 100 % & more",
    (
        Column("name", "Name_1"),
        Column("ratio", "Ratio", "ratio", "more"),
        Column("count", "Count", "count"),
        Column("sure", "Sure"),
    ),
    (
        ("a|b & c_d", Figure(0.5, 0.25, 0.75, 3), 3, True),
        ("e", 0.125, None, None),
        ("f", None, 0, False),
    ),
    ("a note",),
)


def test_the_four_forms_say_the_same() -> None:
    records = json.loads(json_text(TABLE))["rows"]
    lines = list(csv.DictReader(io.StringIO(csv_text(TABLE))))
    assert records[0] == {
        "name": "a|b & c_d",
        "ratio": {"value": 0.5, "low": 0.25, "high": 0.75, "count": 3},
        "count": 3,
        "sure": True,
    }
    assert (lines[0]["ratio"], lines[0]["ratio_low"], lines[0]["ratio_high"]) == ("0.5", "0.25", "0.75")
    assert (lines[1]["ratio"], lines[1]["ratio_low"], lines[1]["count"]) == ("0.125", "", "")
    assert [line["name"] for line in lines] == [record["name"] for record in records]
    body = [line for line in markdown(TABLE).splitlines() if line.startswith("|")]
    assert body[2] == "| a\\|b & c_d | 50.0 % [25.0 %, 75.0 %] | 3 | yes |"
    assert body[3] == "| e | 12.5 % | – | – |"
    printed = latex(TABLE)
    assert r"a|b \& c\_d & 50.0 \% {\scriptsize [25.0 \%, 75.0 \%]} & 3 & yes \\" in printed
    assert r"\caption{A title with 100 \% \& more}" in printed
    assert len(re.findall(r"\\\\$", printed, re.MULTILINE)) == 4


def test_the_papers_rows_stand_beside_ours() -> None:
    table = motion_table(results())
    names = [column.name for column in table.columns]
    rows = {(r[0], r[1]): r for r in table.rows}
    paper = rows["GT annotation (the paper)", "PN-M"]
    assert (paper[names.index("collision")], paper[names.index("collision_fixed")]) == (0.192, 0.052)
    assert ("rule", "all") in rows
    assert ("rule", "Storage") in rows


def test_a_table_is_as_wide_as_its_columns() -> None:
    with pytest.raises(ValueError, match="2 cells"):
        ResultTable("t", "t", (Column("a", "A"), Column("b", "B")), (("x",),))
    with pytest.raises(ValueError, match="different names"):
        ResultTable("t", "t", (Column("a", "A"), Column("a", "B")), ())
