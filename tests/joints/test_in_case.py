"""A block between walls slides as a drawer does; what holds dividers, or has no wall beside it, does not."""

from dataclasses import replace

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.joints.config import RealizationConfig
from grafu.joints.no_hardware import NO_HARDWARE
from grafu.joints.rail.body_region import drawer_frame
from grafu.joints.rail.in_case import is_in_case
from grafu.vocabulary import PartLabel
from judging import installed, realized
from small_scenes import box, scene, sliding

OUT = vec3(0.0, -1.0, 0.0)
BLOCK = replace(box("drawer", (0.0, -0.4, 0.0), (0.4, 0.0, 0.3)), label=PartLabel.UNKNOWN, labelled_by="none")
LEFT = box("left", (-0.02, -0.4, -0.02), (0.0, 0.0, 0.32))
RIGHT = box("right", (0.4, -0.4, -0.02), (0.42, 0.0, 0.32))
BOTTOM = box("bottom", (0.0, -0.4, -0.02), (0.4, 0.0, 0.0))
DIVIDER = box("divider", (0.19, -0.4, 0.0), (0.21, 0.0, 0.3))
SUNK = box("sunk", (-0.02, -0.4, -0.02), (0.01, 0.0, 0.32))  # a wall that is drawn into it by a centimetre


@pytest.mark.parametrize(
    ("walls", "expected"),
    [
        ((LEFT, RIGHT, BOTTOM), True),
        ((SUNK, RIGHT, BOTTOM), True),
        ((LEFT, RIGHT), False),
        ((LEFT, BOTTOM), False),
        ((DIVIDER, BOTTOM), False),
    ],
    ids=["a case", "a case that is drawn into it", "nothing below and behind", "one wall", "a divider within it"],
)
def test_a_block_stands_in_a_case(walls, expected):
    frame = drawer_frame(BLOCK.mesh, OUT)

    assert is_in_case(frame, RayCaster(merge_meshes([wall.mesh for wall in walls]))) is expected


@pytest.mark.parametrize(("high", "expected"), [(0.01, False), (0.06, True)])
def test_a_sheet_fills_no_case(high, expected):
    block, top = (
        box("drawer", (0.0, -0.4, 0.0), (0.4, 0.0, high)),
        box("top", (0.0, -0.4, high), (0.4, 0.0, high + 0.02)),
    )
    walls = RayCaster(merge_meshes([wall.mesh for wall in (LEFT, RIGHT, BOTTOM, top)]))

    assert is_in_case(drawer_frame(block.mesh, OUT), walls) is expected


@pytest.mark.parametrize(("walls", "slides"), [((LEFT, RIGHT, BOTTOM), True), ((LEFT, BOTTOM), False)])
def test_a_guessed_block_slides_without_rails_where_it_stands_in_a_case(walls, slides):
    asset = scene(BLOCK, *walls, joints=(sliding("drawer", (0.0, -1.0, 0.0)),))

    found = installed(realized(asset, RealizationConfig(trim=False)))

    assert ("drawer" in found) is slides
    assert not slides or found["drawer"].template == NO_HARDWARE
