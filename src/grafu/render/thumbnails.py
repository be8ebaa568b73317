"""Thumbnails of all templates, and what each is made of, for programs that offer them: `... thumbnails FOLDER`.

Run as `python -m grafu.render.thumbnails FOLDER`: there go, for each template, `KIND-ID.png` and `KIND-ID.packed`
(`grafu.export.blend.process`), and at the end `templates.json`, whose `templates` have `key` (`KIND-ID`), `kind`
(`hinge`, `rail`, `handle`), `id`, `title` and `about`.
"""

import sys
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import final

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.dataclass import dataclass
from grafu.export.blend.process import packed
from grafu.export.whole_file import whole_file
from grafu.graph.serialize import dump_json
from grafu.render.gallery import Model, handle_object, handle_picture, models_of, natural_object, template_picture
from grafu.render.picture import Picture, encode_png
from grafu.templates.concealed import ConcealedModel
from grafu.templates.gallery import builtin_gallery
from grafu.templates.handles import HANDLES
from grafu.templates.template import RailModel

SIZE = (256, 256)
"""Pixels of a thumbnail, as Blender's asset browser shows them."""


@final
@dataclass(frozen=True)
class TemplateEntry:
    """What a list of templates states about one: its kind (`hinge`, `rail`, `handle`), id, title and a few words."""

    kind: str
    id: str
    title: str
    about: str

    @property
    def key(self) -> str:
        """The name of its files."""
        return f"{self.kind}-{self.id}"


def thumbnails(size: tuple[int, int] = SIZE) -> Iterator[tuple[TemplateEntry, Picture, ArticulatedObject]]:
    """Yields every built-in template: what it is, its picture (`size` pixels), and itself at its natural size."""
    for model in models_of(builtin_gallery()):
        yield _entry_of(model), template_picture(model, size), natural_object(model)
    for handle in HANDLES:
        entry = TemplateEntry("handle", handle.id, handle.title, handle.family)
        yield entry, handle_picture(handle, size=size), handle_object(handle)


def write_thumbnails(folder: Path) -> None:
    """Writes what the module's docstring names into a folder that is there."""
    entries = []
    for entry, picture, made in thumbnails():
        _write(encode_png(picture), folder / f"{entry.key}.png")
        _write(packed(made), folder / f"{entry.key}.packed")
        entries.append({"key": entry.key, **asdict(entry)})
    _write(dump_json({"templates": entries}).encode(), folder / "templates.json")


def _entry_of(model: Model) -> TemplateEntry:
    about = "concealed" if isinstance(model, ConcealedModel) else model.mechanism.in_words
    return TemplateEntry("rail" if isinstance(model, RailModel) else "hinge", model.id, model.title, about)


def _write(data: bytes, path: Path) -> None:
    with whole_file(path) as fresh:
        fresh.write_bytes(data)


if __name__ == "__main__":
    write_thumbnails(Path(sys.argv[1]))
