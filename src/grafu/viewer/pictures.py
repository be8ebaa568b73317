"""The still pictures of a model's page: as it came, closed and open; and small images, as data URIs.

Pictures are drawn on the CPU and clear around the model, so that they stand on light and on dark paper. Images are no
larger than a screen shows.
"""

import re
from base64 import b64decode, b64encode
from collections.abc import Sequence
from io import BytesIO
from typing import final

import numpy as np
from PIL import Image

from grafu.articulation.articulated_object import ArticulatedObject, Visual, VisualRole
from grafu.asset.edit import as_static_object
from grafu.asset.part import Asset
from grafu.asset.scan_files import library_call
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Texture
from grafu.geometry.budget import require_time
from grafu.processes.cores import made_of_each, own_cores
from grafu.processes.limits import give_back_unused
from grafu.render.camera import three_quarter_view
from grafu.render.exposure import PictureStyle
from grafu.render.picture import box_of, opened_values, posed_visuals, render
from grafu.viewer.shell import Html, joined, tag

LIMIT = 1024  # pixels a side: a whole piece of furniture on a screen shows no more
_BUDGET = 6 * LIMIT * LIMIT  # pixels of all images of a page together
_TEXTURE_QUALITY = 84


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
    small.save(stream, kind, quality=_TEXTURE_QUALITY)
    return data_uri(stream.getvalue(), mime)


SIZE = (320, 240)
THUMBNAIL = (112, 84)  # pixels, in a row of a table
CARD = (320, 240)  # pixels, on a card
MIME = "image/webp"
_STYLE = PictureStyle(background="transparent")
_QUALITY = 82
_FACES_AT_ONCE = 500_000  # of a picture, up to which several are drawn at a time: each takes memory of its own
_OPENED = re.compile(
    rf'<img src="data:{MIME};base64,(?P<data>[A-Za-z0-9+/=]+)"[^>]{{0,99}} alt="[^">]{{0,9999}}: open"'.encode()
)
_MOST_PIXELS = 2000 * 2000  # of a picture of ours


@final
@dataclass(frozen=True)
class Stills:
    """WebP files from one camera, `SIZE` in pixels: the input, and the result closed and open.

    `closed` is empty where the closed result shows nothing that the input did not, but for hardware.
    """

    before: bytes
    closed: bytes
    opened: bytes


def take_stills(asset: Asset, articulated: ArticulatedObject, size: tuple[int, int] = SIZE) -> Stills:
    """Returns the pictures of a model before and after."""
    before, closed = posed_visuals(as_static_object(asset)), posed_visuals(articulated)
    opened = posed_visuals(articulated, opened_values(articulated))
    camera = three_quarter_view(box_of([*before, *closed, *opened]), size[0] / size[1])

    def taken(visuals: list[Visual]) -> bytes:
        require_time()
        picture = render(visuals, camera, size, _STYLE)
        give_back_unused()
        return _encoded(Image.fromarray(picture))

    shown = [before, opened] if _alike(asset, closed) else [before, closed, opened]
    faces = max(sum(len(s.mesh.faces) for visual in visuals for s in visual.surfaces) for visuals in shown)
    made = made_of_each(shown, taken, own_cores() if faces <= _FACES_AT_ONCE else 1)
    return Stills(made[0], b"" if len(made) < 3 else made[1], made[-1])


def _alike(asset: Asset, closed: list[Visual]) -> bool:
    """Whether nothing but hardware was added, and no part was moved or cut."""
    if any(visual.role is VisualRole.ADDED for visual in closed):
        return False
    kept = [visual for visual in closed if visual.role is VisualRole.PART]
    return all(np.array_equal(asset.part(v.name).mesh.triangles, v.mesh.triangles) for v in kept)


def thumbnail(stills: Stills, size: tuple[int, int] = THUMBNAIL) -> bytes:
    """Returns the open picture, made small for a list."""
    return _small(stills.opened, size)


def thumbnail_of_page(page: bytes) -> bytes:
    """Returns the open picture of a model's page, made small for a card; empty where the page holds none.

    Raises:
        UnreadableAsset: if the picture is damaged.
    """
    found = _OPENED.search(page)
    with library_call("the picture in a page", "a small WebP"):
        return _small(b64decode(found["data"]), CARD) if found else b""


def _small(picture: bytes, size: tuple[int, int]) -> bytes:
    with Image.open(BytesIO(picture), formats=("WEBP",)) as image:
        if image.width * image.height > _MOST_PIXELS:
            raise ValueError(f"it has {image.width} x {image.height} pixels")
        return _encoded(image.convert("RGBA").resize(size, Image.Resampling.LANCZOS))


def stills_row(stills: Stills, name: str) -> Html:
    """Returns the pictures side by side, with captions."""
    phrases = (("As it came", stills.before), ("Closed", stills.closed), ("Open", stills.opened))
    shown = [(caption, data) for caption, data in phrases if data]
    return tag("div", joined(_figure(caption, data, name) for caption, data in shown), class_="stills")


def _figure(caption: str, data: bytes, name: str) -> Html:
    uri, (width, height) = data_uri(data, MIME), SIZE
    image = tag("img", src=uri, width=width, height=height, alt=f"{name}: {caption.lower()}")
    return tag("figure", image, tag("figcaption", caption))


def _encoded(image: Image.Image) -> bytes:
    stream = BytesIO()
    image.save(stream, "WEBP", quality=_QUALITY, method=2)
    return stream.getvalue()
