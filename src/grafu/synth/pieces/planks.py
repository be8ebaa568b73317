"""Pieces made of straight boards, the most of all furniture. It knows no furniture."""

from collections.abc import Sequence

from grafu.geometry.appearance import Material
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.pieces.assembly import Piece
from grafu.synth.pieces.finish import surface_of
from grafu.synth.pieces.shapes import board, sheet
from grafu.vocabulary import PartLabel

Corner = tuple[float, float, float]
Span = tuple[Corner, Corner]
LEAST = 1e-6  # metres below which a board is a sheet without thickness


def plank(label: PartLabel, stem: str, material: Material, *spans: Span) -> Piece:
    """Returns a piece of one or more boards, each between two corners; one without thickness is a sheet."""
    return Piece(label, stem, tuple(surface_of(straight(low, high), material) for low, high in spans))


def solid(label: PartLabel, stem: str, material: Material, meshes: Sequence[TriangleMesh]) -> Piece:
    """Returns a piece of several solids in one material."""
    return Piece(label, stem, tuple(surface_of(mesh, material) for mesh in meshes))


def straight(low: Corner, high: Corner) -> TriangleMesh:
    """Returns a board, or a sheet where the corners agree along one axis."""
    thin = min(b - a for a, b in zip(low, high, strict=True)) < LEAST
    return sheet(low, high) if thin else board(low, high)


def mirrored_span(span: Span) -> Span:
    """Returns the mirror image of a span across x = 0."""
    (x0, *low), (x1, *high) = span
    return (-x1, low[0], low[1]), (-x0, high[0], high[1])


def both_sides(span: Span) -> tuple[tuple[str, Span], tuple[str, Span]]:
    """Returns a span given on the right (+x) and its mirror image, each with the word for its side."""
    return ("left", mirrored_span(span)), ("right", span)
