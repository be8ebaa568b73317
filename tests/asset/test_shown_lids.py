"""A broad plate that alone closes a hollow body is a lid without a name; tops of tables and cabinets are none."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.reading import Convention, Reading
from grafu.asset.settling import settled
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel
from small_scenes import box

AUTO = LoadOptions(up="+Z", front="-Y", scale=1.0)
W, D, H = 0.8, 0.5, 0.45


def tub(thick=0.02, low=0.0, high=H):
    """A box open above, as one shell."""
    outer = trimesh.creation.box(bounds=[(0, 0, low), (W, D, high)])
    inner = trimesh.creation.box(bounds=[(thick, thick, low + thick), (W - thick, D - thick, high)])
    inner.invert()
    walls = [m.submesh([np.flatnonzero(m.triangles_center[:, 2] < high - 1e-9)], append=True) for m in (outer, inner)]
    rim = [((0, 0), (W, thick)), ((0, D - thick), (W, D)), ((0, thick), (thick, D - thick)),
           ((W - thick, thick), (W, D - thick))]  # fmt: skip
    rims = [trimesh.Trimesh([(a[0], a[1], high), (b[0], a[1], high), (b[0], b[1], high), (a[0], b[1], high)],
                            [[0, 1, 2], [0, 2, 3]]) for a, b in rim]  # fmt: skip
    made = trimesh.util.concatenate([*walls, *rims])
    made.merge_vertices()
    return made


def solid(low, high):
    return trimesh.creation.box(bounds=[low, high])


def plate(over=0.01, low=H, thick=0.03):
    return solid((-over, -over, low), (W + over, D + over, low + thick))


def boards(front=0.02, back=0.02):
    """Four walls and a bottom, apart."""
    return {
        "Cube_1": solid((0, 0, 0), (W, front, H)),
        "Cube_2": solid((0, D - back, 0), (W, D, H)),
        "Cube_3": solid((0, front, 0), (0.02, D - back, H)),
        "Cube_4": solid((W - 0.02, front, 0), (W, D - back, H)),
        "Cube_5": solid((0.02, front, 0), (W - 0.02, D - back, 0.02)),
    }


def read(tmp_path, name="piece", **objects):
    """The parts of a file of some objects."""
    scene = trimesh.Scene()
    for called, mesh in objects.items():
        scene.add_geometry(mesh, node_name=called, geom_name=called)
    scene.export(tmp_path / f"{name}.glb")
    return load_asset(tmp_path / f"{name}.glb", AUTO).parts


def lids(tmp_path, name="piece", **objects):
    """The parts that are lids by their shape."""
    parts = read(tmp_path, name, **objects)
    return [part for part in parts if part.label is PartLabel.DOOR and part.labelled_by == "shape"]


@pytest.mark.parametrize("body", [{"Cube_9": tub()}, boards()], ids=["one shell", "boards"])
def test_a_plate_on_a_hollow_body_is_a_lid(tmp_path, body):
    (lid,) = lids(tmp_path, Cube=plate(), **body)

    assert float(lid.box.low[2]) == pytest.approx(H, abs=1e-6)


def test_a_cushion_on_it_is_a_piece_of_it_and_feet_and_knobs_are_none(tmp_path):
    feet = {f"f{x}{y}": solid((x, y, -0.05), (x + 0.04, y + 0.04, 0)) for x in (0.05, 0.7) for y in (0.05, 0.4)}
    cushion = solid((0.01, 0.01, H + 0.03), (W - 0.01, D - 0.01, H + 0.1))
    knob = solid((0.38, -0.03, H + 0.005), (0.42, -0.011, H + 0.025))
    (lid,) = lids(tmp_path, Cube=plate(), a=cushion, b=knob, c=tub(), **feet)

    assert float(lid.box.high[2] - lid.box.low[2]) == pytest.approx(0.1, abs=1e-6)


LOOK_ALIKES = {
    "a top on a solid body": {"a": plate(), "b": solid((0, 0, 0), (W, D, H))},
    "a top that stands out all round": {"a": plate(over=0.06), "b": tub()},
    "a thick mattress": {"a": plate(thick=0.4), "b": tub()},
    "a board over the floor of a crate": {"a": plate(over=-0.021, low=0.3), "b": tub()},
    "a seat before a back": {"a": plate(), "b": tub(), "back": solid((0, D + 0.02, 0), (W, D + 0.06, 0.85))},
    "a top above the body": {"a": plate(low=H + 0.05), "b": tub()},
    "a case with a door": {"a": plate(), **boards(back=0.006)},
    "a case with two doors": {
        "a": plate(),
        **{name: mesh for name, mesh in boards().items() if name != "Cube_1"},
        "l": solid((0, 0, 0), (W / 2 - 0.001, 0.02, H)),
        "r": solid((W / 2 + 0.001, 0, 0), (W, 0.02, H)),
    },
    "an open case": {"a": plate(), **{name: mesh for name, mesh in boards().items() if name != "Cube_1"}},
    "an open case in one object": {
        "a": plate(),
        "b": trimesh.util.concatenate([mesh for name, mesh in boards().items() if name != "Cube_1"]),
    },
    "a top on legs": {
        "a": plate(),
        **{f"l{x}{y}": solid((x, y, 0), (x + 0.05, y + 0.05, H)) for x in (0, 0.75) for y in (0, 0.45)},
    },
    "a body with an inner floor near its rim": {"a": plate(), "b": tub(low=0.3), "c": solid((0, 0, 0), (W, D, 0.3))},
}


@pytest.mark.parametrize("what", LOOK_ALIKES)
def test_other_plates_are_no_lids(tmp_path, what):
    assert lids(tmp_path, **LOOK_ALIKES[what]) == []


@pytest.mark.parametrize(("scale", "is_lid"), [(1.0, True), (1.9, False), (2.3, False)])
def test_what_is_as_high_as_a_cupboard_or_as_long_as_a_bed_has_none(tmp_path, scale, is_lid):
    size = (scale, 1.0, 1.0) if scale > 2 else (1.0, 1.0, scale if scale == 1 else 2.1)
    meshes = {"a": plate(), "b": tub()}
    for mesh in meshes.values():
        mesh.apply_scale(size)
    assert bool(lids(tmp_path, **meshes)) is is_lid


@pytest.mark.parametrize(("is_one", "is_lid"), [(True, True), (False, False)], ids=["a bin", "a locker of boards"])
def test_a_slender_bin_may_be_as_high_as_a_cupboard(tmp_path, is_one, is_lid):
    meshes = {"a": plate(), **({"b": tub()} if is_one else boards())}
    for mesh in meshes.values():
        mesh.apply_scale((0.6, 1.0, 2.3))

    assert bool(lids(tmp_path, **meshes)) is is_lid


def test_a_domed_lid_may_be_almost_half_as_high_as_the_chest(tmp_path):
    assert lids(tmp_path, a=plate(thick=0.35), b=tub()) != []
    assert lids(tmp_path, a=plate(thick=0.45), b=tub()) == []


def test_names_tell_first(tmp_path):
    assert lids(tmp_path, name="coffee_table", a=plate(), b=tub()) == []
    assert lids(tmp_path, top_panel=plate(), b=tub()) == []
    assert lids(tmp_path, a=plate(), b=tub(), door=solid((0.1, -0.02, 0.1), (0.7, 0.0, 0.4))) == []


@pytest.mark.parametrize("top", ["lid", "Cube"])
def test_the_walls_below_a_lid_are_no_doors_unless_a_handle_sits_on_one(tmp_path, top):
    walls = {"Cube_1", "Cube_2", "Cube_3", "Cube_4"}
    bare = {p.source.name: p.label for p in read(tmp_path, **{top: plate()}, **boards())}
    handle = solid((0.3, -0.03, 0.3), (0.5, 0.0, 0.32))
    held = {p.source.name: p.label for p in read(tmp_path, **{top: plate()}, handle=handle, **boards())}

    assert {bare[name] for name in walls} == {PartLabel.SIDE_PANEL}
    assert held["Cube_1"] is PartLabel.UNKNOWN
    assert held["Cube_2"] is PartLabel.SIDE_PANEL


def test_walls_stay_what_they_are_where_something_else_is_a_door(tmp_path):
    door = solid((0.1, -0.02, 0.1), (0.7, 0.0, 0.4))
    parts = read(tmp_path, lid=plate(), cabinet_door=door, **boards())

    assert {p.label for p in parts if p.source.name == "Cube_2"} == {PartLabel.UNKNOWN}


@pytest.mark.parametrize(("labels", "label"), [("none", PartLabel.DOOR), ("input", PartLabel.UNKNOWN)])
def test_of_what_its_maker_divided_labels_tell_unless_they_are_hidden(labels, label):
    boxes = [box("a", (-0.01, -0.01, H), (W + 0.01, D + 0.01, H + 0.03))]
    boxes += [box("b", (0.0, 0.0, 0.0), (W, D, H))]
    shell = TriangleMesh(np.array(tub().vertices), np.array(tub().faces))
    parts = (boxes[0], replace(boxes[1], surfaces=(replace(boxes[1].surfaces[0], mesh=shell),)))
    parts = tuple(replace(part, labelled_by="name") for part in parts)
    reading = Reading("partnet-mobility", parts, Convention("made", up="+Z", front="-Y", unit=1.0))
    made = settled(reading, "piece", Path("piece"), LoadOptions(labels=labels))

    assert made.part("a").label is label


def test_where_no_name_tells_anything_shape_tells_of_what_its_maker_divided(tmp_path):
    visual = '<visual><geometry><mesh filename="{}.obj"/></geometry></visual>'
    links = "".join(f'<link name="link_{k}">{visual.format(k)}</link>' for k in range(2))
    fixed = '<joint name="j" type="fixed"><parent link="link_0"/><child link="link_1"/></joint>'
    (tmp_path / "piece.urdf").write_text(f'<robot name="piece">{links}{fixed}</robot>')
    tub().export(tmp_path / "0.obj")
    plate().export(tmp_path / "1.obj")

    assert [part.label for part in load_asset(tmp_path / "piece.urdf").parts] == [PartLabel.SIDE_PANEL, PartLabel.DOOR]


def leaning(degrees, low):
    """A lid turned about its lower edge at the back."""
    mesh = plate()
    turn = trimesh.transformations.rotation_matrix(-np.radians(degrees), [1, 0, 0], [0, D, low])
    return mesh.apply_translation([0, 0, low - H]).apply_transform(turn)


@pytest.mark.parametrize(("low", "count"), [(H, 1), (H + 0.1, 0)], ids=["on the body", "above it"])
@pytest.mark.parametrize("degrees", [40, 75])
def test_a_lid_that_is_drawn_open_is_one_where_it_would_close_the_body(tmp_path, degrees, low, count):
    assert len(lids(tmp_path, a=leaning(degrees, low), b=tub())) == count


def test_a_panel_before_the_wall_of_a_tub_is_of_it(tmp_path):
    panel = solid((0.02, -0.008, 0.03), (W - 0.02, 0, H - 0.01))

    assert [part.source.name for part in lids(tmp_path, a=plate(), b=tub(), c=panel)] == ["a"]


@pytest.mark.parametrize(("called", "label"), [("Lid", PartLabel.SIDE_PANEL), ("Cube", PartLabel.UNKNOWN)])
def test_a_wall_that_was_cut_from_its_object_is_no_door_where_a_name_tells_of_the_lid(tmp_path, called, label):
    """Without such a name it may be the door of a case with a top."""
    wall, high, side = 0.05, 0.8, W - 0.05
    walls = [
        solid((0, 0, 0), (wall, D, high)),
        solid((side, 0, 0), (W, D, high)),
        solid((wall, 0, 0), (side, D, wall)),
        solid((wall, D - wall, wall), (side, D, high)),
        solid((wall, 0, wall), (side, wall, high)),
    ]
    parts = read(tmp_path, Cabinet=trimesh.util.concatenate(walls), **{called: plate(low=high + 0.003)})

    assert {part.id: part.label for part in parts}["Cabinet_front"] is label


def test_a_lid_may_reach_into_its_body_as_a_plug_or_around_it_as_a_cap(tmp_path):
    plug = trimesh.util.concatenate([plate(), solid((0.06, 0.06, H - 0.03), (W - 0.06, D - 0.06, H))])
    cap = trimesh.util.concatenate([plate(), solid((-0.01, -0.01, H - 0.03), (W + 0.01, -0.001, H))])
    for lid in (plug, cap):
        (found,) = lids(tmp_path, Cube=lid, Cube_9=tub())
        assert float(found.box.low[2]) == pytest.approx(H - 0.03, abs=1e-6)
    assert not lids(tmp_path, Cube=solid((-0.01, -0.01, H - 0.15), (W + 0.01, D + 0.01, H + 0.03)), Cube_9=tub())


def test_the_body_below_a_lid_is_no_drawer(tmp_path):
    bodies = [read(tmp_path, Cube=plate(), Cube_9=tub()), read(tmp_path, "trunk", Cube=plate(), Cube_9=tub())]
    for parts in bodies:
        (body,) = (part for part in parts if part.source.name == "Cube_9")
        assert (body.label, body.labelled_by) == (PartLabel.SIDE_PANEL, "shape")


def test_a_handle_above_a_wall_is_that_of_the_lid(tmp_path):
    front = solid((0, 0, 0), (W, 0.02, H))
    walls = {**boards(), "Cube_1": front}
    on_lid = solid((W / 2 - 0.05, -0.03, H + 0.005), (W / 2 + 0.05, -0.01, H + 0.02))
    on_wall = on_lid.copy().apply_translation((0, 0.01, -0.1))
    for handle, label in ((on_lid, PartLabel.SIDE_PANEL), (on_wall, PartLabel.UNKNOWN)):
        parts = read(tmp_path, lid=plate(), handle=handle, **walls)
        assert {p.label for p in parts if p.source.name == "Cube_1"} == {label}
