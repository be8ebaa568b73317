"""Which carriers `judge_network_decided.py` counts for the true one: what meets it and runs beside the same border."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from grafu.data.pair import GraphPair
from grafu.geometry.box import Box
from grafu.graph.edges import Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.piece_facts import STATIC, PieceFacts
from grafu.vocabulary import PartLabel

sys.path.insert(0, str(Path(__file__).parents[2] / "scripts"))

from judge_network_decided import decided_table, judge_decided

BOXES = {  # a case 0.8 m wide and high; the door covers all of it, the drawer lies behind a strip at its left
    "side": (PartLabel.SIDE_PANEL, (0.0, 0.0, 0.0), (0.02, 0.4, 0.8)),
    "strip": (PartLabel.BAR, (0.0, -0.002, 0.0), (0.02, 0.0, 0.8)),
    "other_side": (PartLabel.SIDE_PANEL, (0.78, 0.0, 0.0), (0.8, 0.4, 0.8)),
    "top": (PartLabel.TOP_PANEL, (0.0, 0.0, 0.8), (0.8, 0.4, 0.82)),
    "door": (PartLabel.DOOR, (0.0, -0.02, 0.0), (0.8, -0.002, 0.8)),
    "drawer": (PartLabel.DRAWER, (0.04, 0.0, 0.1), (0.76, 0.38, 0.3)),
    "runner": (PartLabel.BAR, (0.02, 0.0, 0.1), (0.03, 0.38, 0.12)),
    "post": (PartLabel.BAR, (0.02, 0.0, 0.1), (0.03, 0.02, 0.3)),
}
NODES = tuple(PartNode(name, label, Box(np.array(low), np.array(high))) for name, (label, low, high) in BOXES.items())
INPUT = FunctionalGraph("case", NODES)


def judged(true, found, bodies=None):
    """Counts of one true edge and one found edge, of the doors and drawers that move."""
    facts = PieceFacts(bodies=dict.fromkeys(BOXES, STATIC) | (bodies or {}))
    pair = GraphPair(INPUT, replace(INPUT, edges=(true,)), "natural", "case", facts)
    return judge_decided(replace(INPUT, edges=(found,)), pair, frozenset())


@pytest.mark.parametrize(
    ("carrier", "alike"), [("side", 1), ("strip", 1), ("top", 0), ("other_side", 0)]
)  # the top meets the side, and is near the door, but runs along another border
def test_a_hinge_may_be_on_what_meets_its_carrier_along_the_border(carrier, alike):
    counts = judged(Hinge("side", "door", 0, 1), Hinge(carrier, "door", 0, 1))
    assert counts["hinge", "alike"] == alike
    assert counts["hinge", "right"] == (carrier == "side")


@pytest.mark.parametrize(("carrier", "alike"), [("side", 1), ("runner", 1), ("post", 0), ("other_side", 0)])
def test_a_rail_may_be_on_what_meets_its_carrier_along_the_drawer(carrier, alike):
    assert judged(Rail("side", "drawer", 2), Rail(carrier, "drawer", 2))["rail", "alike"] == alike


def test_what_moves_with_another_part_is_no_such_carrier():
    counts = judged(Hinge("side", "door", 0, 1), Hinge("strip", "door", 0, 1), {"strip": "drawer"})
    assert counts["hinge", "alike"] == 0


def test_the_table_has_both_figures():
    counts = judged(Hinge("side", "door", 0, 1), Hinge("strip", "door", 0, 1))
    assert "| hinge | 1 | 0.000 | 1.000 |" in decided_table([counts]).splitlines()
