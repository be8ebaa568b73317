"""The shapes of one link of a robot description as one part: a link is rigid, whatever joint it hangs on.

It looks at links, names and boxes, never at joints. The link that the others hang on holds the body of the piece: its
shapes stay parts of their own.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.bodies import BodyVisual
from grafu.asset.drafts import numbered_whole
from grafu.asset.grips import face_area
from grafu.asset.labels import is_whole_part, label_of
from grafu.asset.names import spoken
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
    covers: float = 0.9
    """Shapes that are named as several doors or drawers are of one where the largest covers so much of the outline of
    their link (fraction of area)."""
    apart: float = 0.05
    """A link that is farther from all others is a piece of furniture by itself (fraction of the diagonal of all)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_links_as_groups(
    visuals: Sequence[BodyVisual], base: str, division: Division, config: LinkGroupConfig = LinkGroupConfig()
) -> tuple[BodyVisual, ...]:
    """Returns the shapes of links, in order, those of each rigid part with its link's name as their group.

    A link whose shapes are named as several doors or drawers holds these and is no part, unless one of them covers the
    others; so is one that fills nearly the whole box, and one that stands apart from all others. Groups that are stated
    stay.

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
    names = {link: _name(link, by_link[link]) for link in rigid}
    taken = Counter([*names.values(), *by_link])
    called = {link: name if taken[name] == 1 else link for link, name in names.items()}
    return tuple(replace(v, group=called[v.link]) if v.link in rigid else v for v in visuals)


def _name(link: str, own: Sequence[BodyVisual]) -> str:
    """Returns what a link is called, or its largest shape where a number is all that names the link (`link_3`)."""
    if spoken(link):
        return link
    boxes = {v.name: box for v in own if label_of(v.name) is not PartLabel.HANDLE and (box := _box([v])) is not None}
    return max(boxes, key=lambda name: face_area(boxes[name]), default=link)


def _is_part(link: str, own: Sequence[BodyVisual], whole: Box | None, config: LinkGroupConfig) -> bool:
    if len(own) < 2 or any(v.group for v in own) or label_of(link) is PartLabel.HANDLE:
        return False
    named = {v.name if is_whole_part(v.name) else numbered_whole(v.name) for v in own} - {"", link}
    box = _box(own)
    if whole is None or box is None or (len(named) > 1 and not _is_of_one_front(own, box, config)):
        return False
    return bool(np.prod(box.size) <= config.most * np.prod(whole.size))


def _is_of_one_front(own: Sequence[BodyVisual], whole: Box, config: LinkGroupConfig) -> bool:
    """Whether one shape covers all others of its link, seen across it: `door_0` is a door, `door_1` is its liner."""
    plate = max((box for visual in own if (box := _box([visual])) is not None), key=face_area)
    across = np.delete(np.arange(3), plate.thin_axis)
    return bool(np.prod(plate.size[across]) >= config.covers * np.prod(whole.size[across]))


def _is_apart(link: str, boxes: Mapping[str, Box], whole: Box | None, config: LinkGroupConfig) -> bool:
    reach = 0.0 if whole is None else config.apart * whole.diagonal
    return not any(boxes[link].overlaps(box, reach) for other, box in boxes.items() if other != link)


def _box(visuals: Iterable[BodyVisual]) -> Box | None:
    boxes = [s.mesh.box for v in visuals for s in v.surfaces if not s.is_empty]
    return Box.enclosing(boxes) if boxes else None
