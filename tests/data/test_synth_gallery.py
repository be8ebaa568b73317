from base64 import b64decode
from html.parser import HTMLParser
from io import BytesIO

import pytest
from PIL import Image

from grafu.data.gallery import PAGE_NAME, SHEET_NAME, caption_of, gallery_page, views_of
from grafu.synth.generate import make_specimen
from grafu.synth.specimen import Defect, Specimen

SIZE = (72, 60)


def specimen_without_a_part() -> Specimen:
    made = make_specimen(5, 0, 0)
    lost = next(i for i in sorted(made.removable) if i in {p.id for p in made.asset.parts})
    asset = made.whole.without_annotation()
    kept = tuple(p for p in asset.parts if p.id != lost)
    given = type(asset)(asset.name, asset.path, asset.kind, kept)
    defects = (Defect("missing", (lost,)), Defect("floating", (kept[0].id,)), Defect("floating", (kept[1].id,)))
    return Specimen(made.id, made.family, given, made.whole, made.truth, made.removable, defects)


class Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.seen: list[tuple[str, dict[str, str | None]]] = []

    def handle_starttag(self, tag, attrs):
        self.seen.append((tag, dict(attrs)))


def test_the_page_needs_no_other_file_and_shows_every_model():
    files = gallery_page((make_specimen(4, k, 0) for k in range(3)), SIZE)
    page = Tags()
    page.feed(files[PAGE_NAME].decode())
    tags = [tag for tag, _ in page.seen]
    assert (tags.count("figure"), tags.count("svg")) == (3, 3)
    sources = [attrs["src"] or "" for tag, attrs in page.seen if tag == "img"]
    assert all(source.startswith("data:image/jpeg;base64,") for source in sources)
    picture = Image.open(BytesIO(b64decode(sources[0].split(",")[1])))
    assert picture.size == (2 * SIZE[0], SIZE[1])
    assert not [tag for tag in tags if tag in ("script", "link")]


def test_the_sheet_is_a_picture_of_rows_of_two():
    sheet = Image.open(BytesIO(gallery_page([make_specimen(4, k, 0) for k in range(3)], SIZE)[SHEET_NAME]))
    assert sheet.width == 2 * 3 * SIZE[0]
    assert sheet.height > 2 * SIZE[1]


def test_an_opened_model_looks_different():
    views = views_of(make_specimen(4, 1, 0), SIZE)
    assert (views[:, : SIZE[0]] != views[:, SIZE[0] :]).any()


def test_the_caption_says_what_is_wrong():
    specimen = specimen_without_a_part()
    caption = caption_of(specimen)
    assert caption.startswith(f"{specimen.id}: {specimen.family}; {len(specimen.asset.parts)} parts; missing ")
    assert caption.endswith("; floating (2)")


def test_what_is_missing_is_dashed():
    assert "stroke-dasharray" in gallery_page([specimen_without_a_part()], SIZE)[PAGE_NAME].decode()


def test_an_empty_gallery_is_refused():
    with pytest.raises(ValueError, match="at least one specimen"):
        gallery_page([])
