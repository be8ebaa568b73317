"""A guessed door that is low and wide, right above a door of its width, is a drawer; look-alikes stay doors."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset
from grafu.completion.drawers_above_doors import DrawerAboveConfig, with_drawers_above_doors
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

BODY = replace(box("body", (-0.25, 0.0, 0.0), (0.25, 0.5, 0.85)), label=PartLabel.SIDE_PANEL)
LOWER = ((-0.24, -0.02, 0.1), (0.24, 0.0, 0.62))
UPPER = ((-0.24, -0.02, 0.63), (0.24, 0.0, 0.84))


def completed(upper=UPPER, lower=LOWER, *, guessed=True, handle=None, rise=0.0):
    """Returns the completion in which both fronts hang as doors, once low and wide ones above doors are drawers."""

    def raised(ends):
        return [(x, y, z + rise) for x, y, z in ends]

    fronts = [replace(box(n, *raised(e)), label=PartLabel.DOOR) for n, e in (("upper", upper), ("lower", lower))]
    tall = replace(BODY, surfaces=box("body", (-0.25, 0.0, 0.0), (0.25, 0.5, 0.85 + rise)).surfaces)
    knobs = [replace(box("knob", *handle), label=PartLabel.HANDLE)] if handle else []
    asset = Asset("made", "", "made", (tall, *fronts, *knobs))
    graph = parse_graph(asset)
    edges = [Hinge("body", "upper", 0, 1), Hinge("body", "lower", 0, 1), *(Attached("upper", "knob") for _ in knobs)]
    labels = tuple(Decision(n, "label", "door", 0.7, "drawer", 0.3) for n in ("upper", "lower")) if guessed else ()
    before = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=labels)
    return with_drawers_above_doors(before, asset).completed


@pytest.mark.parametrize("handle", [None, ((-0.02, -0.05, 0.7), (0.02, -0.02, 0.74))], ids=["no handle", "a knob"])
def test_a_low_wide_front_above_a_door_slides_out(handle):
    after = completed(handle=handle)
    assert Rail("body", "upper", 2) in after.motions
    assert [hinge.child for hinge in after.hinges] == ["lower"]


LOOK_ALIKES = {
    "what the input labels": {"guessed": False},
    "a handle at its side": {"handle": ((0.18, -0.05, 0.7), (0.22, -0.02, 0.74))},
    "a flap of a wall cabinet": {"rise": 0.9},
    "no wider than high": {
        "upper": ((-0.24, -0.02, 0.63), (-0.04, 0.0, 0.84)),
        "lower": ((-0.24, -0.02, 0.1), (-0.04, 0.0, 0.62)),
    },
    "as high as the other": {
        "upper": ((-0.24, -0.02, 0.48), (0.24, 0.0, 0.84)),
        "lower": ((-0.24, -0.02, 0.1), (0.24, 0.0, 0.47)),
    },
    "of another width": {"lower": ((-0.24, -0.02, 0.1), (0.0, 0.0, 0.62))},
    "far above": {"lower": ((-0.24, -0.02, 0.0), (0.24, 0.0, 0.5))},
    "in another plane": {"upper": ((-0.24, 0.1, 0.63), (0.24, 0.12, 0.84))},
}


@pytest.mark.parametrize("change", LOOK_ALIKES.values(), ids=LOOK_ALIKES)
def test_look_alikes_stay_doors(change):
    assert {hinge.child for hinge in completed(**change).hinges} == {"upper", "lower"}


@pytest.mark.parametrize("name", ["wide", "low", "top", "alike", "off"])
def test_a_setting_that_is_not_above_0_is_refused(name):
    with pytest.raises(ValueError, match=name):
        DrawerAboveConfig(**{name: 0.0})


def stacked(below=((-0.24, -0.02, 0.1), (0.24, 0.0, 0.46)), guessed=True, handle=None):
    """Returns the completion of a drawer of 0.48 x 0.36 m above what hangs as a door."""
    upper = replace(box("upper", (-0.24, -0.02, 0.47), (0.24, 0.0, 0.83)), label=PartLabel.DRAWER)
    knobs = [replace(box("knob", *handle), label=PartLabel.HANDLE)] if handle else []
    asset = Asset("made", "", "made", (BODY, upper, replace(box("lower", *below), label=PartLabel.DOOR), *knobs))
    graph = parse_graph(asset)
    edges = [Rail("body", "upper", 2), Hinge("body", "lower", 0, 1), *(Attached("lower", "knob") for _ in knobs)]
    labels = (Decision("lower", "label", "door", 0.99, "drawer", 0.01),) if guessed else ()
    before = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=labels)
    return with_drawers_above_doors(before, asset).completed


def test_a_front_of_the_size_of_the_drawer_right_above_it_slides_out():
    assert {rail.child for rail in stacked().rails} == {"upper", "lower"}
    held = stacked(handle=((-0.02, -0.05, 0.4), (0.02, -0.02, 0.42)))
    assert {rail.child for rail in held.rails} == {"upper", "lower"}


@pytest.mark.parametrize(
    "changed",
    [
        {"guessed": False},
        {"below": ((-0.24, -0.02, 0.02), (0.24, 0.0, 0.46))},
        {"below": ((-0.24, -0.02, 0.0), (0.24, 0.0, 0.36))},
        {"below": ((0.02, -0.02, 0.1), (0.5, 0.0, 0.46))},
        {"handle": ((0.18, -0.05, 0.3), (0.22, -0.02, 0.34))},
    ],
    ids=["the input labels it", "it is higher", "it is far below", "it is aside", "a handle at its side"],
)
def test_what_is_not_alike_stays_a_door_below_a_drawer(changed):
    assert [hinge.child for hinge in stacked(**changed).hinges] == ["lower"]


def test_a_whole_stack_slides_out_from_one_drawer_on():
    fronts = [
        replace(box(f"front_{k}", (-0.24, -0.02, z), (0.24, 0.0, z + 0.2)), label=PartLabel.DOOR)
        for k, z in enumerate((0.02, 0.23, 0.44))
    ]
    fronts.append(replace(box("front_3", (-0.24, -0.02, 0.65), (0.24, 0.0, 0.85)), label=PartLabel.DRAWER))
    asset = Asset("made", "", "made", (BODY, *fronts))
    graph = parse_graph(asset)
    edges = [*(Hinge("body", f"front_{k}", 0, 1) for k in range(3)), Rail("body", "front_3", 2)]
    labels = tuple(Decision(f"front_{k}", "label", "door", 0.9, "drawer", 0.1) for k in range(3))
    before = GraphCompletion(graph, with_edges(graph, edges), "network", decisions=labels)
    assert len(with_drawers_above_doors(before, asset).completed.rails) == 4
