"""Binary FBX files of the small cabinet, written by our own code: materials, texture coordinates, a hierarchy."""

import struct
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from small_assets import AS_IT_IS, CABINET, mesh_of

MATERIALS = {"wood": (0.6, 0.4, 0.2), "steel": (0.5, 0.5, 0.5), "glass": (0.8, 0.9, 0.9)}
MAGIC = b"Kaydara FBX Binary  \x00\x1a\x00"
Record = tuple[str, tuple[Any, ...], tuple[Any, ...]]
"""A name, values and records within; texts are bytes, arrays NumPy's."""


def _value(value: Any) -> bytes:
    if isinstance(value, bytes):
        return b"S" + struct.pack("<I", len(value)) + value
    if isinstance(value, np.ndarray):
        kind = {"f": b"d", "i": b"i"}[value.dtype.kind]
        data = value.astype({b"d": "<f8", b"i": "<i4"}[kind]).tobytes()
        packed = zlib.compress(data) if value.size > 12 else data
        return kind + struct.pack("<III", value.size, int(value.size > 12), len(packed)) + packed
    return b"D" + struct.pack("<d", value) if isinstance(value, float) else b"L" + struct.pack("<q", value)


def _packed(record: Record, at: int, version: int) -> bytes:
    head = struct.Struct("<QQQB" if version >= 7500 else "<IIIB")
    name, values, records = record
    inside = b"".join(map(_value, values))
    start = at + head.size + len(name) + len(inside)
    within = b""
    for below in records:
        within += _packed(below, start + len(within), version)
    within += bytes(head.size) if records else b""
    return head.pack(start + len(within), len(values), len(inside), len(name)) + name.encode() + inside + within


def fbx_bytes(records: tuple[Record, ...], version: int = 7400) -> bytes:
    """Returns the bytes of a file."""
    data = MAGIC + struct.pack("<I", version)
    for record in records:
        data += _packed(record, len(data), version)
    return data + bytes(25)


def _properties(**values: Any) -> Record:
    rows = []
    for name, value in values.items():
        numbers = value if isinstance(value, tuple) else (value,)
        rows.append(("P", (name.replace("_", " ").encode(), b"", b"", b"", *numbers), ()))
    return ("Properties70", (), tuple(rows))


def _layer(kind: str, mapping: bytes, reference: bytes, **arrays: np.ndarray) -> Record:
    within = [("MappingInformationType", (mapping,), ()), ("ReferenceInformationType", (reference,), ())]
    return (kind, (0,), (*within, *((name, (array,), ()) for name, array in arrays.items())))


def _geometry(number: int, name: str, matrix: np.ndarray) -> Record:
    """A mesh of triangles with texture coordinates and one material; the last corner of each is counted from -1."""
    mesh = mesh_of(name)
    corners = mesh.faces[:, ::-1].copy() if np.linalg.det(matrix) < 0 else mesh.faces.copy()
    corners[:, 2] = -1 - corners[:, 2]
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    layers = (
        _layer("LayerElementUV", b"ByPolygonVertex", b"IndexToDirect", UV=uv, UVIndex=np.arange(corners.size) % 4),
        _layer("LayerElementMaterial", b"AllSame", b"IndexToDirect", Materials=np.zeros(1, int)),
    )
    arrays = (("Vertices", (mesh.vertices @ matrix.T,), ()), ("PolygonVertexIndex", (corners,), ()))
    return ("Geometry", (number, name.encode() + b"\0\1Geometry", b"Mesh"), (*arrays, *layers))


def _model(number: int, name: str, kind: bytes, **properties: Any) -> Record:
    return ("Model", (number, name.encode() + b"\0\1Model", kind), (_properties(**properties),))


def fbx_records(
    matrix: np.ndarray = AS_IT_IS,
    up: str = "+Z",
    centimetres: float = 100.0,
    materials: Mapping[str, str] | None = None,
    below: Mapping[str, str] | None = None,
    poses: Mapping[str, Mapping[str, Any]] | None = None,
    image: bytes = b"",
) -> tuple[Record, ...]:
    """Returns the records of the cabinet.

    Args:
        matrix: what the object frame, in metres, is multiplied by.
        up: the axis that points up in the file.
        centimetres: the length of a unit.
        materials: part names to names of materials; the others are `wood`, which has an image.
        below: part names to names of nodes that they hang below.
        poses: properties of models by name.
        image: the image within the file; empty where it lies beside it.
    """
    objects: list[Record] = []
    links: list[tuple[Any, ...]] = [(b"OP", 400, 300, b"DiffuseColor"), (b"OO", 401, 400)]
    for place, (name, color) in enumerate(MATERIALS.items()):
        clear = {"TransparencyFactor": 0.75} if name == "glass" else {}
        looks = _properties(DiffuseColor=color, **clear)
        objects.append(("Material", (300 + place, name.encode() + b"\0\1Material", b""), (looks,)))
    names = (("RelativeFilename", (b"..\\elsewhere\\wood grain.png",), ()), ("FileName", (b"C:\\wood grain.png",), ()))
    objects.append(("Texture", (400, b"wood\0\1Texture", b""), names))
    objects.append(("Video", (401, b"wood\0\1Video", b"Clip"), (("Content", (image,), ()),)))
    groups = list(dict.fromkeys((below or {}).values()))
    for place, name in enumerate(groups):
        objects.append(_model(500 + place, name, b"Null", **(poses or {}).get(name, {})))
        links.append((b"OO", 500 + place, 0))
    for place, name in enumerate(CABINET):
        pose = (poses or {}).get(name, {})
        objects += [_geometry(1000 + place, name, matrix), _model(2000 + place, name, b"Mesh", **pose)]
        above = 500 + groups.index(below[name]) if below and name in below else 0
        painted = 300 + list(MATERIALS).index((materials or {}).get(name, "wood"))
        links += [(b"OO", 1000 + place, 2000 + place), (b"OO", 2000 + place, above), (b"OO", painted, 2000 + place)]
    settings = _properties(UpAxis="XYZ".index(up[1]), UpAxisSign=int(f"{up[0]}1"), UnitScaleFactor=centimetres)
    connections = tuple(("C", link, ()) for link in links)
    return (
        ("FBXHeaderExtension", (), (("FBXVersion", (7400,), ()),)),
        ("GlobalSettings", (), (settings,)),
        ("Objects", (), tuple(objects)),
        ("Connections", (), connections),
    )


def write_fbx(folder: Path, data: bytes | None = None, image: bytes | None = None) -> Path:
    """Writes the file and, where there is one, the image beside it."""
    folder.mkdir(parents=True, exist_ok=True)
    if image is not None:
        (folder / "wood grain.png").write_bytes(image)
    path = folder / "cabinet.fbx"
    path.write_bytes(fbx_bytes(fbx_records()) if data is None else data)
    return path
