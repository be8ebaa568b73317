import os
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.part import Asset, Part, PartSource
from grafu.evaluation.statistics import Spread, StatisticsRow, compare, compare_measures, measure_folder
from grafu.evaluation.statistics_fronts import doors_of, drawers_of, lacks_top
from grafu.evaluation.statistics_measures import ModelMeasures, measure_model
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import parse_graph
from grafu.synth.generate import make_specimen
from grafu.vocabulary import PartLabel

MODELS = Path(os.environ.get("GRAFU_MODELS", Path(__file__).parents[2].parent / "shared" / "models")) / "pnm"

BOXES = {
    "left": (PartLabel.SIDE_PANEL, [-0.5, -0.3, 0.0], [-0.48, 0.3, 1.0]),
    "right": (PartLabel.SIDE_PANEL, [0.48, -0.3, 0.0], [0.5, 0.3, 1.0]),
    "bottom": (PartLabel.BOTTOM_PANEL, [-0.48, -0.3, 0.0], [0.48, 0.3, 0.02]),
    "top": (PartLabel.TOP_PANEL, [-0.48, -0.3, 0.98], [0.48, 0.3, 1.0]),
    "door": (PartLabel.DOOR, [-0.48, -0.32, 0.02], [0.48, -0.3, 0.7]),
    "drawer": (PartLabel.DRAWER, [-0.48, -0.32, 0.7], [0.48, 0.2, 0.97]),
    "knob": (PartLabel.HANDLE, [0.4, -0.36, 0.3], [0.44, -0.32, 0.4]),
}


def part(name, mesh=None):
    label, low, high = BOXES[name]
    mesh = mesh or TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))
    return Part(name, label, (Surface(mesh),), PartSource(name))


def cabinet(*left_out) -> tuple[Asset, FunctionalGraph]:
    asset = Asset("cabinet", "", "made", tuple(part(n) for n in BOXES if n not in left_out))
    edges = [Hinge("left", "door", 0, 0), Rail("left", "drawer", 2), Attached("door", "knob")]
    there = {p.id for p in asset.parts}
    return asset, with_edges(parse_graph(asset), [e for e in edges if {e.parent, e.child} <= there])


def test_a_door_is_measured_as_seen_from_in_front():
    (door,) = doors_of(cabinet()[1])
    assert (door.width, door.height, door.depth) == pytest.approx((0.96, 0.68, 0.02))
    assert door.hinge_side == "left"
    assert door.handle_place == "opposite"
    assert door.along[0] == pytest.approx(0.9 / 0.96)
    assert door.handle_ratio == pytest.approx(0.1 / 0.68)
    assert door.handle_height == pytest.approx(0.33 / 0.68)


@pytest.mark.parametrize(
    ("border", "side", "place"), [(1, "right", "same"), (2, "bottom", "centre"), (3, "top", "centre")]
)
def test_hinge_sides_are_those_that_one_sees(border, side, place):
    graph = cabinet()[1]
    (door,) = doors_of(with_edges(graph, [Hinge("left", "door", border, 0)]))
    assert (door.hinge_side, door.handle_place) == (side, place)


def test_a_drawer_runs_along_its_rails():
    (drawer,) = drawers_of(cabinet()[1])
    assert (drawer.width, drawer.height, drawer.depth) == pytest.approx((0.96, 0.27, 0.52))
    assert (drawer.handles, drawer.hinge_side, drawer.handle_ratio) == ((), None, None)


def test_a_top_is_what_covers_the_topmost_front():
    assert not lacks_top(*cabinet())
    assert lacks_top(*cabinet("top"))


def test_a_top_below_a_hutch_does_not_count_as_missing():
    asset, graph = cabinet("drawer", "knob")
    assert not lacks_top(asset, graph)
    assert lacks_top(*cabinet("drawer", "knob", "top", "bottom"))


def test_furniture_that_does_not_move_is_judged_over_its_footprint():
    assert not lacks_top(*cabinet("door", "drawer", "knob"))
    assert lacks_top(*cabinet("door", "drawer", "knob", "top"))


def test_what_does_not_apply_is_absent():
    measures = measure_model(*cabinet("drawer"))
    assert "drawer width" not in measures.values
    assert measures.values["drawers"] == 0
    assert measures.tallies["movable parts with a handle"] == (1, 1)
    assert "movable parts with a handle" not in measure_model(*cabinet("door", "drawer", "knob")).tallies


def test_nodes_that_the_asset_lacks_are_left_out():
    asset, graph = cabinet()
    topless = Asset("cabinet", "", "made", tuple(p for p in asset.parts if p.id != "top"))
    measures = measure_model(topless, graph)
    assert measures.values["parts"] == 6
    assert measures.tallies["models without a top"] == (1, 1)


def test_boards_in_line_and_apart():
    assert measure_model(*cabinet()).values["connected components"] == 1
    assert measure_model(*cabinet("bottom", "top", "drawer", "door", "knob")).values["connected components"] == 2


def test_surfaces_are_told_apart():
    box = part("left").mesh
    doubled = merge_meshes([box, TriangleMesh(box.vertices, box.faces[:, ::-1])])
    parts = (part("left"), part("right", box.with_faces(np.arange(10))), part("top", doubled))
    asset = Asset("three", "", "made", parts)
    tallies = measure_model(asset, parse_graph(asset)).tallies
    assert tallies["parts with a closed surface"] == (1, 3)
    assert tallies["parts drawn from both sides"] == (1, 3)


def model(name, **values):
    return ModelMeasures(name, values, {"yes": (int(values.get("parts", 0)) % 2, 1)})


def test_each_real_model_is_held_against_the_range():
    made = [model(str(k), parts=float(k)) for k in range(101)]
    row = compare_measures(made, [model("a", parts=50.0), model("b", parts=99.0)]).row("parts")
    assert row.synthetic == Spread(5.0, 50.0, 95.0)
    assert (row.models, row.within, row.outliers) == (2, 0.5, (("b", 99.0),))
    assert compare_measures(made, [model("b", parts=99.0)] * 3).row("parts").verdict == "outside"
    assert compare_measures(made, [model("b", parts=95.01)] * 3).row("parts").verdict == "inside"  # but for rounding


def test_a_fraction_is_held_against_groups_of_as_many():
    made = [model(str(k), parts=float(k)) for k in range(100)]
    compared = compare_measures(made, [model(str(k), parts=float(k)) for k in range(10)])
    assert compared.row("yes").verdict == "inside"
    assert compare_measures(made, [model(str(k), parts=1.0) for k in range(10)]).row("yes").verdict == "outside"


@pytest.mark.parametrize(
    ("models", "within", "verdict"),
    [
        (0, None, "no real"),
        (17, 1.0, "inside"),
        (17, 13 / 17, "plausible"),
        (17, 12 / 17, "outside"),
        (1, 0.0, "plausible"),
    ],
)
def test_verdicts_allow_for_chance(models, within, verdict):
    assert StatisticsRow("parts", False, None, None, models, within).verdict == verdict


def test_a_measure_that_only_the_real_have_is_outside():
    row = compare_measures([model("a")], [model("b", legs=4.0)]).row("legs")
    assert (row.synthetic, row.within) == (None, 0.0)


def test_nothing_to_compare_is_refused():
    with pytest.raises(ValueError, match="at least one specimen"):
        compare([])


def test_an_unreadable_model_is_named_and_left_out(tmp_path):
    (tmp_path / "broken.obj").write_text("nothing here")
    measured, unread = measure_folder(tmp_path)
    assert measured == ()
    assert unread[0].startswith("broken.obj: ")


def test_made_furniture_without_real_has_a_table():
    compared = compare(make_specimen(3, k, 0) for k in range(6))
    text = compared.markdown()
    assert text.startswith("6 synthetic models, 0 real ones")
    assert "| parts |" in text
    assert {row.verdict for row in compared.rows} == {"no real"}
    assert compared.failing == ()


@pytest.mark.skipif(not MODELS.is_dir(), reason="the real furniture is not here")
def test_real_tops_are_seen_as_they_are():
    measured, unread = measure_folder(MODELS)
    topless = {m.name for m in measured if m.tallies["models without a top"][0]}
    assert unread == ()
    known = {"41003", "41085", "44781", "45001", "45463", "45940", "46896", "20411"}  # three of eight have a top
    assert topless & known == {"44781", "45001", "45463", "45940"}
