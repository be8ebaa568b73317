"""How finely two models are compared, and how near two are that must not lie in different splits."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive


@final
@dataclass(frozen=True)
class DescriptorConfig:
    """Lengths are fractions of the sides of the box around the model, so that its size does not count.

    Raises:
        ValueError: if a number is not above 0.
    """

    cells_across: int = 4
    """Cells of the grid along X, an even number: half of them are the mirror images of the others."""
    cells_deep: int = 4
    """Cells along Y."""
    cells_up: int = 6
    """Cells along Z."""
    longest_edge: float = 1.0
    """Triangles are halved until no edge is longer, in cells: how a surface is cut into triangles does not count."""
    thinnest: float = 0.01
    """The box counts as at least so thick, as a fraction of its longest side: noise in a flat model does not count."""
    faces_at_once: int = 20_000
    """How many faces are halved at a time, which bounds the memory."""
    proportion_weight: float = 0.5
    """How much the proportions of the box weigh against what is in it."""
    radius: float = 0.08
    """Two models whose descriptors are at most so far apart are near-duplicates; the largest distance is about 1.4."""
    rounding: float = 0.0005
    """Descriptors are compared as multiples of this: copies that differ by rounding are the same."""
    hash_step: float = 0.05
    """The geometric hash is made of few numbers of the descriptor, each a multiple of this."""
    tree_axes: int = 12
    """Along how many axes, the longest of the set, the tree of neighbours parts it."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        if self.cells_across % 2:
            raise ValueError(f"`DescriptorConfig.cells_across` must be even: got {self.cells_across}")
