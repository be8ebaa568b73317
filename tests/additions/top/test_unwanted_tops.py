import pytest
from topless import carcass

from grafu.additions.step import StepRequest
from grafu.additions.top import step
from grafu.additions.top.step import TopChoice, add_tops, why_no_top
from grafu.asset.part import Asset
from grafu.joints.plan import RealizationPlan
from grafu.pipeline.additions import planned_scene
from grafu.refusal import Reason, Refusal


@pytest.mark.parametrize("name", ["captains-bed", "sinkCabinet", "mattress_Cube.001", "lit_2", "lavello", "oven", "床"])
def test_beds_sinks_and_appliances_want_no_top(name):
    why = why_no_top(("case", name))
    assert name in why


@pytest.mark.parametrize(
    "name", ["bedsideTable2", "bedroom dresser", "bed_side_table", "desk", "Kommode", "sinker", ""]
)
def test_other_furniture_may_have_one(name):
    assert why_no_top((name, "door_1")) == ""


@pytest.mark.parametrize(
    ("refused", "is_given"),
    [((), False), ((Reason.UNLIKELY, Reason.CARRIES), False), ((Reason.UNLIKELY, Reason.BLOCKED), True)],
    ids=["nothing moves", "what was guessed to move cannot", "a door is blocked"],
)
def test_where_nothing_moves_what_is_open_above_stays_so_and_no_top_is_looked_for(refused, is_given, monkeypatch):
    looked = []
    find = step.missing_tops
    monkeypatch.setattr(step, "missing_tops", lambda *given: looked.append(given) or find(*given))
    asset = Asset("made", "", "made", tuple(carcass()))
    plan = RealizationPlan((), tuple(Refusal(asset.parts[0].id, reason) for reason in refused))
    made = add_tops(planned_scene(asset, plan), StepRequest(plan), TopChoice())
    assert (bool(made.additions), bool(made.deficiencies)) == (is_given, is_given)
    assert bool(looked) is is_given
