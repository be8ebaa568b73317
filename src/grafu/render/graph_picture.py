"""A functional graph as a picture: one drawing, as SVG text or as pixels. It writes no files.

Nodes stand where their parts stand, seen from the front and pushed apart, coloured by category; contacts are thin and
grey, hinges blue, rails orange, attachments red. Where a part moves, its motion is written: the border that carries the
pin and the rotation axis, or the direction of the slide, as signed axes of the object frame.
"""

from collections.abc import Collection
from dataclasses import replace
from html import escape
from typing import final

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from grafu.dataclass import dataclass
from grafu.graph.edges import Contact, Edge, MotionEdge, Rail, Slide, Turn, ends_of, kind_of
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import AXIS_NAMES, border_to_face, border_to_signed_axis
from grafu.render.graph_layout import Places, in_the_way, node_places, with_room
from grafu.render.light import displayed
from grafu.render.picture import CATEGORY_COLORS, Picture
from grafu.vocabulary import EdgeKind, PartLabel

Rgb = tuple[int, int, int]
Point = tuple[float, float]

EDGE_COLORS: dict[EdgeKind, Rgb] = {
    EdgeKind.CONTACT: (186, 186, 190),
    EdgeKind.HINGE: (24, 96, 200),
    EdgeKind.RAIL: (222, 112, 16),
    EdgeKind.ATTACHED: (190, 24, 44),
    EdgeKind.SLIDE: (142, 84, 168),
    EdgeKind.TURN: (16, 132, 132),
}
"""An sRGB colour for each kind of edge."""

SHORT_LABELS: dict[PartLabel, str] = {
    PartLabel.TOP_PANEL: "T",
    PartLabel.SIDE_PANEL: "S",
    PartLabel.BACK_PANEL: "Bk",
    PartLabel.BOTTOM_PANEL: "Bo",
    PartLabel.FACE_FRAME: "F",
    PartLabel.SHELF: "Sh",
    PartLabel.DIVIDER: "Di",
    PartLabel.BAR: "Ba",
    PartLabel.LEG: "L",
    PartLabel.DOOR: "Do",
    PartLabel.DRAWER: "Dr",
    PartLabel.HANDLE: "H",
    PartLabel.MISC: "M",
    PartLabel.UNKNOWN: "?",
}
"""What is written in a node."""

_INK: Rgb = (38, 38, 40)
_NAME = 10.0  # pixels: the size of a name
_FINE = 3  # the raster is drawn so many times as large, then made smaller


@final
@dataclass(frozen=True, slots=True)
class Stroke:
    """A straight line, width in pixels."""

    start: Point
    end: Point
    color: Rgb
    width: float


@final
@dataclass(frozen=True, slots=True)
class Disc:
    """A node: a filled circle with a word in it; dashed and hollow where the part is missing. `title` is its name."""

    center: Point
    radius: float
    color: Rgb
    word: str
    title: str
    dashed: bool = False


@final
@dataclass(frozen=True, slots=True)
class Writing:
    """A line of text, centred on a point, size in pixels, on a white ground."""

    center: Point
    text: str
    size: float
    color: Rgb


@final
@dataclass(frozen=True, slots=True)
class GraphDrawing:
    """What is drawn, from back to front: strokes, discs, writings; `size` is width and height in pixels."""

    size: tuple[int, int]
    strokes: tuple[Stroke, ...]
    discs: tuple[Disc, ...]
    writings: tuple[Writing, ...]


def draw_graph(
    graph: FunctionalGraph,
    size: tuple[int, int] = (640, 480),
    missing: Collection[str] = (),
    names: bool | None = None,
) -> GraphDrawing:
    """Returns the drawing of a graph; `missing` are the ids of nodes that are drawn dashed.

    With `names` the ids stand below the nodes; None writes them where there is room. No name covers another node or its
    writings: one that finds no such place is left out, and is the node's title alone.

    Raises:
        ValueError: if the size is not positive.
    """
    if min(size) < 1:
        raise ValueError(f"`size` must be a positive width and height: got {size}")
    room = float(np.sqrt(size[0] * size[1] / max(len(graph.nodes), 1)))  # the side of one node's own square
    radius = float(np.clip(0.2 * room, 4.0, 15.0))
    names = room > 105 if names is None else names
    places = node_places(graph, size, 2.2 * radius + (4 if names else 0), (5.0 if names else 3.3) * radius)
    halves = _halves(graph, radius) if names else np.zeros((0, 2))
    places = with_room(places, halves, size) if names else places
    place_of = {node.id: (float(x), float(y)) for node, (x, y) in zip(graph.nodes, places, strict=True)}
    kinds = list(EDGE_COLORS)  # contacts first, so that they lie at the back
    edges = sorted(graph.edges, key=lambda edge: kinds.index(kind_of(edge)))
    strokes = tuple(_stroke(edge, place_of, radius) for edge in edges)
    discs = tuple(_disc(node, place_of[node.id], radius, node.id in missing) for node in graph.nodes)
    writings = _motions(graph, place_of, radius, above=names)
    if names:
        moving = {move.child for move in graph.motions}
        hidden = in_the_way(places, halves, np.array([node.id in moving for node in graph.nodes], dtype=bool))
        named = [item for item, is_hidden in zip(place_of.items(), hidden, strict=True) if not is_hidden]
        writings += [Writing((x, y + radius + 7), i, _NAME, _INK) for i, (x, y) in named]
    return GraphDrawing(size, strokes, discs, tuple(_within(w, size) for w in writings))


def drawing_svg(drawing: GraphDrawing) -> str:
    """Returns the drawing as a whole SVG element, to stand in a page or in a file of its own."""
    width, height = drawing.size
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}"'
    body = [*map(_stroke_svg, drawing.strokes), *map(_disc_svg, drawing.discs), *map(_writing_svg, drawing.writings)]
    return "\n".join([f'{head} font-family="sans-serif" text-anchor="middle">', *body, "</svg>"])


def drawing_picture(drawing: GraphDrawing) -> Picture:
    """Returns the drawing as pixels on white."""
    width, height = drawing.size
    image = Image.new("RGBA", (width * _FINE, height * _FINE), "white")
    draw = ImageDraw.Draw(image)
    for stroke in drawing.strokes:
        ends = [tuple(_FINE * c for c in point) for point in (stroke.start, stroke.end)]
        draw.line(ends, fill=stroke.color, width=round(_FINE * stroke.width))
    for disc in drawing.discs:
        _paint_disc(draw, disc)
    for writing in drawing.writings:
        _paint_text(draw, writing.center, writing.text, writing.size, writing.color, halo=1.5)
    return np.array(image.resize((width, height), Image.Resampling.LANCZOS))


def motion_words(graph: FunctionalGraph, edge: MotionEdge) -> str:
    """Returns how the child moves: `-X about +Z` (the pin lies on the -X side, the axis points up), or `slides -Y`."""
    if isinstance(edge, Rail | Slide):
        return f"slides {AXIS_NAMES[edge.axis]}"
    if isinstance(edge, Turn):
        return f"turns about {AXIS_NAMES[edge.axis]}"
    thin = graph.node(edge.child).box.thin_axis
    face = border_to_face(thin, edge.border)
    return f"{AXIS_NAMES[face]} about {AXIS_NAMES[border_to_signed_axis(thin, edge.border, edge.sign)]}"


def category_rgb(label: PartLabel) -> Rgb:
    """Returns the category's colour as 8-bit sRGB."""
    r, g, b = (int(c) for c in displayed(np.array(CATEGORY_COLORS[label], dtype=np.float32)))
    return r, g, b


def _stroke(edge: Edge, place_of: dict[str, Point], radius: float) -> Stroke:
    first, second = ends_of(edge)
    width = 0.8 if isinstance(edge, Contact) else float(np.clip(radius / 4, 1.8, 3.0))
    return Stroke(place_of[first], place_of[second], EDGE_COLORS[kind_of(edge)], width)


def _disc(node: PartNode, place: Point, radius: float, dashed: bool) -> Disc:
    title = f"{node.id} ({node.label.value}{', missing' if dashed else ''})"
    return Disc(place, radius, category_rgb(node.label), SHORT_LABELS[node.label], title, dashed)


def _motions(graph: FunctionalGraph, place_of: dict[str, Point], radius: float, above: bool) -> list[Writing]:
    """Returns one writing for each moving part: above it, or else on the side where its first edge does not run."""
    first: dict[str, MotionEdge] = {}
    for edge in sorted(graph.motions, key=lambda edge: list(EDGE_COLORS).index(kind_of(edge))):
        first.setdefault(edge.child, edge)
    size = _motion_size(radius)
    found = []
    for child, move in first.items():
        x, y = place_of[child]
        side = 1 if not above and place_of[move.parent][1] < y else -1
        color = EDGE_COLORS[kind_of(move)]
        found.append(Writing((x, y + side * (radius + 0.75 * size)), motion_words(graph, move), size, color))
    return found


def _motion_size(radius: float) -> float:
    return float(np.clip(0.85 * radius, 7.0, 11.0))


def _halves(graph: FunctionalGraph, radius: float) -> Places:
    """Returns half the width and height of each node with its name and motion, pixels."""
    size = _motion_size(radius)
    wide = {node.id: _half_width(node.id, _NAME) for node in graph.nodes}
    for move in graph.motions:
        wide[move.child] = max(wide[move.child], _half_width(motion_words(graph, move), size))
    high = radius + max(1.3 * size, 1.3 * _NAME)
    return np.array([(max(wide[node.id], radius + 1.0), high) for node in graph.nodes]).reshape(-1, 2)


def _half_width(text: str, size: float) -> float:
    """Returns half the width of a line of text, pixels: letters are about half as wide as high."""
    return 0.27 * size * len(text) + 2


def _within(writing: Writing, size: tuple[int, int]) -> Writing:
    """Returns the writing shifted into the picture."""
    half = np.array([_half_width(writing.text, writing.size), 0.6 * writing.size])
    x, y = np.clip(writing.center, np.minimum(half, np.array(size) / 2), np.maximum(size - half, np.array(size) / 2))
    return replace(writing, center=(float(x), float(y)))


def _hex(color: Rgb) -> str:
    return "#" + "".join(f"{c:02x}" for c in color)


def _stroke_svg(stroke: Stroke) -> str:
    (x1, y1), (x2, y2) = stroke.start, stroke.end
    ends = f'x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"'
    return f'<line {ends} stroke="{_hex(stroke.color)}" stroke-width="{stroke.width:g}"/>'


def _disc_svg(disc: Disc) -> str:
    (x, y), r, color = disc.center, disc.radius, _hex(disc.color)
    look = f'fill="#fff" stroke="{color}" stroke-dasharray="3 2.2"' if disc.dashed else f'fill="{color}" stroke="#fff"'
    circle = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" {look} stroke-width="1.4"/>'
    ink = _hex(_INK) if disc.dashed else "#fff"
    word = f'<text x="{x:.1f}" y="{y + 0.34 * r:.1f}" font-size="{r:.1f}" fill="{ink}">{escape(disc.word)}</text>'
    return f"<g><title>{escape(disc.title)}</title>{circle}{word}</g>"


def _writing_svg(writing: Writing) -> str:
    x, y = writing.center
    place = f'x="{x:.1f}" y="{y + 0.34 * writing.size:.1f}" font-size="{writing.size:.1f}" fill="{_hex(writing.color)}"'
    halo = 'stroke="#fff" stroke-width="2.5" paint-order="stroke"'
    return f"<text {place} {halo}>{escape(writing.text)}</text>"


def _paint_disc(draw: ImageDraw.ImageDraw, disc: Disc) -> None:
    (x, y), r = (_FINE * disc.center[0], _FINE * disc.center[1]), _FINE * disc.radius
    around = (x - r, y - r, x + r, y + r)
    if disc.dashed:
        draw.ellipse(around, fill="white")
        for start in range(0, 360, 36):
            draw.arc(around, start, start + 22, fill=disc.color, width=round(1.4 * _FINE))
    else:
        draw.ellipse(around, fill=disc.color, outline="white", width=_FINE)
    _paint_text(draw, disc.center, disc.word, disc.radius, _INK if disc.dashed else (255, 255, 255))


def _paint_text(
    draw: ImageDraw.ImageDraw, center: Point, text: str, size: float, color: Rgb, halo: float = 0.0
) -> None:
    font = ImageFont.load_default(size=_FINE * size)
    place = (_FINE * center[0], _FINE * center[1])
    draw.text(place, text, fill=color, font=font, anchor="mm", stroke_width=round(_FINE * halo), stroke_fill="white")
