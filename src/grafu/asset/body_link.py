"""Which link of a robot description holds the body of a piece: its shapes are rigid, as those of every link are.

It looks at links, labels and boxes, never at joints.
"""

from collections.abc import Mapping
from typing import final

import numpy as np

from grafu.asset.part import ROBOTS, Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class BodyLinkConfig:
    """Which link of a robot description holds the body of a piece.

    Raises:
        ValueError: if a number is not above 0.
    """

    boards: int = 3
    """Its parts at least, besides handles: a body that is a single mesh is not known from a drawer."""

    def __post_init__(self) -> None:
        require_positive(self, "boards")


def body_link(asset: Asset, config: BodyLinkConfig = BodyLinkConfig()) -> str:
    """Returns the link of a robot description that holds the body of a piece; empty where there is none, or one link.

    It is the largest, and has several parts of its own.
    """
    links = parts_of_links(asset)
    if asset.kind not in ROBOTS or len(links) < 2:
        return ""
    sizes = {link: float(np.prod(Box.enclosing(p.box for p in own).size)) for link, own in links.items()}
    largest = max(sizes, key=lambda link: sizes[link])
    boards = [part for part in links[largest] if part.label is not PartLabel.HANDLE]
    return largest if len(boards) >= config.boards else ""


def parts_of_links(asset: Asset) -> Mapping[str, list[Part]]:
    """Returns the parts of each link, by its name."""
    found: dict[str, list[Part]] = {}
    for part in asset.parts:
        if part.source.link:
            found.setdefault(part.source.link, []).append(part)
    return found
