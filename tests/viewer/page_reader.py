"""Reads a page back: its elements, and its geometry by the form that docs/pages.md states."""

import json
import zlib
from base64 import b64decode
from html.parser import HTMLParser
from typing import Any

import numpy as np

EMPTY = {"meta", "link", "img", "input", "br", "col"}


class PageReader(HTMLParser):
    """All elements with their attributes and texts; it complains where tags do not match."""

    def __init__(self, page: str) -> None:
        super().__init__(convert_charrefs=True)
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.texts: dict[int, str] = {}
        self._open: list[tuple[str, int]] = []
        self.feed(page)
        self.close()
        assert self._open == [], f"never closed: {self._open}"

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in EMPTY:
            self._open.append((tag, len(self.elements) - 1))

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        last, _ = self._open.pop()
        assert last == tag, f"<{last}> is closed by </{tag}>"

    def handle_data(self, data: str) -> None:
        for _, index in self._open:
            self.texts[index] = self.texts.get(index, "") + data

    def all(self, tag: str, **attributes: str) -> list[dict[str, str | None]]:
        wanted = {key.rstrip("_").replace("_", "-"): value for key, value in attributes.items()}
        return [found for name, found in self.elements if name == tag and wanted.items() <= found.items()]

    def text_of(self, element_id: str) -> str:
        return next(
            self.texts.get(k, "") for k, (_, found) in enumerate(self.elements) if found.get("id") == element_id
        )


def scene_of(page: PageReader) -> dict[str, Any]:
    return json.loads(page.text_of("scene"))


def buffer_of(page: PageReader) -> bytes:
    return zlib.decompress(b64decode(page.text_of("geometry")))


def triangles_of(scene: dict[str, Any], buffer: bytes, piece: dict[str, Any]) -> np.ndarray:
    """Returns the corners of a piece's triangles, metres, (faces, 3, 3)."""
    mesh = scene["meshes"][piece["mesh"]]
    vertices = cut(buffer, mesh["vertices"], np.uint16).reshape(-1, 4)[:, :3] / 65535
    indices = cut(buffer, mesh["indices"], np.uint32 if mesh["bits"] == 32 else np.uint16)
    return (np.array(piece["low"]) + vertices * np.array(piece["size"]))[indices].reshape(-1, 3, 3)


def normals_of(scene: dict[str, Any], buffer: bytes, piece: dict[str, Any]) -> np.ndarray:
    """Returns a unit normal per corner, (faces, 3, 3)."""
    mesh = scene["meshes"][piece["mesh"]]
    flat = cut(buffer, mesh["vertices"], np.int8).reshape(-1, 8)[:, 6:] / 127
    z = 1 - np.abs(flat).sum(axis=1)
    fold = np.maximum(-z, 0)[:, None]
    normals = np.column_stack([flat - np.where(flat >= 0, fold, -fold), z])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    indices = cut(buffer, mesh["indices"], np.uint32 if mesh["bits"] == 32 else np.uint16)
    return normals[indices].reshape(-1, 3, 3)


def cut(buffer: bytes, place: list[int], kind: Any) -> np.ndarray:
    start, length = place
    return np.frombuffer(buffer[start : start + length], kind)
