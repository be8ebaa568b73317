"""A drawer that is named after its lock is a drawer where it has the size of the others; a lock is small."""

import numpy as np
import pytest

from grafu.asset.labels import label_of
from grafu.asset.named_fittings import with_named_fittings
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel


def part(name, low, high):
    mesh = TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))
    return Part(name, label_of(name), (Surface(mesh),), PartSource(name), "name")


def drawer(name, k, depth=0.58):
    return part(name, (0, 0, 0.18 * k), (0.41, depth, 0.18 * k + 0.17))


STACK = (drawer("drawer.001_Cube", 0), drawer("drawer.002_Cube", 1))


@pytest.mark.parametrize(
    ("name", "label"),
    [("drawer_lock_Cube.002", PartLabel.DRAWER), ("door_lock", PartLabel.MISC), ("lock", PartLabel.MISC)],
)
def test_a_lock_as_large_as_the_drawers_is_one(name, label):
    """No door is as large, and a name that states no drawer tells none."""
    found, notes = with_named_fittings((*STACK, drawer(name, 2)))
    assert found[-1].label is label
    assert found[:2] == STACK
    assert len(notes) == (label is PartLabel.DRAWER)


@pytest.mark.parametrize(
    "fitting",
    [
        part("drawer_lock", (0.2, -0.01, 0.4), (0.22, 0.0, 0.42)),
        part("drawer_rail", (0.0, 0.02, 0.4), (0.01, 0.56, 0.43)),
        drawer("drawer_slide", 2, depth=0.3),
    ],
    ids=["a lock", "a rail", "not as deep"],
)
def test_fittings_of_another_size_stay_fittings(fitting):
    assert with_named_fittings((*STACK, fitting)) == ((*STACK, fitting), [])
