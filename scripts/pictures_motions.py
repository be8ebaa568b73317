"""The contact sheet of docs/joints.md: furniture of each way to move, opened on the joints that were built for it.

Motions are the synthetic furniture's own, so no weights change a picture. `python scripts/pictures.py motions` writes
the sheet; `python scripts/judge_kinds.py` judges the same kinds in figures.
"""

from collections.abc import Callable
from math import radians

import numpy as np
from judge_kinds_makers import KINDS

from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.render.camera import three_quarter_view
from grafu.render.picture import Picture, box_of, contact_sheet, opened_values, posed_visuals, render
from grafu.templates.gallery import builtin_gallery

SIZE = (260, 220)
COLUMNS = 5
SHOWN = {  # kind: seed, caption, and how far it is opened
    "sliding": (1, "sliding doors", 0.5),
    "pocket-door": (2, "pocket door", 0.8),
    "folding": (2, "folding doors", 0.7),
    "folding-corner": (2, "two hinged leaves", 0.8),
    "shutter": (0, "shutter", 0.7),
    "lid": (1, "lid with a stay", 0.9),
    "lift-up": (2, "lift-up flap", 1.0),
    "lift-parallel": (1, "parallel lift", 1.0),
    "drop-front": (1, "drop front", 1.0),
    "tilting": (1, "tilting fronts", 1.0),
    "drop-leaf-supports": (1, "table leaves, supports", 1.0),
    "extending": (2, "extension leaves", 1.0),
    "pull-out": (1, "pull-out unit", 1.0),
    "waste-bin": (2, "waste bin", 1.0),
    "keyboard-tray": (1, "keyboard tray", 1.0),
    "carousel": (3, "carousel", 1.0),
    "swivel-mirror": (1, "swivel mirror", 1.0),
    "refrigerator": (1, "refrigerator", 0.8),
    "oven": (1, "oven, racks, knobs", 1.0),
    "dishwasher": (1, "dishwasher, baskets", 1.0),
    "microwave": (1, "microwave oven", 0.8),
    "washing-machine": (1, "washing machine", 0.9),
    "building-door": (1, "door, lever, bolt", 0.6),
    "two-leaf-window": (1, "window, two leaves", 0.6),
    "sash": (1, "sash window", 0.8),
}
FROM_THE_RIGHT = ("carousel", "folding-corner")  # what is seen best from the side to which the corner opens


def motions_sheet() -> Picture:
    """Returns one opened piece of each kind, with a caption each."""
    pictures = [_opened(kind, seed, ratio) for kind, (seed, _, ratio) in SHOWN.items()]
    return contact_sheet(pictures, [caption for _, caption, _ in SHOWN.values()], COLUMNS)


def _opened(kind: str, seed: int, ratio: float) -> Picture:
    asset = KINDS[kind](np.random.default_rng(seed), kind)
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery()).object
    visuals = posed_visuals(made, opened_values(made, ratio))
    azimuth = radians(55 if kind in FROM_THE_RIGHT else -35)
    return render(visuals, three_quarter_view(box_of(visuals), SIZE[0] / SIZE[1], azimuth), SIZE)


SHEETS: dict[str, Callable[[], Picture]] = {"motions": motions_sheet}
