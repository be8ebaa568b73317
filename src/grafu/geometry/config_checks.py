"""Checks of the numbers in a config. Configs use them when they are made."""

from math import inf, isfinite


def require_positive(config: object, *names: str) -> None:
    """Raises ValueError unless these fields of a config are above 0 and finite; of a tuple, all its numbers."""
    for name in names:
        value = getattr(config, name)
        if not all(0 < number < inf for number in (value if isinstance(value, tuple) else (value,))):
            raise ValueError(f"`{type(config).__name__}.{name}` must be above 0: got {value}")


def require_finite(config: object, *names: str) -> None:
    """Raises ValueError unless all numbers of these fields of a config, which are tuples, are finite."""
    for name in names:
        if not all(isfinite(number) for number in getattr(config, name)):
            raise ValueError(f"`{type(config).__name__}.{name}` must be finite: got {getattr(config, name)}")


def require_not_negative(config: object, *names: str) -> None:
    """Raises ValueError unless these fields of a config are at least 0 and finite."""
    for name in names:
        if not 0 <= getattr(config, name) < inf:
            raise ValueError(f"`{type(config).__name__}.{name}` must not be negative: got {getattr(config, name)}")


def require_at_most_one(config: object, *names: str) -> None:
    """Raises ValueError unless these fields of a config are at most 1."""
    for name in names:
        if not getattr(config, name) <= 1:
            raise ValueError(f"`{type(config).__name__}.{name}` must be at most 1: got {getattr(config, name)}")


def require_ratios(config: object, *names: str) -> None:
    """Raises ValueError unless these fields of a config lie between 0 and 1."""
    for name in names:
        if not 0 < getattr(config, name) < 1:
            raise ValueError(f"`{type(config).__name__}.{name}` must be between 0 and 1: got {getattr(config, name)}")
