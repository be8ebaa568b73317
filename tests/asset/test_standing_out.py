"""The front of nameless parts is the side that handles stand out of, where these are on one side alone."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.frame import settle_frame, whole_box
from grafu.asset.options import LoadOptions
from grafu.asset.part import Part
from grafu.asset.reading import Convention, Reading
from grafu.asset.standing import vector
from grafu.asset.standing_out import StandingOutConfig, side_with_handles
from grafu.vocabulary import PartLabel
from small_scenes import box

MJCF = Convention("MJCF", up="+Z")
FRONTS = ("-Y", "+Y", "-X", "+X")
SHELL = [
    box("left", (-0.2, -0.1, 0.0), (-0.19, 0.1, 0.6)),
    box("right", (0.19, -0.1, 0.0), (0.2, 0.1, 0.6)),
    box("back", (-0.19, 0.09, 0.0), (0.19, 0.1, 0.6)),
    box("top", (-0.2, -0.1, 0.6), (0.2, 0.1, 0.61)),
    box("leaf", (-0.2, -0.115, 0.0), (0.2, -0.1, 0.6)),
]
KNOB = box("knob", (0.15, -0.135, 0.3), (0.165, -0.115, 0.315))


def nameless(parts, front="-Y"):
    """Returns parts without names that face this direction of the input, Z up."""
    f = vector(front)
    T = np.eye(4)
    T[:3, :3] = np.column_stack([np.cross(-f, [0.0, 0.0, 1.0]), -f, [0.0, 0.0, 1.0]])
    return tuple(
        Part(f"Cube.{k}", PartLabel.UNKNOWN, tuple(s.transformed(T) for s in part.surfaces), part.source, "none")
        for k, part in enumerate(parts)
    )


def side(parts, **changes):
    return side_with_handles(parts, whole_box(tuple(parts)), "+Z", replace(StandingOutConfig(), **changes))


@pytest.mark.parametrize("front", FRONTS)
@pytest.mark.parametrize("stated", [None, "+X"])
def test_a_cabinet_faces_where_its_only_knob_is(front, stated):
    parts = nameless([*SHELL, KNOB], front)
    frame = settle_frame(Reading("mesh file", parts, replace(MJCF, front=stated)), LoadOptions())
    assert frame.front == front
    assert ("small parts stand out there alone" in frame.assumed[1]) == (front != stated)


@pytest.mark.parametrize(
    "others",
    [
        [box("knob", (-0.16, 0.1, 0.3), (-0.14, 0.12, 0.32))],  # one behind, too
        [box("bar", (0.2, -0.05, 0.2), (0.23, 0.05, 0.22))],  # a bar at the side, as of a trolley
    ],
)
def test_small_parts_on_two_sides_tell_no_front(others):
    assert side(nameless([*SHELL, KNOB])) == "-Y"
    assert side(nameless([*SHELL, KNOB, *others])) is None


@pytest.mark.parametrize(
    "part",
    [
        box("plinth", (-0.2, -0.13, 0.0), (0.2, -0.115, 0.05)),  # reaches the ends of the side
        box("board", (-0.15, -0.13, 0.1), (0.15, -0.115, 0.5)),  # too large
        box("shelf", (-0.05, -0.115, 0.3), (0.05, 0.05, 0.31)),  # stands out of nothing
        box("lamp", (-0.02, -0.25, 0.3), (0.02, -0.23, 0.32)),  # stands far off
    ],
    ids=lambda part: part.id,
)
def test_what_is_no_handle_by_its_size_and_place_tells_no_front(part):
    assert side(nameless([*SHELL, part])) is None


@pytest.mark.parametrize("change", ["long", "slim", "deep", "least", "most", "inside"])
def test_each_threshold_decides(change):
    limit = {"least": 0.05, "inside": 0.45}.get(change, 0.01)
    assert side(nameless([*SHELL, KNOB]), **{change: limit}) is None
    with pytest.raises(ValueError, match=change):
        StandingOutConfig(**{change: 0.0})


def test_fronts_that_were_cut_out_show_the_front_where_no_small_part_stands_out():
    block = box("block", (-0.2, -0.2, 0.0), (0.2, 0.2, 0.6))
    reading = Reading("mesh file", nameless([block]), MJCF, fronts_face="-X")
    frame = settle_frame(reading, LoadOptions())
    assert frame.assumed[1] == "front is -X: what was cut out of a mesh as a front faces there"
    held = replace(reading, parts=nameless([block, box("knob", (0.2, 0.0, 0.3), (0.22, 0.02, 0.32))]))
    assert settle_frame(held, LoadOptions()).front == "+X"
