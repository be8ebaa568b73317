"""A made cabinet with a door and drawers behind it, with what pages must stand: odd names, glass, textures, colours."""

from dataclasses import dataclass, replace
from io import BytesIO

import numpy as np
from PIL import Image

from grafu.asset.part import Asset, PartSource
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report import report_of
from grafu.pipeline.report_schema import Report
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.viewer.model_page import model_page
from grafu.viewer.pictures import take_stills

ATTACK = "</script><script>window.hurt=1</script><img src=x onerror='window.hurt=1'>"
CABINET = Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door(handle="none")), (1.0, 3.0)))
BLUE = (0.05, 0.1, 0.9, 1.0)
GLASS = Material("glass", (0.7, 0.9, 1.0, 0.3), alpha_mode="BLEND")


@dataclass(frozen=True)
class Made:
    result: Functionalized
    report: Report


def made_model() -> Made:
    result = functionalize(named_badly(painted(make_cabinet(CABINET))), MotionSource.ANNOTATION, builtin_gallery())
    return Made(result, report_of(result, ATTACK))


def page_of(made: Made) -> str:
    result = made.result
    stills = take_stills(result.asset, result.object, (64, 48))
    return model_page(result.asset, result.object, result.completion, made.report, stills)


def picture(size: tuple[int, int] = (64, 32), mode: str = "RGB", kind: str = "PNG") -> bytes:
    stream = BytesIO()
    Image.new(mode, size, (200, 40, 40) if mode == "RGB" else (200, 40, 40, 128)).save(stream, kind)
    return stream.getvalue()


def painted(asset: Asset) -> Asset:
    """The same asset, the door blue, one side textured, another of glass, the bottom with a colour at each vertex."""
    looks = {"door": Material("blue", BLUE), "side_panel_right": GLASS}
    parts = []
    for part in asset.parts:
        look = next((look for name, look in looks.items() if part.id.startswith(name)), None)
        surfaces = part.surfaces
        if look:
            surfaces = tuple(Surface(s.mesh, look, None, s.normals) for s in surfaces)
        elif part.id.startswith("side_panel_left"):
            surfaces = tuple(textured(s) for s in surfaces)
        elif part.id.startswith("bottom"):
            surfaces = tuple(colored(s) for s in surfaces)
        parts.append(replace(part, surfaces=surfaces))
    return replace(asset, parts=tuple(parts))


def textured(surface: Surface) -> Surface:
    material = Material("wood", base_color_texture=Texture("wood", picture(), "image/png"))
    return Surface(surface.mesh, material, surface.mesh.vertices[:, :2] * 3.0 - 1.7, surface.normals)


def colored(surface: Surface) -> Surface:
    rows = np.arange(4 * len(surface.mesh.vertices)) % 251
    return Surface(surface.mesh, Material(), None, surface.normals, rows.astype(np.uint8).reshape(-1, 4))


def named_badly(asset: Asset) -> Asset:
    """The same asset, one part of which has a name that would like to be run."""
    first, *others = asset.parts
    return replace(asset, parts=(replace(first, source=PartSource(ATTACK)), *others))
