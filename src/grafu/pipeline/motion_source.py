"""Where a motion comes from, as one choice of the user's. It imports nothing, so that the command starts fast."""

from enum import StrEnum


class MotionSource(StrEnum):
    """What states how each door and drawer moves."""

    AUTO = "auto"  # the first of `AUTO_ORDER` that can answer
    ANNOTATION = "annotation"  # the joints that the input states
    NETWORK = "network"  # the trained network; it reads no annotation
    RULE = "rule"  # carpenters' rules on labels, boxes and handles


AUTO_ORDER = (MotionSource.ANNOTATION, MotionSource.NETWORK, MotionSource.RULE)
"""What `auto` tries: the annotation where the input has one, the network where its weights came with the package.

Without the first it reads no annotation: this line is the one place that decides it."""
