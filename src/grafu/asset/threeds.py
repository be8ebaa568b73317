"""3DS files (.3ds): objects with faces are parts, in the file's own coordinates. It settles no frame.

Names, meshes, texture coordinates, diffuse colours, opacity and images are read; lights, cameras and animations are
not. Every count is compared with the bytes that are there before memory is taken for it.
"""

import struct
from collections.abc import Iterator
from dataclasses import field
from pathlib import Path
from typing import Final, final

import numpy as np

from grafu.asset.drafts import PartDraft, parts_of_drafts
from grafu.asset.mesh_files import linear_channel, named_texture, surface_of_corners
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface

_MAIN, _EDITOR, _OBJECT, _HIDDEN, _MESH = 0x4D4D, 0x3D3D, 0x4000, 0x4010, 0x4100
_POINTS, _FACES, _FACE_MATERIAL, _UV = 0x4110, 0x4120, 0x4130, 0x4140
_MATERIAL, _NAME, _DIFFUSE, _TRANSPARENCY, _MAP, _MAP_FILE = 0xAFFF, 0xA000, 0xA020, 0xA050, 0xA200, 0xA300
_FLOAT_COLOURS: Final = (0x0010, 0x0013)
_BYTE_COLOURS: Final = (0x0011, 0x0012)
_PERCENT, _PERCENT_FLOAT = 0x0030, 0x0031
_HEADER = 6  # bytes of a chunk before its content: what it is, and its length with them
_LARGEST = 1e12  # of a coordinate: products of some of them stay finite
_LONGEST = 256  # letters of a name
_EXPECTED = "a 3DS file with objects; export it again, best as GLB"


def read_threeds(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the objects of a .3ds file, in its own coordinates.

    Raises:
        UnreadableAsset: if the file is missing or damaged.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    scene = _Scene(path, files, memoryview(files.read(path)))
    drafts = list(scene.drafts())
    check_parts(len(drafts), path, options.limits)
    convention = Convention("the format (3DS: Z up, no unit)", up="+Z")
    return Reading("mesh file", parts_of_drafts(drafts), convention, notes=tuple(dict.fromkeys(scene.notes)))


@final
@dataclass
class _Scene:
    """The chunks while they are read. Not a value: notes gather."""

    path: Path
    files: ModelFiles
    data: memoryview
    notes: list[str] = field(default_factory=list)
    _count: int = 0  # of chunks

    def drafts(self) -> Iterator[PartDraft]:
        """Yields the objects with faces, each as a piece."""
        if self.data[:2] != struct.pack("<H", _MAIN):
            raise self._damaged("it does not begin as one")
        looks = dict(map(self._material, self._in_editor(_MATERIAL)))
        for number, held in enumerate(self._in_editor(_OBJECT), 1):
            self.files.limits.require("nodes", number, self.path)
            name, rest = self._text(held)
            surfaces: list[Surface] = []
            is_hidden = False
            for kind, within in self._chunks(rest):
                is_hidden |= kind == _HIDDEN
                surfaces += self._surfaces(within, looks) if kind == _MESH else []
            if surfaces and is_hidden:
                self.notes.append(f"{name} is hidden and was left out")
            elif surfaces:
                yield PartDraft(name or f"object_{number}", tuple(surfaces), file=self.path.name)

    def _in_editor(self, sought: int) -> Iterator[memoryview]:
        """Yields the content of the editor's chunks of a kind."""
        mains = (held for kind, held in self._chunks(self.data) if kind == _MAIN)
        editors = (held for main in mains for kind, held in self._chunks(main) if kind == _EDITOR)
        yield from (held for editor in editors for kind, held in self._chunks(editor) if kind == sought)

    def _chunks(self, data: memoryview) -> Iterator[tuple[int, memoryview]]:
        """Yields what each chunk is and its content."""
        at = 0
        while at + _HEADER <= len(data):
            kind, length = struct.unpack_from("<HI", data, at)
            if length < _HEADER or at + length > len(data):
                raise self._damaged(f"chunk {kind:#06x} reaches beyond what holds it")
            self._count += 1
            self.files.limits.require("values", self._count, self.path)
            yield kind, data[at + _HEADER : at + length]
            at += length

    def _surfaces(self, mesh: memoryview, looks: dict[str, Material]) -> list[Surface]:
        held = dict(self._chunks(mesh))
        if _POINTS not in held or _FACES not in held:
            return []
        points, _ = self._table(held[_POINTS], "<f4", 3, vertices=1)
        corners, rest = self._table(held[_FACES], "<u2", 4, faces=1)
        uv = self._table(held[_UV], "<f4", 2)[0] if _UV in held else np.zeros((0, 2))
        faces = corners[:, :3].astype(np.int64)
        if not len(faces):
            return []
        if faces.max() >= len(points):
            raise self._damaged(f"a face names vertex {faces.max()} of {len(points)}")
        if not max(np.abs(points).max(), np.abs(uv).max(initial=0.0)) < _LARGEST:
            raise self._damaged("a coordinate is none of furniture")
        look = np.zeros(len(faces), np.int64)
        names = [""]
        for name, chosen in self._face_materials(rest, len(faces)):
            look[chosen] = len(names)
            names.append(name)
        used = np.unique(look).tolist()
        self.files.tally.add(self.path, primitives=len(used))
        has_uv = len(uv) == len(points)
        return [_surface(points, faces[look == k], uv, has_uv, looks.get(names[k], Material())) for k in used]

    def _face_materials(self, data: memoryview, count: int) -> Iterator[tuple[str, np.ndarray]]:
        """Yields names of materials and the faces that have them."""
        for kind, held in self._chunks(data):
            if kind == _FACE_MATERIAL:
                name, rest = self._text(held)
                chosen = self._table(rest, "<u2", 1)[0][:, 0].astype(np.int64)
                if len(chosen) and chosen.max() >= count:
                    raise self._damaged(f"a material names face {chosen.max()} of {count}")
                yield name, chosen

    def _table(self, data: memoryview, dtype: str, width: int, **counted: int) -> tuple[np.ndarray, memoryview]:
        """Returns the rows that a count declares, and what follows them."""
        if len(data) < 2:
            raise self._damaged("a table has no length")
        (count,) = struct.unpack_from("<H", data)
        size = count * width * np.dtype(dtype).itemsize
        if 2 + size > len(data):
            raise self._damaged(f"a table of {count} rows reaches beyond its chunk")
        self.files.tally.add(self.path, **dict.fromkeys(counted, count))
        rows = np.frombuffer(data[2 : 2 + size], dtype).reshape(count, width)
        return rows.astype(np.float64) if dtype == "<f4" else rows, data[2 + size :]

    def _material(self, data: memoryview) -> tuple[str, Material]:
        name, colour, opacity, texture = "", (0.8, 0.8, 0.8), 1.0, None
        for kind, held in self._chunks(data):
            if kind == _NAME:
                name = self._text(held)[0]
            elif kind == _DIFFUSE:
                colour = self._colour(held) or colour
            elif kind == _TRANSPARENCY:
                opacity = 1.0 - self._percent(held)
            elif kind == _MAP:
                files = [self._text(file)[0] for below, file in self._chunks(held) if below == _MAP_FILE]
                texture = named_texture(files[0], self.path.parent, self.files, self.notes) if files else None
        red, green, blue = (linear_channel(value) for value in colour)
        mode = "BLEND" if opacity < 0.999 else "OPAQUE"
        base = (1.0, 1.0, 1.0, opacity) if texture is not None else (red, green, blue, opacity)
        return name, Material(name=name, base_color=base, alpha_mode=mode, base_color_texture=texture)  # type: ignore[arg-type]

    def _colour(self, data: memoryview) -> tuple[float, float, float] | None:
        for kind, held in self._chunks(data):
            if kind in _BYTE_COLOURS and len(held) >= 3:
                return held[0] / 255, held[1] / 255, held[2] / 255
            if kind in _FLOAT_COLOURS and len(held) >= 12:
                red, green, blue = np.nan_to_num(np.clip(np.frombuffer(held[:12], "<f4"), 0.0, 1.0)).tolist()
                return red, green, blue
        return None

    def _percent(self, data: memoryview) -> float:
        for kind, held in self._chunks(data):
            if kind == _PERCENT and len(held) >= 2:
                return min(struct.unpack_from("<H", held)[0] / 100, 1.0)
            if kind == _PERCENT_FLOAT and len(held) >= 4:
                value = struct.unpack_from("<f", held)[0]
                return min(max(value, 0.0), 1.0) if value == value else 0.0
        return 0.0

    def _text(self, data: memoryview) -> tuple[str, memoryview]:
        """Returns a name that a zero ends, and what follows it."""
        name, end, _ = bytes(data[:_LONGEST]).partition(b"\0")
        if not end:
            raise self._damaged("a name has no end")
        return name.decode("latin-1"), data[len(name) + 1 :]

    def _damaged(self, why: str) -> UnreadableAsset:
        return UnreadableAsset(f"{self.path} is damaged ({why}): expected {_EXPECTED}")


def _surface(points: np.ndarray, faces: np.ndarray, uv: np.ndarray, has_uv: bool, material: Material) -> Surface:
    """Returns some of a mesh's triangles with the vertices that they use."""
    corners = np.full((faces.size, 3), -1)
    corners[:, 0] = faces.ravel()
    if has_uv:
        corners[:, 1] = faces.ravel()
    return surface_of_corners(corners, points, uv, np.zeros((0, 3)), None, material)
