"""Without names, a small front with buttons or dials beside a door is a panel; other small fronts still move."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part
from grafu.completion.control_panels import with_panels_of_controls
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Hinge
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

BODY = replace(box("body", (0.0, 0.0, 0.0), (0.5, 0.35, 0.28)), label=PartLabel.SIDE_PANEL)
DOOR = box("door", (0.0, -0.02, 0.0), (0.36, 0.0, 0.28))
PANEL = box("panel", (0.362, -0.02, 0.0), (0.5, 0.0, 0.28))
DIALS = [box(f"dial_{z}", (0.41, -0.045, z), (0.45, -0.02, z + 0.04)) for z in (0.06, 0.18)]


def buttons(z: float, count: int = 4, wide: float = 0.012) -> Part:
    """A row of buttons on the panel, one part."""
    made = [
        box("buttons", (0.38 + 0.025 * k, -0.024, z), (0.38 + 0.025 * k + wide, -0.02, z + 0.01)) for k in range(count)
    ]
    return replace(made[0], surfaces=tuple(surface for one in made for surface in one.surfaces))


def moving(*parts: Part, guessed: bool = True) -> frozenset[str]:
    """Which fronts move in the end, of those that hang on the body: all but the body, buttons and dials."""
    asset = Asset("made", "", "made", parts)
    graph = parse_graph(asset)
    fronts = [p.id for p in parts if not p.id.startswith(("body", "buttons", "dial"))]
    still = {p.id: PartLabel.MISC for p in parts if p.id not in fronts and p.label is PartLabel.UNKNOWN}
    labelled = relabelled(graph, {**dict.fromkeys(fronts, PartLabel.DOOR), **still})
    hinges = [Hinge("body", front, 0, 1) for front in fronts]
    told = tuple(Decision(front, "label", "door", 0.9, "misc", 0.1) for front in fronts) if guessed else ()
    completion = GraphCompletion(graph, with_edges(labelled, hinges), "network", decisions=told)
    return frozenset(edge.child for edge in with_panels_of_controls(completion, asset).completed.motions)


@pytest.mark.parametrize("controls", [[buttons(0.1)], DIALS], ids=["buttons", "two dials one above the other"])
def test_a_front_with_controls_beside_a_larger_door_stays(controls):
    assert moving(BODY, DOOR, PANEL, *controls) == {"door"}


LOW = box("panel", (0.0, -0.02, 0.283), (0.36, 0.0, 0.36))
KNOBS = [box(f"dial_{x}", (x, -0.045, 0.3), (x + 0.025, -0.02, 0.325)) for x in (0.08, 0.26)]


@pytest.mark.parametrize(
    "parts",
    [
        (DOOR, PANEL),
        (DOOR, PANEL, DIALS[0]),
        (DOOR, PANEL, buttons(0.1, wide=0.1, count=1)),
        (DOOR, LOW, *KNOBS),
        (DOOR, box("panel", (0.362, -0.02, 0.0), (0.7, 0.0, 0.28)), buttons(0.1)),
        (
            DOOR,
            PANEL,
            buttons(0.1),
            box("a", (0.0, -0.02, 0.3), (0.3, 0.0, 0.5)),
            box("b", (0.32, -0.02, 0.3), (0.5, 0.0, 0.5)),
        ),
    ],
    ids=["bare", "one knob", "a plate on it", "a drawer with two knobs", "as large as the door", "a chest of fronts"],
)
def test_other_small_fronts_move(parts):
    fronts = {p.id for p in parts if not p.id.startswith(("buttons", "dial"))}
    assert moving(BODY, *parts) == fronts


def test_what_a_name_tells_moves():
    asset = (BODY, *(replace(part, label=PartLabel.DOOR) for part in (DOOR, PANEL)), buttons(0.1))
    assert moving(*asset, guessed=False) == {"door", "panel"}
