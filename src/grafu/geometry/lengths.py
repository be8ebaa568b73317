"""Lengths as people write them: a number of metres, or one with its unit."""

import re
from collections.abc import Mapping
from types import MappingProxyType

METRES_PER_UNIT: Mapping[str, float] = MappingProxyType({"mm": 0.001, "cm": 0.01, "m": 1.0, "in": 0.0254, "ft": 0.3048})


def metres_of(text: str) -> float:
    """Returns the length in metres that a text such as `0.72`, `72cm` or `28.3 in` states.

    Raises:
        ValueError: if it is not a number, or the unit is not known; the message states what is expected.
    """
    parts = re.fullmatch(r"\s*([-+0-9.e]+|[-+]?nan|[-+]?inf)\s*([a-z]*)\s*", text, re.I)
    unit = parts[2].lower() or "m" if parts else ""
    try:
        return float(parts[1] if parts else "") * METRES_PER_UNIT[unit]
    except (KeyError, ValueError):
        units = ", ".join(METRES_PER_UNIT)
        raise ValueError(f"must be a number, or one with a unit of {units}: got {text!r}") from None
