"""Whether a PNG file is whole and plain, found without Pillow: to import that takes longer than to look at textures.

Only what every reader takes is plain: 8 bits in each channel, or a palette, no interlacing, nothing but pixels and how
they are shown. Of all others nothing is stated.
"""

import struct
import zlib
from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

_SIGNATURE: Final = b"\x89PNG\r\n\x1a\n"
_CHANNELS: Final = {0: 1, 2: 3, 4: 2, 6: 4}  # by the kind of colour: gray, RGB, gray and alpha, RGBA
_SHOWN: Final = {b"sRGB": 1, b"gAMA": 4, b"cHRM": 32, b"pHYs": 9}  # bytes of what tells how it is shown
_PALETTE: Final = 3  # the kind of colour whose pixels are numbers in a palette
_MOST: Final = 2**26  # pixels; larger ones are left to Pillow, which has its own view of them
_FILTERS: Final = 5


class PlainPng(NamedTuple):
    """What the chunks of a plain file hold: its size in pixels, bytes of a row, and the packed rows."""

    width: int
    height: int
    row: int
    packed: bytes

    @property
    def pixels(self) -> int:
        """How many it has."""
        return self.width * self.height

    @property
    def is_whole(self) -> bool:
        """Whether the rows can be unpacked, are all there, and are stored in a known way."""
        unpacker = zlib.decompressobj()
        try:
            rows = unpacker.decompress(self.packed, self.row * self.height + 1)
        except zlib.error:
            return False
        are_all = len(rows) == self.row * self.height and unpacker.eof and not unpacker.unused_data
        return are_all and max(rows[:: self.row]) < _FILTERS


def plain_png(data: bytes) -> PlainPng | None:
    """Returns what a plain file holds; None of any other."""
    chunks = list(_chunks(data))
    if len(data) != len(_SIGNATURE) + sum(12 + len(content) for _, content in chunks):
        return None  # damaged, or followed by something else
    kinds = [kind for kind, _ in chunks]
    if len(kinds) < 3 or kinds[0] != b"IHDR" or kinds[-1] != b"IEND" or len(chunks[0][1]) != 13 or chunks[-1][1]:
        return None
    first, last = kinds.index(b"IDAT") if b"IDAT" in kinds else 0, len(kinds) - 1
    if not first or any(kind != b"IDAT" for kind in kinds[first:last]):
        return None
    width, height, bits, colour, *others = struct.unpack(">IIBBBBB", chunks[0][1])
    of_pixel = _bits_of_pixel(bits, colour, chunks[1:first])
    if not of_pixel or any(others) or not 0 < width * height <= _MOST:
        return None
    return PlainPng(width, height, 1 + (width * of_pixel + 7) // 8, b"".join(part for _, part in chunks[first:last]))


def _bits_of_pixel(bits: int, colour: int, shown: Sequence[tuple[bytes, bytes]]) -> int:
    """Returns how many bits a pixel has; 0 where something tells otherwise than plainly how it is shown."""
    palettes = [content for kind, content in shown if kind == b"PLTE"]
    are_plain = all(kind == b"PLTE" or len(content) == _SHOWN.get(kind) for kind, content in shown)
    if colour == _PALETTE:
        is_one = len(palettes) == 1 and 0 < len(palettes[0]) <= 3 * 2**bits and len(palettes[0]) % 3 == 0
        return bits if bits in (1, 2, 4, 8) and is_one and are_plain else 0
    return 8 * _CHANNELS.get(colour, 0) if bits == 8 and not palettes and are_plain else 0


def _chunks(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yields the kind and content of each chunk; of what follows one that is damaged nothing."""
    at = len(_SIGNATURE) if data.startswith(_SIGNATURE) else len(data)
    while at + 12 <= len(data):
        end = at + 8 + int.from_bytes(data[at : at + 4], "big")
        if end + 4 > len(data) or zlib.crc32(data[at + 4 : end]) != int.from_bytes(data[end : end + 4], "big"):
            return
        yield data[at + 4 : at + 8], data[at + 8 : end]
        at = end + 4
