"""What choices may be about: the parts, joints, handles and compartments of the last build."""

from collections.abc import Mapping
from dataclasses import field
from typing import final

from grafu.dataclass import dataclass
from grafu.editor.rooms import Room
from grafu.joints.motion_choice import MotionChoice
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class Known:
    """What the last build knows of the parts that are asked about.

    `parts` are the ids of the input's parts, `added` those of the parts that were added, `moving` those that move,
    `motions` how they do (none of a part whose motion no choice can state). `compartments` counts these. `categories`
    are those of parts that have one. `fronts` are the moving parts that added handles are on. `rooms` are the least and
    the greatest offset of the handles that were added to a moving part: aside, then up, metres.
    """

    parts: frozenset[str]
    added: frozenset[str] = frozenset()
    moving: frozenset[str] = frozenset()
    motions: Mapping[str, MotionChoice] = field(default_factory=dict)
    compartments: int = 0
    categories: Mapping[str, PartLabel] = field(default_factory=dict)
    fronts: Mapping[str, str] = field(default_factory=dict)
    rooms: Mapping[str, Room] = field(default_factory=dict)
