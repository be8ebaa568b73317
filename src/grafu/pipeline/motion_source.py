"""Where a motion comes from, as one choice of the user's. It imports nothing heavy, so that the command starts fast."""

from enum import StrEnum
from pathlib import Path
from typing import final

from grafu.dataclass import dataclass
from grafu.errors import OptionError


class MotionSource(StrEnum):
    """What states how each door and drawer moves."""

    AUTO = "auto"  # the first of `AUTO_ORDER` that can answer
    ANNOTATION = "annotation"  # the joints that the input states
    NETWORK = "network"  # the trained network
    RULE = "rule"  # the rule-based baseline: labels, boxes and handles
    PARTICULATE = "particulate"  # a file that Particulate wrote
    SINGAPO = "singapo"  # an object.json of SINGAPO or CAGE
    GRAFU_PRED = "grafu-pred"  # a predicted graph of the authors' own code
    URDF = "urdf"  # the joints of any other robot description of the object

    @property
    def is_foreign(self) -> bool:
        """Whether another system states the motions, in a file of its own."""
        return self in FOREIGN


FOREIGN = (MotionSource.PARTICULATE, MotionSource.SINGAPO, MotionSource.GRAFU_PRED, MotionSource.URDF)
"""The sources that are read from another system's file."""

AUTO_ORDER = (MotionSource.NETWORK, MotionSource.RULE)
"""What `auto` tries: the network, where its weights came with the package. Neither reads an annotation: an input gives
the same with its joints and without."""


@final
@dataclass(frozen=True, slots=True)
class SourceOption:
    """A source and, where it is another system's, its file, or a folder that holds what it wrote for each input.

    Raises:
        OptionError: if a foreign source has no file, or another one has.
    """

    source: MotionSource = MotionSource.AUTO
    path: Path | None = None

    def __post_init__(self) -> None:
        if self.source.is_foreign and self.path is None:
            raise OptionError(f"motions of {self.source} are read from a file, which must be named: {self.source}:FILE")
        if self.path is not None and not self.source.is_foreign:
            raise OptionError(f"the motion source {self.source} reads no file: got {self.path}")


def parse_motion(text: str) -> SourceOption:
    """Returns the choice that `SOURCE` or, for another system's file, `SOURCE:FILE` states.

    Raises:
        OptionError: if there is no such source, or a file is missing or one too many.
    """
    word, _, file = text.partition(":")
    sources = {source.value: source for source in MotionSource}
    source = sources.get(word.strip().lower())
    if source is None:
        words = [f"{word}:FILE" if each.is_foreign else word for word, each in sources.items()]
        raise OptionError(f"must be one of {', '.join(words)}: got {text!r}")
    return SourceOption(source, Path(file) if file else None)
