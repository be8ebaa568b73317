"""A shelf that is a board is fixed, whatever the network states; racks, trays and what its name has slide do slide."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset, Part, PartSource
from grafu.completion.fixed_shelves import FixedShelfConfig, with_fixed_shelves
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Slide
from grafu.graph.edit import with_edges
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT = 2  # the face that looks to -Y
BODY = replace(box("body", (-0.4, 0.0, 0.0), (0.4, 0.6, 1.0)), label=PartLabel.SIDE_PANEL)
BOARD = box("shelf", (-0.38, 0.0, 0.5), (0.38, 0.5, 0.515))


def merged(*parts: Part) -> Part:
    return replace(parts[0], id="shelf", surfaces=tuple(s for part in parts for s in part.surfaces))


RIM = box("rim", (-0.38, 0.0, 0.5), (0.38, 0.01, 0.56))
WIRES = [box("wire", (-0.38 + 0.05 * k, 0.0, 0.5), (-0.37 + 0.05 * k, 0.5, 0.51)) for k in range(16)]


def slid(shelf: Part, label: PartLabel = PartLabel.SHELF) -> tuple[GraphCompletion, GraphCompletion]:
    asset = Asset("made", "", "made", (BODY, replace(shelf, label=label)))
    graph = parse_graph(asset)
    slide = Decision("shelf", "slide", str(FRONT), 0.99)
    before = GraphCompletion(graph, with_edges(graph, [Slide("body", "shelf", FRONT)]), "network", decisions=(slide,))
    return before, with_fixed_shelves(before, asset)


def test_a_board_is_fixed_and_only_touches_what_it_was_to_slide_on():
    before, after = slid(BOARD)
    assert before.completed.motions
    assert not after.completed.motions
    assert not after.decisions
    assert after.completed.node("shelf").label is PartLabel.SHELF


@pytest.mark.parametrize(
    ("shelf", "label"),
    [
        (merged(BOARD, RIM), PartLabel.SHELF),
        (merged(*WIRES), PartLabel.SHELF),
        (replace(BOARD, source=PartSource("pull-out shelf")), PartLabel.SHELF),
        (BOARD, PartLabel.MISC),
    ],
    ids=["a tray", "a rack", "named as sliding", "no shelf"],
)
def test_what_looks_like_it_slides_as_predicted(shelf, label):
    before, after = slid(shelf, label)
    assert after is before


def test_fractions_are_checked():
    with pytest.raises(ValueError, match="flat"):
        FixedShelfConfig(flat=1.5)
