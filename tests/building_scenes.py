"""A door of a building, of a few boxes: its frame, its leaf and a knob."""

from dataclasses import replace

from small_scenes import box, cylinder


def frame(depth=0.12, width=0.9, low=0.0):
    """Two jambs and a head in one part, open at the floor."""
    half, post = depth / 2, 0.05
    pieces = [
        box("a", (0.0, -half, low), (post, half, 2.1)),
        box("b", (width - post, -half, low), (width, half, 2.1)),
        box("c", (post, -half, 2.05), (width - post, half, 2.1)),
    ]
    return replace(
        box("frame", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=tuple(s for p in pieces for s in p.surfaces)
    )


def leaf(y=(-0.06, -0.02), x=(0.053, 0.847), name="panel"):
    return box(name, (x[0], y[0], 0.005), (x[1], y[1], 2.045))


def knob(x=0.79, y=(-0.1, -0.06), name="grip"):
    return cylinder(name, ((x, y[0], 1.0), (x, y[1], 1.0)), 0.02)
