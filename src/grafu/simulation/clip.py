"""A short GIF of a run: poses that a simulator passed through, drawn by our own renderer. It writes no file."""

from collections.abc import Mapping, Sequence
from io import BytesIO

import numpy as np
from PIL import Image

from grafu.articulation.articulated_object import Visual
from grafu.geometry.appearance import Material, Surface
from grafu.render.camera import three_quarter_view
from grafu.render.picture import box_of, render
from grafu.simulation.world import Meshes

_SIZE = (240, 200)
_MILLISECONDS = 120  # of each frame
_COLOURS = ((0.62, 0.52, 0.38), (0.14, 0.36, 0.62), (0.75, 0.33, 0.10), (0.42, 0.52, 0.33), (0.42, 0.28, 0.50))


def clip_of(poses: Sequence[Mapping[str, np.ndarray]], meshes: Meshes, frames: int) -> bytes:
    """Returns a GIF of at most so many poses, evenly chosen; empty where there is no pose or nothing to see."""
    chosen = [poses[k] for k in np.unique(np.linspace(0, len(poses) - 1, frames).round().astype(int))] if poses else []
    visuals = {link: _visual(link, held, k) for k, (link, held) in enumerate(meshes.items()) if held}
    if not chosen or not visuals:
        return b""
    shown = [[_posed(visual, pose.get(link, np.eye(4))) for link, visual in visuals.items()] for pose in chosen]
    camera = three_quarter_view(box_of([visual for frame in shown for visual in frame]), _SIZE[0] / _SIZE[1])
    pictures = [Image.fromarray(render(frame, camera, _SIZE)).convert("RGB") for frame in shown]
    stream = BytesIO()
    pictures[0].save(
        stream, "GIF", save_all=True, append_images=pictures[1:], duration=_MILLISECONDS, loop=0, optimize=True
    )
    return stream.getvalue()


def _visual(link: str, held: Mapping[str, object], index: int) -> Visual:
    color = _COLOURS[0 if index == 0 else 1 + (index - 1) % (len(_COLOURS) - 1)]
    material = Material(link, (*color, 1.0), roughness=0.7)
    return Visual(link, tuple(Surface(mesh, material) for mesh in held.values()))  # type: ignore[arg-type]


def _posed(visual: Visual, T: np.ndarray) -> Visual:
    return Visual(visual.name, tuple(surface.transformed(T) for surface in visual.surfaces))
