"""Where a motion comes from, as one choice of the user's. It imports nothing, so that the command starts fast."""

from enum import StrEnum


class MotionSource(StrEnum):
    """What states how each door and drawer moves."""

    AUTO = "auto"  # the input's annotation where it has one, else the rule
    ANNOTATION = "annotation"  # the joints that the input states
    RULE = "rule"  # carpenters' rules on labels, boxes and handles
