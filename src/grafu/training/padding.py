"""Arrays of different lengths as one tensor, filled up behind their ends.

Batches of ever new sizes would be slow: for each size of a product oneDNN builds code of its own, keeps a thousand of
them, and litters the heap with those that it drops. With sizes in steps a few dozen are made once.
"""

from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor

SLOT_STEP = 4  # graphs of a batch have so many nodes, or a multiple
ROW_STEP = 64  # and their points as many rows


def stepped(size: int, step: int) -> int:
    """Returns the least multiple of `step` that is not below `size`."""
    return -(-size // step) * step


def padded(arrays: Sequence[np.ndarray], shape: tuple[int, ...], fill: float | int | bool) -> Tensor:
    """Returns the arrays, each filled up to `shape`, one behind another; there is at least one."""
    stacked = np.full((len(arrays), *shape), fill, dtype=arrays[0].dtype)
    for row, array in zip(stacked, arrays, strict=True):
        row[tuple(slice(size) for size in array.shape)] = array
    return torch.from_numpy(stacked)
