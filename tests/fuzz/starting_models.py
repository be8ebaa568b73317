"""Small models in every form that is read, made by our own code: what the fuzzer changes."""

import base64
import json
import shutil
import struct
from collections.abc import Callable, Iterable
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from zipfile import ZIP_STORED, ZipFile, ZipInfo

import numpy as np

from collada_documents import collada_text, write_collada
from draco_scenes import write_draco
from fbx_scenes import fbx_bytes, fbx_records, write_fbx
from fuzz.bombs import png_of
from grafu.geometry.mesh import TriangleMesh
from meshopt_scenes import write_meshopt
from robot_models import mjcf_text, sdf_text, write_mjcf, write_sdf
from small_assets import (
    CABINET,
    Y_UP,
    glb_bytes,
    gltf_document,
    mesh_of,
    obj_text,
    write_glb,
    write_grouped_obj,
    write_obj_folder,
    write_pnm,
    write_urdf,
)
from threeds_files import threeds_bytes, write_threeds
from threemf_packages import threemf_bytes, threemf_text, write_threemf
from usd_scenes import scene_of, write_usd

MTL = (
    "newmtl wood\nKd 0.6 0.4 0.2\nNs 20\nd 1.0\nmap_Kd textures/wood.png\n"
    "newmtl steel\nKd 0.7 0.7 0.7\nKs 0.5 0.5 0.5\nTr 0.0\nmap_Kd -s 1 1 1 textures/wood.png\n"
    "map_Bump textures/wood.png\n"
)
PNG = png_of(8, 8, True, 8, 2)
DRAWERS = {"drawer_front-9": "drawer_1_front", "drawer_bottom-10": "drawer_1_bottom", "handle-11": "drawer_1_handle"}
SWEET = {
    "cabinet_door_surface-7": "sweethome3d_opening_on_hinge_1_leaf",
    "handle-8": "sweethome3d_hinge_1_pin",
    "drawer_front-9": "sweethome3d_opening_on_rail_2_front",
    "shelf-6": "sweethome3d_rail_2_runner",
}

Maker = Callable[[Path], str]
"""Writes a model into a folder and returns the entry within it that is given to the command."""


def glb(folder: Path) -> str:
    write_glb(folder / "cabinet.glb")
    return "cabinet.glb"


def _textured() -> tuple[dict, bytes]:
    """Returns a scene with materials, texture coordinates, three kinds of textures, and a door over two meshes."""
    document, binary = gltf_document(list(CABINET))
    uv = np.tile(np.array([[0, 0], [1, 0], [1, 1], [0, 1]], "<f4"), (2, 1)).tobytes()
    document["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(uv)})
    document["accessors"].append(
        {"bufferView": len(document["bufferViews"]) - 1, "componentType": 5126, "count": 8, "type": "VEC2"}
    )
    for mesh in document["meshes"]:
        mesh["primitives"][0]["attributes"]["TEXCOORD_0"] = len(document["accessors"]) - 1
        mesh["primitives"][0]["material"] = 0
    textured = {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 0.9, 0.8, 1], "metallicFactor": 0.1}
    document["materials"] = [
        {"name": "wood", "pbrMetallicRoughness": textured, "normalTexture": {"index": 1}, "alphaMode": "MASK"}
    ]
    document["textures"], document["samplers"] = [{"source": 0, "sampler": 0}, {"source": 1}], [{"wrapS": 10497}]
    document["nodes"] += [{"name": "drawer_1", "children": [8, 9, 10], "translation": [0, 0, 0.01]}]
    document["scenes"] = [{"nodes": [*range(8), 11]}]
    document["animations"] = [{"channels": [], "samplers": []}]
    return document, binary + uv


def glb_textured(folder: Path) -> str:
    document, binary = _textured()
    uri = "data:image/png;base64," + base64.b64encode(PNG).decode()
    document["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(PNG)})
    document["images"] = [
        {"bufferView": len(document["bufferViews"]) - 1, "mimeType": "image/png", "name": "inside"},
        {"uri": uri, "name": "within"},
    ]
    document["buffers"] = [{"byteLength": len(binary) + len(PNG)}]
    (folder / "cabinet.glb").write_bytes(glb_bytes(document, binary + PNG))
    return "cabinet.glb"


def gltf(folder: Path) -> str:
    document, binary = _textured()
    document["images"] = [{"uri": "textures/wood.png"}, {"uri": "textures/wood%20grain.png"}]
    document["buffers"] = [{"byteLength": len(binary), "uri": "scene.bin"}]
    (folder / "textures").mkdir()
    for name in ("wood.png", "wood grain.png"):
        (folder / "textures" / name).write_bytes(PNG)
    (folder / "scene.bin").write_bytes(binary)
    (folder / "scene.gltf").write_text(json.dumps(document))
    return "scene.gltf"


def glb_draco(folder: Path) -> str:
    return write_draco(folder).name


def glb_meshopt(folder: Path) -> str:
    return write_meshopt(folder).name


def _with_materials(path: Path) -> None:
    """Gives an OBJ texture coordinates, a library beside it and pictures below."""
    (path.parent / "textures").mkdir(exist_ok=True)
    (path.parent / "textures" / "wood.png").write_bytes(PNG)
    path.with_suffix(".mtl").write_text(MTL)
    lines = path.read_text().split("\n")
    faces = [
        f"f {' '.join(f'{w}/{k % 4 + 1}' for k, w in enumerate(line[2:].split()))}" for line in lines if line[:1] == "f"
    ]
    given = iter(faces)
    lines = [next(given) if line[:1] == "f" else line for line in lines]
    lines = [
        f"{line}\nusemtl {'steel' if 'handle' in line else 'wood'}" if line[:2] == "g " else line for line in lines
    ]
    coordinates = ["vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1"]
    path.write_text("\n".join([f"mtllib {path.stem}.mtl", *coordinates, *lines]))


def obj(folder: Path) -> str:
    _with_materials(write_grouped_obj(folder / "cabinet.obj", names=DRAWERS))
    return "cabinet.obj"


def obj_folder(folder: Path) -> str:
    write_obj_folder(folder)
    _with_materials(folder / "shelf-6.obj")
    return "."


def stl_folder(folder: Path) -> str:
    for index, name in enumerate(CABINET):
        mesh_of(name).to_trimesh().export(folder / f"{name}.stl", file_type="stl_ascii" if index % 2 else "stl")
    return "."


def ply_folder(folder: Path) -> str:
    for index, name in enumerate(CABINET):
        mesh = mesh_of(name).to_trimesh()
        mesh.visual.vertex_colors = np.full((8, 4), 200, np.uint8)
        mesh.export(folder / f"{name}.ply", encoding="ascii" if index % 2 else "binary")
    return "."


def sweet_home(folder: Path) -> str:
    _with_materials(write_grouped_obj(folder / "cabinet.obj", 100 * Y_UP, SWEET))
    return "cabinet.obj"


def collada(folder: Path) -> str:
    text = collada_text(materials={"shelf-6": "steel", "handle-8": "glass"}, below={"drawer_front-9": "drawer_1"})
    write_collada(folder, text, PNG)
    return "cabinet.dae"


def fbx(folder: Path) -> str:
    looks = {"shelf-6": "steel", "handle-8": "glass"}
    pose = {"RotationActive": 1, "PreRotation": (0.0, 0.0, 90.0), "Lcl_Translation": (0.0, 0.0, 0.1)}
    records = fbx_records(materials=looks, below={"drawer_front-9": "drawer_1"}, poses={"drawer_1": pose}, image=PNG)
    write_fbx(folder, fbx_bytes(records), PNG)
    return "cabinet.fbx"


def threemf(folder: Path) -> str:
    return write_threemf(folder, threemf_bytes(threemf_text(below={"drawer_front-9": "drawer_1"}))).name


def threeds(folder: Path) -> str:
    (folder / "wood.png").write_bytes(PNG)
    looks = {"shelf-6": "pictured", "handle-8": "glass"}
    return write_threeds(folder, threeds_bytes(looks=looks, image="wood.png")).name


def usda(folder: Path) -> str:
    glass = "rel material:binding = </Looks/glass>"
    write_usd(folder, scene_of(back_panel_5="rel material:binding = </Looks/wood>", handle_8=glass), PNG)
    return "cabinet.usda"


def usdz(folder: Path) -> str:
    """The scene and its image in one file: stored, each entry's bytes at a multiple of 64, without the time of day."""
    from pxr import Sdf  # noqa: TID251 the package holds the binary form of what our own code wrote

    usda(folder)
    layer = Sdf.Layer.FindOrOpen(str(folder / "cabinet.usda"))
    layer.Export(str(folder / "cabinet.usdc"))
    stream = BytesIO()
    with ZipFile(stream, "w", ZIP_STORED) as package:
        for name in ("cabinet.usdc", "textures/wood.png"):
            entry = ZipInfo(name)
            spare = -(stream.tell() + 30 + len(name) + 4) % 64
            entry.extra = struct.pack("<HH", 0x1986, spare) + bytes(spare)
            package.writestr(entry, (folder / name).read_bytes())
    shutil.rmtree(folder / "textures")
    for layer_file in folder.glob("cabinet.*"):
        layer_file.unlink()
    (folder / "scene.usdz").write_bytes(stream.getvalue())
    return "scene.usdz"


def urdf(folder: Path) -> str:
    write_urdf(folder)
    path = folder / "cabinet.urdf"
    extra = (
        '<material name="oak"><color rgba="0.6 0.4 0.2 1"/><texture filename="textures/wood.png"/></material>'
        '<link name="knob"><visual><origin rpy="0 0 1.57" xyz="0 0 0.5"/>'
        '<geometry><box size="0.02 0.02 0.02"/></geometry>'
        '<material name="oak"/></visual><visual><geometry><cylinder radius="0.01" length="0.1"/></geometry></visual>'
        '<visual><geometry><sphere radius="0.02"/></geometry></visual></link>'
        '<joint name="knob_joint" type="fixed"><parent link="carcass"/><child link="knob"/></joint></robot>'
    )
    path.write_text(path.read_text().replace("</robot>", extra))
    _with_materials(folder / "meshes" / "shelf-6.obj")
    (folder / "textures").mkdir()
    (folder / "textures" / "wood.png").write_bytes(PNG)
    write_glb(folder / "meshes" / "whole.glb")
    text = path.read_text().replace("meshes/back_panel-5.obj", "package://cabinet/meshes/back_panel-5.obj")
    path.write_text(text.replace('filename="meshes/shelf-6.obj"', 'filename="meshes/shelf-6.obj" scale="1 1 1"'))
    return "cabinet.urdf"


def sdf(folder: Path) -> str:
    looks = (
        "<material><diffuse>0.6 0.4 0.2 1</diffuse><pbr><metal><albedo_map>model://c/textures/wood.png</albedo_map>"
        "</metal></pbr></material>"
    )
    frame = '<frame name="f" attached_to="base"><pose degrees="true">0 0 0.1 0 0 90</pose></frame>'
    write_sdf(folder, sdf_text(frame, looks, ("shelf-6", "handle-8")))
    (folder / "textures").mkdir()
    (folder / "textures" / "wood.png").write_bytes(PNG)
    return "model.sdf"


def mjcf(folder: Path) -> str:
    coupled = '<equality><joint joint1="drawer_joint" joint2="door_joint" polycoef="0 0.2 0 0 0"/></equality>'
    copies = '<replicate count="2" offset="0 0 0.1"><geom name="board" type="box" size="0.3 0.1 0.01"/></replicate>'
    text = mjcf_text(coupled + '<include file="more.xml"/>', ("shelf-6", "handle-8"), within=copies)
    text = text.replace('name="oak"', 'name="oak" texture="wood"')
    write_mjcf(folder, text.replace("<asset>", '<asset><texture name="wood" type="2d" file="textures/wood.png"/>'))
    (folder / "more.xml").write_text(
        "<mujocoinclude><worldbody><geom type='sphere' size='0.1'/></worldbody></mujocoinclude>"
    )
    (folder / "textures").mkdir()
    (folder / "textures" / "wood.png").write_bytes(PNG)
    return "cabinet.xml"


def partnet_mobility(folder: Path) -> str:
    write_pnm(folder)
    (folder / "meta.json").write_text(json.dumps({"model_cat": "StorageFurniture", "anno_id": "1"}))
    _with_materials(folder / "textured_objs" / "shelf-6.obj")
    return "."


def partnet_mobility_urdf(folder: Path) -> str:
    write_urdf(folder)
    (folder / "cabinet.urdf").rename(folder / "mobility.urdf")
    return "mobility.urdf"


def hssd(folder: Path) -> str:
    from grafu.synth.samples import KINDS
    from hssd_models import hssd_model

    hssd_model(KINDS["drop-down flap"](), meshes=2, spare=1).save(folder)
    return "a1b2.glb"


def grouped_text(parts: Iterable[tuple[str, TriangleMesh]]) -> str:
    """Returns an OBJ with an object for each part."""
    text, start = "", 0
    for name, mesh in parts:
        text += f"o {name}\n" + obj_text(mesh, np.eye(3), start)
        start += len(mesh.vertices)
    return text


def plain_obj(folder: Path) -> str:
    """One mesh file beside nothing, for what is read together with a model."""
    (folder / "cabinet.obj").write_text(grouped_text((name, mesh_of(name)) for name in CABINET))
    return "cabinet.obj"


MODELS: dict[str, Maker] = {
    "glb": glb,
    "glb with textures": glb_textured,
    **({"glb with draco": glb_draco} if find_spec("DracoPy") else {}),
    "glb meshopt": glb_meshopt,
    "gltf": gltf,
    "obj": obj,
    "folder of obj": obj_folder,
    "folder of stl": stl_folder,
    "folder of ply": ply_folder,
    "sweet home": sweet_home,
    "collada": collada,
    "fbx": fbx,
    "3mf": threemf,
    "3ds": threeds,
    "usda": usda,
    "usdz": usdz,
    "urdf": urdf,
    "sdf": sdf,
    "mjcf": mjcf,
    "partnet-mobility": partnet_mobility,
    "partnet-mobility urdf": partnet_mobility_urdf,
    "hssd": hssd,
}
