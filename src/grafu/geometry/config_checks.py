"""Checks of the numbers in a config, which configs use when they are made, and configs for models in another scale."""

from dataclasses import is_dataclass, replace
from functools import lru_cache
from math import inf, isfinite
from typing import Any, TypeVar, cast

T = TypeVar("T")


def at_scale(config: T, metre: float) -> T:
    """Returns a config for a model on which a metre is `metre` metres long.

    The fields that `LENGTHS` of its class names, and those of configs in it, are multiplied: lengths in metres on
    furniture of usual size. Other such lengths are multiplied where they are used. It is to be asked for once.
    """
    return config if metre == 1.0 else cast(T, _scaled(config, metre))


@lru_cache(maxsize=256)  # one config is asked for once for each joint, and takes as long as a tenth of a joint
def _scaled(config: Any, metre: float) -> Any:
    changed = dict[str, object]()
    lengths = getattr(type(config), "LENGTHS", ())
    for name in config.__dataclass_fields__:
        value = getattr(config, name)
        if is_dataclass(value):
            changed[name] = at_scale(value, metre)
        elif name in lengths:
            changed[name] = tuple(metre * v for v in value) if isinstance(value, tuple) else metre * value
    return replace(config, **changed)


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
