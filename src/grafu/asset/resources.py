"""The files of one model: what is named in it is sought and read here, by every reader, and nowhere else.

A model may come from any source, so the names in it lead only to regular files in the model's own folder, links
followed. It counts the bytes that are read. Images are checked once when they are read, so that no later stage meets a
broken one; their bytes stay as they are.
"""

import os
import struct
import warnings
import zlib
from io import BytesIO
from pathlib import Path
from typing import Final, Literal, final

from grafu.asset.options import Limits, Tally, how_to_allow
from grafu.asset.plain_png import plain_png
from grafu.asset.regular_files import TooManyBytes, read_regular
from grafu.dataclass import dataclass
from grafu.errors import AssetTooLarge, UnreadableAsset
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
    """The images of one model: each is decoded once, to see that it can be; `by_path` is for readers of files."""

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
        if (plain := plain_png(data)) is not None:
            flaw = self._too_large(plain.pixels)
            if flaw or plain.is_whole:
                return flaw
            self._pixels -= plain.pixels  # Pillow counts them, and tells whether what is broken can be shown
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


OUTSIDE = "lies outside the model's folder (copy it into that folder)"
MISSING = "is missing"
_LIMITS = Limits()


@final
@dataclass(frozen=True, slots=True)
class Sought:
    """A file that a model names: its path, or in words why there is none (`is missing`)."""

    path: Path | None
    why: str = ""


@final
class ModelFiles:
    """The files of one model and what has been read of it so far; one is made for each model that is read.

    `given` is what the user named, a file or a folder. A folder, and a file itself, may be links. What else is
    read lies in that folder, or in the file's, or in one of `roots`.
    """

    def __init__(self, given: Path, limits: Limits = _LIMITS, roots: tuple[Path, ...] = ()) -> None:
        self.limits = limits
        self.tally = Tally(limits)
        self._textures = TextureBook(limits)
        self._given = Path(given)
        folder = self._given if _is_dir(self._given) else self._given.parent
        self._roots = tuple(dict.fromkeys(_real(root) for root in (folder, *roots)))

    def with_roots(self, *roots: Path) -> "ModelFiles":
        """Returns the same, what was counted too, that may also look into these folders."""
        wider = ModelFiles(self._given, self.limits, (*self._roots, *roots))
        wider.tally, wider._textures = self.tally, self._textures
        return wider

    def seek(self, name: str, beside: Path) -> Sought:
        """Returns the file that a name in the model means, counted from the folder `beside`."""
        if not name:
            return Sought(None, MISSING)
        try:
            path = beside / name
            target = _real(path)
            if self._root_of(target) is None:
                return Sought(None, OUTSIDE)
            mode_is_file = target.is_file()
        except (OSError, ValueError):
            return Sought(None, "has a name that no file can have")
        return Sought(path) if mode_is_file else Sought(None, "is no regular file" if target.exists() else MISSING)

    def holds(self, folder: Path) -> bool:
        """Whether a folder is one that the model's files may lie in."""
        try:
            return self._root_of(_real(folder)) is not None
        except (OSError, ValueError):
            return False

    def read(self, path: Path) -> bytes:
        """Returns the content of a file of the model.

        Raises:
            UnreadableAsset: if it is missing, cannot be read, is no regular file, or leads out of the model's folder.
            AssetTooLarge: if the files of the model are larger than the limit.
        """
        try:
            data = self._content(path)
        except TooManyBytes as error:
            raise self._too_large(path, error.size) from None
        except (OSError, ValueError) as error:
            raise UnreadableAsset(f"{path} cannot be read ({reason_of(error)}): expected a readable file") from None
        self.tally.add(path, bytes=len(data))
        return data

    def texture(self, path: Path) -> Texture | str:
        """Returns an image of the model, checked, or in words why there is none; each file is read once."""
        if path not in self._textures.by_path:
            try:
                self._textures.by_path[path] = self._textures.checked(self.read(path), path.name)
            except (UnreadableAsset, AssetTooLarge) as error:
                self._textures.by_path[path] = f"cannot be read: {error}"
        return self._textures.by_path[path]

    def image(self, data: bytes | memoryview, name: str) -> Texture | str:
        """Returns an image that the model holds within a file, checked, or in words why there is none."""
        return self._textures.checked(bytes(data), name)

    def _content(self, path: Path) -> bytes:
        if path == self._given:
            return read_regular(path, self.tally.left("bytes"))
        target = _real(path)
        root = self._root_of(target)
        if root is None:
            raise UnreadableAsset(f"{path} {OUTSIDE}: what a model names must lie in its own folder")
        return read_regular(target, self.tally.left("bytes"), root)

    def _root_of(self, target: Path) -> Path | None:
        return next((root for root in self._roots if target.is_relative_to(root)), None)

    def _too_large(self, path: Path, size: int) -> AssetTooLarge:
        total = self.limits.max_bytes - self.tally.left("bytes") + size
        most = f"{self.limits.max_bytes / 2**20:g} MiB"
        return AssetTooLarge(
            f"{path} makes {total / 2**20:.0f} MiB of files: at most {most} are read; {how_to_allow('bytes', total)}"
        )


def read_bytes(path: Path, limits: Limits) -> bytes:
    """Returns the content of a file that the user named.

    Raises:
        UnreadableAsset: if the file is missing, cannot be read, or is no regular file.
        AssetTooLarge: if it is larger than the limit.
    """
    return ModelFiles(path, limits).read(path)


def _real(path: Path) -> Path:
    return Path(os.path.realpath(path))


def _is_dir(path: Path) -> bool:
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def reason_of(error: OSError | ValueError) -> str:
    """Returns in words why a file could not be opened."""
    if isinstance(error, OSError):
        return error.strerror or str(error)
    return "its name is one that no file can have"
