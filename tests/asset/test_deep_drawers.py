"""Low drawers that are much deeper than wide face where they come out, and not to the ends of their row."""

from dataclasses import replace

import numpy as np

from grafu.asset.part import Asset
from grafu.asset.standing import decide_front, front_votes
from grafu.vocabulary import PartLabel
from small_scenes import box


def row_of_drawers() -> Asset:
    """A counter 4 m wide and 1.1 deep whose drawers, 0.38 m wide and 0.36 high, reach far back; it faces -Y."""
    case = box("case", (-2.0, 0.0, 0.0), (2.0, 1.1, 0.9))
    drawers = [
        box(f"drawer_{k}{row}", (x, -0.02, z), (x + 0.38, 0.98, z + 0.36))
        for k, x in enumerate(np.arange(-2.0, 1.9, 0.4))
        for row, z in enumerate((0.1, 0.5))
    ]
    return Asset(
        "counter", "", "made", (case, *(replace(p, label=PartLabel.DRAWER, labelled_by="name") for p in drawers))
    )


def test_they_vote_for_the_side_that_they_reach():
    asset = row_of_drawers()
    votes = front_votes(asset.parts, asset.box, "+Z")
    assert decide_front(votes, "+X", "+X")[0] == "-Y"
    assert votes["-X"] == votes["+X"] == 0


def test_a_narrow_plate_still_faces_along_its_thickness():
    plate = replace(box("door", (-0.2, -0.03, 0.0), (0.2, 0.0, 0.8)), label=PartLabel.DOOR, labelled_by="name")
    case = box("case", (-0.2, 0.0, 0.0), (0.2, 0.5, 0.8))
    votes = front_votes((case, plate), Asset("a", "", "made", (case, plate)).box, "+Z")
    assert max(votes, key=lambda side: votes[side]) == "-Y"
