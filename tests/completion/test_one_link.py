"""What is guessed to move on the link of the body stays where other links have doors; a label is no guess."""

from dataclasses import replace

import pytest

from grafu.asset.body_link import body_link
from grafu.asset.part import Asset, Part, PartSource
from grafu.completion.one_link import with_rigid_links
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Hinge, Slide
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import BASE_CASE, box

DOOR = box("door", (0.0, -0.02, 0.0), (0.6, 0.0, 0.6))
CONSOLE = box("console", (0.0, -0.02, 0.6), (0.6, 0.0, 0.8))


def moving(links: dict[str, str], kind: str = "urdf", guessed: tuple[str, ...] = ("door", "console")) -> set[str]:
    """Returns what moves in the end of a door and a console; `links`: of parts that are not on the body's."""
    parts = tuple(
        replace(p, source=PartSource(p.id, link=links.get(p.id, "body"))) for p in (*BASE_CASE, DOOR, CONSOLE)
    )
    asset = Asset("made", "", kind, parts)
    given = {name: PartLabel.DOOR for name in ("door", "console") if name not in guessed}
    graph = relabelled(parse_graph(asset), given)
    labelled = relabelled(graph, dict.fromkeys(("door", "console"), PartLabel.DOOR))
    hinges = [Hinge("left", name, 0, 1) for name in ("door", "console")]
    told = tuple(Decision(name, "label", "door", 0.9, "misc", 0.1) for name in guessed)
    completion = GraphCompletion(graph, with_edges(labelled, hinges), "network", decisions=told)
    return {edge.child for edge in with_rigid_links(completion, asset).completed.motions}


def test_a_guess_on_the_link_of_the_body_stays():
    assert moving({"door": "leaf"}) == {"door"}


@pytest.mark.parametrize(
    "case",
    [
        {"links": {}},
        {"links": {"door": "leaf", "console": "flap"}},
        {"links": {"door": "leaf"}, "kind": "glb"},
        {"links": {"door": "leaf"}, "guessed": ("door",)},
    ],
    ids=["all on one link", "a link of its own", "no robot", "a label"],
)
def test_other_doors_move(case):
    assert moving(**case) == {"door", "console"}


def test_what_is_on_the_link_of_the_body_rides_on_no_door_of_another_link():
    sources = {"door": "leaf", "console": "leaf"}
    parts = [replace(p, source=PartSource(p.id, link=sources.get(p.id, "body"))) for p in (*BASE_CASE, DOOR, CONSOLE)]
    asset = Asset("made", "", "urdf", tuple(parts))
    graph = relabelled(parse_graph(asset), {"door": PartLabel.MISC})
    rides = (("door", "left"), ("door", "console"), ("left", "right"))
    found = with_rigid_links(GraphCompletion(graph, graph, "network", rides=rides), asset)
    assert found.rides == rides[1:]


def test_the_largest_link_of_one_mesh_tells_nothing():
    """A case that is one mesh, and a drawer with its handle: the link with more parts is no body."""
    case = replace(box("case", (0.0, 0.0, 0.0), (0.6, 0.5, 0.8)), source=PartSource("case", link="body"))
    asset = Asset("made", "", "urdf", (case, replace(DOOR, source=PartSource("door", link="leaf"))))
    assert body_link(asset) == ""
    boards = tuple(replace(p, source=PartSource(p.id, link="body")) for p in BASE_CASE)
    assert body_link(replace(asset, parts=(*boards, asset.parts[1]))) == "body"


@pytest.mark.parametrize("name", ["left_door_plate", "drawer_deck"])
def test_what_is_called_a_piece_of_a_door_is_none_on_the_link_of_the_body(name):
    """As a plate of a hinge is, and the board below a drawer."""
    asset = named(box(name, (0.0, -0.004, 0.3), (0.05, 0.0, 0.35)), PartLabel.DOOR)
    graph = parse_graph(asset)
    hinges = [Hinge("left", each, 0, 1) for each in ("door", name)]
    found = with_rigid_links(GraphCompletion(graph, with_edges(graph, hinges), "network"), asset)
    assert {edge.child for edge in found.completed.motions} == {"door"}


@pytest.mark.parametrize(("link", "moving"), [("body", {"door"}), ("tray", {"door", "tray"})])
def test_a_tray_on_the_link_of_the_body_stays(link, moving):
    asset = named(box("tray", (0.05, 0.05, 0.3), (0.55, 0.5, 0.32)), PartLabel.SHELF, link)
    graph = parse_graph(asset)
    edges = [Hinge("left", "door", 0, 1), Slide("left", "tray", 2)]
    found = with_rigid_links(GraphCompletion(graph, with_edges(graph, edges), "network"), asset)
    assert {edge.child for edge in found.completed.motions} == moving


def named(part: Part, label: PartLabel, link: str = "body") -> Asset:
    """Returns a case with a door on a link of its own and one more part; both are labelled by their names."""
    boards = [replace(p, source=PartSource(p.id, link="body")) for p in BASE_CASE]
    door = replace(DOOR, source=PartSource("door", link="leaf"), label=PartLabel.DOOR, labelled_by="name")
    more = replace(part, source=PartSource(part.id, link=link), label=label, labelled_by="name")
    return Asset("made", "", "urdf", (*boards, door, more))
