"""Arrays of different lengths as one tensor, filled up behind their ends."""

from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor


def padded(arrays: Sequence[np.ndarray], shape: tuple[int, ...], fill: float | int | bool) -> Tensor:
    """Returns the arrays, each filled up to `shape`, one behind another; there is at least one."""
    stacked = np.full((len(arrays), *shape), fill, dtype=arrays[0].dtype)
    for row, array in zip(stacked, arrays, strict=True):
        row[tuple(slice(size) for size in array.shape)] = array
    return torch.from_numpy(stacked)
