"""Pictures of furniture without a window, a GPU or Blender: rays, soft light, outlines. It writes no files.

A picture is an array of 8-bit sRGB with alpha, rows from the top; `encode_png` and `encode_jpeg` make bytes of it.
The renderer is our own: pyrender, PyVista and Open3D need OpenGL on the machine and 190 MB to 1.1 GB; the rays are
Embree's, which geometry needs anyway.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from io import BytesIO

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from grafu.articulation.articulated_object import ArticulatedObject, Visual, VisualRole
from grafu.articulation.kinematics import link_poses, with_coupled
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Mat4
from grafu.geometry.box import Box
from grafu.render.camera import Camera, three_quarter_view
from grafu.render.changing_places import left_closed
from grafu.render.exposure import SIDE, Exposure, PictureStyle, Samples
from grafu.render.light import displayed
from grafu.render.ray_scene import RayScene
from grafu.shapes import UInt8
from grafu.vocabulary import PartLabel

Picture = UInt8[np.ndarray, "_ _ 4"]

_INK = (38, 38, 40)


CATEGORY_COLORS: dict[PartLabel, tuple[float, float, float]] = {
    PartLabel.TOP_PANEL: (0.55, 0.40, 0.26),
    PartLabel.SIDE_PANEL: (0.62, 0.52, 0.38),
    PartLabel.BACK_PANEL: (0.45, 0.42, 0.38),
    PartLabel.BOTTOM_PANEL: (0.48, 0.36, 0.25),
    PartLabel.FACE_FRAME: (0.72, 0.60, 0.36),
    PartLabel.SHELF: (0.42, 0.52, 0.33),
    PartLabel.DIVIDER: (0.28, 0.45, 0.38),
    PartLabel.BAR: (0.50, 0.50, 0.55),
    PartLabel.LEG: (0.25, 0.22, 0.20),
    PartLabel.DOOR: (0.14, 0.36, 0.62),
    PartLabel.DRAWER: (0.75, 0.33, 0.10),
    PartLabel.HANDLE: (0.62, 0.07, 0.13),
    PartLabel.MISC: (0.42, 0.28, 0.50),
    PartLabel.UNKNOWN: (0.60, 0.60, 0.60),
}
"""A linear colour for each category; doors are blue, drawers orange, handles red."""


def render(
    visuals: Sequence[Visual], camera: Camera, size: tuple[int, int] = (640, 480), style: PictureStyle | None = None
) -> Picture:
    """Returns a picture of visuals as they stand; `size` is width and height in pixels.

    Raises:
        ValueError: if the size is not positive.
    """
    style = style or PictureStyle()
    width, height = size
    if min(size) < 1:
        raise ValueError(f"`size` must be a positive width and height: got {size}")
    shown = [_in_category_color(v) for v in visuals] if style.by_category else visuals
    samples = Exposure(RayScene(shown), camera, (width, height), style).samples()
    each = [samples[row::SIDE, column::SIDE] for row in range(SIDE) for column in range(SIDE)]
    return _developed(sum(each[1:], each[0]) / len(each), style)  # quicker than a mean along two short axes


def posed_visuals(articulated: ArticulatedObject, values: Mapping[str, float] | None = None) -> list[Visual]:
    """Returns all visuals moved to joint values (radians or metres; joints left out stay closed).

    Raises:
        ArticulationError: if `values` names a joint that the object does not have.
    """
    return [
        replace(visual, surfaces=_moved(visual, T), swing=None) for visual, T in placed_visuals(articulated, values)
    ]


def _moved(visual: Visual, T: Mat4) -> tuple[Surface, ...]:
    """Returns the surfaces mapped by T; the very same ones where they stay, of which much may be known already."""
    if np.array_equal(T, np.eye(4)):
        return visual.surfaces
    return tuple(surface.transformed(T) for surface in visual.surfaces)


def placed_visuals(
    articulated: ArticulatedObject, values: Mapping[str, float] | None = None
) -> list[tuple[Visual, Mat4]]:
    """Returns all visuals at rest, each with the motion that takes it to joint values; see `posed_visuals`."""
    poses = link_poses(articulated, values or {}, shown=True)
    values = with_coupled(articulated, values or {})
    by_link = {link: values.get(joint.id, 0.0) for link, joint in articulated.joint_of.items()}

    def place(visual: Visual, T: Mat4) -> Mat4:
        return T if visual.swing is None else np.asarray(T @ visual.swing.motion(by_link[visual.swing.moving]))

    return [(visual, place(visual, poses[link.id])) for link in articulated.links for visual in link.visuals]


def opened_values(articulated: ArticulatedObject, ratio: float = 1.0) -> dict[str, float]:
    """Returns each moving joint's value at a fraction of its range, 0 closed and 1 wide open; coupled ones follow.

    Of sliding leaves that would only change places one stays closed (`left_closed`).
    """
    closed = left_closed(articulated)
    free = {j.id: j.limits.lower + (0.0 if j.id in closed else ratio) * j.limits.range for j in articulated.free_joints}
    return with_coupled(articulated, free)


def box_of(visuals: Sequence[Visual]) -> Box:
    """Returns the box around all visuals that have a face (a unit cube, where there is none)."""
    boxes = [v.mesh.box for v in visuals if len(v.mesh.faces)]
    if not boxes:
        return Box(np.zeros(3), np.ones(3))
    return Box.enclosing(boxes)


def before_after(
    articulated: ArticulatedObject,
    size: tuple[int, int] = (640, 480),
    style: PictureStyle | None = None,
    before: Sequence[Visual] | None = None,
) -> Picture:
    """Returns two pictures side by side from one camera: closed (or `before`), and opened; `size` is one's size."""
    closed = list(before) if before is not None else posed_visuals(articulated)
    opened = posed_visuals(articulated, opened_values(articulated))
    camera = three_quarter_view(box_of([*closed, *opened]), size[0] / size[1])
    return np.concatenate([render(closed, camera, size, style), render(opened, camera, size, style)], axis=1)


def contact_sheet(pictures: Sequence[Picture], captions: Sequence[str], columns: int = 3) -> Picture:
    """Returns pictures of one size in rows on white, each with its caption below.

    Raises:
        ValueError: if there is no picture, the sizes differ, or there is not one caption for each.
    """
    if not pictures or len(pictures) != len(captions) or len({p.shape for p in pictures}) > 1:
        sizes = [p.shape[:2] for p in pictures]
        raise ValueError(f"a contact sheet needs pictures of one size with a caption each: got {sizes}, {captions}")
    height, width = pictures[0].shape[:2]
    strip, columns = max(22, height // 10), min(columns, len(pictures))
    rows = -(-len(pictures) // columns)
    sheet = Image.new("RGBA", (columns * width, rows * (height + strip)), "white")
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(size=int(0.62 * strip))
    for k, (picture, caption) in enumerate(zip(pictures, captions, strict=True)):
        x, y = (k % columns) * width, (k // columns) * (height + strip)
        sheet.alpha_composite(Image.fromarray(picture), (x, y))
        draw.text((x + width / 2, y + height + 0.3 * strip), caption, fill=_INK, font=font, anchor="mm")
    return np.array(sheet)


def encode_png(picture: Picture) -> bytes:
    """Returns the picture as a PNG file's bytes."""
    return _encoded(Image.fromarray(picture), "PNG")


def encode_jpeg(picture: Picture, quality: int = 90) -> bytes:
    """Returns the picture as a JPEG file's bytes, on white."""
    white = Image.new("RGBA", (picture.shape[1], picture.shape[0]), "white")
    return _encoded(Image.alpha_composite(white, Image.fromarray(picture)).convert("RGB"), "JPEG", quality)


def _encoded(image: Image.Image, kind: str, quality: int = 90) -> bytes:
    stream = BytesIO()
    image.save(stream, kind, quality=quality)
    return stream.getvalue()


def _in_category_color(visual: Visual) -> Visual:
    if visual.role is VisualRole.HARDWARE:
        return visual
    material = Material(visual.label.value, (*CATEGORY_COLORS[visual.label], 1.0), roughness=0.7)
    return replace(visual, surfaces=tuple(Surface(s.mesh, material, normals=s.normals) for s in visual.surfaces))


def _developed(samples: Samples, style: PictureStyle) -> Picture:
    """Returns 8-bit sRGB of premultiplied linear samples."""
    alpha = samples[..., 3:]
    rgb, is_lit = np.zeros((*samples.shape[:2], 3), np.uint8), samples[..., :3].any(axis=-1)  # a shadow is black
    rgb[is_lit] = displayed(samples[is_lit, :3] / np.maximum(alpha[is_lit], 1e-6))
    if style.background == "white":  # white paper: composed after the tone curve, which never reaches white
        paper = np.round(rgb * alpha + 255 * (1 - alpha)).astype(np.uint8)
        return np.concatenate([paper, np.full_like(paper[..., :1], 255)], axis=-1)
    return np.concatenate([rgb, np.round(alpha * 255).astype(np.uint8)], axis=-1)
