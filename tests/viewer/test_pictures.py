"""Images for the page: small enough, and never a reason to fail."""

from base64 import b64decode
from io import BytesIO
from threading import get_ident

import pytest
from made_models import made_model, picture
from PIL import Image

from grafu.geometry.appearance import Texture
from grafu.viewer import pictures
from grafu.viewer.pictures import LIMIT, take_stills, texture_uris


def opened(uri: str) -> Image.Image:
    return Image.open(BytesIO(b64decode(uri.partition(",")[2])))


def test_a_small_image_is_kept_byte_for_byte():
    data = picture((40, 20))
    [uri] = texture_uris([Texture("t", data, "image/png")])

    assert b64decode(uri.removeprefix("data:image/png;base64,")) == data


@pytest.mark.parametrize(("kind", "mime"), [("PNG", "image/png"), ("JPEG", "image/jpeg")])
def test_a_large_image_is_made_smaller(kind, mime):
    [uri] = texture_uris([Texture("t", picture((4 * LIMIT, LIMIT), kind=kind), mime)])

    assert opened(uri).size == (LIMIT, LIMIT // 4)
    assert opened(uri).convert("RGB").getpixel((9, 9))[0] == pytest.approx(200, abs=4)


def test_what_is_clear_stays_clear():
    [uri] = texture_uris([Texture("t", picture((2 * LIMIT, 8), mode="RGBA"), "image/png")])

    assert opened(uri).getpixel((5, 0))[3] == 128


def test_of_many_images_each_is_smaller():
    data = picture((LIMIT, LIMIT), kind="JPEG")
    uris = texture_uris([Texture(str(k), data, "image/jpeg") for k in range(30)])

    assert {opened(uri).size for uri in uris} == {(LIMIT // 4, LIMIT // 4)}


@pytest.mark.parametrize("data", [b"", b"no image", picture()[:60]])
def test_a_broken_image_is_left_out(data):
    assert texture_uris([Texture("t", data, "image/png")]) == [""]


def test_two_cores_draw_the_same_pictures_at_a_time_unless_they_have_too_many_faces(monkeypatch):
    made, drawn = made_model().result, pictures.render
    threads: list[int] = []

    def render(*arguments):
        threads.append(get_ident())
        return drawn(*arguments)

    def stills(cores: int, faces: int = 500_000):
        threads.clear()
        monkeypatch.setattr(pictures, "render", render)
        monkeypatch.setattr(pictures, "own_cores", lambda: cores)
        monkeypatch.setattr(pictures, "_FACES_AT_ONCE", faces)
        return take_stills(made.asset, made.object, (64, 48))

    alone = stills(1)
    assert set(threads) == {get_ident()}
    assert stills(2) == alone
    assert get_ident() not in threads
    assert stills(2, faces=10) == alone
    assert set(threads) == {get_ident()}
