"""JSON that is the whole file or a GLB's first chunk: read, its values found by path, and written back.

`Raw` stands for text that no Python value gives: numbers without end, nesting without end, lone surrogates.
"""

import json
import struct
from dataclasses import dataclass
from typing import Any, final

from fuzz.entries import Files, data_of, plain

Path = tuple[Any, ...]


@final
@dataclass(frozen=True)
class Raw:
    """A piece of JSON text, put in as it is."""

    text: str


def json_files(files: Files) -> list[str]:
    """Returns the names of the files that hold a JSON document."""
    return [name for name in plain(files, ".json", ".gltf", ".glb") if document_of(data_of(files, name)) is not None]


def document_of(data: bytes) -> Any:
    """Returns the document of a JSON file or GLB, or None where it holds none."""
    try:
        return json.loads(text_of(data))
    except (ValueError, RecursionError, struct.error):
        return None


def text_of(data: bytes) -> str:
    """Returns the JSON text of a file or GLB."""
    if data[:4] != b"glTF":
        return data.decode("utf-8-sig", "replace")
    (length,) = struct.unpack_from("<I", data, 12)
    return data[20 : 20 + length].decode("utf-8", "replace")


def with_document(data: bytes, document: Any) -> bytes:
    """Returns the file with another document."""
    raws: list[str] = []

    def mark(value: Any) -> str:
        raws.append(value.text)
        return f"@raw{len(raws) - 1}@"

    text = json.dumps(document, default=mark)
    for index, raw in enumerate(raws):
        text = text.replace(f'"@raw{index}@"', raw)
    return with_text(data, text)


def with_text(data: bytes, text: str) -> bytes:
    """Returns the file with another JSON text; a GLB keeps its other chunks."""
    encoded = text.encode("utf-8", "surrogatepass")
    if data[:4] != b"glTF":
        return encoded
    (length,) = struct.unpack_from("<I", data, 12)
    encoded += b" " * (-len(encoded) % 4)
    rest = data[20 + length :]
    head = struct.pack("<4sII", b"glTF", 2, 20 + len(encoded) + len(rest))
    return head + struct.pack("<I4s", len(encoded), b"JSON") + encoded + rest


def places(value: Any, path: Path = ()) -> list[Path]:
    """Returns the path to every value below a document."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [p for key, below in items for p in [(*path, key), *places(below, (*path, key))]]


def value_at(document: Any, path: Path) -> Any:
    """Returns the value at a path."""
    for key in path:
        document = document[key]
    return document


def replaced(document: Any, path: Path, value: Any) -> Any:
    """Returns the document with another value at a path; nothing is changed in place."""
    if not path:
        return value
    copy = dict(document) if isinstance(document, dict) else list(document)
    copy[path[0]] = replaced(document[path[0]], path[1:], value)
    return copy


def removed(document: Any, path: Path) -> Any:
    """Returns the document without the value at a path."""
    holder = value_at(document, path[:-1])
    copy = dict(holder) if isinstance(holder, dict) else list(holder)
    del copy[path[-1]]
    return replaced(document, path[:-1], copy)
