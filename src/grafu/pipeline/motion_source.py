"""Where a motion comes from, as one choice of the user's. It imports nothing, so that the command starts fast."""

from enum import StrEnum


class MotionSource(StrEnum):
    """What states how each door and drawer moves."""

    AUTO = "auto"  # the first of `AUTO_ORDER` that can answer
    ANNOTATION = "annotation"  # the joints that the input states
    NETWORK = "network"  # the trained network
    RULE = "rule"  # carpenters' rules on labels, boxes and handles


AUTO_ORDER = (MotionSource.NETWORK, MotionSource.RULE)
"""What `auto` tries: the network, where its weights came with the package. Neither reads an annotation: an input gives
the same with its joints and without."""
