"""The judge of empty rooms: finds what could be furnished, and nothing where drawers, legs or panels take the room."""

from math import radians

import pytest

from grafu.additions.config import NO_ADDITIONS, AdditionConfig
from grafu.additions.interior.request import parse_interior
from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.asset.edit import scaled, yawed
from grafu.asset.part import Asset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.judging.panels import empty_rooms
from grafu.judging.piece import JudgedPiece
from grafu.metrics.judged import judged_piece
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.synth.samples import KINDS
from grafu.templates.gallery import builtin_gallery

Point = tuple[float, float, float]


def box(name: str, low: Point, high: Point) -> Visual:
    return Visual(name, (Surface(TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high)))),))


def still(*visuals: Visual) -> JudgedPiece:
    return judged_piece(ArticulatedObject("still", "body", (Link("body", visuals),)))


def rooms(asset: Asset, config: AdditionConfig = NO_ADDITIONS):
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), PipelineConfig(Settings(additions=config)))
    return empty_rooms(judged_piece(made.object))


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


def test_posts_are_no_walls():
    boards = [box(f"board_{k}", (0.0, 0.0, z), (0.9, 0.5, z + 0.02)) for k, z in enumerate((0.1, 0.8))]
    corners = [(x, y) for x in (0.0, 0.86) for y in (0.0, 0.46)]
    posts = [box(f"post_{k}", (x, y, 0.0), (x + 0.04, y + 0.04, 0.9)) for k, (x, y) in enumerate(corners)]
    sides = [box(f"side_{k}", (x, 0.0, 0.0), (x + 0.02, 0.5, 0.9)) for k, x in enumerate((-0.02, 0.9))]
    back = box("back", (0.0, 0.5, 0.0), (0.9, 0.51, 0.9))
    assert empty_rooms(still(*boards, *posts)) == []
    assert len(empty_rooms(still(*boards, *posts, *sides, back))) == 1
