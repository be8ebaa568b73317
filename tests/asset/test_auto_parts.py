"""`parts="auto"`: an input is cut where it hides doors or drawers; what is divided already is read as it is."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.asset.cutting import cut_where_fronts_appear
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import IDENTITY_FRAME, Part, PartSource
from grafu.asset.reading import Convention, Reading
from grafu.errors import UnsegmentedAsset
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.vocabulary import PartLabel
from small_assets import CABINET, DOOR, DRAWER, mesh_of, write_grouped_obj, write_obj_folder, write_pnm

AUTO = LoadOptions(up="+Z", front="-Y", scale=1.0)
FRONTS = (DOOR[0], "drawer_front-9")
CASE = [name for name in CABINET if name not in (*DOOR, *DRAWER)]


def welded(names=tuple(CABINET), label=PartLabel.UNKNOWN, name="body"):
    """A part with a surface for each board, with a material and texture coordinates of its own."""
    meshes = [mesh_of(n) for n in names]
    uvs = [mesh.vertices[:, [0, 2]].copy() for mesh in meshes]
    surfaces = tuple(Surface(m, Material(n), uv) for n, m, uv in zip(names, meshes, uvs, strict=True))
    return Part(name, label, surfaces, PartSource(name), "name" if label is not PartLabel.UNKNOWN else "none")


def cut(*parts, kind="mesh file"):
    return cut_where_fronts_appear(Reading(kind, parts, Convention("test")), IDENTITY_FRAME)


@pytest.mark.parametrize("suffix", ["stl", "obj", "ply", "glb"])
def test_one_mesh_of_any_format_gives_its_fronts_and_handles(tmp_path, suffix):
    path = tmp_path / f"welded.{suffix}"
    merge_meshes([mesh_of(name) for name in CABINET]).to_trimesh().export(path)
    found = load_asset(path, AUTO)

    sizes = [np.round(p.box.size, 4).tolist() for p in found.parts]
    assert len(found.parts) == 5
    assert all(np.round(mesh_of(name).box.size, 4).tolist() in sizes for name in (*FRONTS, "handle-8", "handle-11"))
    assert {p.label for p in found.parts} == {PartLabel.UNKNOWN}
    assert any("was cut into 2 fronts, 2 handles and the rest (--parts auto)" in note for note in found.notes)
    with pytest.raises(UnsegmentedAsset):
        load_asset(path, replace(AUTO, parts="input"))


def test_ids_say_what_was_cut_from_what_and_other_parts_keep_theirs():
    other = replace(welded((CASE[0],)), id="body_front", source=PartSource("body_front"))
    found = cut(welded(), other)

    assert [p.id for p in found.parts] == [
        "body",
        "body_front_2",
        "body_front_3",
        "body_handle",
        "body_handle_2",
        "body_front",
    ]
    assert {p.source.name for p in found.parts[:5]} == {"body"}


def test_materials_and_texture_coordinates_go_with_their_faces():
    found = {p.id: p for p in cut(welded()).parts}

    assert sorted(s.material.name for s in found["body"].surfaces) == sorted([*CASE, "drawer_bottom-10"])
    fronts = [s.material.name for name in ("body_front", "body_front_2") for s in found[name].surfaces]
    assert sorted(fronts) == sorted(FRONTS)
    for part in found.values():
        for surface in part.surfaces:
            assert np.array_equal(surface.uv, surface.mesh.vertices[:, [0, 2]])


@pytest.mark.parametrize("write", [write_grouped_obj, write_obj_folder, write_pnm])
def test_what_is_divided_already_is_read_as_it_is(tmp_path, write):
    path = write(tmp_path / "c.obj")
    plain, auto = load_asset(path, replace(AUTO, parts="input")), load_asset(path, AUTO)

    assert auto.parts == plain.parts
    assert auto.notes == plain.notes


def test_segmented_inputs_and_named_panels_are_left_alone():
    assert cut(welded(), kind="partnet-mobility").parts == (welded(),)
    panel, other = welded(label=PartLabel.SIDE_PANEL, name="side_panel"), welded((CASE[0],), name="other")
    assert cut(panel, other).parts == (panel, other)


@pytest.mark.parametrize("label", [PartLabel.SIDE_PANEL, PartLabel.LEG, PartLabel.SHELF])
def test_what_is_all_of_a_piece_is_cut_whatever_board_its_name_means(label):
    alone = replace(welded(label=label, name="Cabinet_leg"), labelled_by="name")
    found = cut(alone)
    assert sum(part.id.startswith("Cabinet_leg_front") for part in found.parts) == 2
    assert label not in {part.label for part in found.parts}
    assert len(cut(replace(alone, labelled_by="annotation")).parts) == (1 if label is not PartLabel.SHELF else 5)


def test_shelves_that_are_a_whole_case_are_cut_and_a_board_called_shelf_is_not():
    shelves = cut(welded(label=PartLabel.SHELF, name="shelves"), welded((CASE[0],), name="other"))
    assert sum(p.id.startswith("shelves_front") for p in shelves.parts) == 2

    board = welded(FRONTS, PartLabel.SHELF, "shelf")
    assert [p.id for p in cut(board, welded((CASE[0],))).parts] == ["shelf", "body"]


def test_a_robot_of_several_links_is_left_alone_and_one_of_one_link_is_not():
    body, other = welded(), welded((CASE[0],), name="other")
    links = [replace(p, source=PartSource(p.id, link=link)) for p, link in ((body, "base"), (other, "arm"))]
    single = replace(body, source=PartSource("body", link="base"))

    assert cut(*links, kind="urdf").parts == tuple(links)
    assert len(cut(single, kind="urdf").parts) == 5


def test_what_rode_on_a_cut_object_rides_on_nothing_until_contact_says_on_what():
    handle = replace(welded(("handle-8",), PartLabel.HANDLE, "handle"), carried_by="doors")
    found = {
        p.id: p for p in cut(welded([n for n in CABINET if n != "handle-8"], PartLabel.DOOR, "doors"), handle).parts
    }

    assert found["handle"].carried_by is None
    assert found["handle"].surfaces == handle.surfaces


def test_fronts_of_what_is_called_doors_are_doors_and_the_rest_is_not():
    found = {p.id: p.label for p in cut(welded(label=PartLabel.DOOR, name="doors")).parts}

    assert found["doors"] is PartLabel.UNKNOWN
    assert found["doors_front"] is found["doors_front_2"] is PartLabel.DOOR
    assert found["doors_handle"] is PartLabel.UNKNOWN


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (
            CASE,
            "none of its 6 shells looks like the front of a door or drawer, and none is drawn on it along its creases, "
            "materials and texture islands; --parts loose makes parts of its 6 shells",
        ),
        (
            CASE[:1],
            "it is one connected shell, in which no front of a door or drawer is found: none is drawn on it along its "
            "creases, materials and texture islands; divide it first",
        ),
    ],
)
def test_one_mesh_without_a_front_is_refused_naming_what_was_tried(tmp_path, names, said):
    path = tmp_path / "case.stl"
    merge_meshes([mesh_of(name) for name in names]).to_trimesh().export(path)
    with pytest.raises(UnsegmentedAsset, match=said):
        load_asset(path, AUTO)


def test_a_body_that_is_labelled_by_its_name_is_cut_and_stays_what_it_is():
    found = cut(welded(label=PartLabel.SIDE_PANEL, name="Fridge"))

    assert next(part for part in found.parts if part.id == "Fridge").label is PartLabel.SIDE_PANEL
    assert len(found.parts) > 3


@pytest.mark.parametrize(("height", "label"), [(2.0, PartLabel.SIDE_PANEL), (0.5, PartLabel.UNKNOWN)])
def test_the_rest_of_a_case_beside_a_larger_one_is_its_body_and_no_drawer_between_others(height, label):
    tall = [Surface(mesh_of(CASE[0]).transformed(np.diag([30.0, 1.0, height, 1.0])))]
    found = cut(welded(), replace(welded(), id="tall", source=PartSource("tall"), surfaces=tuple(tall)))

    assert found.parts[0].id == "body"
    assert (found.parts[0].label, found.parts[0].labelled_by) == (label, "shape" if height > 1 else "none")


@pytest.mark.parametrize("name", ["wardrobe", "oficina_armario"])
def test_a_shallow_case_that_is_called_what_it_is_gets_cut_and_a_front_that_is_called_so_does_not(name):
    shallow = np.diag([1.0, 0.4, 1.0, 1.0])
    whole = welded(label=PartLabel.SIDE_PANEL, name=name)
    whole = replace(whole, surfaces=tuple(surface.transformed(shallow) for surface in whole.surfaces))
    assert whole.box.size[1] < 0.25 * whole.box.size[0]
    front = welded(FRONTS, PartLabel.SIDE_PANEL, name)

    assert sum("_front" in part.id for part in cut(whole, welded((CASE[0],), name="other")).parts) == 2
    assert [part.id for part in cut(front, welded(CASE)).parts] == [name, "body"]


@pytest.mark.parametrize(
    ("part", "model", "is_door"),
    [
        ("oven", "", True),
        ("Object_7", "double_oven", True),
        ("Backofen", "", True),
        ("Object_7", "kitchen", False),
        ("cabinet", "", False),
    ],
)
def test_high_fronts_of_appliances_are_doors_and_low_ones_are_left_open(part, model, is_door):
    reading = Reading("mesh file", (welded(name=part),), Convention("test"))
    found = cut_where_fronts_appear(reading, IDENTITY_FRAME, model)

    high, low = (mesh_of(name).box.size for name in FRONTS)
    labels = {tuple(np.round(p.box.size, 4)): p.label for p in found.parts}
    assert high[2] > 0.5 * high[0]
    assert low[2] < 0.5 * low[0]
    assert labels[tuple(np.round(high, 4))] is (PartLabel.DOOR if is_door else PartLabel.UNKNOWN)
    assert labels[tuple(np.round(low, 4))] is PartLabel.UNKNOWN


def front(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


OVEN = [
    front((-0.3, 0.0, 0.0), (0.3, 0.4, 0.02)),
    front((-0.3, 0.0, 0.38), (0.3, 0.4, 0.4)),
    front((-0.3, 0.0, 0.02), (-0.28, 0.4, 0.38)),
    front((0.28, 0.0, 0.02), (0.3, 0.4, 0.38)),
    front((-0.28, 0.38, 0.02), (0.28, 0.4, 0.38)),
]


@pytest.mark.parametrize(
    ("name", "label"), [("microwave", PartLabel.MISC), ("MicrowaveFactory", PartLabel.MISC), ("oven", PartLabel.DOOR)]
)
def test_a_microwave_has_one_door_and_the_front_beside_it_is_its_panel(name, label):
    door, panel = front((-0.3, -0.02, 0.0), (0.15, 0.0, 0.4)), front((0.152, -0.02, 0.0), (0.3, 0.0, 0.4))
    whole = Part(name, PartLabel.UNKNOWN, (Surface(merge_meshes([*OVEN, door, panel])),), PartSource(name), "none")
    found = cut(whole).parts
    labels = {round(float(p.box.size[0]), 3): p.label for p in found if p.box.size[1] < 0.03}
    assert labels == {0.45: PartLabel.DOOR, 0.148: label}


@pytest.mark.parametrize(("name", "is_cut"), [("roundDoorFrame", False), ("doorway_2", False), ("door_cabinet", True)])
def test_in_the_frame_of_a_door_there_are_no_fronts(name, is_cut):
    reading = Reading("mesh file", (welded(name="Object_7"),), Convention("test"))
    assert (len(cut_where_fronts_appear(reading, IDENTITY_FRAME, name).parts) > 1) is is_cut


@pytest.mark.parametrize(
    ("body", "by", "is_cut"), [("oven", "name", False), ("oven", "none", True), ("case", "name", True)]
)
def test_an_appliance_that_has_its_door_as_an_object_hides_no_more_fronts(body, by, is_cut):
    """What else looks like fronts on it are panels of knobs."""
    away = trimesh.transformations.translation_matrix((5.0, 0.0, 0.0))
    leaf = welded((FRONTS[0],), PartLabel.DOOR if by == "name" else PartLabel.UNKNOWN, "leaf")
    leaf = replace(leaf, labelled_by=by, surfaces=tuple(s.transformed(away) for s in leaf.surfaces))
    found = cut(welded(name=body), leaf).parts
    assert (len(found) > 2) is is_cut


def test_handles_of_fronts_that_were_cut_are_split_between_them(tmp_path):
    """One mesh holds both handles, another the case with its fronts."""
    rest = [mesh_of(name) for name in CABINET if not name.startswith("handle")]
    handles = [mesh_of(name) for name in CABINET if name.startswith("handle")]
    scene = trimesh.Scene()
    for name, meshes in (("fridge", rest), ("handles", handles)):
        scene.add_geometry(merge_meshes(meshes).to_trimesh(), node_name=name, geom_name=name)
    path = tmp_path / "fridge.glb"
    scene.export(path)

    found = load_asset(path, AUTO)

    parts = {part.id: part for part in found.parts}
    assert {part.carried_by for part in parts.values() if part.label is PartLabel.HANDLE} >= {"fridge_front"}


def test_objects_without_names_that_are_one_drawer_are_joined(tmp_path):
    """The boards of a drawer in a GLB, each an object called `Cube`; with names that tell, nothing is joined."""
    boards = {
        "left": ((-0.37, -0.18, 0.65), (-0.36, 0.15, 0.90)),
        "right": ((0.36, -0.18, 0.65), (0.37, 0.15, 0.90)),
        "back": ((-0.36, 0.14, 0.65), (0.36, 0.15, 0.90)),
    }
    meshes = [
        *(mesh_of(n) for n in CABINET),
        *(TriangleMesh.box_mesh(Box(np.array(a), np.array(b))) for a, b in boards.values()),
    ]

    def read(names, **options):
        scene = trimesh.Scene()
        for name, mesh in zip(names, meshes, strict=True):
            scene.add_geometry(mesh.to_trimesh(), node_name=name, geom_name=name)
        scene.export(tmp_path / "cabinet.glb")
        return load_asset(tmp_path / "cabinet.glb", replace(AUTO, **options))

    nameless = [f"Cube.{k:03}" for k in range(len(meshes))]
    found = read(nameless)
    front = next(p for p in found.parts if p.source.name == "Cube.008")

    assert front.box.size[1] == pytest.approx(0.35)
    assert len(found.parts) == len(meshes) - 4
    assert any("joined to Cube.008" in note for note in found.notes)
    assert len(read(nameless, parts="input").parts) == len(meshes)
    assert len(read([*CABINET, *(f"side_panel_{name}" for name in boards)]).parts) == len(CABINET) - 1 + len(boards)


TUB = [
    ((-0.5, -0.3, 0.0), (0.5, -0.28, 0.58)),
    ((-0.5, 0.28, 0.0), (0.5, 0.3, 0.58)),
    ((-0.5, -0.28, 0.0), (-0.48, 0.28, 0.58)),
    ((0.48, -0.28, 0.0), (0.5, 0.28, 0.58)),
    ((-0.48, -0.28, 0.0), (0.48, 0.28, 0.02)),
]
SEAL, COVER = ((-0.49, -0.29, 0.58), (0.49, 0.29, 0.585)), ((-0.5, -0.3, 0.585), (0.5, 0.3, 0.62))
GRIP = ((-0.1, -0.33, 0.6), (0.1, -0.3, 0.615))
LOCK = ((-0.05, -0.31, 0.4), (0.05, -0.3, 0.5))
BLOCK = ((-0.5, -0.3, 0.0), (0.5, 0.3, 0.57))
STRAPS = [((x, -0.306, 0.0), (x + 0.08, -0.3, 0.56)) for x in (-0.3, 0.22)]
DRAWERS = [((-0.48, -0.3, z), (0.48, -0.28, z + 0.26)) for z in (0.03, 0.3)]
KNOBS = [((-0.02, -0.33, z), (0.02, -0.3, z + 0.04)) for z in (0.14, 0.41)]


@pytest.mark.parametrize(
    ("model", "objects", "has_lid"),
    [
        ("chest_freezer", [[*TUB, SEAL, COVER, GRIP]], True),
        ("toy chest", [TUB, [SEAL], [COVER]], True),
        ("chest", [TUB, [SEAL]], True),
        ("chest", [TUB], False),
        ("chest_of_drawers", [[*TUB, COVER]], False),
        ("box", [[*TUB, COVER]], False),
        ("old chest", [TUB, [LOCK], [COVER]], True),
        ("old trunk", [[BLOCK, *STRAPS], [COVER]], True),
        ("old chest", [TUB[1:], *([one] for one in (*DRAWERS, *KNOBS)), [COVER]], False),
    ],
)
def test_what_is_called_a_chest_gets_the_lid_that_covers_it(model, objects, has_lid):
    boards = [[TriangleMesh.box_mesh(Box(np.array(a), np.array(b))) for a, b in one] for one in objects]
    parts = tuple(
        Part(f"cube_{k}", PartLabel.UNKNOWN, (Surface(merge_meshes(one)),), PartSource(f"cube_{k}"))
        for k, one in enumerate(boards)
    )
    found = cut_where_fronts_appear(Reading("mesh file", parts, Convention("test")), IDENTITY_FRAME, model)

    lids = [part for part in found.parts if part.label is PartLabel.DOOR]
    assert len(lids) == has_lid
    if has_lid and any(COVER in one for one in objects):
        assert lids[0].id.endswith("_lid")
        assert lids[0].box.low[2] == pytest.approx(COVER[0][2])
        assert (lids[0].box.low[1] == pytest.approx(GRIP[0][1])) == (GRIP in objects[0])


CASING = [
    *(((x, -0.3, 0.0), (x + 0.02, 0.3, 0.8)) for x in (-0.3, 0.28)),
    ((-0.28, 0.28, 0.0), (0.28, 0.3, 1.0)),  # the panel of its controls stands behind, above the lid
    ((-0.28, -0.3, 0.0), (0.28, -0.28, 0.8)),
    ((-0.28, -0.28, 0.0), (0.28, 0.28, 0.02)),
]
SERVICE = ((-0.25, -0.305, 0.05), (0.25, -0.29, 0.75))
PORTHOLE = ((-0.18, -0.31, 0.25), (0.18, -0.29, 0.6))
KNOB = ((-0.02, 0.2, 0.85), (0.02, 0.28, 0.9))
SET_IN, TOP_PLATE = ((-0.25, -0.25, 0.78), (0.25, 0.15, 0.8)), ((-0.31, -0.31, 0.8), (0.31, 0.31, 0.83))


@pytest.mark.parametrize(
    ("model", "boards", "has_lid"),
    [
        ("washing_machine", [*CASING, SERVICE, SET_IN, KNOB], True),
        ("Waschmaschine 3", [*CASING, SET_IN], True),
        ("washing_machine", [*CASING, PORTHOLE, SET_IN, KNOB], False),
        ("washing_machine", [*CASING, SERVICE, TOP_PLATE], False),
        ("dishwasher", [*CASING, SERVICE, SET_IN, KNOB], False),
    ],
    ids=["loaded from above", "by its German name", "a door in front", "a top", "a dishwasher"],
)
def test_a_washing_machine_without_a_door_in_front_has_its_lid_on_top(model, boards, has_lid):
    meshes = [TriangleMesh.box_mesh(Box(np.array(a), np.array(b))) for a, b in boards]
    part = Part("body", PartLabel.UNKNOWN, (Surface(merge_meshes(meshes)),), PartSource("Cube"))
    found = cut_where_fronts_appear(Reading("mesh file", (part,), Convention("test")), IDENTITY_FRAME, model)

    lids = [part for part in found.parts if part.id.endswith("_lid")]
    assert len(lids) == has_lid
    if has_lid:
        assert lids[0].box.low == pytest.approx(SET_IN[0])
        assert lids[0].box.high == pytest.approx(SET_IN[1])
        assert [part.label for part in found.parts].count(PartLabel.DOOR) == 1


@pytest.mark.parametrize(
    ("model", "beside", "height", "fronts"),
    [
        ("captains-bed", "Cube.002", 1.0, 0),  # as wide as the bed and high: its footboard
        ("model_7", "mattress", 1.0, 0),
        ("model_7", "Cube.002", 1.0, 2),
        ("captains-bed", "Cube.002", 0.5, 2),  # low: drawers below a bed
    ],
)
def test_the_boards_at_the_ends_of_a_bed_are_no_fronts(model, beside, height, fronts):
    low = np.diag([1.0, 1.0, height, 1.0])
    body = replace(welded(), surfaces=tuple(surface.transformed(low) for surface in welded().surfaces))
    other = replace(welded((CASE[0],)), id="beside", source=PartSource(beside))
    found = cut_where_fronts_appear(Reading("mesh file", (body, other), Convention("test")), IDENTITY_FRAME, model)
    assert sum("_front" in part.id for part in found.parts) == fronts
    faces = sum(len(part.mesh.faces) for part in found.parts)
    assert faces == len(body.mesh.faces) + len(other.mesh.faces)
