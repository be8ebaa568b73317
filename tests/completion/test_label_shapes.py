"""What boxes and contacts state about labels: panels behind smaller fronts, rods, and the bars of handles."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.completion.decode_config import DecodeConfig
from grafu.completion.label_shapes import held_by_handles, with_held, without_cases, without_overlaid, without_slim
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.graph.arrays import DOOR, DRAWER, HANDLE, LABELS
from grafu.graph.edges import Contact
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

BODY = Box(vec3(0.0, 0.02, 0.0), vec3(1.0, 0.5, 1.0))
PANEL = Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.02, 1.0))
FRONT = Box(vec3(0.05, -0.02, 0.05), vec3(0.95, 0.0, 0.6))
BESIDE = Box(vec3(0.8, -0.04, 0.7), vec3(0.82, 0.0, 0.8))
ON_FRONT = Box(vec3(0.8, -0.04, 0.4), vec3(0.82, -0.02, 0.5))


def fronts(front=FRONT, handles=(ON_FRONT,), panel=PartLabel.UNKNOWN) -> tuple[bool, bool]:
    """Returns whether the panel, and what lies on it, are still doors, after both were predicted to be some."""
    boxes = (BODY, PANEL, front, *handles)
    nodes = tuple(PartNode(str(k), panel if k == 1 else PartLabel.UNKNOWN, box) for k, box in enumerate(boxes))
    weights = np.full((len(nodes), len(LABELS)), 0.01)
    weights[0, LABELS.index(PartLabel.SIDE_PANEL)] = 0.9
    weights[1:3, DOOR], weights[1:3, DRAWER], weights[3:, HANDLE] = 0.8, 0.1, 0.9
    made = without_overlaid(weights, FunctionalGraph("g", nodes, ()), DecodeConfig())
    assert np.array_equal(made[[0, 3]], weights[[0, 3]]) if handles else True
    return made[1, DOOR] + made[1, DRAWER] > 0, made[2, DOOR] > 0


def test_a_panel_behind_a_smaller_front_is_none():
    assert fronts() == (False, True)


@pytest.mark.parametrize(
    "case",
    [
        {"handles": (BESIDE,)},
        {"handles": (BESIDE, ON_FRONT)},
        {"handles": ()},
        {"front": Box(vec3(0.01, -0.02, 0.01), vec3(0.99, 0.0, 0.99))},
        {
            "front": Box(vec3(0.4, -0.02, 0.4), vec3(0.7, 0.0, 0.6)),
            "handles": (Box(vec3(0.5, -0.04, 0.5), vec3(0.52, -0.02, 0.52)),),
        },
        {"front": Box(vec3(0.05, 0.02, 0.05), vec3(0.95, 0.04, 0.6))},
        {"front": Box(vec3(0.5, -0.02, 0.05), vec3(1.4, 0.0, 0.6))},
        {"panel": PartLabel.DOOR},
    ],
    ids=["a mirror", "both have handles", "no handle", "as large", "small", "behind it", "beside it", "by its name"],
)
def test_other_panels_stay_fronts(case):
    assert fronts(**case) == (True, True)


def test_a_drawer_below_a_narrower_one_stays_a_drawer():
    """Seen from above the upper one lies within the outline of the lower one, and so do the handles of both."""
    lower = Box(vec3(0.0, 0.0, 0.5), vec3(0.5, 0.45, 0.7))
    upper = Box(vec3(0.0, 0.0, 0.702), vec3(0.3, 0.45, 0.85))
    grips = [Box(vec3(x, -0.01, z), vec3(x + 0.06, 0.01, z + 0.02)) for x, z in ((0.22, 0.6), (0.12, 0.78))]
    nodes = tuple(PartNode(str(k), PartLabel.UNKNOWN, box) for k, box in enumerate((BODY, lower, upper, *grips)))
    weights = np.full((len(nodes), len(LABELS)), 0.01)
    weights[0, LABELS.index(PartLabel.SIDE_PANEL)], weights[1:3, DRAWER], weights[3:, HANDLE] = 0.9, 0.9, 0.9
    assert np.array_equal(without_overlaid(weights, FunctionalGraph("g", nodes, ()), DecodeConfig()), weights)


def test_it_holds_on_every_side_of_the_object():
    for turns in range(4):
        c, s = np.cos(turns * np.pi / 2), np.sin(turns * np.pi / 2)
        R = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        boxes = [Box.around(box.corners() @ R.T) for box in (BODY, PANEL, FRONT, ON_FRONT)]
        nodes = tuple(PartNode(str(k), PartLabel.UNKNOWN, box) for k, box in enumerate(boxes))
        weights = np.full((4, len(LABELS)), 0.01)
        weights[0, 0], weights[1:3, DOOR], weights[3, HANDLE] = 0.9, 0.8, 0.9
        made = without_overlaid(weights, FunctionalGraph("g", nodes, ()), DecodeConfig())
        assert made[1, DOOR] == 0.0 < made[2, DOOR]


BAR, SIDE = LABELS.index(PartLabel.BAR), LABELS.index(PartLabel.SIDE_PANEL)
GRIP = Box(vec3(0.9, -0.05, 0.3), vec3(0.92, -0.01, 0.7))  # it floats 10 mm before the panel


def held(plate=PANEL, *, grip=0.9, door=0.2, label=PartLabel.UNKNOWN, others=()):
    """Returns whether the plate before a body is surely a door or drawer; it was taken for a bar."""
    boxes = (BODY, plate, GRIP, *others)
    nodes = tuple(PartNode(str(k), label if k == 1 else PartLabel.UNKNOWN, box) for k, box in enumerate(boxes))
    weights = np.full((len(nodes), len(LABELS)), 0.001)
    weights[0, SIDE], weights[1, [BAR, DOOR]], weights[2, HANDLE], weights[3:, DOOR] = 0.9, [0.7, door], grip, 0.9
    weights[2, BAR] = 0.9 - grip
    made = with_held(weights, FunctionalGraph("g", nodes, ()), DecodeConfig())
    assert np.array_equal(np.delete(made, 1, axis=0), np.delete(weights, 1, axis=0))
    assert made[1, DOOR] == weights[1, DOOR]
    return made[1, BAR] == 0.0


def test_the_plate_that_a_handle_sits_on_is_a_front():
    assert held()


@pytest.mark.parametrize(
    "case",
    [
        {"grip": 0.5},
        {"door": 0.01},
        {"label": PartLabel.BAR},
        {"plate": Box(vec3(0.0, 0.0, 0.0), vec3(0.8, 0.02, 1.0))},
        {"plate": Box(vec3(0.0, 0.2, 0.0), vec3(1.0, 0.22, 1.0))},
        {"plate": Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.4, 1.0))},
        {"plate": Box(vec3(0.0, -0.1, 0.49), vec3(1.0, 0.5, 0.51))},
        {"others": (Box(vec3(0.05, -0.01, 0.05), vec3(0.95, 0.0, 0.9)),)},
    ],
    ids=[
        "an unsure handle",
        "improbable",
        "by its name",
        "beside it",
        "farther in",
        "thick",
        "lying",
        "a front before it",
    ],
)
def test_other_plates_stay_what_they_are(case):
    assert not held(**case)


@pytest.mark.parametrize(
    ("height", "label", "is_front"), [(0.01, "unknown", False), (0.05, "unknown", True), (0.01, "drawer", True)]
)
def test_a_rod_is_no_drawer_unless_its_name_states_it(height, label, is_front):
    rod = PartNode("rod", PartLabel(label), Box(vec3(0.1, -0.05, 0.5), vec3(0.9, -0.05 + height, 0.5 + height)))
    weights = np.full((2, len(LABELS)), 0.1)
    weights[1, DRAWER] = 0.8
    graph = FunctionalGraph("g", (PartNode("body", PartLabel.UNKNOWN, BODY), rod), ())
    assert bool(without_slim(weights, graph, DecodeConfig())[1, DRAWER] > 0) is is_front


@pytest.mark.parametrize(
    ("side", "label", "is_front"), [(0.03, "unknown", False), (0.06, "unknown", True), (0.03, "drawer", True)]
)
def test_a_button_is_no_drawer_unless_its_name_states_it(side, label, is_front):
    button = PartNode("button", PartLabel(label), Box(vec3(0.5, -0.03, 0.5), vec3(0.5 + side, 0.0, 0.5 + side)))
    weights = np.full((2, len(LABELS)), 0.1)
    graph = FunctionalGraph("g", (PartNode("body", PartLabel.UNKNOWN, BODY), button), ())
    assert bool(without_slim(weights, graph, DecodeConfig())[1, DRAWER] > 0) is is_front


def test_what_touches_handles_alone_is_a_piece_of_a_handle():
    boxes = {"front": FRONT, "post": ON_FRONT, "bar": BESIDE, "foot": BODY}
    nodes = tuple(PartNode(name, PartLabel.UNKNOWN, box) for name, box in boxes.items())
    edges = (Contact("front", "post"), Contact("post", "bar"), Contact("front", "foot"))
    graph = FunctionalGraph("g", nodes, edges)
    labels = {"front": PartLabel.DRAWER, "post": PartLabel.HANDLE, "bar": PartLabel.BAR, "foot": PartLabel.LEG}
    assert held_by_handles(graph, labels) == {"bar"}
    assert held_by_handles(graph, labels | {"post": PartLabel.BAR}) == frozenset()
    assert held_by_handles(replace(graph, edges=(Contact("front", "post"),)), labels) == frozenset()
    assert held_by_handles(replace(graph, edges=(*edges, Contact("bar", "front"))), labels) == frozenset()


CASE = Box(vec3(0.0, 0.0, 0.0), vec3(1.3, 0.42, 0.8))
LEAVES = tuple(Box(vec3(x, 0.01, 0.08), vec3(x + 0.4, 0.03, 0.78)) for x in (0.02, 0.88))
BESIDE_IT = Box(vec3(1.3, 0.0, 0.0), vec3(2.0, 0.42, 2.0))


def is_front(body, *fronts, label=PartLabel.UNKNOWN) -> bool:
    """Whether a body is still a drawer, after it and what lies in its face were predicted to be fronts."""
    nodes = tuple(
        PartNode(str(k), label if k == 1 else PartLabel.UNKNOWN, box)
        for k, box in enumerate((BESIDE_IT, body, *fronts))
    )
    weights = np.full((len(nodes), len(LABELS)), 0.01)
    weights[0, LABELS.index(PartLabel.SIDE_PANEL)] = weights[1, DRAWER] = 0.9
    weights[2:, DOOR] = 0.9
    made = without_cases(weights, FunctionalGraph("g", nodes, ()), DecodeConfig())
    assert np.array_equal(made[[0, *range(2, len(nodes))]], weights[[0, *range(2, len(nodes))]])
    return bool(made[1, DRAWER] > 0)


@pytest.mark.parametrize("turns", range(4))
def test_a_body_on_the_floor_with_two_fronts_in_its_face_is_a_case(turns):
    c, s = np.cos(turns * np.pi / 2), np.sin(turns * np.pi / 2)
    R = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    body, *leaves = (Box.around(box.corners() @ R.T) for box in (CASE, *LEAVES))
    assert not is_front(body, *leaves)


def moved(box: Box, y: float = 0.0, z: float = 0.0) -> Box:
    return Box(box.low + vec3(0.0, y, z), box.high + vec3(0.0, y, z))


@pytest.mark.parametrize(
    ("body", "fronts", "label"),
    [
        (CASE, LEAVES[:1], PartLabel.UNKNOWN),
        (moved(CASE, z=0.5), tuple(moved(leaf, z=0.5) for leaf in LEAVES), PartLabel.UNKNOWN),
        (CASE, tuple(moved(leaf, y=0.15) for leaf in LEAVES), PartLabel.UNKNOWN),
        (CASE, (LEAVES[0], Box(LEAVES[0].low + vec3(0.05, 0.0, 0.0), LEAVES[0].high)), PartLabel.UNKNOWN),
        (CASE, tuple(Box(b.low, b.low + vec3(0.2, 0.02, 0.1)) for b in LEAVES), PartLabel.UNKNOWN),
        (CASE, LEAVES, PartLabel.DRAWER),
    ],
    ids=["a drawer's own front", "above the floor", "inner drawers", "a front and its pane", "small", "by its name"],
)
def test_other_bodies_may_be_drawers(body, fronts, label):
    assert is_front(body, *fronts, label=label)
