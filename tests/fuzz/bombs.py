"""Changes that ask for far more than they hold: counts, repeats, depth, pictures, archives."""

import base64
import json
import re
import struct
import zlib
from functools import cache
from random import Random
from typing import Any

import numpy as np

from fuzz.array_changes import saved
from fuzz.documents import Raw, document_of, json_files, places, replaced, text_of, value_at, with_document, with_text
from fuzz.entries import Files, data_of, plain

_COUNTS = re.compile(r"(?i)count|length|offset|stride|index|size|slot|number|limit|shape|version")
_HUGE = (2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**40, 2**53, 2**63, 2**64, 10**100, -1, -(2**63), 1e18)
_MOST = 4_000_000  # bytes of a list that is repeated


def huge_count(files: Files, rng: Random) -> Files | None:
    names = json_files(files)
    if not names:
        return None
    name = rng.choice(names)
    document = document_of(data_of(files, name))

    def is_count(path: tuple[Any, ...]) -> bool:
        value = value_at(document, path)
        return isinstance(value, int) and isinstance(path[-1], str) and bool(_COUNTS.search(path[-1]))

    found = [path for path in places(document) if is_count(path)]
    if not found:
        return None
    changed = replaced(document, rng.choice(found), rng.choice(_HUGE))
    return {**files, name: with_document(data_of(files, name), changed)}


def _scene(files: Files, rng: Random) -> tuple[str, dict[str, Any]] | None:
    names = [n for n in plain(files, ".glb", ".gltf") if isinstance(document_of(data_of(files, n)), dict)]
    if not names:
        return None
    name = rng.choice(names)
    document = document_of(data_of(files, name))
    return (name, document) if isinstance(document.get("nodes"), list) and document["nodes"] else None


def many_instances(files: Files, rng: Random) -> Files | None:
    """Thousands of nodes show one mesh."""
    found = _scene(files, rng)
    if found is None:
        return None
    name, document = found
    count = rng.choice((300, 6_000, 100_000))
    first = len(document["nodes"])
    new = [{"mesh": 0, "name": f"copy_{k}", "translation": [k, 0, 0]} for k in range(count)]
    changed = {**document, "nodes": [*document["nodes"], *new]}
    changed["scenes"] = [{"nodes": list(range(first + count))}]
    return {**files, name: with_document(data_of(files, name), changed)}


def deep_scene(files: Files, rng: Random) -> Files | None:
    """Nodes hang below nodes, thousands deep, each scaled against the one above."""
    found = _scene(files, rng)
    if found is None:
        return None
    name, document = found
    count, first = rng.choice((1000, 20_000)), len(document["nodes"])
    scale = rng.choice(([1, 1, 1], [2, 2, 2], [0.5, 0.5, 0.5], [-1, 1, 1]))
    chain = [{"children": [first + k + 1], "scale": scale, "name": f"n{k}"} for k in range(count)]
    changed = {**document, "nodes": [*document["nodes"], *chain, {"mesh": 0, "name": "door"}]}
    changed["scenes"] = [{"nodes": [*range(first), first]}]
    return {**files, name: with_document(data_of(files, name), changed)}


def shared_children(files: Files, rng: Random) -> Files | None:
    """Each node has the next one below it many times over: 10 to the power of 30 paths."""
    found = _scene(files, rng)
    if found is None:
        return None
    name, document = found
    first = len(document["nodes"])
    layers = [{"children": [first + k + 1] * 10, "name": f"layer_{k}"} for k in range(30)]
    changed = {**document, "nodes": [*document["nodes"], *layers, {"mesh": 0}], "scenes": [{"nodes": [first]}]}
    return {**files, name: with_document(data_of(files, name), changed)}


def many_primitives(files: Files, rng: Random) -> Files | None:
    """One mesh lists one primitive thousands of times; all look at the same bytes."""
    found = _scene(files, rng)
    if found is None or not found[1].get("meshes"):
        return None
    name, document = found
    meshes = list(document["meshes"])
    try:
        meshes[0] = {**meshes[0], "primitives": list(meshes[0]["primitives"])[:1] * rng.choice((1000, 30_000))}
    except (KeyError, TypeError, AttributeError):
        return None
    return {**files, name: with_document(data_of(files, name), {**document, "meshes": meshes})}


def deep_json(files: Files, rng: Random) -> Files | None:
    """Children within children, as deep as Python reads and deeper."""
    names = json_files(files)
    if not names:
        return None
    name = rng.choice(names)
    document = document_of(data_of(files, name))
    depth = rng.choice((200, 330, 900, 50_000))
    key = rng.choice(("children", "nodes", "extras", "a"))
    raw = Raw(f'{{"id": 1, "name": "x", "{key}": [' * depth + "]}" * depth)
    path = rng.choice(places(document) or [()])
    return {**files, name: with_document(data_of(files, name), replaced(document, path, raw))}


def many_groups(files: Files, rng: Random) -> Files | None:
    """An OBJ of tens of thousands of groups, materials or objects."""
    names = plain(files, ".obj")
    if not names:
        return None
    name = rng.choice(names)
    word, count = rng.choice(("g", "o", "usemtl", "mtllib")), rng.choice((3000, 100_000))
    lines = "".join(f"{word} {word}{k}\nf -1 -2 -3\n" for k in range(count))
    return {**files, name: data_of(files, name) + b"\n" + lines.encode()}


def many_faces(files: Files, rng: Random) -> Files | None:
    """An OBJ that states its faces over and over."""
    names = [n for n in plain(files, ".obj") if b"\nf " in data_of(files, n)]
    if not names:
        return None
    name = rng.choice(names)
    faces = b"".join(b"f" + line + b"\n" for line in data_of(files, name).split(b"\nf")[1:])[:10_000]
    return {**files, name: data_of(files, name) + b"\n" + faces * min(rng.choice((100, 3000)), _MOST // len(faces))}


def many_files(files: Files, rng: Random) -> Files | None:
    """A folder holds hundreds of copies of a file."""
    folder, _, name = rng.choice(plain(files) or [""]).rpartition("/")
    original = f"{folder}/{name}".lstrip("/")
    if not original or len(data_of(files, original)) > 20_000:
        return None
    stem, dot, suffix = name.rpartition(".")
    copies = {f"{folder}/{stem}_{k}{dot}{suffix}".lstrip("/"): files[original] for k in range(400)}
    return {**files, **copies}


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


@cache
def png_of(width: int, height: int, filled: bool, depth: int = 1, color: int = 0) -> bytes:
    """Returns a PNG of one colour; not `filled`: its header states so, but there is no more."""
    head = _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, 0))
    row = b"\0" * (1 + (width * depth * {0: 1, 2: 3, 6: 4}[color] + 7) // 8)
    rows = zlib.compress(row * height, 1) if filled else zlib.compress(row)
    return b"\x89PNG\r\n\x1a\n" + head + _chunk(b"IDAT", rows) + _chunk(b"IEND", b"")


def picture_bomb(files: Files, rng: Random) -> Files | None:
    """A picture of many more pixels than bytes, or one that only states so."""
    names = plain(files, ".png", ".jpg")
    if not names:
        return None
    whole = rng.choice((png_of(9000, 9000, True), png_of(20_000, 20_000, True), png_of(65_535, 1, True)))
    empty = rng.choice((png_of(2**31 - 1, 2**31 - 1, False), png_of(0, 0, False), png_of(30_000, 30_000, False, 8, 6)))
    jpeg = b"\xff\xd8\xff\xc0\x00\x11\x08\xff\xff\xff\xff\x03" + bytes(9) + b"\xff\xd9"
    return {**files, rng.choice(names): rng.choice((whole, whole, empty, jpeg))}


def picture_bomb_within(files: Files, rng: Random) -> Files | None:
    """The same, as the picture that a scene holds within itself."""
    found = _scene(files, rng)
    if found is None or not isinstance(found[1].get("images"), list):
        return None
    name, document = found
    data = base64.b64encode(rng.choice((png_of(9000, 9000, True), png_of(30_000, 30_000, False, 8, 6)))).decode()
    changed = {**document, "images": [{"uri": f"data:image/png;base64,{data}"}]}
    return {**files, name: with_document(data_of(files, name), changed)}


@cache
def _zeros_packed(size: int) -> bytes:
    """Returns an archive whose one member is an array of zeros of so many bytes, a block of them over and over."""
    name, head = b"face_part_ids.npy", saved(np.zeros(size // 8, np.bool_)[:4])[:128].replace(b"(4,)", b"(%d,)" % size)
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(head[:128]) + packer.flush(zlib.Z_FULL_FLUSH)
    block = packer.compress(bytes(2**20)) + packer.flush(zlib.Z_FULL_FLUSH)
    packed += block * (size // 2**20) + packer.flush(zlib.Z_FINISH)
    common = struct.pack("<HHHIIIIHH", 0, 8, 0, 0x21, 0, len(packed), 128 + size, len(name), 0)
    local = b"PK\3\4" + struct.pack("<H", 20) + common + name + packed
    central = b"PK\1\2" + struct.pack("<HH", 20, 20) + common + struct.pack("<HHHII", 0, 0, 0, 0, 0) + name
    return local + central + b"PK\5\6" + struct.pack("<HHHHIIH", 0, 0, 1, 1, len(central), len(local), 0)


def archive_bomb(files: Files, rng: Random) -> Files | None:
    """An archive that unpacks to a thousand times its size."""
    names = plain(files, ".npz")
    return {**files, rng.choice(names): _zeros_packed(1800 * 2**20)} if names and rng.random() < 0.2 else None


def long_text(files: Files, rng: Random) -> Files | None:
    """A document of many megabytes of spaces, or with a text of many megabytes."""
    names = json_files(files)
    if not names:
        return None
    name = rng.choice(names)
    text = text_of(data_of(files, name))
    inside = f'{{"x": {json.dumps("x" * 3_000_000)}, ' if text.startswith("{") else f'["{"x" * 3_000_000}", '
    longer = rng.choice((" " * 5_000_000 + text, inside + text[1:]))
    return {**files, name: with_text(data_of(files, name), longer)}


CHANGES = (
    *(huge_count,) * 4,
    *(many_instances, deep_scene, shared_children, many_primitives, deep_json, many_groups, many_faces, many_files),
    *(picture_bomb, picture_bomb_within, archive_bomb, long_text),
)
