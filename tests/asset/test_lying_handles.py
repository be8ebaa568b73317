"""What lies on a front of another object and stands out of it is its handle; hinges, plates and mouldings are none."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.lying_handles import with_lying_handles
from grafu.asset.part import Part
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT = replace(box("fronts_1", (0.0, -0.02, 0.0), (0.45, 0.0, 0.7)), label=PartLabel.UNKNOWN, labelled_by="none")
CASE = replace(box("case", (0.0, 0.0, 0.0), (0.9, 0.5, 0.7)), label=PartLabel.SIDE_PANEL, labelled_by="name")
BAR = ((0.03, -0.05, 0.3), (0.042, -0.02, 0.43))
OTHERS = {
    "a hinge at the border": ((-0.002, -0.03, 0.3), (0.01, -0.02, 0.36)),
    "a plate of a lock": ((0.03, -0.023, 0.3), (0.06, -0.02, 0.36)),
    "a panel": ((0.05, -0.04, 0.05), (0.4, -0.02, 0.65)),
    "what is far before it": ((0.03, -0.1, 0.3), (0.042, -0.06, 0.43)),
}


def label_of(low, high, by: str = "none", front: Part = FRONT, lies: bool = True) -> PartLabel:
    lying = replace(box("metal", low, high), label=PartLabel.MISC, labelled_by=by)
    return with_lying_handles((CASE, front, lying), (False, False, lies))[2].label


@pytest.mark.parametrize("ends", [BAR, ((0.2, -0.048, 0.3), (0.23, -0.02, 0.33))], ids=["bar", "knob"])
def test_a_bar_or_a_knob_on_a_front_is_its_handle(ends):
    assert label_of(*ends) is PartLabel.HANDLE
    assert label_of(*ends, by="name") is PartLabel.MISC
    assert label_of(*ends, lies=False) is PartLabel.MISC
    assert label_of(*ends, front=replace(FRONT, label=PartLabel.SIDE_PANEL)) is PartLabel.MISC


@pytest.mark.parametrize("other", OTHERS)
def test_what_else_lies_there_is_none(other):
    assert label_of(*OTHERS[other]) is PartLabel.MISC


@pytest.mark.parametrize(("towards", "label"), [((0.0, -1.0, 0.0), PartLabel.HANDLE), (None, PartLabel.MISC)])
def test_a_bar_is_a_handle_also_on_a_front_with_the_box_of_its_drawer(towards, label):
    """Such a front is as deep as its box; it is known where one looks that was cut out of an object."""
    drawer = replace(box("fronts_1", (0.0, -0.02, 0.0), (0.45, 0.4, 0.2)), label=PartLabel.UNKNOWN, labelled_by="none")
    bar = replace(box("metal", (0.15, -0.05, 0.1), (0.3, -0.02, 0.11)), label=PartLabel.MISC, labelled_by="none")
    facing = (None, None if towards is None else np.array(towards), None)

    assert with_lying_handles((CASE, drawer, bar), (False, False, True), facing)[2].label is label
