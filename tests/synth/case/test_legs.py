"""Legs that lean: where they stand at a height, so that stretchers meet them."""

from typing import get_args

import numpy as np
import pytest

from grafu.graph.parse import parse_graph
from grafu.synth.case.bases import METAL
from grafu.synth.case.legs import Leg, LegShape, lean, leg_meshes
from grafu.synth.tables.table import DrawerTable, make_table


@pytest.mark.parametrize("shape", ["tapered", "splayed", "cabriole"])
@pytest.mark.parametrize("z", [0.0, 0.15, 0.5])
def test_legs_lean_as_their_solids_do(shape: LegShape, z: float) -> None:
    leg = Leg(shape, 0.05, 0.5)
    [mesh] = leg_meshes(leg, (0.0, 0.0), (1.0, 1.0), 0.5)
    level = mesh.vertices[np.isclose(mesh.vertices[:, 2], z)]
    if not len(level):
        rows = mesh.to_trimesh().section([0.0, 0.0, 1.0], [0.0, 0.0, z])
        level = np.asarray(rows.vertices)

    assert lean(leg, z, 0.5) == pytest.approx(float(level[:, :2].min() + level[:, :2].max()) / 2, abs=0.003)


@pytest.mark.parametrize("shape", [shape for shape in get_args(LegShape) if shape not in METAL])
@pytest.mark.parametrize("kind", ["sides", "box", "H"])
def test_stretchers_reach_the_legs_of_tables(shape: LegShape, kind: str) -> None:
    table = make_table(DrawerTable(leg_shape=shape, stretcher=kind))  # type: ignore[arg-type]
    graph = parse_graph(table)

    assert all(graph.neighbours[p.id] for p in table.parts if p.id.startswith("stretcher"))
