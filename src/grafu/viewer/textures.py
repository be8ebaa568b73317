"""Images for the page: no larger than a screen shows, as data URIs. It knows no meshes."""

from base64 import b64encode
from collections.abc import Sequence
from io import BytesIO

from PIL import Image

from grafu.geometry.appearance import Texture

LIMIT = 1024  # pixels a side: a whole piece of furniture on a screen shows no more
_BUDGET = 6 * LIMIT * LIMIT  # pixels of all images of a page together
_QUALITY = 84


def texture_uris(textures: Sequence[Texture]) -> list[str]:
    """Returns each image as a data URI, at most `LIMIT` pixels a side, and less where there are many.

    An image that cannot be read becomes an empty string: the part keeps its plain colour.
    """
    limit = LIMIT
    while limit > 64 and len(textures) * limit * limit > _BUDGET:
        limit //= 2
    return [_texture_uri(texture, limit) for texture in textures]


def data_uri(data: bytes, mime: str) -> str:
    """Returns bytes as a URI that needs no network."""
    return f"data:{mime};base64,{b64encode(data).decode()}"


def _texture_uri(texture: Texture, limit: int) -> str:
    try:
        with Image.open(BytesIO(texture.data)) as image:
            if max(image.size) <= limit:
                image.verify()
                return data_uri(texture.data, texture.mime)
            image.draft("RGB", (limit, limit))  # a JPEG is decoded at a smaller size at once
            return _smaller(image, limit)
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError):
        return ""


def _smaller(image: Image.Image, limit: int) -> str:
    has_alpha = image.mode in ("RGBA", "LA", "PA") or "transparency" in image.info
    small = image.convert("RGBA" if has_alpha else "RGB")
    small.thumbnail((limit, limit), Image.Resampling.BOX)
    kind, mime = ("PNG", "image/png") if has_alpha else ("JPEG", "image/jpeg")
    stream = BytesIO()
    small.save(stream, kind, quality=_QUALITY)
    return data_uri(stream.getvalue(), mime)
