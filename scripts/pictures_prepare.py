"""The pictures of docs/prepare.md: one welded mesh that is cut into parts, and a row that is told apart."""

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.asset.edit import as_static_object, moved
from grafu.asset.load import endings_in, load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import Asset
from grafu.export.glb import export_glb
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.transform import translation
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.render.camera import three_quarter_view
from grafu.render.picture import Picture, box_of, contact_sheet, opened_values, posed_visuals, render
from grafu.templates.gallery import builtin_gallery

SAMPLES = Path(__file__).parent.parent / "samples"
SIZE = (420, 320)
ROW = ("chest", "sideboard", "dresser")
GAP = 0.25  # metres between the pieces of the row
COLOURS = ((0.14, 0.36, 0.62), (0.75, 0.33, 0.10), (0.30, 0.52, 0.25), (0.62, 0.07, 0.13), (0.42, 0.28, 0.50))
PLAIN = (0.55, 0.55, 0.55)


def welded_sheet() -> Picture:
    """Returns a sample as one mesh without names, the parts that it is cut into, and what works."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scan.stl"
        merge_meshes([part.mesh for part in load_asset(SAMPLES / "kitchen_base.glb").parts]).to_trimesh().export(path)
        asset = load_asset(path, LoadOptions(up="+Z", front="-Y", scale=1.0))
    whole = _coloured(asset, [PLAIN] * len(asset.parts))
    body = asset.parts[0].id
    cut = _coloured(asset, [PLAIN if p.id == body else COLOURS[k % len(COLOURS)] for k, p in enumerate(asset.parts)])
    captions = ("one mesh, no names", "the parts that it is cut into", "as it opens")
    return _sheet([whole, cut, _opened(asset)], captions)


def pieces_sheet() -> Picture:
    """Returns a row of samples in one file, the pieces that it is told apart into, and each as it opens."""
    found = [load_asset(SAMPLES / f"{name}.glb") for name in ROW]
    ends = np.cumsum([0.0, *(float(asset.box.size[0]) + GAP for asset in found)])
    placed = [
        moved(asset, translation(vec3(end - asset.box.low[0], -asset.box.high[1], 0.0)))
        for asset, end in zip(found, ends, strict=False)
    ]
    with TemporaryDirectory() as folder:
        path = Path(folder) / "row.glb"
        path.write_bytes(export_glb(_together(placed)).contents["model.glb"])
        split = LoadOptions(pieces="split")
        pieces = [load_asset(path, replace(split, piece=k)) for k in range(1, len(endings_in(path, split)) + 1)]
    row = [visual for asset in placed for visual in _coloured(asset, [PLAIN] * len(asset.parts))]
    names = [f"row_piece_{k}" for k in range(1, len(pieces) + 1)]
    return _sheet([row, *(_opened(piece) for piece in pieces)], ["row.glb", *names])


def _together(assets: list[Asset]) -> ArticulatedObject:
    """Returns several assets as one rigid link, without names that mean anything."""
    visuals = [visual for asset in assets for visual in as_static_object(asset).links[0].visuals]
    return ArticulatedObject("row", "body", (Link("body", tuple(_named(v, k) for k, v in enumerate(visuals))),))


def _named(visual: Visual, number: int) -> Visual:
    return replace(visual, name=f"object_{number}")


def _coloured(asset: Asset, colours: list[tuple[float, float, float]]) -> list[Visual]:
    materials = [Material("plain", (*colour, 1.0), roughness=0.7) for colour in colours]
    return [
        Visual(part.id, tuple(Surface(surface.mesh, material) for surface in part.surfaces))
        for part, material in zip(asset.parts, materials, strict=True)
    ]


def _opened(asset: Asset) -> list[Visual]:
    made = functionalize(asset, MotionSource.AUTO, builtin_gallery()).object
    return posed_visuals(made, opened_values(made, 0.6))


def _sheet(shown: list[list[Visual]], captions: list[str] | tuple[str, ...]) -> Picture:
    pictures = [render(each, three_quarter_view(box_of(each), SIZE[0] / SIZE[1]), SIZE) for each in shown]
    return contact_sheet(pictures, captions, len(pictures))


SHEETS = {"prepare_welded": welded_sheet, "prepare_pieces": pieces_sheet}
