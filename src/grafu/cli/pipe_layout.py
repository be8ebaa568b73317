"""How tables and lines are laid out in a pipe or a file, which have no width of their own."""

from typing import Final

PIPE_WIDTH: Final = 200  # rich would fold at 80
NUMBERS: Final = ("doors", "drawers", "skipped", "seconds", "opening", "models", "movable")
"""The columns whose cells stand to the right."""
