"""Sweeps of single joints: thin things in the way, solids within solids, meshes that are no boxes, open neighbours."""

import gc
from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.edit import yawed
from grafu.asset.part import AnnotatedJoint, Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Drawer, Pair
from grafu.synth.noise.untidy import with_doubled_faces, with_loose_faces, with_open_backs
from grafu.synth.pieces.shapes import turned
from grafu.synth.truth import clashes as module
from grafu.synth.truth.clashes import DEPTH, clashes_of
from grafu.vocabulary import JointType, PartLabel


def block(low, high) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def part(name: str, mesh: TriangleMesh, label: PartLabel = PartLabel.BAR) -> Part:
    return Part(name, label, (Surface(mesh),), PartSource(name))


FRONT = part("drawer", block([0, 0, 0], [0.4, 0.018, 0.2]), PartLabel.DRAWER)
SLIDE = AnnotatedJoint("drawer", JointType.PRISMATIC, Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)), 0.0, 0.4)


def before(*others: Part) -> Asset:
    return Asset("thing", "", "made", (FRONT, *others), joints=(SLIDE,))


@pytest.mark.parametrize("at", np.linspace(-0.39, -0.01, 9).tolist())
def test_the_thinnest_board_on_a_slide_is_met(at):
    board = part("board", block([0.1, at, 0.05], [0.2, at + 0.003, 0.1]))
    assert clashes_of(before(board)).hits("drawer") == {"board"}


@pytest.mark.parametrize("yaw", [0.3, np.pi / 2, 2.0])
def test_it_is_met_in_furniture_that_stands_askew(yaw):
    board = part("board", block([0.1, -0.2, 0.05], [0.2, -0.197, 0.1]))
    assert clashes_of(yawed(before(board), yaw)).hits("drawer") == {"board"}


def test_a_bar_that_is_no_box_is_met_by_its_mesh():
    near = part("near", turned(vec3(0.2, -0.1, -0.5), vec3(0.2, -0.1, 0.7), ((0.0, 0.02), (1.0, 0.02))))
    below = part("below", turned(vec3(0.2, -0.1, -0.5), vec3(0.2, -0.1, -0.002), ((0.0, 0.02), (1.0, 0.02))))
    assert clashes_of(before(near)).hits("drawer") == {"near"}
    assert clashes_of(before(below)).hits("drawer") == frozenset()


def test_a_box_wholly_within_the_moving_part_is_met():
    inner = part("inner", block([0.1, 0.004, 0.05], [0.2, 0.014, 0.1]))
    assert clashes_of(before(inner)).hits("drawer") == {"inner"}


@pytest.mark.parametrize(("sunk", "met"), [(0.0, False), (0.8 * DEPTH, False), (1.2 * DEPTH, True)])
def test_a_touch_is_no_clash(sunk, met):
    wall = part("wall", block([-0.1, -1, 0], [sunk, 1, 1]))
    assert bool(clashes_of(before(wall)).hits("drawer")) is met


@pytest.mark.parametrize("edit", [with_doubled_faces, with_loose_faces, with_open_backs])
def test_untidy_boards_are_met_like_tidy_ones(edit):
    board = part("board", block([0.1, -0.2, -0.05], [0.2, -0.1, 0.1]))
    assert clashes_of(edit(before(board))).hits("drawer") == {"board"}


def test_what_is_behind_doors_meets_them_closed_and_not_open():
    clashes = clashes_of(make_cabinet(Cabinet(layout=Pair(behind=Drawer(handle="none")))))
    assert clashes.bodies_hit("drawer") == ("door_1", "door_2")
    assert clashes.hits("drawer", ("door_1",)) >= {"door_2"}
    assert clashes.hits("drawer", ("door_1", "door_2")) == frozenset()


def test_what_rides_counts_as_what_it_rides_on():
    knob = replace(part("knob", block([0.1, -0.03, 0.1], [0.12, 0, 0.12]), PartLabel.HANDLE), rides_on="drawer")
    bar = part("bar", block([0.11, -0.5, 0.11], [0.13, -0.41, 0.13]))
    assert clashes_of(before(knob, bar)).hits("drawer") == {"bar"}
    assert clashes_of(before(bar)).hits("drawer") == frozenset()


def test_an_asset_is_worked_out_once_and_forgotten_with_it():
    asset = before()
    known = len(module._known)
    assert clashes_of(asset) is clashes_of(asset)
    assert len(module._known) == known + 1
    del asset
    gc.collect()
    assert len(module._known) <= known
