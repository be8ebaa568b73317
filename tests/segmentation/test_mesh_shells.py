"""Shells as four sides show them: worked out once in the mesh's frame, and turned."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation import view
from grafu.segmentation.mesh_shells import MeshShells, axes_from


def wedge(seed: int) -> TriangleMesh:
    """A box whose corners are moved at random, so that no face lies across an axis."""
    box = TriangleMesh.box_mesh(Box(vec3(float(seed), 0.0, 0.0), vec3(seed + 0.5, 1.0, 2.0)))
    moved = np.random.default_rng(seed).uniform(-0.1, 0.1, box.vertices.shape)
    return TriangleMesh(box.vertices + moved, box.faces)


WEDGES = [wedge(k) for k in range(4)]


@pytest.mark.parametrize("turn", range(4))
@given(together=st.sampled_from([1, 13, 24, 10**6]))
def test_each_side_shows_the_bounds_and_areas_of_the_turned_shells(turn: int, together: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(view, "_TOGETHER", together)
        seen = MeshShells.of(WEDGES).seen(axes_from(turn))
    for k, mesh in enumerate(WEDGES):
        turned = TriangleMesh(mesh.vertices @ axes_from(turn).T, mesh.faces)
        np.testing.assert_allclose(seen.low[k], turned.box.low, atol=1e-12)
        np.testing.assert_allclose(seen.high[k], turned.box.high, atol=1e-12)
        shown = turned.face_normals * turned.face_areas[:, None]
        np.testing.assert_allclose(seen.faced[k], np.maximum(shown, 0.0).sum(axis=0), atol=1e-9)


def test_the_rays_of_a_side_are_traced_once_however_faces_are_sorted() -> None:
    shells = MeshShells.of(WEDGES)
    parted = shells.parted([np.arange(len(mesh.faces)) for mesh in WEDGES])
    assert len(parted.owner) == 48
    assert parted.seen(axes_from(1)).rays is shells.seen(axes_from(1)).rays
    assert parted.seen(axes_from(2)).rays is not shells.seen(axes_from(1)).rays
