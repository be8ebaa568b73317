"""Images of a model, checked once when they are read, so that no later stage meets a broken one.

The bytes stay as they are. It opens no files.
"""

import struct
import warnings
import zlib
from io import BytesIO
from pathlib import Path
from typing import Final, Literal, final

from grafu.asset.options import Limits, how_to_allow
from grafu.geometry.appearance import Texture

Mime = Literal["image/png", "image/jpeg"]
_MIMES: Final[dict[bytes, Mime]] = {b"\x89PNG": "image/png", b"\xff\xd8\xff": "image/jpeg"}
# What Pillow raises on images that are damaged or built to do harm.
_BROKEN: Final = (
    OSError,
    SyntaxError,
    ValueError,
    TypeError,
    KeyError,
    IndexError,
    OverflowError,
    struct.error,
    zlib.error,
)


@final
class TextureBook:
    """The images of one model: each is decoded once, to see that it can be; `by_path` is for whoever reads files."""

    def __init__(self, limits: Limits) -> None:
        self.by_path: dict[Path, Texture | str] = {}
        self._limits = limits
        self._pixels = self._bytes = 0
        self._known: dict[bytes, tuple[bytes, Mime | None, str]] = {}  # the same bytes are kept once

    def checked(self, data: bytes, name: str) -> Texture | str:
        """Returns the image as a texture, or in words why it is none (`is neither PNG nor JPEG`)."""
        if data not in self._known:
            self._known[data] = (data, *self._judged(data))
        kept, mime, flaw = self._known[data]
        return Texture(name, kept, mime) if mime is not None and not flaw else flaw

    def _judged(self, data: bytes) -> tuple[Mime | None, str]:
        """Returns the kind of an image and in words what is wrong with it, empty where it can be shown."""
        mime = next((mime for magic, mime in _MIMES.items() if data.startswith(magic)), None)
        if mime is None:
            return None, "is neither PNG nor JPEG"
        self._bytes += len(data)
        if self._bytes > self._limits.max_bytes:
            return mime, f"makes more bytes than are read of one model ({how_to_allow('bytes', self._bytes)})"
        try:
            return mime, self._flaw(data, mime)
        except _BROKEN:
            return mime, "is damaged"

    def _flaw(self, data: bytes, mime: Mime) -> str:
        """Returns in words what is wrong with an image, or nothing; its size is known before it is decoded."""
        from PIL import Image  # local: models without images need it not

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Pillow warns of large images: the limits are ours
            try:
                image = Image.open(BytesIO(data), formats=("PNG", "JPEG"))
            except Image.DecompressionBombError:
                return "is too large for any image of furniture"
            with image:
                if image.get_format_mimetype() != mime:
                    return "is damaged"
                flaw = self._too_large(image.width * image.height)
                if not flaw:
                    image.load()
                return flaw

    def _too_large(self, pixels: int) -> str:
        limits = self._limits
        if pixels > limits.max_image_pixels:
            return f"has {pixels:,} pixels, more than is read ({how_to_allow('image-pixels', pixels)})"
        self._pixels += pixels
        if self._pixels > limits.max_pixels:
            return f"makes more pixels than are read of one model ({how_to_allow('pixels', self._pixels)})"
        return ""
