"""A drawer drawn sunk into a case of one piece is pressed back from it where that is not seen; others stay whole."""

from dataclasses import replace

import manifold3d
import numpy as np
import pytest

from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.realize import realize
from grafu.vocabulary import PartLabel
from judging import GALLERY, installed
from small_scenes import box, scene, sliding

WHOLE = RealizationConfig(max_carve_hidden=0.06)  # the case stays whole, as one does of which too much would go


def case_of_one_piece() -> Part:
    """A case of 0.5 x 0.45 x 0.4 m, one shell, open at its front (y = 0), with walls of 30 mm."""
    block = manifold3d.Manifold.cube((0.5, 0.45, 0.4))
    room = manifold3d.Manifold.cube((0.44, 0.42, 0.34)).translate((0.03, -0.01, 0.03))
    made = (block - room).to_mesh()
    mesh = TriangleMesh(np.asarray(made.vert_properties[:, :3], float), np.asarray(made.tri_verts, int))
    return replace(box("case", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(mesh),), label=PartLabel.SIDE_PANEL)


def pulled(low: float, before: float = -0.002):
    """A drawer whose lower end is at a height, and whose front stands so far before the case (m, negative: inside)."""
    body = box("drawer", (0.04, -before, low), (0.46, 0.38, 0.33))
    asset = scene(case_of_one_piece(), body, joints=(sliding("drawer", (0.0, -1.0, 0.0)),))
    return installed(realize(plan_from_annotation(asset), asset, GALLERY, WHOLE))["drawer"]


def sunk(outcome) -> list[float]:
    return [c.amount for c in outcome.clearances if "sunk" in c.why]


@pytest.mark.parametrize("depth", [0.003, 0.008])
def test_a_drawer_sunk_into_the_floor_of_its_case_is_raised_out_of_it(depth):
    outcome = pulled(0.03 - depth)
    (amount,) = sunk(outcome)
    assert depth < amount <= 0.013
    assert outcome.collision_share == 0.0
    assert outcome.opening > 0.2


def test_a_drawer_that_fits_stays_whole():
    assert sunk(pulled(0.035)) == []


def test_a_drawer_sunk_far_into_its_case_stays_whole():
    assert sunk(pulled(0.012)) == []


def test_a_drawer_whose_side_is_seen_stays_whole():
    """Its lower end lies before the case, where all of it is seen."""
    assert sunk(pulled(0.022, before=0.1)) == []
