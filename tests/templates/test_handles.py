"""The built-in handles as solids in their frame."""

import numpy as np
import pytest

from grafu.errors import TemplateError
from grafu.templates.handles import HANDLES, handle_template
from grafu.templates.template import HandleSize, HandleTemplate

every_handle = pytest.mark.parametrize("handle", HANDLES, ids=lambda handle: handle.id)


def box_of(meshes) -> np.ndarray:
    vertices = np.vstack([mesh.vertices for mesh in meshes])
    return np.array([vertices.min(axis=0), vertices.max(axis=0)])


def test_there_are_eighteen_of_three_families():
    assert len({handle.id for handle in HANDLES}) == 18
    assert {handle.family for handle in HANDLES} == {"bar", "knob", "cup"}


@every_handle
def test_handles_are_closed_and_look_outwards(handle):
    for mesh in handle.build():
        assert mesh.is_watertight
        assert mesh.to_trimesh().volume > 0
    assert 50 <= sum(len(mesh.faces) for mesh in handle.build()) <= 400


@every_handle
@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_handles_fill_their_size_from_the_foot_plane_on(handle, ratio):
    length, protrusion = ratio * handle.natural.length, ratio**0.5 * handle.natural.protrusion
    meshes = handle.build(length, protrusion)
    low, high = box_of(meshes)
    assert all(mesh.is_watertight and mesh.to_trimesh().volume > 0 for mesh in meshes)
    assert (high - low)[0] == pytest.approx(length)
    assert low[1] == pytest.approx(-protrusion)
    assert high[1] == pytest.approx(0.0, abs=1e-9)
    assert low[0] == pytest.approx(-high[0])


@every_handle
def test_handles_are_longer_than_high_and_repeat_from_memory(handle):
    low, high = box_of(handle.build())
    assert (high - low)[2] <= 1.45 * (high - low)[0]
    assert handle.build() is handle.build()


def test_handles_are_found_by_their_id():
    assert handle_template("bail").title == "Drop handle"
    with pytest.raises(TemplateError, match="one of bar-round"):
        handle_template("lever")


@pytest.mark.parametrize("size", [(0.0, 0.02), (0.1, -0.01)])
def test_sizes_are_above_nothing(size):
    with pytest.raises(TemplateError, match="above 0"):
        handle_template("bar-round").build(*size)


def test_a_handle_reaches_its_natural_length():
    with pytest.raises(TemplateError, match="must reach"):
        HandleTemplate("short", "Short", "bar", HandleSize(0.2, 0.02), 0.1, handle_template("bar-round").shape)
