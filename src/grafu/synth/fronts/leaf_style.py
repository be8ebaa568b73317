"""The styles of leaves, the sides of a front, and which leaf may have a grip: the words that layouts are made of."""

from typing import Literal

from grafu.synth.fronts.hold import Grip

Side = Literal["left", "right", "top", "bottom"]
LeafStyle = Literal[
    "slab", "chamfered", "rounded", "bowed", "swept", "swept frame", "arched", "half arched", "planks", "shaker",
    "glass", "mirror", "raised panel", "two panels", "muntins", "louvred", "arched rail",
]  # fmt: skip
CURVED: frozenset[LeafStyle] = frozenset({"bowed", "swept", "swept frame"})  # they bulge before the front's plane


def check_grip(grip: Grip, leaf: LeafStyle) -> None:
    """Raises ValueError if a leaf that is not a slab has a grip."""
    if grip != "none" and leaf != "slab":
        raise ValueError(f"a grip is cut into a slab: got a {grip} in a {leaf} leaf")
