"""What a handle stands on is of the handle, step by step, up to the front."""

from dataclasses import replace

from grafu.asset.handle_stands import with_handle_stands
from grafu.asset.labels import label_of
from grafu.asset.part import Part, PartSource
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel
from small_scenes import box


def _part(name: str, low, high) -> Part:
    return replace(box(name, low, high), label=label_of(name), source=PartSource(name))


KNOB = _part("knob", (0.185, -0.05, 0.385), (0.215, -0.04, 0.415))
STEM = _part("spindle", (0.195, -0.04, 0.395), (0.205, -0.023, 0.405))
PLATE = _part("escutcheon", (0.185, -0.023, 0.36), (0.215, -0.02, 0.44))
FRONT = _part("slab", (0.0, -0.02, 0.0), (0.4, 0.0, 0.8))
CASE = _part("case", (0.0, 0.0, 0.0), (0.4, 0.4, 0.8))
HINGE = _part("hinge_plate", (0.19, -0.06, 0.39), (0.21, -0.05, 0.41))


def _handles(*parts: Part) -> set[str]:
    kept = with_handle_stands(parts, Box.enclosing(part.box for part in parts))
    return {part.id for part in kept if part.label is PartLabel.HANDLE}


def test_stem_and_plate_behind_a_knob_are_of_it_and_the_front_is_not() -> None:
    assert _handles(KNOB, STEM, PLATE, FRONT) == {"knob", "spindle", "escutcheon"}


def test_a_plate_is_of_no_handle_that_does_not_reach_it() -> None:
    assert _handles(KNOB, PLATE, FRONT) == {"knob"}


def test_what_is_named_as_a_hinge_and_a_small_front_are_of_no_handle() -> None:
    small = _part("slab", (0.15, -0.02, 0.35), (0.25, 0.0, 0.45))

    assert _handles(KNOB, HINGE, STEM, PLATE, small, CASE) == {"knob", "spindle", "escutcheon"}


def test_a_front_whose_handle_is_one_mesh_with_that_of_another_is_of_none() -> None:
    handles = _part("handles", (0.05, -0.05, 0.1), (0.35, -0.02, 0.7))

    assert _handles(handles, FRONT, CASE) == {"handles"}
