"""Lofts, sweeps and sheets are closed, look outwards and hold the volume that they should."""

import numpy as np
import pytest

from grafu.geometry.sweep import chamfered_rectangle, circle, loft, sheet, swept

Z = np.array([0.0, 0.0, 1.0])
SQUARE = np.array([(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]) * 0.05


def volume(mesh) -> float:
    assert mesh.is_watertight
    return float(mesh.to_trimesh().volume)


def test_a_loft_between_two_squares_is_a_box():
    rings = np.stack([np.column_stack([SQUARE, np.full(4, z)]) for z in (0.0, 2.0)])
    assert volume(loft(rings)) == pytest.approx(0.02)


def test_a_swept_section_keeps_its_size_around_a_mitred_corner():
    path = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0)])
    mesh = swept(path, SQUARE, Z)
    assert volume(mesh) == pytest.approx(0.01 * 2.0)
    assert np.allclose(mesh.box.high, (1.05, 1.0, 0.05))


def test_a_circle_swept_around_a_circle_is_a_ring():
    angles = 2 * np.pi * np.arange(64) / 64
    path = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(64)])
    assert volume(swept(path, circle(0.1, 32), Z, closed=True)) == pytest.approx(2 * np.pi**2 * 0.01, rel=0.02)


def test_ends_lie_flat_where_a_direction_is_given():
    path = np.array([(0.0, 0.0, 0.0), (0.1, -0.2, 0.0), (0.5, -0.4, 0.0)])
    mesh = swept(path, SQUARE, Z, (np.array([0.0, -1.0, 0.0]), np.array([1.0, 0.0, 0.0])))
    assert np.allclose(mesh.vertices[:4, 1], 0.0)
    assert np.allclose(mesh.vertices[-4:, 0], 0.5)


def test_a_sheet_lies_between_its_grids():
    x, y = np.meshgrid(np.linspace(0.0, 1.0, 4), np.linspace(0.0, 2.0, 3), indexing="ij")
    outer, inner = (np.stack([x, y, np.full_like(x, z)], axis=-1) for z in (0.1, 0.0))
    assert volume(sheet(outer, inner)) == pytest.approx(0.2)


def test_a_chamfered_rectangle_fills_its_half_sizes():
    section = chamfered_rectangle((0.2, 0.1), 0.02)
    assert np.allclose(section.max(axis=0), (0.2, 0.1))
    assert np.allclose(section.min(axis=0), (-0.2, -0.1))
