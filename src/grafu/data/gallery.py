"""Specimens to look at: each as it was modelled, whole and opened, and its graph, in one page and one sheet.

It writes no files and makes no furniture.
"""

from base64 import b64encode
from collections import Counter
from collections.abc import Iterable
from html import escape

import numpy as np

from grafu.articulation.sweep import all_open
from grafu.asset.edit import as_static_object
from grafu.export.files import ExportFiles
from grafu.render.camera import three_quarter_view
from grafu.render.exposure import PictureStyle
from grafu.render.graph_picture import (
    EDGE_COLORS,
    SHORT_LABELS,
    GraphDrawing,
    category_rgb,
    draw_graph,
    drawing_picture,
    drawing_svg,
)
from grafu.render.picture import Picture, box_of, contact_sheet, encode_jpeg, encode_png, posed_visuals, render
from grafu.synth.specimen import Specimen
from grafu.synth.truth.clashes import articulated_of

PAGE_NAME = "gallery.html"
SHEET_NAME = "gallery.png"
SIZE = (230, 200)  # pixels of one picture: small, so that a hundred models take a minute or two
_COLUMNS = 2  # specimens in a row of the sheet
_BY_CATEGORY = PictureStyle(by_category=True)

_CSS = """
body { font: 14px sans-serif; margin: 24px; color: #262628; background: #fff }
main { display: flex; flex-wrap: wrap; gap: 18px }
figure { margin: 0; border: 1px solid #ddd; border-radius: 6px; padding: 6px }
figure > div { display: flex }
figcaption { padding: 4px 6px; max-width: 44em }
.key span { display: inline-block; margin: 0 10px 6px 0 }
.key i { display: inline-block; min-width: 1.3em; padding: 1px 4px; border-radius: 9px; color: #fff; font-style: normal;
  text-align: center }
"""


def gallery_page(specimens: Iterable[Specimen], size: tuple[int, int] = SIZE) -> ExportFiles:
    """Returns `gallery.html`, which needs no other file, and `gallery.png`, the same models on one sheet.

    Each model is seen as modelled, in its own look; whole with every joint open, by category; and as its true graph,
    what the model lacks dashed. `size` is one picture's width and height in pixels.

    Raises:
        ValueError: if there is no specimen.
    """
    panels: list[Picture] = []
    captions: list[str] = []
    figures: list[str] = []
    for specimen in specimens:
        views = views_of(specimen, size)
        drawing = draw_graph(specimen.truth, size, specimen.missing, names=False)
        panels.append(np.concatenate([views, drawing_picture(drawing)], axis=1))
        captions.append(f"{specimen.id}: {specimen.family}, {len(specimen.asset.parts)} parts")
        figures.append(_figure(specimen, views, drawing))
    if not panels:
        raise ValueError("a gallery needs at least one specimen: got none")
    sheet = encode_png(contact_sheet(panels, captions, _COLUMNS))
    return ExportFiles({PAGE_NAME: _page(figures).encode(), SHEET_NAME: sheet})


def views_of(specimen: Specimen, size: tuple[int, int] = SIZE) -> Picture:
    """Returns two pictures side by side from one camera: as modelled, and whole with every joint wide open."""
    closed = posed_visuals(as_static_object(specimen.asset))
    articulated = articulated_of(specimen.whole)
    opened = posed_visuals(articulated, all_open(articulated))
    camera = three_quarter_view(box_of([*closed, *opened]), size[0] / size[1])
    return np.concatenate([render(closed, camera, size), render(opened, camera, size, _BY_CATEGORY)], axis=1)


def caption_of(specimen: Specimen) -> str:
    """Returns id, family, number of parts, what is missing and which other defects there are, in one line."""
    defects = Counter(defect.kind for defect in specimen.defects if defect.kind != "missing")
    words = [f"{specimen.id}: {specimen.family}", f"{len(specimen.asset.parts)} parts"]
    if specimen.missing:
        words.append(f"missing {', '.join(specimen.missing)}")
    words += [f"{kind} ({count})" if count > 1 else kind for kind, count in defects.items()]
    return "; ".join(words)


def _figure(specimen: Specimen, views: Picture, drawing: GraphDrawing) -> str:
    width, height = views.shape[1], views.shape[0]
    source = "data:image/jpeg;base64," + b64encode(encode_jpeg(views, quality=85)).decode()
    image = f'<img alt="" width="{width}" height="{height}" src="{source}">'
    caption = escape(caption_of(specimen))
    return f"<figure><div>{image}{drawing_svg(drawing)}</div><figcaption>{caption}</figcaption></figure>"


def _page(figures: list[str]) -> str:
    head = '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Synthetic furniture</title>'
    intro = (
        f"<p>{len(figures)} models. Each: as modelled; whole, every joint open, coloured by category; its functional "
        "graph, dashed what the model lacks.</p>"
    )
    return "\n".join(
        [f"{head}<style>{_CSS}</style></head><body>", intro, _key(), "<main>", *figures, "</main></body></html>\n"]
    )


def _key() -> str:
    nodes = [(SHORT_LABELS[label], label.value, category_rgb(label)) for label in SHORT_LABELS]
    edges = [("&mdash;", kind.value, color) for kind, color in EDGE_COLORS.items()]
    entries = [
        f'<span><i style="background:rgb{color}">{sign}</i> {name}</span>' for sign, name, color in nodes + edges
    ]
    return f'<p class="key">{"".join(entries)}</p>'
