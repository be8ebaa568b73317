"""Two sheets that are one front of a surface are one part; two fronts without a groove between them are not."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Part
from grafu.asset.parted_surface import with_boards
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel
from small_scenes import box
from solids import as_mesh, solid

HANDLES = (((0.28, -0.05, 0.2), (0.32, -0.02, 0.22)), ((0.28, -0.05, 0.6), (0.32, -0.02, 0.62)))


def _front_in_two(at: float, *more, label: PartLabel = PartLabel.UNKNOWN) -> tuple[Part, ...]:
    """A cabinet whose door of 0.4 x 0.6 m lies 20 mm before it, cut at a height, and what stands out of that."""
    body = solid((0.0, 0.0, 0.0), (0.6, 0.4, 0.8)) + solid((0.1, -0.02, 0.1), (0.5, 0.0, 0.7))
    for low, high in more:
        body = body + solid(low, high)
    mesh = as_mesh(body.refine_to_length(0.02))
    centers = mesh.triangles.mean(axis=1)
    number = np.where(centers[:, 1] < -1e-6, np.where(centers[:, 2] < at, 0, 1), 2)
    made = replace(box("part", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), label=label, labelled_by="none")
    return tuple(_piece(made, name, mesh, number == k) for k, name in enumerate(("lower", "upper", "case")))


def _piece(made: Part, name: str, mesh: TriangleMesh, faces: np.ndarray) -> Part:
    return replace(made, id=name, surfaces=(Surface(mesh.with_faces(faces)),))


def test_a_door_that_was_parted_in_two_is_one() -> None:
    made = with_boards(_front_in_two(0.3))

    assert [part.id for part in made] == ["upper", "case"]
    assert made[0].box.size[[0, 2]] == pytest.approx([0.4, 0.6], abs=0.01)


@pytest.mark.parametrize("case", ["handles", "alike", "named"])
def test_two_fronts_stay_two(case: str) -> None:
    parts = {
        "handles": _front_in_two(0.3, *HANDLES),
        "alike": _front_in_two(0.4),
        "named": _front_in_two(0.3, label=PartLabel.DRAWER),
    }[case]

    assert {"lower", "upper", "case"} <= {part.id for part in with_boards(parts)}
