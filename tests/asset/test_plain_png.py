"""What is stated of a PNG file without Pillow is what Pillow states; of all that is not plain and whole it is asked."""

import struct
import sys
import zlib
from io import BytesIO

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from grafu.asset import resources
from grafu.asset.options import Limits
from grafu.asset.plain_png import plain_png
from grafu.asset.resources import TextureBook
from grafu.geometry.appearance import Texture

MODES = ("L", "LA", "RGB", "RGBA")


def png(mode: str = "RGB", size: tuple[int, int] = (5, 4), **how: object) -> bytes:
    """Returns a file with random pixels."""
    channels = len(mode)
    pixels = np.random.default_rng(1).integers(0, 255, (size[1], size[0], channels), dtype=np.uint8)
    file = BytesIO()
    Image.fromarray(pixels.squeeze() if channels == 1 else pixels, mode).save(file, "PNG", **how)
    return file.getvalue()


def with_chunk(data: bytes, kind: bytes, content: bytes, before: bytes) -> bytes:
    """Returns the file with a chunk more, right before another."""
    at = data.index(before) - 4
    body = kind + content
    return data[:at] + struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body)) + data[at:]


LIMITS = Limits()


def judged(data: bytes, limits: Limits = LIMITS, by_pillow: bool = False) -> Texture | str:
    """Returns what becomes of an image."""
    with pytest.MonkeyPatch.context() as patch:
        if by_pillow:
            patch.setattr(resources, "plain_png", lambda _: None)
        return TextureBook(limits).checked(data, "image.png")


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("dpi", [None, (72, 72)])
def test_a_plain_file_is_told_without_pillow(
    mode: str, dpi: tuple[int, int] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    data = png(mode, **({} if dpi is None else {"dpi": dpi}))
    plain = plain_png(data)
    assert plain is not None
    assert (plain.width, plain.height, plain.is_whole) == (5, 4, True)

    for name in [name for name in sys.modules if name.split(".")[0] == "PIL"]:
        monkeypatch.setitem(sys.modules, name, None)

    assert isinstance(judged(data), Texture)


@settings(deadline=None)
@given(mode=st.sampled_from(MODES), at=st.integers(0, 200), value=st.integers(0, 255), cut=st.integers(0, 30))
def test_a_spoiled_file_is_judged_as_by_pillow(mode: str, at: int, value: int, cut: int) -> None:
    data = bytearray(png(mode))
    data[at % len(data)] = value
    spoiled = bytes(data[: len(data) - cut])

    assert judged(spoiled) == judged(spoiled, by_pillow=True)


def rows_of(data: bytes) -> bytes:
    """Returns the unpacked rows of a file with one chunk of them."""
    at = data.index(b"IDAT")
    return zlib.decompress(data[at + 4 : at + 4 + int.from_bytes(data[at - 4 : at], "big")])


def with_rows(data: bytes, rows: bytes) -> bytes:
    """Returns the file with other rows."""
    at = data.index(b"IDAT") - 4
    end = at + 12 + int.from_bytes(data[at : at + 4], "big")
    return with_chunk(data[:at] + data[end:], b"IDAT", zlib.compress(rows), b"IEND")


@pytest.mark.parametrize("change", [lambda r: r[:-1], lambda r: r + b"\0", lambda r: b"\x09" + r[1:], lambda _: b""])
def test_rows_that_lack_or_are_odd_are_left_to_pillow(change: object) -> None:
    data = png()
    spoiled = with_rows(data, change(rows_of(data)))  # type: ignore[operator]

    plain = plain_png(spoiled)

    assert plain is not None
    assert not plain.is_whole
    assert judged(spoiled) == judged(spoiled, by_pillow=True)


def palette(colours: int) -> bytes:
    """Returns a file with a palette."""
    pixels = np.arange(35, dtype=np.uint8).reshape(5, 7) % colours
    image = Image.fromarray(pixels, "L").convert("P", palette=Image.Palette.ADAPTIVE, colors=colours)
    file = BytesIO()
    image.save(file, "PNG")
    return file.getvalue()


def with_kind(data: bytes, colour: int) -> bytes:
    """Returns the file with another kind of colour in its header."""
    header = data[12:25] + bytes([colour]) + data[26:29]
    return data[:12] + header + struct.pack(">I", zlib.crc32(header)) + data[33:]


@pytest.mark.parametrize("colours", [2, 3, 4, 9, 16, 30])
def test_a_palette_is_plain(colours: int) -> None:
    plain = plain_png(palette(colours))

    assert plain is not None
    assert (plain.width, plain.height, plain.is_whole) == (7, 5, True)
    assert judged(palette(colours)) == judged(palette(colours), by_pillow=True)


@settings(deadline=None)
@given(colours=st.integers(2, 40), at=st.integers(0, 250), value=st.integers(0, 255))
def test_a_spoiled_palette_is_judged_as_by_pillow(colours: int, at: int, value: int) -> None:
    spoiled = bytearray(palette(colours))
    spoiled[at % len(spoiled)] = value

    assert judged(bytes(spoiled)) == judged(bytes(spoiled), by_pillow=True)


def odd_files() -> dict[str, bytes]:
    """Returns files that Pillow is asked about."""
    text = PngInfo()
    text.add_text("author", "someone")
    deep = BytesIO()
    Image.fromarray(np.zeros((4, 4), np.uint16)).save(deep, "PNG")
    return {
        "text": png(pnginfo=text),
        "palette of none": with_chunk(png(), b"PLTE", b"123", b"IDAT"),
        "no palette": with_kind(png("L"), 3),
        "two palettes": with_chunk(palette(4), b"PLTE", b"123", b"IDAT"),
        "odd palette": with_chunk(with_kind(png("L"), 3), b"PLTE", b"1234", b"IDAT"),
        "16 bits": deep.getvalue(),
        "more": png() + b"more",
        "unknown": with_chunk(png(), b"abcd", b"1", b"IDAT"),
        "gamma": with_chunk(png(), b"gAMA", b"1", b"IDAT"),
        "late": with_chunk(png(), b"pHYs", b"123456789", b"IEND"),
        "no rows": png()[: png().index(b"IDAT") - 4] + with_chunk(png(), b"x", b"", b"IEND")[-12:],
        "nothing": b"\x89PNG\r\n\x1a\n",
    }


@pytest.mark.parametrize("name", odd_files())
def test_other_files_are_left_to_pillow(name: str) -> None:
    data = odd_files()[name]

    assert plain_png(data) is None
    assert judged(data) == judged(data, by_pillow=True)


def test_pixels_are_counted_once_and_before_they_are_unpacked() -> None:
    data = png(size=(10, 10))
    spoiled = with_rows(data, b"")
    book = TextureBook(Limits(max_pixels=250))

    assert book.checked(spoiled, "spoiled") == "is damaged"
    assert isinstance(book.checked(png(size=(10, 9)), "first"), Texture)
    assert "more pixels" in str(book.checked(png(size=(10, 8)), "second"))
    for limits in (Limits(max_image_pixels=99), Limits(max_pixels=99)):
        assert judged(data, limits) == judged(data, limits, by_pillow=True)
