"""Furniture that has no top and wants none, told by names: beds, crates, sinks, appliances. It looks at no shape."""

from collections.abc import Iterable
from typing import Final

from grafu.asset.languages import word_set
from grafu.asset.names import singular, spoken

TOPLESS: Final = word_set(
    "bed mattress cradle crib cot sofa couch armchair crate basket sink basin washbasin washstand bathtub stove cooker "
    "hob cooktop oven microwave fridge refrigerator freezer dishwasher washer bin stair"
)


def why_no_top(names: Iterable[str]) -> str:
    """Returns why no top is put on what these are the names of (the piece and its parts), empty where one may be."""
    for name in names:
        said = [singular(word) for word in spoken(name)]
        beside = {i for i, word in enumerate(said[1:]) if word in ("side", "room")}  # a bedside table, a bedroom
        found = [word for i, word in enumerate(said) if word in TOPLESS and i not in beside]
        if found:
            return f"by its name `{name}` it has a {found[0]}, on which no top belongs"
    return ""
