from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.graph.edges import Attached, Contact, Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.render.graph_layout import node_places
from grafu.render.graph_picture import (
    EDGE_COLORS,
    SHORT_LABELS,
    category_rgb,
    draw_graph,
    drawing_picture,
    drawing_svg,
    motion_words,
)
from grafu.vocabulary import EdgeKind, PartLabel


def node(name, label, center, half):
    return PartNode(name, label, Box.from_center(vec3(*center), vec3(*half)))


NODES = (
    node("side & wall", PartLabel.SIDE_PANEL, (-0.5, 0.0, 0.5), (0.01, 0.3, 0.5)),
    node("other_side", PartLabel.SIDE_PANEL, (0.5, 0.0, 0.5), (0.01, 0.3, 0.5)),
    node("door", PartLabel.DOOR, (0.0, -0.3, 0.3), (0.5, 0.01, 0.3)),
    node("drawer", PartLabel.DRAWER, (0.0, 0.0, 0.8), (0.45, 0.3, 0.1)),
    node("knob", PartLabel.HANDLE, (0.4, -0.33, 0.3), (0.02, 0.02, 0.02)),
)
EDGES = (
    Hinge("side & wall", "door", 0, 0),
    Rail("side & wall", "drawer", 2),
    Rail("other_side", "drawer", 2),
    Attached("door", "knob"),
    Contact("other_side", "door"),
)
GRAPH = FunctionalGraph("cabinet", NODES, EDGES)


def many(count):
    rng = np.random.default_rng(count)
    centers = rng.uniform(-1, 1, (count, 3))
    return FunctionalGraph(
        "many", tuple(node(f"n{k}", PartLabel.SHELF, c, (0.1, 0.1, 0.1)) for k, c in enumerate(centers.tolist()))
    )


@given(st.integers(1, 60))
def test_nodes_stand_in_the_picture_and_apart(count):
    places = node_places(many(count), (400, 300), 15.0, 30.0)
    assert np.all(places >= 15)
    assert np.all(places <= [385, 285])
    gaps = np.linalg.norm(places[:, None] - places[None], axis=2)[~np.eye(count, dtype=bool)]
    assert count == 1 or gaps.min() > 14


def test_nodes_stand_as_the_parts_stand():
    places = dict(zip([n.id for n in NODES], node_places(GRAPH, (400, 300), 15.0, 20.0), strict=True))
    assert places["side & wall"][0] < places["door"][0] < places["other_side"][0]
    assert places["drawer"][1] < places["door"][1]  # y points down


def test_parts_in_one_place_do_not_hide_each_other():
    twins = tuple(node(f"n{k}", PartLabel.SHELF, (0.0, 0.0, 0.0), (0.1, 0.1, 0.1)) for k in range(5))
    places = node_places(FunctionalGraph("twins", twins), (400, 300), 15.0, 30.0)
    assert np.linalg.norm(places[:, None] - places[None], axis=2)[~np.eye(5, dtype=bool)].min() > 15


def test_an_empty_graph_is_an_empty_picture():
    drawing = draw_graph(FunctionalGraph("empty", ()), (30, 20))
    assert (drawing_picture(drawing) == 255).all()
    ElementTree.fromstring(drawing_svg(drawing))


def test_a_picture_without_size_is_refused():
    with pytest.raises(ValueError, match="positive width and height"):
        draw_graph(GRAPH, (0, 20))


def test_the_svg_holds_every_node_edge_and_motion():
    root = ElementTree.fromstring(drawing_svg(draw_graph(GRAPH)))
    titles = [e.text for e in root.iter() if e.tag.endswith("title")]
    texts = [e.text for e in root.iter() if e.tag.endswith("text")]
    assert titles == [f"{n.id} ({n.label.value})" for n in NODES]
    assert len([e for e in root.iter() if e.tag.endswith("line")]) == len(EDGES)
    assert texts.count("slides -Y") == 1  # once for the drawer, not for each rail
    assert "-X about -Z" in texts
    assert "side & wall" in texts


def test_a_missing_part_is_dashed():
    drawing = draw_graph(GRAPH, missing=["knob"])
    assert [d.title for d in drawing.discs if d.dashed] == ["knob (handle, missing)"]
    assert "stroke-dasharray" in drawing_svg(drawing)
    assert not np.array_equal(drawing_picture(drawing), drawing_picture(draw_graph(GRAPH)))


def test_names_are_written_where_there_is_room():
    written = {w.text for w in draw_graph(GRAPH).writings}
    assert "other_side" in written
    assert "n0" not in {w.text for w in draw_graph(many(60)).writings}
    assert "n0" in {w.text for w in draw_graph(many(60), names=True).writings}


def boxes_of(writings):
    """Returns the corners of writings, as a browser draws them: letters are about half as wide as high."""
    half = np.array([(0.25 * w.size * len(w.text), 0.45 * w.size) for w in writings])
    middles = np.array([w.center for w in writings])
    return middles - half, middles + half


@pytest.mark.parametrize("seed", range(4))
def test_no_name_covers_another_or_a_motion(seed):
    rng = np.random.default_rng(seed)
    centers = np.concatenate([rng.uniform(-1, 1, (18, 3)), rng.normal(0, 0.05, (9, 3))])  # nine stand in one corner
    named = enumerate(centers.tolist())
    fronts = tuple(node(f"drawer_front_number_{k}", PartLabel.DRAWER, c, (0.1, 0.1, 0.1)) for k, c in named)
    nodes = (node("drawer_side", PartLabel.SIDE_PANEL, (0.0, 0.0, 0.0), (0.1, 0.1, 0.1)), *fronts[1:])
    edges = tuple(Rail("drawer_side", one.id, 2) for one in nodes[1:9])
    drawing = draw_graph(FunctionalGraph("crowded", nodes, edges), (880, 560), names=True)
    low, high = boxes_of(drawing.writings)
    meets = ((low[:, None] < high[None]) & (low[None] < high[:, None])).all(axis=2)
    np.fill_diagonal(meets, val=False)
    assert not meets.any()
    named = sum(writing.text.startswith("drawer") for writing in drawing.writings)
    assert named >= 20


def test_writings_stay_in_the_picture():
    for writing in draw_graph(GRAPH, (200, 160), names=True).writings:
        assert writing.center[0] - 0.2 * writing.size * len(writing.text) > 0
        assert writing.center[0] + 0.2 * writing.size * len(writing.text) < 200
        assert 0.5 * writing.size < writing.center[1] < 160 - 0.5 * writing.size


def test_edges_have_the_colours_of_their_kinds():
    others = {EDGE_COLORS[EdgeKind.SLIDE], EDGE_COLORS[EdgeKind.TURN]}
    assert {s.color for s in draw_graph(GRAPH).strokes} == set(EDGE_COLORS.values()) - others
    assert set(EDGE_COLORS) == set(EdgeKind)
    assert len(set(EDGE_COLORS.values())) == len(EdgeKind)
    assert draw_graph(GRAPH).strokes[0].color == EDGE_COLORS[EdgeKind.CONTACT]  # at the back


def test_the_pixels_show_the_categories():
    drawing = draw_graph(GRAPH, (320, 240))
    picture = drawing_picture(drawing)
    assert picture.shape == (240, 320, 4)
    for disc in drawing.discs:
        x, y = round(disc.center[0] - 0.75 * disc.radius), round(disc.center[1])
        assert np.abs(picture[y, x, :3].astype(int) - disc.color).max() < 40


def test_every_category_has_a_word_and_a_colour():
    assert set(SHORT_LABELS) == set(PartLabel)
    assert len(set(SHORT_LABELS.values())) == len(PartLabel)
    assert len({category_rgb(label) for label in PartLabel}) == len(PartLabel)


def test_motions_in_words():
    assert motion_words(GRAPH, Hinge("other_side", "door", 3, 1)) == "+Z about +X"
    assert motion_words(GRAPH, Rail("other_side", "drawer", 3)) == "slides +Y"
