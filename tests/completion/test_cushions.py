"""Cushions and backs of seats close nothing; thick lids of hollow bodies and thick doors of cases do."""

import pytest

from grafu.completion.cushions import closes_nothing, is_cushion_sized
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster
from small_scenes import box

SEAT = box("seat", (-0.3, -0.35, 0.3), (0.3, 0.25, 0.45))
BACK = box("back", (-0.3, 0.2, 0.46), (0.3, 0.35, 1.0))
BLOCK = [box("block", (-0.3, -0.3, 0.0), (0.3, 0.3, 0.3))]
TUB = [
    box("bottom", (-0.3, -0.35, 0.0), (0.3, 0.25, 0.02)),
    box("left", (-0.3, -0.35, 0.0), (-0.28, 0.25, 0.3)),
    box("right", (0.28, -0.35, 0.0), (0.3, 0.25, 0.3)),
    box("front", (-0.3, -0.35, 0.0), (0.3, -0.33, 0.3)),
    box("rear", (-0.3, 0.23, 0.0), (0.3, 0.25, 0.3)),
]


def told(part, rest):
    return closes_nothing(part.box, RayCaster(merge_meshes([one.mesh for one in rest])))


def test_a_cushion_lies_on_what_is_closed_and_a_lid_on_what_is_hollow():
    assert is_cushion_sized(SEAT.box)
    assert "cushion" in told(SEAT, BLOCK)
    assert told(SEAT, TUB) == ""


def test_a_back_has_nothing_behind_it_and_a_door_has_a_case():
    assert is_cushion_sized(BACK.box)
    assert "behind" in told(BACK, [*BLOCK, SEAT])
    assert told(BACK, [*BLOCK, box("rear", (-0.3, 0.7, 0.4), (0.3, 0.72, 1.0))]) == ""
    assert told(BACK, [box("case", (-0.3, -0.3, 0.4), (0.3, -0.28, 1.0))]) == ""  # it faces backwards


@pytest.mark.parametrize("thick", [0.02, 0.06, 0.09])
def test_doors_are_thinner(thick):
    assert not is_cushion_sized(box("door", (0.0, 0.0, 0.0), (0.6, thick, 0.8)).box)
