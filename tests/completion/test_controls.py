"""Knobs of appliances are controls: they go with no drawer beside them, and miss no door."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset
from grafu.completion.controls import without_controls
from grafu.completion.rule import complete_by_rule
from grafu.graph.completion import PieceGuess
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel, PieceKind
from small_scenes import box, scene

CASE = [
    box("side", (0.0, 0.0, 0.0), (0.02, 0.6, 0.9)),
    box("other_side", (0.58, 0.0, 0.0), (0.6, 0.6, 0.9)),
    replace(box("panel", (0.2, -0.02, 0.74), (0.6, 0.0, 0.86)), label=PartLabel.FACE_FRAME),
    box("drawer_tray", (0.03, -0.02, 0.74), (0.18, 0.3, 0.86)),
]
KNOB = [
    box("handle_plate", (0.24, -0.022, 0.78), (0.28, -0.02, 0.82)),
    box("handle_knob", (0.245, -0.05, 0.785), (0.275, -0.022, 0.815)),
]
OVEN, CABINET = (PieceGuess(kind, 0.9, PieceKind.SHELF, 0.1) for kind in (PieceKind.OVEN, PieceKind.CABINET))


def called(asset: Asset, name: str, handles: str = "knob") -> Asset:
    parts = (
        replace(p, source=replace(p.source, name=handles)) if p.label is PartLabel.HANDLE else p for p in asset.parts
    )
    return replace(asset, name=name, parts=tuple(parts))


def refused(asset: Asset, piece: PieceGuess | None = None) -> set[str]:
    completion = replace(complete_by_rule(parse_graph(asset)), piece=piece)
    return {r.part for r in without_controls(completion, asset).refused}


def test_all_pieces_of_a_knob_stay_on_the_panel_that_one_of_them_touches():
    graph = complete_by_rule(parse_graph(scene(*CASE, *KNOB))).completed
    assert graph.attachments == ()
    on_tray = [box("handle_knob", (0.1, -0.05, 0.785), (0.13, -0.02, 0.815)), KNOB[0]]
    graph = complete_by_rule(parse_graph(scene(*CASE, *on_tray))).completed
    assert [(edge.parent, edge.child) for edge in graph.attachments] == [("drawer_tray", "handle_knob")]


@pytest.mark.parametrize(
    ("name", "piece", "still"),
    [
        ("stove_4", None, set()),
        ("model", OVEN, set()),
        ("model", CABINET, {"handle_plate", "handle_knob"}),
        ("model", None, {"handle_plate", "handle_knob"}),
    ],
)
def test_the_knobs_of_an_appliance_miss_no_door_and_those_of_a_cabinet_do(name, piece, still):
    assert refused(called(scene(*CASE, *KNOB), name), piece) == still


def test_a_handle_of_an_appliance_that_is_no_knob_by_its_name_misses_its_door():
    assert refused(called(scene(*CASE, *KNOB), "stove_4", "handle"), OVEN) == {"handle_plate", "handle_knob"}
