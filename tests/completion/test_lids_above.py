"""A lid lies on the case that it closes: what is guessed to be a drawer below one is none."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part
from grafu.completion.static_guesses import static_guesses
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Rail
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.parse import parse_graph
from grafu.refusal import Reason
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT = 2  # -Y


def at(name: str, low, high, label: PartLabel = PartLabel.UNKNOWN) -> Part:
    return replace(box(name, low, high), label=label)


BASE = at("base", (-0.3, -0.2, 0.0), (0.3, 0.2, 0.05), PartLabel.SIDE_PANEL)
CASE = at("case", (-0.3, -0.2, 0.05), (0.3, 0.2, 0.3))
LID = at("lid", (-0.31, -0.21, 0.302), (0.31, 0.21, 0.33), PartLabel.DOOR)
SIDE = at("side", (-0.33, -0.2, 0.0), (-0.301, 0.2, 0.301), PartLabel.SIDE_PANEL)


def reasons(*parts: Part) -> list[Reason]:
    """Why `case`, which was guessed to be a drawer, stays; empty where it slides."""
    asset = Asset("made", "", "made", parts)
    graph = parse_graph(asset)
    labels = {p.id: PartLabel.MISC for p in parts if p.label is PartLabel.UNKNOWN} | {"case": PartLabel.DRAWER}
    completed = with_edges(relabelled(graph, labels), [Rail("base", "case", FRONT)])
    guess = Decision("case", "label", "drawer", 0.9, "misc", 0.1)
    completion = GraphCompletion(graph, completed, "network", decisions=(guess,), refused=())
    doors = {p.id for p in parts if p.label is PartLabel.DOOR}
    refused = tuple(r for r in completion.refused if r.part not in doors)
    return [r.reason for r in static_guesses(replace(completion, refused=refused), asset) if r.part == "case"]


@pytest.fixture(autouse=True)
def _doors_without_hinges(monkeypatch):
    """The lid has no hinge in these graphs: how it moves is no matter here."""
    monkeypatch.setattr(GraphCompletion, "_silent_parts", lambda self: [])


def test_what_a_lid_alone_lies_on_is_no_drawer():
    assert reasons(BASE, CASE, LID) == [Reason.CARRIES]


def test_a_mirror_in_the_lid_carries_nothing():
    mirror = at("mirror", (-0.2, -0.1, 0.3005), (0.2, 0.1, 0.302), PartLabel.MISC)
    assert reasons(BASE, CASE, LID, mirror) == [Reason.CARRIES]


@pytest.mark.parametrize(
    "parts",
    [
        (BASE, CASE, LID, SIDE),
        (BASE, CASE, at("flap", (-0.31, -0.21, 0.302), (-0.1, 0.21, 0.33), PartLabel.DOOR)),
        (BASE, CASE, at("door", (-0.3, -0.22, 0.05), (0.3, -0.201, 0.3), PartLabel.DOOR)),
    ],
    ids=["the side of a case carries the lid, too", "a lid over a third of it", "a door before it"],
)
def test_a_drawer_below_or_behind_others_is_one(parts):
    assert Reason.CARRIES not in reasons(*parts)
