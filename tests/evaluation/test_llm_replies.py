"""What a language model replies: its JSON found in any text, names and codes checked, and nothing of it run."""

import json
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.additions.config import AdditionConfig
from grafu.additions.interior.request import NOTHING
from grafu.errors import FunctionalizationError, GraphError, ReplyError
from grafu.evaluation.llm.edit_reply import read_edit_reply
from grafu.evaluation.llm.graph_reply import CompletedByReply, read_graph_reply
from grafu.evaluation.llm.graph_text import graph_text
from grafu.evaluation.llm.reply_json import object_in_reply
from grafu.geometry.box import Box
from grafu.graph.edges import Contact
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.joints.motion_choice import FIXED, MotionChoice, Moves, Side
from grafu.vocabulary import JointType, PartLabel


def node(name: str, label: PartLabel, low: tuple[float, ...], high: tuple[float, ...], word: str = "") -> PartNode:
    return PartNode(name, label, Box(np.array(low), np.array(high)), None, word)


# p1 a side, p2 a door in front of it, p3 a drawer above, p4 a handle on the door, p5 of no known category
GRAPH = FunctionalGraph(
    "cabinet",
    (
        node("left side", PartLabel.SIDE_PANEL, (-0.4, 0.0, 0.0), (-0.38, 0.4, 1.0), "wood"),
        node("leaf", PartLabel.DOOR, (-0.4, -0.02, 0.0), (0.4, 0.0, 0.6)),
        node("box", PartLabel.DRAWER, (-0.38, -0.02, 0.6), (0.38, 0.4, 0.9)),
        node("pull", PartLabel.HANDLE, (0.3, -0.05, 0.3), (0.32, -0.02, 0.4)),
        node("thing", PartLabel.UNKNOWN, (0.38, 0.0, 0.0), (0.4, 0.4, 1.0)),
    ),
    (Contact("left side", "leaf"), Contact("leaf", "pull"), Contact("left side", "box")),
)
HINGE = {"kind": "hinge", "parent": "p1", "child": "p2", "border": "-X", "axis": "-Z"}
RAIL = {"kind": "rail", "parent": "p1", "child": "p3", "axis": "-Y"}
HANDLE = {"kind": "attached", "parent": "p2", "child": "p4"}


def read(*edges: dict[str, str], **more: Any) -> CompletedByReply:
    return read_graph_reply(json.dumps({"edges": edges, **more}), GRAPH, "m")


def edits(*stated: dict[str, Any]) -> Any:
    ids = {"p1": "left side", "p2": "leaf", "p3": "box"}
    return read_edit_reply(json.dumps({"edits": stated}), ids)


@pytest.mark.parametrize(
    "text",
    [
        '{"edges": []}',
        'Here it is:\n```json\n{"edges": []}\n```\nGood luck!',
        'Ids are written {id}, and {"so": 1} is nothing. {"edges": []} {"edges": [1]}',
        '<think>{"edges"</think>{"edges": []}',
    ],
)
def test_the_object_is_found_in_whatever_stands_around_it(text: str) -> None:
    assert object_in_reply(text, "edges") == {"edges": []}


@pytest.mark.parametrize(
    ("text", "states"),
    [
        ("", "an empty reply"),
        ("I cannot help with that.", "none in 'I cannot help with that.'"),
        ('{"edges": [{"kind": "rail"', "cut off"),
        ('{"edges": [], "edges": []}', "names a value twice"),
        ("{" * 5000, "cut off"),
        ('{"edges": ' + "[" * 100_000, "cut off"),
        ("[1, 2]", "none in"),
        ('{"edits": []}', "`edges`"),
    ],
)
def test_a_reply_without_the_object_is_refused_in_one_line(text: str, states: str) -> None:
    with pytest.raises(ReplyError, match=states) as error:
        object_in_reply(text, "edges")
    assert "\n" not in str(error.value)


@given(st.text(max_size=200) | st.recursive(st.none() | st.integers() | st.text(max_size=3), st.lists, max_leaves=8))
def test_no_reply_raises_anything_else(said: Any) -> None:
    for text in (str(said), json.dumps({"edges": said}), json.dumps({"edges": [said], "labels": said})):
        with suppress(FunctionalizationError):
            read_graph_reply(text, GRAPH, "m")
        with suppress(FunctionalizationError):
            read_edit_reply(text.replace("edges", "edits"), {"p1": "left side"})


def test_the_graph_is_told_by_numbers_and_names_alone() -> None:
    shown = json.loads(graph_text(GRAPH))
    assert [part["id"] for part in shown["parts"]] == ["p1", "p2", "p3", "p4", "p5"]
    assert shown["parts"][0] == {
        "id": "p1", "label": "side panel", "low": [-0.4, 0.0, 0.0], "high": [-0.38, 0.4, 1.0], "name": "wood",
    }  # fmt: skip
    assert shown["contacts"] == [["p1", "p2"], ["p1", "p3"], ["p2", "p4"]]
    assert "left side" not in graph_text(GRAPH)  # our ids may state more than the input does


def test_edges_become_joints_on_the_parts_of_the_graph() -> None:
    found = read(HINGE, RAIL, HANDLE, labels={"p5": "side panel"}).motions
    door, drawer = found.joints
    assert (door.part, door.type, drawer.part, drawer.type) == ("p2", JointType.REVOLUTE, "p3", JointType.PRISMATIC)
    assert door.axis.direction.tolist() == [0, 0, -1]
    assert door.axis.point[0] == pytest.approx(-0.4)
    assert drawer.axis.direction.tolist() == [0, -1, 0]
    assert {part.name: part.parent for part in found.parts if part.parent} == {"p4": "p2"}
    assert [part.slot for part in found.parts] == [0, 1, 2, 3, 4]


def test_labels_are_by_the_ids_of_the_graph() -> None:
    assert read(labels={"p5": "side panel"}).labels["thing"] is PartLabel.SIDE_PANEL
    assert read().labels["leaf"] is PartLabel.DOOR


def test_a_part_that_is_no_handle_may_move_as_one_with_another() -> None:
    found = read(HINGE, {"kind": "attached", "parent": "p2", "child": "p5"}).motions
    assert found.body_of["p5"] == "p2"


def test_a_door_may_hang_on_what_moves() -> None:
    other = {"kind": "turn", "parent": "p2", "child": "p5", "axis": "-Y"}
    found = read(HINGE, other, labels={"p5": "misc"}).motions
    assert found.carrier_of("p5") == "p2"
    assert found.joints[1].axis.point.tolist() == pytest.approx([0.39, 0.2, 0.5])


def test_new_parts_may_be_named_and_get_no_joint() -> None:
    new = {"id": "new1", "label": "top panel", "low": [-0.4, 0, 1.0], "high": [0.4, 0.4, 1.02]}
    found = read({**HINGE, "parent": "new1"}, new_parts=[new]).motions
    assert "new1" not in found.labels
    assert [joint.part for joint in found.joints] == ["p2"]


@pytest.mark.parametrize(
    ("edges", "more", "states"),
    [
        ([{**HINGE, "child": "p22"}], {}, "there is no `p22`; did you mean `p2`"),
        ([{**HINGE, "parent": "left side"}], {}, "there is no `left side`"),
        ([], {"labels": {"p9": "door"}}, "there is no `p9`"),
        ([], {"labels": {"p5": "gate"}}, "labels.p5"),
        ([{**HINGE, "border": "-Y"}], {}, "broad face -Y"),
        ([{**HINGE, "axis": "-X"}], {}, "runs along Z: got -X"),
        ([{**HINGE, "axis": "up"}], {}, "edges.0.hinge.axis"),
        ([{**HINGE, "kind": "weld"}], {}, "edges.0"),
        ([{**HINGE, "code": "rm"}], {}, "edges.0.hinge.code"),
        ([{"kind": "hinge", "child": "p2", "border": "-X", "axis": "-Z"}], {}, "edges.0.hinge.parent"),
        ([{**RAIL, "child": "p2"}], {}, "p2"),
        ([HINGE, {**HINGE, "parent": "p5", "border": "+X"}], {"labels": {"p5": "side panel"}}, "p2"),
        ([{**HINGE, "parent": "p2"}], {}, "must join two parts"),
        ([], {"new_parts": [{"id": "p1", "label": "misc", "low": [0, 0, 0], "high": [1, 1, 1]}]}, "must be unique"),
        ([], {"new_parts": [{"id": "n", "label": "misc", "low": [0, 0, 2], "high": [1, 1, 1]}]}, "at least `low`"),
        ([], {"comment": "done"}, "comment"),
    ],
)
def test_a_reply_that_breaks_a_rule_is_refused_with_the_reason(edges: list, more: dict, states: str) -> None:
    with pytest.raises((ReplyError, GraphError), match=states):
        read(*edges, **more)


def test_edits_become_the_settings_of_the_command_line() -> None:
    found = edits(
        {"do": "hinge", "part": "p2", "edge": "left", "degrees": 90},
        {"do": "slide", "part": "p3", "direction": "front", "distance": 0.3},
        {"do": "label", "part": "p1", "label": "side panel"},
        {"do": "add", "what": "top"},
    ).settings
    assert found.motions == {
        "leaf": MotionChoice(Moves.TURNS, Side.LEFT), "box": MotionChoice(Moves.SLIDES, Side.FRONT),
    }  # fmt: skip
    assert found.joints["leaf"].opening == pytest.approx(np.pi / 2)
    assert found.joints["box"].opening == pytest.approx(0.3)
    assert found.labels == {"left side": PartLabel.SIDE_PANEL}
    assert found.additions.top == AdditionConfig().top
    assert (found.additions.handles, found.additions.interior) == (None, NOTHING)  # no edit asked for them


def test_the_other_edits() -> None:
    found = edits(
        {"do": "hinge", "part": "p2", "edge": "top", "opens": "inwards"},
        {"do": "fix", "part": "p3"},
        {"do": "attach", "part": "p1", "to": "p2"},
        {"do": "add", "what": "handles"},
        {"do": "add", "what": "interior"},
    )
    assert found.settings.motions == {"leaf": MotionChoice(Moves.TURNS, Side.TOP, inwards=True), "box": FIXED}
    assert found.settings.joints == {}
    assert found.attached == {"left side": "leaf"}
    usual = AdditionConfig()
    assert (found.settings.additions.handles, found.settings.additions.interior) == (usual.handles, usual.interior)
    assert found.settings.additions.top is None
    folded = edits({"do": "fold", "part": "p2", "to": "left"}).settings
    assert folded.motions == {"leaf": MotionChoice(Moves.FOLDS, Side.LEFT)}


@pytest.mark.parametrize(
    ("stated", "states"),
    [
        ([{"do": "run", "code": "import os"}], "edits.0"),
        ([{"do": "fix", "part": "p2", "code": "import os"}], "edits.0.fix.code"),
        ([{"do": "fix", "part": "p7"}], "there is no `p7`"),
        ([{"do": "attach", "part": "p1", "to": "p7"}], "there is no `p7`"),
        ([{"do": "hinge", "part": "p2", "edge": "diagonal"}], "edits.0.hinge.edge"),
        ([{"do": "hinge", "part": "p2", "edge": "left", "degrees": -5}], "edits.0.hinge.degrees"),
        ([{"do": "slide", "part": "p2", "direction": "front", "distance": 1e400}], "edits.0.slide.distance"),
        (
            [{"do": "fix", "part": "p2"}, {"do": "hinge", "part": "p2", "edge": "left"}],
            "at most one edit of its motions",
        ),
        ([{"do": "label", "part": "p2", "label": w} for w in ("door", "bar")], "at most one edit of its labels"),
        ([{"do": "attach", "part": a, "to": b} for a, b in (("p1", "p2"), ("p2", "p1"))], "in a circle"),
        ([{"do": "attach", "part": "p1", "to": "p1"}], "in a circle"),
    ],
)
def test_an_edit_that_cannot_be_is_refused_with_the_reason(stated: list, states: str) -> None:
    with pytest.raises(ReplyError, match=states):
        edits(*stated)


def test_no_module_that_reads_replies_can_run_them() -> None:
    import grafu.evaluation.llm as package

    for path in Path(package.__file__).parent.glob("*.py"):
        words = path.read_text()
        assert not any(word in words for word in ("eval(", "exec(", "subprocess", "import_module", "os.system")), path
