"""`Deckel`, `крышка` and `盖板` name lids and tops of cases: the lid of a bench opens, the top of a dresser stays."""

import numpy as np
import pytest
import trimesh

from grafu.asset.lid_names import with_lids_by_name
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel

WORDS = ["Deckel_7", "крышка", "盖板 48", "Schrankdeckel"]
BENCH = {  # its arms stand higher than the lid between them
    "Seite_1": ((-0.6, -0.2, 0.0), (-0.57, 0.2, 0.7)),
    "Seite_2": ((0.57, -0.2, 0.0), (0.6, 0.2, 0.7)),
    "Boden": ((-0.57, -0.2, 0.05), (0.57, 0.2, 0.07)),
    "Rückwand": ((-0.57, 0.18, 0.07), (0.57, 0.2, 0.42)),
    "Blende": ((-0.57, -0.2, 0.07), (0.57, -0.18, 0.42)),
}
LID = ((-0.57, -0.2, 0.42), (0.57, 0.2, 0.45))


def part(name, label=PartLabel.UNKNOWN):
    mesh = TriangleMesh.box_mesh(Box(np.zeros(3), np.ones(3)))
    return Part("part", label, (Surface(mesh),), PartSource(name), "none")


@pytest.mark.parametrize("name", WORDS)
def test_it_is_a_lid_where_no_door_or_drawer_is_and_no_label_beside_one(name):
    (lid, _) = with_lids_by_name([part(name), part("Boden", PartLabel.BOTTOM_PANEL)])
    assert (lid.label, lid.labelled_by) == (PartLabel.DOOR, "name")

    (top, _) = with_lids_by_name([part(name), part("Schublade", PartLabel.DRAWER)])
    assert top.label is PartLabel.UNKNOWN


@pytest.mark.parametrize("name", ["Deckelplatte", "Boden", "lid cover plate"])
def test_other_names_keep_their_label(name):
    (other,) = with_lids_by_name([part(name)])
    assert other == part(name)


@pytest.mark.parametrize("name", WORDS)
def test_the_lid_of_a_bench_between_arms_opens(tmp_path, name):
    scene = trimesh.Scene()
    for node, (low, high) in {**BENCH, name: LID}.items():
        scene.add_geometry(trimesh.creation.box(bounds=[low, high]), node_name=node, geom_name=node)
    scene.export(tmp_path / "bench.glb")
    asset = load_asset(tmp_path / "bench.glb", LoadOptions(up="+Z", front="-Y", scale=1.0))
    assert [p.source.name for p in asset.parts if p.label is PartLabel.DOOR] == [name]
