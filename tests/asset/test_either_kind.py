"""What is named after doors and drawers alike is either by its shape, where it is a front at all."""

import numpy as np
import pytest

from grafu.asset.either_kind import with_either_kind
from grafu.asset.labels import label_of
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel


def labelled(name, size):
    mesh = TriangleMesh.box_mesh(Box(np.zeros(3), np.array(size, float)))
    part = Part(name, label_of(name), (Surface(mesh),), PartSource(name), "none")
    (found,) = with_either_kind((part,))
    return found.label, found.labelled_by


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ((0.6, 0.02, 0.2), PartLabel.DRAWER),
        ((0.02, 0.6, 0.47), PartLabel.DRAWER),
        ((0.6, 0.02, 0.5), PartLabel.DOOR),
        ((0.4, 0.02, 0.7), PartLabel.DOOR),
    ],
    ids=["wide", "wide, at the side", "hardly wider than high", "tall"],
)
def test_an_upright_plate_is_a_drawer_where_it_is_low(size, expected):
    assert labelled("Door-and-Drawers-Right.001", size) == (expected, "name")


@pytest.mark.parametrize("size", [(0.6, 0.5, 0.7), (0.6, 0.5, 0.02)], ids=["a body", "a board that lies"])
def test_what_is_no_upright_plate_stays_open(size):
    assert labelled("doors_and_drawers", size)[0] is PartLabel.UNKNOWN


def test_other_names_stay_as_they_are():
    assert labelled("Cube.003", (0.6, 0.02, 0.2)) == (PartLabel.UNKNOWN, "none")
