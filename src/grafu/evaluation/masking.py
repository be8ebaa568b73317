"""Labels hidden at random, the same ones for the same model and seed. It changes nothing else of an asset."""

from dataclasses import replace
from hashlib import sha256

import numpy as np

from grafu.asset.part import Asset
from grafu.vocabulary import PartLabel

LEVELS = (0.1, 0.3, 0.5, 1.0)
"""The paper's rates."""


def masked(asset: Asset, share: float, seed: int) -> Asset:
    """Returns the asset with this share of its labels unknown, rounded to whole parts, and no joints or riders.

    Of one seed the parts that are masked at a lower share are masked at every higher one, so that levels differ by
    nothing but what is hidden. The draw depends on the asset's name and its part ids alone.

    Raises:
        ValueError: if the share is not in 0..1.
    """
    if not 0 <= share <= 1:
        raise ValueError(f"`share` must be in 0..1: got {share}")
    bare = asset.without_annotation()
    hidden = set(mask_order(bare, seed)[: round(share * len(bare.parts))])
    parts = tuple(replace(p, label=PartLabel.UNKNOWN, labelled_by="none") if p.id in hidden else p for p in bare.parts)
    return replace(bare, parts=parts)


def mask_order(asset: Asset, seed: int) -> list[str]:
    """Returns the part ids in the order in which they lose their labels."""
    ids = sorted(part.id for part in asset.parts)
    digest = sha256("\n".join([asset.name, *ids]).encode()).digest()
    order = np.random.default_rng([seed, int.from_bytes(digest[:8])]).permutation(len(ids))
    return [ids[k] for k in order]
