"""The plate that is called by an appliance is its door, also where it is one object of a door of several."""

from dataclasses import replace

import pytest

from grafu.asset.appliance_fronts import with_appliance_fronts
from grafu.asset.one_front import joined_where_nameless
from grafu.asset.part import IDENTITY_FRAME, PartSource
from grafu.asset.reading import Convention, Reading
from grafu.vocabulary import PartLabel
from small_scenes import BASE_CASE, box


def plate(name: str, low=(0.02, -0.02, 0.1), high=(0.58, 0.0, 0.68)):
    return replace(box("front", low, high), id=name, source=PartSource(name))


def label(part, *others) -> PartLabel:
    return with_appliance_fronts((part, *BASE_CASE, *others), IDENTITY_FRAME)[0].label


@pytest.mark.parametrize("name", ["oven", "microwave", "fridge", "Dishwasher"])
def test_a_plate_that_is_called_an_appliance_is_its_door(name):
    assert label(plate(name)) is PartLabel.DOOR


@pytest.mark.parametrize(
    ("low", "high"),
    [
        ((0.02, -0.02, 0.1), (0.58, 0.5, 0.68)),  # the whole appliance
        ((0.02, -0.02, 0.6), (0.58, 0.0, 0.7)),  # its control panel
        ((0.02, 0.0, 0.1), (0.58, 0.5, 0.12)),  # a plate that lies
    ],
    ids=["whole", "low", "lying"],
)
def test_other_shapes_of_that_name_are_not(low, high):
    assert label(plate("oven", low, high)) is PartLabel.UNKNOWN


@pytest.mark.parametrize("name", ["cabinet", "oven_frame", "oven_knob", "plate"])
def test_plates_of_other_names_are_not(name):
    assert label(plate(name)) is not PartLabel.DOOR


def test_where_another_part_is_named_its_door_it_is_not():
    door = replace(plate("oven"), id="oven_2", label=PartLabel.DOOR)
    assert label(plate("oven"), door) is PartLabel.UNKNOWN
    assert label(plate("fridge"), door) is PartLabel.DOOR


def test_a_front_of_several_objects_bears_the_name_of_the_appliance_among_them():
    case = [replace(part, source=PartSource("side panel")) for part in BASE_CASE]
    foot = plate("foot", (0.0, 0.4, -0.1), (0.05, 0.45, 0.0))
    pane = plate("oven", (0.05, -0.025, 0.13), (0.55, -0.02, 0.65))
    found = joined_where_nameless(
        Reading("mesh file", (plate("thing"), pane, foot, *case), Convention("test")), IDENTITY_FRAME
    ).parts
    assert [part.id for part in found][:2] == ["oven", "foot"]
    assert found[0].box.low[0] == 0.02
