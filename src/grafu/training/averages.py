"""Means over marked entries, so that padding and what is unknown never count."""

import torch
from jaxtyping import Bool, Float
from torch import Tensor


def mean_where(values: Float[Tensor, "*shape"], where: Bool[Tensor, "*shape"]) -> Float[Tensor, ""]:
    """Returns the mean of the marked values, 0 where none is marked."""
    return weighted_mean(values, where.to(values.dtype))


def weighted_mean(values: Float[Tensor, "*shape"], weights: Float[Tensor, "*shape"]) -> Float[Tensor, ""]:
    """Returns the mean of the values by weight; values without weight take no part, even if infinite."""
    used = torch.where(weights > 0, values, 0.0)
    total = weights.sum()
    return (used * weights).sum() / torch.where(total > 0, total, 1.0)
