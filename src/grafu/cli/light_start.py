"""What the command does without as it starts: the checks of array shapes, and a search for garbage among modules.

They are for the tests. In the command's own processes the names of jaxtyping stand for the plain array class, and
jaxtyping, with a third of all modules of the standard library behind it, is not imported. A program that imports grafu
as a library keeps all as it is.
"""

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

_SHAPES = (
    *("Bool", "Int", "UInt", "Float", "Complex", "Num", "Real", "Inexact", "Integer", "Shaped"),
    *(f"{kind}{bits}" for kind in ("Int", "UInt") for bits in (8, 16, 32, 64)),
    *(f"Float{bits}" for bits in (16, 32, 64)),
)


class _AnyShape:
    """What stands for a jaxtyping name: with a class and a shape in brackets it is that class."""

    def __getitem__(self, stated: tuple[Any, str]) -> Any:
        return stated[0]


def without_shape_checks() -> None:
    """Lets this process's modules be imported without jaxtyping; does nothing where it is imported already."""
    if "jaxtyping" not in sys.modules:
        light = ModuleType("jaxtyping", "The names of array shapes, which nothing checks in this process.")
        light.__dict__.update(dict.fromkeys(_SHAPES, _AnyShape()))
        sys.modules["jaxtyping"] = light


@contextmanager
def without_collecting() -> Iterator[None]:
    """Imports many modules at a go: what they hold stays, to look for garbage among it takes a tenth of the time."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
