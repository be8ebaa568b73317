import pytest

from grafu.additions.top.step import why_no_top


@pytest.mark.parametrize("name", ["captains-bed", "sinkCabinet", "mattress_Cube.001", "lit_2", "lavello", "oven", "床"])
def test_beds_sinks_and_appliances_want_no_top(name):
    why = why_no_top(("case", name))
    assert name in why


@pytest.mark.parametrize(
    "name", ["bedsideTable2", "bedroom dresser", "bed_side_table", "desk", "Kommode", "sinker", ""]
)
def test_other_furniture_may_have_one(name):
    assert why_no_top((name, "door_1")) == ""
