"""Files that other people's libraries read: PLY and STL by trimesh, XML by lxml, NumPy's arrays; and their guard.

Whatever such a reader raises, the file is damaged. The guard stands around the library's call alone: around our own
code it would hide our own faults. Of arrays nothing is unpickled, and no memory is taken that the file does not hold.
"""

import io
import logging
import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from grafu.asset.options import Limits, Tally
from grafu.asset.reading import MeshFile, MeshPiece
from grafu.asset.resources import ModelFiles
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh


@contextmanager
def library_call(where: object, expected: str) -> Iterator[None]:
    """Turns any exception of a library inside the block into one clear line; NumPy warns of no number in it.

    Args:
        where: the file, for the message.
        expected: what it should have been, in words.

    Raises:
        UnreadableAsset: where the library raised anything but an interruption or want of memory.
    """
    try:
        with np.errstate(all="ignore"):  # numbers that damage made huge, or none
            yield
    except MemoryError:
        raise
    except Exception as error:
        raise UnreadableAsset(f"{where} is damaged or of another kind: expected {expected}") from error


def parse_xml(data: bytes, path: Path, expected: str, limits: Limits) -> Any:
    """Returns the root element of XML; `expected` states in words what the file at `path` should be.

    Raises:
        UnreadableAsset: if it is not XML, nested more than 255 elements deep, or declares a document type: its entities
            are a known way to exhaust memory and to read other files.
        AssetTooLarge: if it is larger than the limits allow.
    """
    from lxml import etree  # local: models of other formats need it not

    limits.require("values", data.count(b"<") + data.count(b"="), path)
    # libxml2's own limits hold as long as `huge_tree` is not asked for: depth, length of texts, growth by entities
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True)
    try:
        root = etree.fromstring(data, parser)
    except (etree.XMLSyntaxError, ValueError, LookupError) as error:  # text beside an encoding it does not have
        reason = (str(error).splitlines() or [""])[0]
        raise UnreadableAsset(f"{path} is not readable XML ({reason}): expected {expected}") from None
    if root.getroottree().docinfo.internalDTD is not None:
        raise UnreadableAsset(
            f"{path} declares a document type or XML entities, which are refused: expected {expected} without them"
        )
    return root


_HEADERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}


def array_from(data: bytes) -> np.ndarray:
    """Returns the array in the bytes of a `.npy` file; it cannot be written to.

    Raises:
        ValueError: if they are no such file, hold objects, or another array than the header states; NumPy raises other
            exceptions for headers that are no Python.
    """
    stream = io.BytesIO(data)
    version = np.lib.format.read_magic(stream)
    if version not in _HEADERS:
        raise ValueError(f"it is of another kind of array file: {version}")
    shape, fortran, dtype = _HEADERS[version](stream)
    size = math.prod(shape) * dtype.itemsize
    if dtype.hasobject or min(shape, default=0) < 0 or size != len(data) - stream.tell():
        raise ValueError("it holds another array than it states")
    if not size:
        return np.zeros(shape, dtype)
    return np.frombuffer(data, dtype, offset=stream.tell()).reshape(shape, order="F" if fortran else "C")


_LARGEST = 1e15  # of a coordinate: squares and products of such stay finite
_UNHEARD = logging.NullHandler()
_ELEMENT = re.compile(rb"^element[ \t]+(\S+)[ \t]+(\d{1,18})[ \t\r]*$", re.MULTILINE)


def read_with_trimesh(path: Path, data: bytes, files: ModelFiles) -> MeshFile:
    """Returns the one piece of a PLY or STL file, read before; `path` states which.

    Raises:
        UnreadableAsset: if it is damaged.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    kind = path.suffix.lower()[1:]
    check_declared(data, kind, path, files.tally)
    mesh = _loaded(path, data, kind)
    visual: Any = mesh.visual
    colors = np.asarray(visual.vertex_colors) if visual.kind == "vertex" else None
    surface = Surface(TriangleMesh.from_trimesh(mesh), colors=colors)
    return MeshFile((MeshPiece("", () if surface.is_empty else (surface,)),))


def _loaded(path: Path, data: bytes, kind: str) -> Any:
    import trimesh  # local: it takes a while to import

    logging.getLogger("trimesh").addHandler(_UNHEARD)  # what it logs of damaged files is said here in one line
    with library_call(path, f"{kind.upper()}, a triangle mesh"):
        loaded = trimesh.load(io.BytesIO(data), file_type=kind, process=False)
    mesh = loaded if isinstance(loaded, trimesh.Trimesh) else None
    fits = mesh is not None and (not len(mesh.faces) or 0 <= mesh.faces.min() <= mesh.faces.max() < len(mesh.vertices))
    if mesh is None or not fits or not np.abs(mesh.vertices).max(initial=0) < _LARGEST:
        raise UnreadableAsset(f"{path} holds no triangle mesh with finite coordinates; re-export it")
    return mesh


def check_declared(data: bytes, kind: str, where: object, tally: Tally) -> None:
    """Counts what a file's header declares, before memory is taken for it.

    Raises:
        UnreadableAsset: if the file holds less than it declares.
        AssetTooLarge: if the model has more of something than the limits allow.
    """
    if kind == "ply":
        _check_ply(data, where, tally)
    elif data[:5].lower() == b"solid" and data.find(b"facet", 0, 4096) >= 0:
        faces = data.count(b"endfacet") or data.count(b"ENDFACET")
        tally.add(where, faces=faces, vertices=3 * faces)
    elif len(data) >= 84:
        declared = int.from_bytes(data[80:84], "little")
        tally.add(where, faces=declared, vertices=3 * declared)
        if 84 + declared * 50 > len(data):
            raise UnreadableAsset(f"{where} is truncated: its header declares {declared} faces; export it again")


def _check_ply(data: bytes, where: object, tally: Tally) -> None:
    for noun, digits in _ELEMENT.findall(data[: data.find(b"end_header") + 10]):
        count = int(digits)
        # a face with many corners is several triangles, each of four bytes at least
        counts = {"faces": count} if noun == b"face" else {"vertices": count}
        tally.add(where, **counts)
        if count > len(data):
            raise UnreadableAsset(f"{where} is truncated: its header declares {count} elements; export it again")
