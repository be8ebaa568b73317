"""The shapes of one link of a robot description as one part: a link is rigid, whatever joint it hangs on.

It looks at links, names and boxes, never at joints. The link that the others hang on holds the body of the piece: its
shapes stay parts of their own.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.bodies import BodyVisual
from grafu.asset.drafts import numbered_whole
from grafu.asset.labels import is_whole_part, label_of
from grafu.asset.options import Division
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class LinkGroupConfig:
    """Which links are one part.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    most: float = 0.9
    """A link that fills more of the box around all holds the whole piece, and is no part of it (fraction)."""
    apart: float = 0.05
    """A link that is farther from all others is a piece of furniture by itself (fraction of the diagonal of all)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_links_as_groups(
    visuals: Sequence[BodyVisual], base: str, division: Division, config: LinkGroupConfig = LinkGroupConfig()
) -> tuple[BodyVisual, ...]:
    """Returns the shapes of links, in order, those of each rigid part with its link's name as their group.

    A link whose shapes are named as several doors or drawers holds these and is no part; so is one that fills nearly
    the whole box, and one that stands apart from all others. Groups that are stated stay.

    Args:
        visuals: the shapes of all links, in any one frame.
        base: the link that the others hang on.
        division: how the user wants parts; all stay as they are in the file unless they are found automatically.
        config: the tolerances.
    """
    if division != "auto":
        return tuple(visuals)
    by_link: dict[str, list[BodyVisual]] = {}
    for visual in visuals:
        by_link.setdefault(visual.link, []).append(visual)
    whole = _box(visuals)
    boxes = {link: box for link, own in by_link.items() if (box := _box(own)) is not None}
    rigid = {
        link
        for link, own in by_link.items()
        if link != base and _is_part(link, own, whole, config) and not _is_apart(link, boxes, whole, config)
    }
    return tuple(replace(v, group=v.link) if v.link in rigid else v for v in visuals)


def _is_part(link: str, own: Sequence[BodyVisual], whole: Box | None, config: LinkGroupConfig) -> bool:
    if len(own) < 2 or any(v.group for v in own) or label_of(link) is PartLabel.HANDLE:
        return False
    named = {v.name if is_whole_part(v.name) else numbered_whole(v.name) for v in own} - {"", link}
    box = _box(own)
    if len(named) > 1 or whole is None or box is None:
        return False
    return bool(np.prod(box.size) <= config.most * np.prod(whole.size))


def _is_apart(link: str, boxes: Mapping[str, Box], whole: Box | None, config: LinkGroupConfig) -> bool:
    reach = 0.0 if whole is None else config.apart * whole.diagonal
    return not any(boxes[link].overlaps(box, reach) for other, box in boxes.items() if other != link)


def _box(visuals: Iterable[BodyVisual]) -> Box | None:
    boxes = [s.mesh.box for v in visuals for s in v.surfaces if not s.is_empty]
    return Box.enclosing(boxes) if boxes else None
