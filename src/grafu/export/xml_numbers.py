"""Numbers as XML attributes hold them: short, without minus zero or rounding noise."""

from collections.abc import Iterable


def number(value: float) -> str:
    """Returns a number in ten digits; what is smaller than 1e-12 is zero."""
    return f"{value if abs(value) > 1e-12 else 0.0:.10g}"


def numbers(values: Iterable[float]) -> str:
    """Returns numbers apart by spaces."""
    return " ".join(number(float(value)) for value in values)
