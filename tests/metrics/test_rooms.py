"""The judge of empty rooms: finds what could be furnished, and nothing where drawers, legs or panels take the room."""

from math import radians

import pytest

from grafu.asset.edit import scaled, yawed
from grafu.asset.part import Asset
from grafu.metrics.rooms import empty_rooms
from grafu.pipeline.addition_config import NO_ADDITIONS, AdditionConfig
from grafu.pipeline.functionalize import PipelineConfig, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.realization.interior.request import parse_interior
from grafu.synth.kinds import KINDS
from grafu.templates.gallery import builtin_gallery


def rooms(asset: Asset, config: AdditionConfig = NO_ADDITIONS):
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), PipelineConfig(additions=config))
    return empty_rooms(made.object)


@pytest.mark.parametrize(
    "kind", ["inset pair", "open backs", "corner door at 45 degrees", "overlay door, hinged right"]
)
def test_rooms_behind_doors_are_found(kind):
    assert rooms(KINDS[kind]()) or kind == "open backs"  # without a back nothing closes the room


@pytest.mark.parametrize(
    "kind",
    [
        "drawers with rails between",
        "drawers tight in their walls",
        "whole drawer boxes",
        "drawers behind an inset door",
        "table with hanging drawers",
        "two-sided table",
    ],
)
def test_drawers_and_tables_leave_none(kind):
    assert rooms(KINDS[kind]()) == []


@pytest.mark.parametrize("factor", [0.1, 10.0])
def test_rooms_grow_with_the_model(factor):
    (plain,), (other,) = rooms(KINDS["inset pair"]()), rooms(scaled(KINDS["inset pair"](), factor))
    assert other.size / plain.size == pytest.approx([factor] * 3, rel=0.05)


def test_a_turned_cabinet_holds_a_room_too():
    assert rooms(yawed(KINDS["inset pair"](), radians(30.0)))


def test_shelves_close_together_leave_no_room():
    config = AdditionConfig(interior=parse_interior("shelves=4"))
    assert rooms(KINDS["inset pair"](), config) == []
