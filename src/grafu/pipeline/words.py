"""Numbers and lists as people read them."""

from collections.abc import Iterable


def counted(count: int, what: str) -> str:
    """Returns `1 hinge`, `2 hinges`."""
    endings = {"s": what, "lf": f"{what[:-1]}ves", "x": f"{what}es"}
    plural = next((plural for ending, plural in endings.items() if what.endswith(ending)), f"{what}s")
    return f"{count} {what if count == 1 else plural}"


def listed(words: Iterable[str]) -> str:
    """Returns `a`, `a and b`, `a, b and c`."""
    known = list(words)
    return " and ".join([", ".join(known[:-1]), known[-1]] if len(known) > 1 else known)


def percent(ratio: float) -> str:
    """Returns a fraction as a percentage; never 0 % above nothing, never 100 % below all."""
    if 0 < ratio < 0.005:
        return "under 1 %"
    return "over 99 %" if 0.995 <= ratio < 1 else f"{100 * ratio:.0f} %"


def cut_in_words(kind: str) -> str:
    """Returns the kind of a clearance in the report for people: `shrunk` where the report has `eased`."""
    return "shrunk" if kind == "eased" else kind
