"""Objects joined by their material have the name of the first: the fronts among them are found, whatever it states."""

from collections import defaultdict
from pathlib import Path

import pytest
import trimesh

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.vocabulary import PartLabel

SAMPLES = Path(__file__).parents[2] / "samples"
AUTO = LoadOptions(up="+Z", front="-Y", scale=1.0)
CASE = [
    ((-0.80, -0.18, 0.0), (-0.78, 0.20, 0.80)),
    ((0.78, -0.18, 0.0), (0.80, 0.20, 0.80)),
    ((-0.80, -0.20, 0.80), (0.80, 0.20, 0.82)),
    ((-0.78, -0.18, 0.0), (0.78, 0.20, 0.02)),
    ((-0.78, 0.18, 0.02), (0.78, 0.20, 0.80)),
]


def fronts(path):
    """The doors and drawers, and what may be one, that were cut out of objects of a file."""
    asset = load_asset(path, AUTO)
    return [(part.label, part.labelled_by) for part in asset.parts if "_front" in part.id]


@pytest.mark.parametrize(("sample", "count"), [("desk", 4), ("kitchen_base", 4), ("dresser", 6)])
def test_every_front_of_a_sample_is_found_and_none_is_what_the_first_is_called(tmp_path, sample, count):
    """All fronts are one object, called like the first drawer."""
    scene, joined = trimesh.load_scene(SAMPLES / f"{sample}.glb"), defaultdict(list)
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        material = scene.geometry[name].visual.material.name
        is_front = node.startswith(("door", "drawer")) and material != "birch"
        joined["drawer_1" if is_front else f"all_{material}"].append(
            scene.geometry[name].copy().apply_transform(transform)
        )
    found = trimesh.Scene()
    for name, meshes in joined.items():
        bare = [trimesh.Trimesh(mesh.vertices, mesh.faces, process=False) for mesh in meshes]
        found.add_geometry(trimesh.util.concatenate(bare), node_name=name, geom_name=name)
    found.apply_transform(trimesh.transformations.rotation_matrix(1.5707963267948966, [1, 0, 0]))
    found.export(tmp_path / "joined.glb")

    assert len(fronts(tmp_path / "joined.glb")) == count


def cabinet(tmp_path, name, boxes):
    """A case and one object of several boxes."""
    scene = trimesh.Scene()
    for called, held in (("case", CASE), (name, boxes)):
        mesh = trimesh.util.concatenate([trimesh.creation.box(bounds=box) for box in held])
        scene.add_geometry(mesh, node_name=called, geom_name=called)
    scene.export(tmp_path / "cabinet.glb")
    return tmp_path / "cabinet.glb"


LEAVES = [((-0.77, -0.20, 0.03), (-0.002, -0.18, 0.79)), ((0.002, -0.20, 0.03), (0.77, -0.18, 0.79))]
DRAWERS = [((0.20, -0.20, low), (0.77, -0.18, low + 0.14)) for low in (0.35, 0.50, 0.65)]


def test_two_leaves_are_the_doors_that_their_name_says(tmp_path):
    assert fronts(cabinet(tmp_path, "door_1", LEAVES)) == [(PartLabel.DOOR, "name")] * 2


def test_a_door_and_drawers_around_a_niche_are_fronts_and_none_is_a_door_by_name(tmp_path):
    door = ((-0.77, -0.20, 0.03), (-0.10, -0.18, 0.79))

    assert fronts(cabinet(tmp_path, "door_1", [door, *DRAWERS])) == [(PartLabel.UNKNOWN, "none")] * 4


def test_several_that_the_name_speaks_of_are_what_it_says(tmp_path):
    unlike = [((0.20, -0.20, 0.03), (0.77, -0.18, 0.34)), *DRAWERS]

    assert {label for label, _ in fronts(cabinet(tmp_path, "drawers", unlike))} == {PartLabel.DRAWER}


def test_a_door_with_panels_that_do_not_fill_it_stays_one(tmp_path):
    """Its stiles and rails are no fronts."""
    panels = [((-0.60, -0.205, 0.10), (-0.15, -0.20, 0.35)), ((-0.60, -0.205, 0.45), (-0.15, -0.20, 0.70))]
    board = [((-0.77, -0.20, 0.03), (0.0, -0.18, 0.79))]

    assert fronts(cabinet(tmp_path, "door_1", [*board, *panels])) == []
