"""Our graph JSON round trips exactly, the authors' up to a micrometre, and both refuse nonsense in one line."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.errors import GraphError
from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS, Attached, Contact, Hinge, Rail
from grafu.graph.edit import as_contacts
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.json_values import read_vector
from grafu.graph.official_json import (
    functional_to_official,
    graph_from_official,
    input_to_official,
    prediction_from_official,
)
from grafu.graph.serialize import completion_from_json, completion_to_json, dump_json, graph_from_json, graph_to_json
from grafu.graph.serialize import load_json as load
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

numbers = st.floats(-3, 3, allow_nan=False)
points = st.one_of(st.none(), st.lists(st.tuples(numbers, numbers, numbers), min_size=1, max_size=3))


def box(x: float, size: tuple[float, float, float] = (0.3, 0.02, 0.5)) -> Box:
    return Box.from_center(np.array([x, 0.1, 0.7]), np.array(size) / 2)


def graph(border=0, sign=0, axis=2, x=0.1, cloud=None, word="side panel", clear=0.0) -> FunctionalGraph:
    nodes = (
        PartNode("zz side", PartLabel.SIDE_PANEL, box(x, (0.02, 0.4, 0.9)), source_name=word, transparent=clear),
        PartNode("door", PartLabel.DOOR, box(x + 0.2), None if cloud is None else PointCloud(np.array(cloud))),
        PartNode("drawer", PartLabel.DRAWER, box(x + 0.5, (0.3, 0.4, 0.2))),
        PartNode("knob", PartLabel.HANDLE, box(x + 0.3, (0.02, 0.02, 0.02))),
    )
    edges = (
        Hinge("zz side", "door", border, sign),
        Rail("zz side", "drawer", axis),
        Attached("door", "knob"),
        Contact("door", "drawer"),
    )
    return FunctionalGraph("кабинет/1", nodes, edges)


codes = (st.sampled_from(BORDERS), st.sampled_from(SIGNS), st.sampled_from(SIGNED_AXES))


@given(*codes, numbers, points, st.text(), st.floats(0.0, 1.0))
def test_our_form_round_trips_exactly(border, sign, axis, x, cloud, word, clear):
    written = graph(border, sign, axis, x, cloud, word, clear)
    assert graph_from_json(load(dump_json(graph_to_json(written)))) == written


def test_a_completion_round_trips_exactly():
    full = graph()
    decisions = (Decision("door", "mount", "zz side", 1 / 3, "drawer", 0.1, "rule"),)
    refused, weighed = (Refusal("knob", Reason.NO_MOTION, "why not"),), ((PartLabel.BACK_PANEL, 1 / 7),)
    completion = GraphCompletion(as_contacts(full), full, "rule", (), decisions, refused, weighed=weighed)
    text = dump_json(completion_to_json(completion))
    assert completion_from_json(load(text)) == completion
    assert graph_from_json(load(text)) == full


@pytest.mark.parametrize(
    ("weighed", "message"),
    [
        ({"sofa": 0.5}, "must name part categories: 'sofa'"),
        ({"back panel": "much"}, "`back panel` of `weighed`"),
        ({"back panel": 1.5}, "must be in 0..1"),
        ([0.5], "`weighed` must be a JSON object"),
    ],
)
def test_what_was_weighed_is_refused_if_wrong(weighed, message):
    data = completion_to_json(GraphCompletion(as_contacts(graph()), graph(), "rule"))
    data["completion"]["weighed"] = weighed
    with pytest.raises(GraphError, match=message):
        completion_from_json(data)


def test_our_form_is_a_superset_of_the_authors():
    ours, theirs = graph_to_json(graph()), functional_to_official(graph())
    assert set(theirs) <= set(ours)
    assert set(theirs["nodes"]["drawer"]) <= set(ours["nodes"]["drawer"])
    assert set(theirs["edges"][0]) <= set(ours["edges"][0])
    reread = graph_from_official(ours).graph
    assert [(n.id, n.label) for n in reread.nodes] == [(n.id, n.label) for n in graph().nodes]
    assert set(reread.edges) == set(graph().edges)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"schema": "grafu.graph/2"}, "schema `grafu.graph/1`"),
        ({"nodes": 3}, "`nodes` must be a JSON object"),
        ({"edges": {}}, "`edges` of the graph must be a list"),
        ({"model_id": 3}, "`model_id` of the graph must be a string"),
        ({"edges": [{"src": "door", "dst": "knob", "kind": "glue"}]}, "kind of an edge"),
        ({"edges": [{"src": "zz side", "dst": "door", "kind": "hinge"}]}, "must state `hinge_border_4`"),
        ({"edges": [{"src": "zz side", "dst": "drawer", "kind": "rail", "rail_axis_signed": 9}]}, "0..5"),
    ],
)
def test_our_form_refuses(change, message):
    with pytest.raises(GraphError, match=message):
        graph_from_json(graph_to_json(graph()) | change)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"label": "sofa"}, "label of node `door`"),
        ({"box": None}, "`box` of node `door`"),
        ({"box": {"low": [0, 0, 0], "high": [1, 1, "x"]}}, "`high` of the box of node `door`"),
        ({"box": {"low": [1, 0, 0], "high": [0, 1, 1]}}, "`high` at least `low`"),
        ({"points": [[1, 2]]}, "`points` of node `door`"),
    ],
)
def test_our_form_refuses_a_wrong_node(change, message):
    data = graph_to_json(graph())
    data["nodes"]["door"] |= change
    with pytest.raises(GraphError, match=message):
        graph_from_json(data)


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000, '{"a": ' + "9" * 5000 + "}"])
def test_text_that_python_cannot_read_is_refused_in_one_line(text):
    with pytest.raises(GraphError, match="usual depth") as caught:
        load(text)
    assert "\n" not in str(caught.value)


def test_numbers_beyond_all_are_refused():
    with pytest.raises(GraphError, match="finite numbers"):
        read_vector({"a": [10**400, 0, 0]}, "a", "it", (3,))


def test_text_that_is_not_json_is_refused():
    with pytest.raises(GraphError, match=r"must be JSON.*line 1"):
        load("{")
    with pytest.raises(GraphError, match="must be a JSON object"):
        load("[]")


@given(st.sampled_from(BORDERS), st.sampled_from(SIGNS), st.sampled_from(SIGNED_AXES), numbers)
def test_the_authors_functional_graph_round_trips(border, sign, axis, x):
    written = graph(border, sign, axis, x)
    reading = graph_from_official(json.loads(json.dumps(functional_to_official(written))))
    assert reading.notes == ()
    assert set(reading.graph.edges) == set(written.edges)
    assert [n.label for n in reading.graph.nodes] == [n.label for n in written.nodes]
    assert all(np.allclose(a.box.low, b.box.low, atol=2e-6) for a, b in zip(reading.graph.nodes, written.nodes))  # noqa: B905


def test_the_authors_input_graph_round_trips():
    written = as_contacts(graph())
    data = input_to_official(written)
    assert data["edges"][3] == {"src": "door", "dst": "drawer", "kind": "contact", "connector": None}
    assert data["edges"][0]["src"] == "zz side"  # the slot's order, not the alphabet's
    assert graph_from_official(data).graph.edges == written.edges


def test_an_input_graph_states_kinds_without_motion():
    reading = graph_from_official(input_to_official(graph()))
    assert reading.graph.attachments == (Attached("door", "knob"),)
    assert len(reading.notes) == 2  # the hinge's and the rail's motion


def test_a_countertop_stays_one():
    data = input_to_official(graph())
    data["nodes"]["zz side"]["material"] = "Countertop.001"
    reading = graph_from_official(data).graph
    assert reading.node("zz side").label is PartLabel.TOP_PANEL
    assert input_to_official(reading)["nodes"]["zz side"]["material"] == "countertop"


@pytest.mark.parametrize(
    ("word", "label"),
    [
        ("side_panel.003", PartLabel.SIDE_PANEL),
        ("Door", PartLabel.DOOR),
        ("rail", PartLabel.UNKNOWN),
        ("lamp", "unknown"),
    ],
)
def test_the_authors_words_are_normalised(word, label):
    data = {"model_id": "m", "nodes": {"a": {"material": word, "obb": {"center": [0, 0, 0], "half": [1, 1, 1]}}}}
    assert graph_from_official(data).graph.nodes[0].label == label


def test_a_turned_box_becomes_the_box_around_it():
    obb = {"center": [1, 0, 0], "half": [0.3, 0.1, 0.2], "quat": [np.sqrt(0.5), 0, 0, np.sqrt(0.5)]}
    found = graph_from_official({"model_id": "m", "nodes": {"a": {"material": "leg", "obb": obb}}}).graph.nodes[0].box
    assert np.allclose(found.half, [0.1, 0.3, 0.2])


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({"hinge_border": 1, "hinge_axis_signed": 5}, Hinge("zz side", "door", 1, 1)),
        ({"hinge_face_dst": 0, "hinge_axis": 2, "hinge_direction": 1}, Hinge("zz side", "door", 0, 0)),
        ({"hinge_border_4": -1, "hinge_axis_sign": None}, Contact("door", "zz side")),
        ({"hinge_border": 2, "hinge_axis_signed": 5}, Contact("door", "zz side")),
    ],
)
def test_older_motion_labels_are_read(fields, expected):
    data = input_to_official(graph())
    data["edges"] = [{"src": "zz side", "dst": "door", "kind": "hinge", **fields}]
    assert graph_from_official(data).graph.edges == (expected,)


def test_the_direction_is_found_from_the_labels_and_doubles_give_way():
    data = functional_to_official(graph())
    turned = [e | {"src": e["dst"], "dst": e["src"]} for e in data["edges"]]
    doubles = [e | {"kind": "contact"} for e in data["edges"]]
    reading = graph_from_official(data | {"edges": doubles + turned + [{"src": "door", "dst": "lamp"}]})
    assert set(reading.graph.edges) == set(graph().edges)
    assert len(reading.notes) == 1  # the dangling edge


def test_a_contradiction_gives_way_to_what_came_first():
    data = functional_to_official(graph())
    data["nodes"]["leg"] = {"material": "leg", "obb": {"center": [0, 0, 0], "half": [1, 1, 1]}}
    data["edges"].append({"src": "leg", "dst": "drawer", "kind": "rail", "rail_axis_signed": 3})
    reading = graph_from_official(data)
    assert Contact("drawer", "leg") in reading.graph.edges
    assert "contradicts" in reading.notes[0]


def test_every_motion_key_of_the_authors_is_written_on_request():
    hinge, rail, attached, contact = functional_to_official(graph(border=1, sign=1), older_labels=True)["edges"]
    assert hinge == {
        "src": "zz side",
        "dst": "door",
        "kind": "hinge",
        "connector": None,
        "hinge_border_4": 1,
        "hinge_axis_sign": 1,
        "hinge_border": 1,
        "hinge_axis_signed": 5,
        "hinge_axis": 2,
        "hinge_direction": 0,
        "hinge_face_src": 1,
        "hinge_face_dst": 0,
    }
    assert (rail["rail_axis_signed"], rail["rail_axis"]) == (2, 1)
    assert set(attached) == set(contact) == {"src", "dst", "kind", "connector"}


def test_nodes_may_be_a_list():
    data = functional_to_official(graph())
    listed = graph_from_official(data | {"nodes": list(data["nodes"].values())})
    assert listed == graph_from_official(data)


def test_a_door_says_where_its_handle_sits():
    nodes = functional_to_official(graph())["nodes"]
    assert nodes["door"]["handle_border"] == 1
    assert "handle_border" not in nodes["drawer"]


def predicted() -> dict:
    obb = {"center": [9, 9, 9], "half": [1, 1, 1], "quat": [1, 0, 0, 0]}
    words = ["side panel", "door", "drawer", "handle", "handle"]
    nodes = {f"slot{k:02d}_{w}": {"slot": k, "material": w, "obb": obb} for k, w in enumerate(words)}
    ids = list(nodes)
    hinge = {"src": ids[0], "dst": ids[1], "kind": "hinge", "hinge_border_4": 1, "hinge_axis_sign": 1}
    return {"model_id": "m", "nodes": nodes, "edges": [hinge, {"src": ids[2], "dst": ids[4], "kind": "attached"}]}


def test_a_prediction_is_anchored_to_its_input():
    given_graph = as_contacts(graph())
    completion = prediction_from_official(predicted(), given_graph)
    assert completion.added == ("slot04_handle",)
    assert completion.completed.node("door").box == given_graph.node("door").box
    assert completion.completed.hinges == (Hinge("zz side", "door", 1, 1),)
    assert completion.completed.attachments == (Attached("drawer", "slot04_handle"),)
    assert completion.refused == (Refusal("drawer", Reason.NO_MOTION, "the prediction states no motion"),)


def test_a_prediction_refuses_a_slot_used_twice_or_missing():
    data = predicted()
    data["nodes"]["slot04_handle"]["slot"] = 3
    with pytest.raises(GraphError, match="each slot once"):
        prediction_from_official(data, as_contacts(graph()))
    del data["nodes"]["slot04_handle"]["slot"]
    with pytest.raises(GraphError, match="`slot` of node `slot04_handle`"):
        prediction_from_official(data, as_contacts(graph()))


def test_a_broken_official_box_is_refused():
    for obb in ({"center": [0, 0], "half": [1, 1, 1]}, {"center": [0, 0, 0], "half": [-1, 1, 1]}, None):
        with pytest.raises(GraphError, match="node `a`"):
            graph_from_official({"model_id": "m", "nodes": {"a": {"material": "leg", "obb": obb}}})
