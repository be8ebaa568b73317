"""Panels on a wall are no doors; before a case, an opening or a shallow box the same plates may be."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part
from grafu.completion.static_guesses import static_guesses
from grafu.completion.wall_panels import wall_behind
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.parse import parse_graph
from grafu.refusal import Reason
from grafu.vocabulary import PartLabel
from small_scenes import box

PANEL = box("panel", (-0.45, -0.02, 0.3), (0.45, 0.0, 1.4))
WALL = box("wall", (-1.5, 0.0, 0.0), (1.5, 0.1, 2.6))
KNOB = box("handle", (0.38, -0.05, 0.8), (0.4, -0.02, 0.9))


def merged(name: str, *parts: Part) -> Part:
    return replace(parts[0], id=name, surfaces=tuple(surface for part in parts for surface in part.surfaces))


OPENING = merged(
    "wall",
    box("left", (-1.5, 0.0, 0.0), (-0.4, 0.1, 2.6)),
    box("right", (0.4, 0.0, 0.0), (1.5, 0.1, 2.6)),
    box("above", (-0.4, 0.0, 1.3), (0.4, 0.1, 2.6)),
)
LOOK_ALIKES = {
    "a solid case, as generators draw it": box("wall", (-0.5, 0.0, 0.2), (0.5, 0.4, 1.5)),
    "a shallow cabinet on a wall": box("wall", (-0.5, 0.0, 0.25), (0.5, 0.1, 1.45)),
    "an opening in a wall": OPENING,
    "a wall far behind": box("wall", (-1.5, 0.3, 0.0), (1.5, 0.4, 2.6)),
    "a mirror on it": box("wall", (-0.43, -0.023, 0.32), (0.43, -0.022, 1.38)),
}


def taken(*parts: Part) -> tuple[GraphCompletion, Asset]:
    """Returns furniture whose panel was guessed to be a door."""
    asset = Asset("made", "", "made", tuple(replace(p, label=PartLabel.UNKNOWN, labelled_by="none") for p in parts))
    graph = parse_graph(asset)
    labels = {p.id: PartLabel.HANDLE if p.id == "handle" else PartLabel.MISC for p in parts}
    edges = [Hinge("wall", "panel", 0, 1), *(Attached("panel", p.id) for p in parts if p.id == "handle")]
    completed = with_edges(relabelled(graph, labels | {"panel": PartLabel.DOOR}), edges)
    guess = Decision("panel", "label", PartLabel.DOOR, 0.97, "misc", 0.03)
    return GraphCompletion(graph, completed, "network", decisions=(guess,)), asset


def test_a_panel_on_a_wall_stays():
    (refusal,) = static_guesses(*taken(PANEL, WALL))
    assert refusal.reason is Reason.UNLIKELY
    assert "it lies on wall" in refusal.why
    assert not list(static_guesses(*taken(PANEL, WALL, KNOB)))  # a handle tells that it opens


@pytest.mark.parametrize("behind", LOOK_ALIKES)
def test_before_anything_else_it_may_be_a_door(behind):
    completion, asset = taken(PANEL, LOOK_ALIKES[behind])
    assert wall_behind(completion.completed.node("panel"), asset, completion.completed) == ""
    assert not list(static_guesses(completion, asset))
