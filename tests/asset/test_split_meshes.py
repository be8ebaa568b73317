"""A mesh that an exporter parted by material is one object again; what the user numbered or grouped is not."""

import json
import struct
from pathlib import Path

import pytest
import trimesh

from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions

SAMPLES = Path(__file__).parents[2] / "samples"
AS_WRITTEN = LoadOptions(up="+Z", front="-Y", scale=1.0, parts="input")
OAK, GLASS, RED = "oak", "glass", "red"
COLOURS = {OAK: (180, 140, 90, 255), GLASS: (200, 220, 230, 90), RED: (200, 30, 30, 255)}
FRAME = [((0.0, 0.0, 0.0), (0.4, 0.02, 0.6))]
PANE = [((0.05, 0.005, 0.05), (0.35, 0.015, 0.55))]


def with_pieces(path, ending, grouped):
    """The sample with each primitive of a mesh in a node of its own: below the mesh's node, or beside it."""
    data = (SAMPLES / "sideboard.glb").read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document, binary = json.loads(data[20 : 20 + length]), data[20 + length :]
    nodes, meshes = document["nodes"], document["meshes"]
    root = next(node for node in nodes if "children" in node)
    for index in list(root["children"]):
        primitives = meshes[nodes[index]["mesh"]]["primitives"]
        if len(primitives) == 1:
            continue
        pieces = []
        for number, primitive in enumerate(primitives):
            material = document["materials"][primitive["material"]]["name"]
            name = nodes[index]["name"] + ending.format(
                number, number + 1, material.replace(" ", "_"), 0x1B6A32 + number
            )
            meshes.append({"primitives": [primitive]})
            nodes.append({"name": name, "mesh": len(meshes) - 1})
            pieces.append(len(nodes) - 1)
        if grouped:
            del nodes[index]["mesh"]
            nodes[index]["children"] = pieces
        else:
            at = root["children"].index(index)
            root["children"][at : at + 1] = pieces
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunk = struct.pack("<II", len(text), 0x4E4F534A) + text
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunk) + len(binary)) + chunk + binary)
    return path


@pytest.mark.parametrize(
    ("ending", "grouped"),
    [("_{1}", True), ("-{0}", True), ("-{0}", False), ("_{3:06x}", True), ("_{3:06x}", False), ("_{2}_0", True)],
    ids=["three.js", "Assimp FBX", "Assimp OBJ", "trimesh", "trimesh, flat", "Sketchfab"],
)
def test_what_an_exporter_parted_is_the_same_furniture(tmp_path, ending, grouped):
    one = load_asset(SAMPLES / "sideboard.glb", AS_WRITTEN)
    other = load_asset(with_pieces(tmp_path / "sideboard.glb", ending, grouped), AS_WRITTEN)

    assert sorted((p.id, p.label, len(p.mesh.faces)) for p in other.parts) == sorted(
        (p.id, p.label, len(p.mesh.faces)) for p in one.parts
    )


def test_what_trimesh_read_and_wrote_is_the_same_furniture(tmp_path):
    trimesh.load_scene(SAMPLES / "sideboard.glb").export(tmp_path / "sideboard.glb")
    one, other = (load_asset(at / "sideboard.glb", AS_WRITTEN) for at in (SAMPLES, tmp_path))

    assert sorted((p.id, p.label) for p in other.parts) == sorted((p.id, p.label) for p in one.parts)


def named(tmp_path, above, *pieces):
    """The names of the parts of objects (name, boxes, material) below a node, or below none."""
    scene = trimesh.Scene()
    if above:
        scene.graph.update(frame_to=above, frame_from="world")
    for name, boxes, colour in pieces:
        mesh = trimesh.util.concatenate([trimesh.creation.box(bounds=box) for box in boxes])
        material = trimesh.visual.material.PBRMaterial(name=colour, baseColorFactor=COLOURS[colour])
        mesh.visual = trimesh.visual.TextureVisuals(material=material)
        scene.add_geometry(mesh, node_name=name, geom_name=name, parent_node_name=above or None)
    scene.add_geometry(trimesh.creation.box(bounds=((0, 1, 0), (2, 1.1, 1))), node_name="back", geom_name="back")
    scene.export(tmp_path / "piece.glb")
    names = [part.source.name for part in load_asset(tmp_path / "piece.glb", AS_WRITTEN).parts]
    return [name for name in names if name != "back"]


def test_a_frame_and_the_pane_in_it_are_the_door_that_stands_above_them(tmp_path):
    assert named(tmp_path, "door", ("door_1", FRAME, OAK), ("door_2", PANE, GLASS)) == ["door"]


def test_pieces_that_three_js_calls_after_the_mesh_are_the_node_above_them(tmp_path):
    knob = [((0.36, -0.02, 0.3), (0.38, 0.0, 0.32))]
    pieces = ("Cube003", FRAME, OAK), ("Cube003_1", PANE, GLASS), ("Cube003_2", knob, RED)

    assert named(tmp_path, "Door", *pieces) == ["Door"]


@pytest.mark.parametrize("colours", [(OAK, OAK), (OAK, RED)])
def test_doors_in_a_group_that_three_js_could_have_named_stay_doors(tmp_path, colours):
    """Two of one material, and two that are alike but for it."""
    assert named(tmp_path, "doors", *zip(("door", "door_1"), beside(2), colours, strict=True)) == ["door", "door_1"]


def beside(count):
    return [[((0.5 * k, 0.0, 0.0), (0.5 * k + 0.5, 0.3, 0.2))] for k in range(count)]


@pytest.mark.parametrize("colours", [(OAK, OAK, OAK), (OAK, GLASS, RED)])
@pytest.mark.parametrize("ending", ["_{}", "-{}"])
def test_drawers_that_stand_in_a_group_stay_drawers(tmp_path, colours, ending):
    """Also where they touch, and where each has a colour of its own."""
    names = [f"drawer{ending.format(k)}" for k in range(3)]

    assert named(tmp_path, "drawer", *zip(names, beside(3), colours, strict=True)) == names


def test_doors_that_are_numbered_from_zero_stay_doors(tmp_path):
    names = [f"door-{k}" for k in range(3)]

    assert named(tmp_path, "", *zip(names, beside(3), (OAK,) * 3, strict=True)) == names


def test_numbers_below_a_numbered_node_that_lie_apart_are_objects_of_their_own(tmp_path):
    apart = [[((0.9 * k, 0.0, 0.0), (0.9 * k + 0.5, 0.3, 0.2))] for k in range(2)]

    assert named(tmp_path, "leg_1", ("leg_1_1", apart[0], OAK), ("leg_1_2", apart[1], OAK)) == ["leg_1_1", "leg_1_2"]


@pytest.mark.parametrize("above", ["leg", ""])
@pytest.mark.parametrize("endings", [("facade", "decade"), ("000010", "000011")])
def test_a_word_or_number_of_six_signs_is_not_drawn_by_chance(tmp_path, above, endings):
    names = [f"leg_{ending}" for ending in endings]

    assert named(tmp_path, above, *zip(names, beside(2), (OAK, OAK), strict=True)) == names


def test_neighbours_are_pieces_of_the_mesh_that_their_own_name_begins_with(tmp_path):
    names = ["leg_1_1b6a32", "leg_1_5b6346", "leg_2_0c77de", "leg_2_9a0001", "door_e0e0e1"]

    found = named(tmp_path, "", *zip(names, beside(5), (OAK, GLASS) * 2 + (OAK,), strict=False))

    assert found == ["leg_1", "leg_2", "door_e0e0e1"]


@pytest.mark.parametrize(
    ("endings", "count"), [(("516266", "123456"), 1), (("51626e", "123456"), 1), (("000001", "000002"), 2)]
)
def test_what_trimesh_draws_at_random_may_be_digits_alone(tmp_path, endings, count):
    names = [f"drawer_1_{ending}" for ending in endings]
    assert len(named(tmp_path, "", *zip(names, beside(2), (OAK, OAK), strict=True))) == count
