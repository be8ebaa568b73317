"""From what a network states to a completed graph: exclusive choices, labels, added parts, refusals. No weights."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.completion.decode_config import ADDABLE, DecodeConfig
from grafu.completion.doors import hang_door
from grafu.completion.drawers import run_drawer
from grafu.completion.features import FeatureConfig, GraphFeatures, Scores
from grafu.completion.network import complete_by_network
from grafu.completion.rule_scene import RuleScene
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.graph.arrays import EDGE_CODES, LABELS
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Contact, Hinge, Rail, ends_of
from grafu.graph.edit import relabelled
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.refusal import Refusal
from grafu.vocabulary import EdgeKind, PartLabel, PieceKind
from network_answers import FREE, SURE, Answers

FEW = FeatureConfig(points=16, anchors=2, neighbours=2)
HINGE, RAIL, ATTACHED = EdgeKind.HINGE, EdgeKind.RAIL, EdgeKind.ATTACHED
LABEL_OF = {
    "left": PartLabel.SIDE_PANEL,
    "right": PartLabel.SIDE_PANEL,
    "back": PartLabel.BACK_PANEL,
    "top": PartLabel.TOP_PANEL,
    "door": PartLabel.DOOR,
    "drawer": PartLabel.DRAWER,
    "knob": PartLabel.HANDLE,
}
BOXES = {
    "left": ([0, 0, 0], [0.02, 0.5, 1]),
    "right": ([0.98, 0, 0], [1, 0.5, 1]),
    "back": ([0.02, 0.48, 0], [0.98, 0.5, 1]),
    "top": ([0.02, 0, 0.98], [0.98, 0.48, 1]),
    "door": ([0, -0.02, 0], [1, 0, 0.7]),
    "drawer": ([0.04, -0.02, 0.72], [0.96, 0.46, 0.97]),
    "knob": ([0.9, -0.05, 0.34], [0.92, -0.02, 0.36]),
}
KNOB = Box(np.array([0.49, -0.05, 0.84]), np.array([0.51, -0.02, 0.86]))
SHELF = Box(np.array([0.02, 0.0, 0.7]), np.array([0.98, 0.48, 0.72]))


def box_of(name: str) -> Box:
    low, high = BOXES[name]
    return Box(np.array(low, float), np.array(high, float))


def moved(box: Box, by: np.ndarray) -> Box:
    return Box(box.low + by, box.high + by)


def cupboard(*names: str, edges: tuple = ()) -> FunctionalGraph:
    wanted = names or tuple(BOXES)
    return FunctionalGraph("cupboard", tuple(PartNode(n, LABEL_OF[n], box_of(n)) for n in wanted), edges)


def told() -> Answers:
    return Answers(
        kinds={
            ("door", "left"): HINGE,
            ("drawer", "left"): RAIL,
            ("drawer", "right"): RAIL,
            ("knob", "door"): ATTACHED,
        },
        parents={("knob", "door"): SURE},
        mounts={("door", "left"): SURE},
        hinges={"door": (0, 0)},
        slides={"drawer": 2},
    )


ONCE = DecodeConfig(mirror=False)
"""What answers here is deaf to what it sees: it states the same of a mirror image."""


def complete(graph: FunctionalGraph, said: Answers, config: DecodeConfig = ONCE) -> GraphCompletion:
    return complete_by_network(graph, said.about(graph), FEW, config)


def test_what_is_said_is_done() -> None:
    completion = complete(cupboard(), told())

    assert completion.source == "network"
    assert set(completion.completed.edges) == {
        Hinge("left", "door", 0, 0),
        Rail("left", "drawer", 2),
        Rail("right", "drawer", 2),
        Attached("door", "knob"),
    }
    assert (completion.added, completion.refused) == ((), ())


def test_every_choice_has_its_score_and_runner_up() -> None:
    completion = complete(cupboard(), told())

    mount = completion.decision("door", "mount")
    assert (mount.choice, mount.runner_up in BOXES) == ("left", True)
    assert mount.score > 0.9 > mount.runner_up_score
    assert completion.decision("door", "border").choice == "0"
    assert completion.decision("door", "sign").choice == "0"
    assert completion.decision("drawer", "slide").choice == "2"
    assert completion.decision("knob", "parent").choice == "door"
    assert [d.choice for d in completion.decisions if d.question == "mount"] == ["left", "left", "right"]


def test_a_door_hangs_on_one_mount_though_two_edges_are_likely() -> None:
    said = told()
    said.kinds[("door", "right")] = HINGE
    said.mounts = {("door", "right"): SURE}

    assert complete(cupboard(), said).completed.hinges == (Hinge("right", "door", 0, 0),)


def test_the_edge_decides_where_the_mount_is_open() -> None:
    said = told()
    said.mounts = {}

    assert complete(cupboard(), said).completed.hinges[0].parent == "left"


def test_a_motion_is_what_the_likely_mounts_say() -> None:
    said = told()
    said.hinges = {("door", name): (3, 1) for name in ("right", "back", "top")} | {("door", "left"): (0, 0)}

    assert complete(cupboard(), said).completed.hinges == (Hinge("left", "door", 0, 0),)


def test_a_mount_agrees_with_the_border() -> None:
    said = told()
    said.kinds[("door", "top")] = HINGE
    said.kinds[("door", "right")] = HINGE
    said.mounts = {("door", name): SURE for name in ("left", "right", "top")} | {("door", "top"): SURE + 0.3}
    said.hinges = {("door", "left"): (0, 0), ("door", "right"): (0, 0), ("door", "top"): (3, 0)}
    hinge = complete(cupboard(), said).completed.hinges[0]

    assert (hinge.border, hinge.parent) in {(0, "left"), (0, "right")}


def test_a_side_is_stated_as_it_was_before_the_network_added_a_handle_itself() -> None:
    lean, names = 0.4, [name for name in BOXES if name != "knob"]
    graph = cupboard(*names)
    said = replace(told(), kinds={k: v for k, v in told().kinds.items() if "knob" not in k}, parents={})
    said.added = [[(PartLabel.HANDLE, box_of("knob"), "door")]]
    network = said.about(graph)

    def sure_of_its_own_handle(features: GraphFeatures) -> Scores:
        scores = network(features)
        is_seen = len(features.labels) > len(names)
        return scores if is_seen else replace(scores, border=np.where(scores.border > 0, lean, 0).astype(np.float32))

    completion = complete_by_network(graph, sure_of_its_own_handle, FEW, ONCE)
    border = completion.decision("door", "border")
    assert (completion.added, border.choice, border.by) == (("handle_added_1",), "0", "")
    assert border.score == pytest.approx(ratio_of(lean, 4), abs=1e-4)
    assert ratio_of(SURE, 4) > 0.9  # what it states with its handle

    fresh = replace(told(), kinds=said.kinds, parents={}, added=[[(PartLabel.HANDLE, box_of("knob"), "door")]])
    again = fresh.about(graph)

    def drops_with_its_own_handle(features: GraphFeatures) -> Scores:
        scores, is_seen = again(features), len(features.labels) > len(names)
        return replace(scores, border=scores.border[..., [2, 1, 0, 3]]) if is_seen else scores

    seen = complete_by_network(graph, drops_with_its_own_handle, FEW, ONCE).decision("door", "border")
    assert seen.choice == "0"  # the handle that it added turns no door to a border that it had ruled out
    shown = complete(cupboard(), replace(told(), added=[[(PartLabel.HANDLE, KNOB, "drawer")]]))
    assert shown.decision("door", "border").score == pytest.approx(ratio_of(SURE, 4), abs=1e-4)


def test_scores_are_the_networks_own_and_so_is_the_choice() -> None:
    graph, lean = cupboard(), 0.4
    network = replace(told(), hinges={}, slides={}).about(graph)

    def leaning(features: GraphFeatures) -> Scores:
        scores = network(features)
        border, turn, slide = scores.border.copy(), scores.sign.copy(), scores.slide.copy()
        border[:, :, 1] = lean  # a little towards the side of the knob, where no rule would pin the door,
        turn[:, :, 0] = lean  # into the case
        slide[:, :, 3] = lean  # and through the back
        return replace(scores, border=border, sign=turn, slide=slide)

    completion = complete_by_network(graph, leaning, FEW, ONCE)
    asked = [completion.decision(*which) for which in (("door", "border"), ("door", "sign"), ("drawer", "slide"))]
    assert [(d.choice, d.by) for d in asked] == [("1", ""), ("0", ""), ("3", "")]
    assert [sorted(choice for choice, _ in d.others) for d in asked[1:]] == [["1"], ["0", "1", "2", "4", "5"]]
    assert ratios_of(asked[0])["1"] == pytest.approx(ratio_of(lean, 4), abs=1e-6)
    assert ratios_of(asked[1])["0"] == pytest.approx(ratio_of(lean, 2), abs=1e-6)
    assert ratios_of(asked[2])["3"] == pytest.approx(ratio_of(lean, 6), abs=1e-6)


def ratios_of(decision: Decision) -> dict[str, float]:
    """The scores of a decision by choice."""
    return {decision.choice: decision.score, decision.runner_up: decision.runner_up_score}


def ratio_of(logit: float, codes: int) -> float:
    """The probability of the one code with this logit where all others have 0."""
    return float(np.exp(logit) / (np.exp(logit) + codes - 1))


def test_the_network_overrules_the_rules() -> None:
    said = told()
    said.hinges = {"door": (0, 1)}

    assert complete(cupboard(), said).completed.hinges == (Hinge("left", "door", 0, 1),)


def told_of_the_door() -> Answers:
    said = told()
    said.kinds = {pair: kind for pair, kind in said.kinds.items() if "drawer" not in pair}
    said.slides = {}
    return said


def wide_front(knob_at: tuple[float, float]) -> FunctionalGraph:
    """Returns a cupboard whose front is 1 m wide and 0.5 m high, its knob at a place (x, z) on it."""
    graph = cupboard("left", "right", "back", "top", "door", "knob")
    x, z = knob_at
    boxes = {
        "door": Box(np.array([0.0, -0.02, 0.48]), np.array([1.0, 0.0, 0.98])),
        "knob": Box(np.array([x - 0.05, -0.05, z - 0.01]), np.array([x + 0.05, -0.02, z + 0.01])),
    }
    bottom = PartNode("bottom", PartLabel.BOTTOM_PANEL, Box(np.array([0.02, 0.0, 0.46]), np.array([0.98, 0.48, 0.48])))
    nodes = (replace(node, box=boxes.get(node.id, node.box)) for node in graph.nodes)
    return replace(graph, nodes=(*nodes, bottom))


@pytest.mark.parametrize(
    ("knob_at", "border", "mount"),
    [((0.5, 0.93), 2, "bottom"), ((0.5, 0.53), 3, "top"), ((0.9, 0.93), 0, "left"), ((0.5, 0.75), 0, "left")],
)
def test_a_plain_flap_is_one_whatever_is_said(knob_at: tuple[float, float], border: int, mount: str) -> None:
    completion = complete(wide_front(knob_at), told_of_the_door())
    hinge = completion.completed.hinges[0]

    assert (hinge.border, hinge.parent) == (border, mount)
    assert completion.decision("door", "border").choice == str(border)
    assert completion.decision("door", "border").by == ("" if border == 0 else "rule")
    assert completion.decision("door", "sign").by == ""


def test_an_upright_door_with_its_knob_above_is_no_flap() -> None:
    graph = wide_front((0.5, 0.93))
    upright = Box(np.array([0.0, -0.02, 0.0]), np.array([1.0, 0.0, 0.98]))
    graph = replace(graph, nodes=tuple(replace(n, box=upright) if n.id == "door" else n for n in graph.nodes))

    assert complete(graph, told_of_the_door()).completed.hinges[0].border == 0


def test_an_unlikely_edge_is_taken_where_no_better_one_is() -> None:
    said = Answers(kinds={("door", "left"): {HINGE: 3.0}, ("drawer", "right"): {RAIL: 3.0}})
    completion = complete(cupboard(), said)

    assert [(h.parent, h.child) for h in completion.completed.hinges] == [("left", "door")]
    assert [(r.parent, r.child) for r in completion.completed.rails] == [("right", "drawer")]


def test_what_nothing_seen_carries_moves_as_the_rules_find() -> None:
    completion = complete(cupboard(), Answers())
    scene = RuleScene(completion.completed)
    hung, run = (rule(completion.completed.node(i), scene) for rule, i in ((hang_door, "door"), (run_drawer, "drawer")))

    assert not isinstance(hung, Refusal)
    assert not isinstance(run, Refusal)
    assert set(completion.completed.hinges) | set(completion.completed.rails) == {*hung[0], *run[0]}
    assert {d.question for d in completion.decisions if d.part == "door"} == {"border", "sign", "mount"}
    assert {d.by for d in completion.decisions if d.question != "parent"} == {"rule"}


def test_a_network_that_is_unsure_what_carries_a_door_leaves_its_side_to_the_rules() -> None:
    def side(logit: float) -> int:
        said = replace(told(), kinds={("door", "right"): {HINGE: logit}}, mounts={("door", "right"): SURE})
        return complete(cupboard(), replace(said, hinges={"door": (1, 1)})).completed.hinges[0].border

    assert (side(9.0), side(3.0)) == (1, 0)


def test_what_nothing_carries_is_refused_with_the_reason() -> None:
    graph = cupboard()
    far = Box(np.array([0.0, -9.0, 9.0]), np.array([0.4, -8.98, 9.6]))
    graph = replace(graph, nodes=tuple(replace(n, box=far) if n.label.is_movable else n for n in graph.nodes))
    completion = complete(graph, Answers())

    assert [r.part for r in completion.refused] == ["knob", "door", "drawer"]
    assert "sits on no door or drawer" in completion.refused[0].why  # the nearest is metres away
    assert all("the network sees no part that carries it" in r.why for r in completion.refused[1:])
    assert [r.why for r in complete(cupboard("door", "drawer"), told_nothing()).refused] == [
        "there is no static part that could carry it: label the static parts"
    ] * 2


def told_nothing() -> Answers:
    return Answers()


def test_rails_are_on_two_different_flanks() -> None:
    graph = cupboard()
    beside = PartNode("slat", PartLabel.BAR, Box(np.array([0.0, 0.0, 0.72]), np.array([0.03, 0.5, 0.75])))
    graph = replace(graph, nodes=(*graph.nodes, beside))
    said = told()
    said.kinds[("drawer", "slat")] = RAIL

    assert {r.parent for r in complete(graph, said).completed.rails} in ({"left", "right"}, {"slat", "right"})


def test_a_drawer_under_a_top_runs_on_it_alone() -> None:
    said = told()
    said.kinds = {("drawer", "top"): RAIL}

    assert complete(cupboard(), said).completed.rails == (Rail("top", "drawer", 2),)


def test_a_part_out_of_reach_carries_nothing() -> None:
    far = PartNode("far", PartLabel.SIDE_PANEL, Box(np.array([3.0, 0.0, 0.0]), np.array([3.02, 0.5, 1.0])))
    graph = replace(cupboard(), nodes=(*cupboard().nodes, far))
    said = told()
    said.mounts = {("door", "far"): 3 * SURE}
    said.kinds[("door", "far")] = HINGE

    assert complete(graph, said).completed.hinges[0].parent == "left"


def test_doors_that_lap_in_two_planes_slide_past_each_other() -> None:
    front = PartNode("front", PartLabel.DOOR, Box(np.array([0.0, -0.02, 0.0]), np.array([0.55, 0.0, 0.7])))
    behind = PartNode("behind", PartLabel.DOOR, Box(np.array([0.5, 0.01, 0.0]), np.array([1.0, 0.03, 0.7])))
    graph = replace(cupboard("left", "right"), nodes=(*cupboard("left", "right").nodes, front, behind))

    completion = complete(graph, Answers())

    assert completion.refused == ()
    assert {(slide.child, slide.axis) for slide in completion.completed.slides} == {("front", 1), ("behind", 0)}


def test_a_handle_of_nothing_is_decoration() -> None:
    said = told()
    said.kinds.pop(("knob", "door"))
    said.parents, said.no_parent = {}, SURE
    completion = complete(cupboard(), said)

    assert completion.completed.attachments == ()
    assert "decoration" in next(r.why for r in completion.refused if r.part == "knob")
    assert "sits on no door" in complete(cupboard("left", "knob"), Answers()).refused[0].why


@pytest.mark.parametrize(("touched", "is_attached"), [("panel", False), ("post", True)])
def test_a_knob_on_a_static_panel_moves_with_nothing(touched: str, is_attached: bool) -> None:
    """Whatever the network states; posts that are smaller than a handle are its own."""
    knob = box_of("knob")
    grown = float(knob.size.max()) * (2.0 if touched == "panel" else 0.1)
    node = PartNode(touched, PartLabel.MISC, Box(knob.center - grown, knob.center + grown))
    graph = cupboard()
    graph = replace(graph, nodes=(*graph.nodes, node), edges=(*graph.edges, Contact("knob", touched)))

    completion = complete(graph, told())

    assert bool(completion.completed.attachments) is is_attached
    assert ("knob" in {refusal.part for refusal in completion.refused}) is not is_attached


@pytest.mark.parametrize(("aside", "is_attached"), [(-0.2, True), (0.004, True), (0.03, False)])
def test_what_stands_apart_beside_a_door_is_no_handle_of_it(aside: float, is_attached: bool) -> None:
    """Whatever the network states: knobs that stand off a control panel beside the door, and touch nothing."""
    graph, knob = cupboard(), box_of("knob")
    beside = moved(knob, vec3(float(box_of("door").high[0]) + aside - float(knob.low[0]), 0.0, 0.0))
    nodes = tuple(replace(node, box=beside) if node.id == "knob" else node for node in graph.nodes)
    edges = tuple(edge for edge in graph.edges if "knob" not in ends_of(edge))

    completion = complete(replace(graph, nodes=nodes, edges=edges), told())

    assert bool(completion.completed.attachments) is is_attached
    assert ("knob" in {refusal.part for refusal in completion.refused}) is not is_attached


def test_a_grip_far_from_its_door_goes_with_the_post_that_it_touches() -> None:
    grip = PartNode("grip", PartLabel.HANDLE, moved(box_of("knob"), vec3(0.0, -0.15, 0.0)))
    post = PartNode("post", PartLabel.HANDLE, Box(vec3(0.9, -0.17, 0.34), vec3(0.92, -0.05, 0.36)))
    graph = cupboard()
    nodes = (*graph.nodes, grip, post)
    touching = replace(graph, nodes=nodes, edges=(Contact("grip", "post"), Contact("post", "knob")))

    loose = complete(replace(graph, nodes=nodes), told())
    held = complete(touching, told())

    assert {edge.child for edge in loose.completed.attachments}.isdisjoint({"grip"})
    assert Attached("door", "grip") in held.completed.attachments
    assert "grip" not in {refusal.part for refusal in held.refused}


@pytest.mark.parametrize(("behind", "is_attached"), [(0.06, False), (0.005, True)])
def test_what_lies_apart_behind_a_door_is_no_handle_of_it(behind: float, is_attached: bool) -> None:
    """Whatever the network states; a leaf of a building's door, at no side of its frame, has handles on both faces."""
    knob = box_of("knob")
    inside = moved(knob, vec3(0.0, behind - float(knob.low[1]), 0.0))
    graph = cupboard()
    nodes = tuple(replace(node, box=inside) if node.id == "knob" else node for node in graph.nodes)
    before = PartNode("before", PartLabel.MISC, Box(vec3(0.0, -0.52, 0.0), vec3(0.02, -0.5, 1.0)))

    in_case = complete(replace(graph, nodes=nodes), told())
    in_frame = complete(replace(graph, nodes=(*nodes, before)), told())

    assert bool(in_case.completed.attachments) is is_attached
    assert in_frame.completed.attachments == (Attached("door", "knob"),)


def test_unlabelled_parts_get_their_labels_and_others_keep_theirs() -> None:
    graph = relabelled(cupboard(), dict.fromkeys(("door", "knob", "back"), PartLabel.UNKNOWN))
    said = told()
    said.labels = {
        "door": PartLabel.DOOR,
        "knob": PartLabel.HANDLE,
        "back": PartLabel.BACK_PANEL,
        "left": PartLabel.LEG,
    }
    completion = complete(graph, said)

    assert {n.id: n.label for n in completion.completed.nodes} == LABEL_OF
    assert set(completion.completed.edges) == set(complete(cupboard(), told()).completed.edges)
    assert completion.decision("door", "label").score > 0.9
    assert completion.decision("left", "label") is None


def test_labels_are_settled_before_edges_and_added_parts_are_asked_about() -> None:
    graph = relabelled(cupboard(), dict.fromkeys(BOXES, PartLabel.UNKNOWN))
    said = told()
    said.labels = dict(LABEL_OF)
    said.added = [[], [(PartLabel.HANDLE, KNOB, "drawer")]]  # what is added in the pass for labels does not count
    network = said.about(graph)
    seen: list[list[PartLabel]] = []

    def changing(features: GraphFeatures) -> Scores:
        seen.append([LABELS[code] for code in features.labels])
        said.labels = dict(LABEL_OF) if len(seen) == 1 else dict.fromkeys(BOXES, PartLabel.LEG)
        return network(features)

    completion = complete_by_network(graph, changing, FEW, ONCE)

    assert [completion.completed.node(name).label for name in BOXES] == list(LABEL_OF.values())
    assert seen[1] == list(LABEL_OF.values())
    assert PartLabel.UNKNOWN not in {label for labels in seen[1:] for label in labels}
    assert completion.added == ("handle_added_1",)
    assert len(seen) == 3


def test_no_part_stays_unknown() -> None:
    graph = relabelled(cupboard(), dict.fromkeys(BOXES, PartLabel.UNKNOWN))
    said = Answers(labels={name: {PartLabel.UNKNOWN: 9.0, PartLabel.LEG: 2.0} for name in BOXES})

    assert {n.label for n in complete(graph, said).completed.nodes} == {PartLabel.LEG}


def test_an_edge_decides_between_door_and_drawer() -> None:
    graph = relabelled(cupboard(), {"drawer": PartLabel.UNKNOWN})
    said = told()
    said.labels = {"drawer": {PartLabel.DOOR: 4.0, PartLabel.DRAWER: 3.8}}

    assert complete(graph, said).completed.node("drawer").label is PartLabel.DRAWER


def test_stated_edges_are_kept_and_bind_the_labels() -> None:
    stated = (Hinge("right", "door", 1, 1), Contact("left", "top"))
    graph = relabelled(cupboard(edges=stated), {"door": PartLabel.UNKNOWN, "right": PartLabel.UNKNOWN})
    said = told()
    said.labels = {"door": PartLabel.SHELF, "right": PartLabel.HANDLE}
    completed = complete(graph, said).completed

    assert set(stated) <= set(completed.edges)
    assert completed.node("door").label is PartLabel.DOOR
    assert completed.node("right").label.is_support
    assert [h.parent for h in completed.hinges] == ["right"]


def test_a_handle_is_added_where_one_is_missing() -> None:
    said = told()
    said.added = [[(PartLabel.HANDLE, KNOB, "drawer")]]
    completion = complete(cupboard(), said)

    assert completion.added == ("handle_added_1",)
    assert Attached("drawer", "handle_added_1") in completion.completed.edges
    assert np.allclose(completion.completed.node("handle_added_1").box.low, KNOB.low, atol=1e-6)
    assert completion.decision("handle_added_1", "exists").score > 0.9
    assert Contact("drawer", "handle_added_1") not in completion.completed.edges


def test_no_second_handle_comes_to_a_door_that_has_one() -> None:
    said = told()
    said.added = [
        [(PartLabel.HANDLE, KNOB, "door"), (PartLabel.HANDLE, KNOB, "drawer"), (PartLabel.HANDLE, KNOB, "drawer")]
    ]

    assert sorted(e.parent for e in complete(cupboard(), said).completed.attachments) == ["door", "drawer"]


def test_free_slots_are_asked_until_none_fires() -> None:
    rows = 11
    drawers = [
        PartNode(f"d{k}", PartLabel.DRAWER, Box(np.array([0.0, 0.0, 0.1 * k]), np.array([1.0, 0.5, 0.1 * k + 0.09])))
        for k in range(rows)
    ]
    side = PartNode("side", PartLabel.SIDE_PANEL, Box(np.array([-0.02, 0.0, 0.0]), np.array([0.0, 0.5, 1.1])))
    graph = FunctionalGraph("tower", (side, *drawers))
    knobs = [(PartLabel.HANDLE, moved(KNOB, d.box.center - KNOB.center - vec3(0.0, 0.265, 0.0)), d.id) for d in drawers]
    said = Answers(
        kinds={(d.id, "side"): RAIL for d in drawers}, added=[knobs[k : k + FREE] for k in range(0, rows, FREE)]
    )
    completion = complete(graph, said)

    assert len(completion.added) == rows
    assert {e.parent: e.child for e in completion.completed.attachments}.keys() == {d.id for d in drawers}
    assert said.passes == 4  # three that add, and one after which none fires


def test_a_slot_that_never_rests_is_stopped() -> None:
    said = told()
    boxes = [moved(SHELF, vec3(0.0, 0.0, -0.05 * k)) for k in range(12)]
    said.added = [[(PartLabel.SHELF, box, None)] for box in boxes]

    assert len(complete(cupboard(), said, replace(ONCE, rounds=3)).added) == 3


def test_a_part_is_added_once() -> None:
    said = told()
    near = moved(SHELF, vec3(0.0, 0.0, 0.004))
    said.added = [[(PartLabel.SHELF, SHELF, None), (PartLabel.SHELF, near, None)], [(PartLabel.SHELF, SHELF, None)]]

    assert complete(cupboard(), said).added == ("shelf_added_1",)


def test_only_what_may_be_missing_is_added() -> None:
    said = told()
    said.added = [[(PartLabel.DOOR, SHELF, None), (PartLabel.SIDE_PANEL, SHELF, None), (PartLabel.DRAWER, SHELF, None)]]

    assert complete(cupboard(), said).added == ()


def test_what_is_weighed_and_not_added_is_stated() -> None:
    said = told()
    back = Box(np.array([0.02, 0.48, 0.0]), np.array([0.98, 0.5, 1.0]))
    said.added = [[(PartLabel.BACK_PANEL, back, None), (PartLabel.SIDE_PANEL, back, None)]]
    graph = cupboard(*(name for name in BOXES if name != "back"))
    network = said.about(graph)

    def doubtful(features: GraphFeatures) -> Scores:
        scores = network(features)
        return replace(scores, exists=np.minimum(scores.exists, np.float32(-2.0)))

    found = complete_by_network(graph, doubtful, FEW, ONCE)
    assert found.added == ()
    assert dict(found.weighed) == {PartLabel.BACK_PANEL: pytest.approx(1.0 / (1.0 + np.exp(2.0)))}


def test_what_is_added_touches_its_neighbours_and_carries_nothing() -> None:
    said = told()
    said.added = [[(PartLabel.DIVIDER, Box(np.array([0.02, 0, 0.7]), np.array([0.04, 0.48, 0.97])), None)]]
    said.kinds[("drawer", "left")] = {}
    said.kinds[("drawer", "right")] = {}
    completion = complete(cupboard(), said)

    assert Contact("divider_added_1", "left") in completion.completed.edges
    assert all(rail.parent in BOXES for rail in completion.completed.rails)


def test_a_graph_without_parts_is_complete() -> None:
    completion = complete(FunctionalGraph("empty", ()), Answers())

    assert (completion.completed.nodes, completion.source) == ((), "network")


def test_a_single_part_is_complete() -> None:
    assert complete(cupboard("left"), Answers()).completed == cupboard("left")
    assert [r.part for r in complete(cupboard("door"), Answers()).refused] == ["door"]


def test_the_order_of_parts_does_not_matter() -> None:
    graph = cupboard()
    turned = replace(graph, nodes=graph.nodes[::-1])

    assert set(complete(turned, told()).completed.edges) == set(complete(graph, told()).completed.edges)


def test_thresholds_are_fractions() -> None:
    with pytest.raises(ValueError, match=r"must be in 0\.\.1"):
        DecodeConfig(fires=1.5)
    with pytest.raises(ValueError, match="must not be negative"):
        DecodeConfig(rounds=-1)


corners = st.tuples(*[st.sampled_from([0.0, 0.02, 0.3, 0.5, 1.0])] * 3).map(np.array)
drawn_parts = st.tuples(st.sampled_from(list(PartLabel)), corners, corners)


@settings(max_examples=60, deadline=None)
@given(st.lists(drawn_parts, max_size=6), st.integers(0, 10_000))
def test_whatever_is_said_every_part_is_answered(drawn: list, seed: int) -> None:
    nodes = tuple(PartNode(f"p{k}", label, Box(low, low + size)) for k, (label, low, size) in enumerate(drawn))
    graph = FunctionalGraph("drawn", nodes)
    completion = complete_by_network(graph, lambda features: any_scores(features, seed), FEW, DecodeConfig(rounds=2))

    assert completion == complete_by_network(graph, lambda f: any_scores(f, seed), FEW, DecodeConfig(rounds=2))
    answered = {e.child for e in completion.completed.attachments} | {r.part for r in completion.refused}
    assert {n.id for n in completion.completed.labelled(PartLabel.HANDLE)} <= answered
    assert not completion.completed.labelled(PartLabel.UNKNOWN)
    assert {completion.completed.node(i).label for i in completion.added} <= set(ADDABLE)
    kept = {n.id: n.label for n in graph.nodes if n.label is not PartLabel.UNKNOWN}
    assert {i: completion.completed.node(i).label for i in kept} == kept


def any_scores(features: GraphFeatures, seed: int) -> Scores:
    """Scores without sense: normal logits of some size, boxes anywhere."""
    n, rng = len(features.labels), np.random.default_rng(seed)
    s = n + FREE

    def logits(*shape: int) -> np.ndarray:
        return (4 * rng.standard_normal(shape)).astype(np.float32)

    centre, half = rng.random((s, 3), np.float32), rng.random((s, 3), np.float32) - np.float32(0.2)
    kinds, labels = EDGE_CODES["all"], len(LABELS)
    return Scores(
        *(logits(s), logits(s, labels), centre, half, logits(s, s, kinds)),
        *(logits(s, s), 1.0, logits(s, s), -1.0, logits(s, s, 4), logits(s, s, 2), logits(s, s, 6)),
        *(logits(s, s), logits(s), logits(len(PieceKind))),
    )
