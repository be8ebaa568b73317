"""Interiors of furniture that stands turned about Z: the same panels as unturned, carried, and in no one's way."""

from math import radians

import numpy as np
import pytest
from interior_judge import faults_of_panels

from front_scenes import cabinet, scene_of
from grafu.additions.interior.furnish import Furnished
from grafu.additions.interior.request import PREDICTED, parse_interior
from grafu.additions.interior.turned import furnish_scene
from grafu.additions.step import PanelHint
from grafu.asset.edit import yawed
from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.transform import from_rotation, rotation_matrix, transform_points
from grafu.synth.fronts.layout import CellRow, Door, Drawer, OpenCell, Pair, Stack
from grafu.synth.samples import KINDS
from grafu.vocabulary import PartLabel

LAYOUTS = {
    "pair": Pair(),
    "doors in a row": CellRow((Door("right"), Door("left"))),
    "pair over drawer": Stack((Pair(), Drawer()), (3.0, 1.0)),
    "open": OpenCell(),
}


def furnished(asset: Asset, request: str) -> Furnished:
    return furnish_scene(scene_of(asset), parse_interior(request))


def turn(degrees: float) -> np.ndarray:
    return from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), radians(degrees)))


ANGLES = (7.0, 30.0, 45.0, 200.0)
TURNED = [(name, ANGLES[(k + more) % 4]) for k, name in enumerate(LAYOUTS) for more in (0, 2)]


@pytest.mark.parametrize(("layout", "degrees"), TURNED)
def test_turned_furniture_gets_the_panels_of_unturned_one(layout, degrees):
    plain = cabinet(LAYOUTS[layout], width=0.9)
    before = furnished(plain, "shelves=2,dividers=1").additions
    asset = yawed(plain, radians(degrees))
    after = furnished(asset, "shelves=2,dividers=1").additions
    assert before
    assert sorted(a.part.label for a in before) == sorted(a.part.label for a in after)
    back = turn(-degrees)
    places = [transform_points(back, a.part.mesh.vertices).mean(axis=0) for a in after]
    for panel in before:
        assert min(np.abs(panel.part.mesh.vertices.mean(axis=0) - place).max() for place in places) < 0.01
    assert faults_of_panels(after, scene_of(asset)) == []


@pytest.mark.parametrize("degrees", [-3.0, 30.0])
@pytest.mark.parametrize("kind", ["table with hanging drawers", "drawers with panels between", "two-sided table"])
def test_what_has_no_interior_has_none_when_turned(kind, degrees):
    found = furnished(yawed(KINDS[kind](), radians(degrees)), "shelves=2")
    assert found.additions == ()
    assert found.refused[0].why.startswith("no compartment")


@pytest.mark.parametrize("kind", ["corner door at 45 degrees", "corner door at 30 degrees"])
@pytest.mark.parametrize("request_", ["shelves=2", "dividers=1", "auto"])
@pytest.mark.parametrize("degrees", [0.0, 20.0, -45.0])
def test_nothing_floats_or_blocks_in_diagonal_corner_cabinets(kind, request_, degrees):
    asset = yawed(KINDS[kind](), radians(degrees))
    found = furnished(asset, request_)
    assert faults_of_panels(found.additions, scene_of(asset)) == []


def test_a_predicted_shelf_finds_its_place_in_turned_furniture():
    asset = yawed(cabinet(Pair(), width=0.9), radians(30.0))
    box = asset.parts[0].box
    for part in asset.parts:
        box = box.union(part.box)
    half = vec3(0.3, 0.2, 0.01)
    hint = PanelHint("expected", PartLabel.SHELF, Box(box.center - half, box.center + half))
    (addition,) = furnish_scene(scene_of(asset), PREDICTED, hints=[hint]).additions
    assert addition.part.box.center[2] == pytest.approx(hint.box.center[2], abs=0.005)
    assert faults_of_panels([addition], scene_of(asset)) == []
    edges = np.diff(addition.part.mesh.triangles, axis=1).reshape(-1, 3)
    level = edges[np.abs(edges[:, 2]) < 1e-9]
    assert np.degrees(np.arctan2(level[:, 1], level[:, 0]) % (np.pi / 2)).round(3).tolist().count(30.0) > 0
