"""Faces cut by solids of many planes, and by many solids: the area is right, and memory stays small."""

import tracemalloc

import numpy as np
import pytest

from grafu.errors import TooComplex
from grafu.geometry import face_cuts
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.budget import Budget
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid, clip


def rounded(center: np.ndarray, corners: int, radius: float) -> ConvexSolid:
    angles = 2 * np.pi * np.arange(corners) / corners
    ring = np.stack([radius * np.cos(angles), radius * np.sin(angles), np.zeros(corners)], axis=1) + center
    up = vec3(0.0, 0.0, 1.0)
    solid = ConvexSolid.around(np.vstack([ring - up, ring + up]))
    assert solid is not None
    return solid


def test_a_rounded_hole_has_its_area_and_takes_little_memory() -> None:
    sheet = TriangleMesh(np.array([[-3.0, -3, 0], [3, -3, 0], [0, 5, 0]]), np.array([[0, 1, 2]]))
    hole = rounded(np.zeros(3), 100, 1.0)
    tracemalloc.start()
    left = clip(Surface(sheet), [hole])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert left.mesh.area == pytest.approx(sheet.area - 50 * np.sin(2 * np.pi / 100), rel=1e-9)
    turned = np.cross(*np.diff(left.mesh.triangles, axis=1).transpose(1, 0, 2))[:, 2]
    assert (turned > 0).all()  # like the sheet
    assert peak < 5e6


def sheet(count: int) -> TriangleMesh:
    x, y = np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1), indexing="ij")
    first = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    corners = np.stack([first, first + count + 1, first + count + 2, first + 1], axis=1)
    vertices = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    return TriangleMesh(vertices, np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]))


def test_batches_of_faces_give_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    solids = [rounded(np.array([0.3 + 0.1 * k, 0.5, 0.0]), 12, 0.2) for k in range(4)]
    whole = clip(Surface(sheet(12)), solids)
    monkeypatch.setattr(face_cuts, "_MOST_PAIRS", 7)
    monkeypatch.setattr(face_cuts, "_MOST_PIECES", 3)
    assert clip(Surface(sheet(12)), solids).mesh.area == pytest.approx(whole.mesh.area, rel=1e-9)


def test_more_cuts_than_fit_are_too_complex() -> None:
    with Budget(room=1000).in_force(), pytest.raises(TooComplex, match="cutting faces"):
        clip(Surface(sheet(12)), [rounded(np.full(3, 0.5), 12, 0.4)])
