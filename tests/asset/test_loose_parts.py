"""`parts="loose"`: a welded model is read as its shells, from any format; screws stay with what they touch."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.asset import loose
from grafu.asset.load import load_asset
from grafu.asset.loose import loose_parts
from grafu.asset.options import Limits, LoadOptions
from grafu.asset.part import Part, PartSource
from grafu.errors import AssetTooLarge, UnsegmentedAsset
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import PartLabel
from small_assets import CABINET, load_annotated, mesh_of, write_grouped_obj, write_pnm

LOOSE = LoadOptions(up="+Z", front="-Y", scale=1.0, parts="loose")


def boxes_of(parts):
    """The boxes, from the lowest corner of all: readers put the whole in the middle."""
    boxes = [part.box for part in parts]
    least = Box.enclosing(boxes).low
    return sorted((*np.round(box.low - least, 5) + 0.0, *np.round(box.high - least, 5) + 0.0) for box in boxes)


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def part(name, *meshes, label=PartLabel.UNKNOWN):
    surfaces = tuple(Surface(mesh, Material(f"m{k}")) for k, mesh in enumerate(meshes))
    return Part(name, label, surfaces, PartSource(name))


BOXES = boxes_of([part(name, mesh_of(name)) for name in CABINET])


def welded(path, order=1):
    merge_meshes([mesh_of(name) for name in list(CABINET)[::order]]).to_trimesh().export(path)
    return path


@pytest.mark.parametrize("suffix", ["stl", "obj", "ply", "glb"])
@pytest.mark.parametrize("order", [1, -1])
def test_a_welded_cabinet_gives_its_parts_back(tmp_path, suffix, order):
    path = welded(tmp_path / f"welded.{suffix}", order)
    found = load_asset(path, LOOSE)

    assert boxes_of(found.parts) == BOXES
    assert {p.label for p in found.parts} == {PartLabel.UNKNOWN}
    assert "(--parts loose): 1 became 11" in " ".join(found.notes)
    with pytest.raises(UnsegmentedAsset, match=r"--parts loose makes parts of its 11 shells, or divide it first"):
        load_asset(path, replace(LOOSE, parts="input"))


def test_parts_that_are_shells_stay_as_they_are(tmp_path):
    path = write_grouped_obj(tmp_path / "c.obj")
    plain, loose = load_asset(path, replace(LOOSE, parts="input")), load_asset(path, LOOSE)

    assert {p.id for p in plain.parts} <= {p.id for p in loose.parts}
    assert boxes_of(loose.parts) == BOXES


def test_what_the_annotation_moves_or_carries_stays_whole_in_it(tmp_path):
    folder = write_pnm(tmp_path / "m")
    plain, loose = (load_annotated(folder, LoadOptions(scale=1.0, parts=parts)) for parts in ("input", "loose"))
    moving = {joint.part for joint in plain.joints}

    assert {joint.part for joint in loose.joints} == moving
    assert boxes_of(p for p in loose.parts if p.id in moving) == boxes_of(p for p in plain.parts if p.id in moving)


def test_one_solid_is_told_nothing_of_shells(tmp_path):
    trimesh.creation.box().export(tmp_path / "one.stl")
    for options in (LoadOptions(), LOOSE):
        with pytest.raises(UnsegmentedAsset) as refused:
            load_asset(tmp_path / "one.stl", options)
        assert "--parts" not in str(refused.value)


def test_screws_stay_with_the_board_they_are_in_and_what_floats_is_a_part():
    left, right = board((0, 0, 0), (0.02, 0.5, 1)), board((0.5, 0, 0), (0.52, 0.5, 1))
    screw, head = board((0.49, 0.2, 0.5), (0.495, 0.205, 0.505)), board((0.02, 0.2, 0.5), (0.024, 0.204, 0.504))
    inside, floating = board((0.01, 0.1, 0.1), (0.014, 0.104, 0.104)), board((0.25, 0.2, 0.5), (0.254, 0.204, 0.504))
    sunk = screw.translated(np.array([0.008, 0, 0]))
    found = loose_parts([part("body", left, merge_meshes([sunk, right]), head, inside, floating)])

    assert boxes_of(found) == boxes_of([part("a", left, head), part("b", right, sunk), part("c", floating)])
    first = next(p for p in found if p.box.low[0] == 0.0)
    assert [s.material.name for s in first.surfaces] == ["m0", "m2", "m3"]


def test_ids_are_unique_and_a_label_goes_where_it_named_the_whole():
    case = part(
        "chest_of_drawers", board((0, 0, 0), (1, 0.02, 1)), board((0, 0.5, 0), (1, 0.6, 1)), label=PartLabel.DRAWER
    )
    doors = part(
        "doors", board((0, -0.05, 0), (0.4, -0.03, 1)), board((0.5, -0.05, 0), (1, -0.03, 1)), label=PartLabel.DOOR
    )
    other = part("doors_2", board((0.2, 0.1, 0.2), (0.3, 0.2, 0.3)))
    held = part("held", board((0, 0.2, 0), (0.1, 0.3, 1)), board((0.5, 0.2, 0), (0.6, 0.3, 1)))
    found = {p.id: p for p in loose_parts([case, doors, other, held], held={"held"})}

    assert set(found) == {"chest_of_drawers", "chest_of_drawers_2", "doors", "doors_3", "doors_2", "held"}
    assert found["chest_of_drawers_2"].label is PartLabel.UNKNOWN
    assert found["doors_3"].label is PartLabel.DOOR
    assert found["held"].surfaces == held.surfaces
    assert loose_parts([]) == ()


def test_attributes_go_with_their_faces():
    mesh = merge_meshes([board((0, 0, 0), (1, 1, 1)), board((2, 0, 0), (3, 1, 1))])
    uv = mesh.vertices[:, :2].copy()
    found = loose_parts([Part("p", PartLabel.UNKNOWN, (Surface(mesh, uv=uv),), PartSource("p"))])

    assert len(found) == 2
    for shell in found:
        [surface] = shell.surfaces
        assert np.array_equal(surface.uv, surface.mesh.vertices[:, :2])


def test_too_many_shells_are_refused_before_parts_are_made_of_them(tmp_path, monkeypatch):
    monkeypatch.setattr(loose, "faces_of_part", None)
    path = welded(tmp_path / "welded.glb")
    with pytest.raises(AssetTooLarge, match=r"has 11 parts: at most 10 are read; .* --limit parts=11"):
        load_asset(path, replace(LOOSE, limits=Limits(max_parts=10)))


def test_tiny_shells_count_unless_they_lie_on_something():
    counted = []
    screws = [board((x, 0.5, 0.2), (x + 0.001, 0.501, 0.201)) for x in (0.1, 0.2, 0.9)]
    wall = board((0.0, 0.0, 0.0), (0.3, 0.5, 1.0))
    loose_parts([part("all", wall, *screws)], allow=counted.append)
    assert counted == [1, 2]  # the wall for certain; with it, what the screw in the air makes
