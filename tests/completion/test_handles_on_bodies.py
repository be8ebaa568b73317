"""A knob above a lid, on the body behind it, is not the lid's; what touches the lid or hangs before a door is."""

from dataclasses import replace

import pytest

from grafu.asset.part import Asset
from grafu.completion.handles import attach_handles
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

BODY = box("body", (-0.3, -0.3, 0.0), (0.3, 0.3, 0.9)), PartLabel.FACE_FRAME
PANEL = box("panel", (-0.3, 0.2, 0.9), (0.3, 0.3, 1.05)), PartLabel.FACE_FRAME
LID = box("lid", (-0.25, -0.25, 0.9), (0.25, 0.19, 0.92)), PartLabel.DOOR
DOOR = box("lid", (-0.25, 0.1, 0.9), (0.25, 0.12, 1.05)), PartLabel.DOOR


@pytest.mark.parametrize(
    ("leaf", "z", "is_attached"),
    [(LID, 0.93, False), (LID, 0.921, True), (DOOR, 0.97, True)],
    ids=["above a lid", "on a lid", "a door in front of the panel"],
)
def test_a_knob_above_a_lid_that_it_does_not_touch_is_not_its(leaf, z, is_attached):
    knob = box("knob", (-0.02, 0.17 if leaf is LID else 0.12, z), (0.02, 0.2, z + 0.04)), PartLabel.HANDLE
    parts = tuple(replace(part, label=label) for part, label in (BODY, PANEL, leaf, knob))
    found = attach_handles(parse_graph(Asset("made", "", "made", parts)))

    assert [(edge.parent, edge.child) for edge in found.graph.attachments] == [("lid", "knob")] * is_attached
