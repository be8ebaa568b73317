"""Names that are those of kitchen appliances, and of which of them doors drop."""

from typing import Final

from grafu.asset.labels import APPLIANCES, is_appliance
from grafu.asset.names import singular, spoken

_DROPPING: Final = frozenset({"oven", "stove", "cooker", "dishwasher"})
_REFRIGERATORS: Final = frozenset({"fridge", "refrigerator"})


def appliances(name: str) -> frozenset[str]:
    """Returns the words of kitchen appliances in a name that ends with one; none where it is that of a part of one."""
    said = [singular(word) for word in spoken(name)]
    return frozenset(said) & APPLIANCES if said and said[-1] in APPLIANCES and is_appliance(name) else frozenset()


def is_dropping_door(name: str) -> bool:
    """Whether a name is that of the door of an oven or a dishwasher, which drops."""
    said = [singular(word) for word in spoken(name)]
    if len(said) < 2 or said[-1] != "door" or "microwave" in said:
        return False
    return said[-2] in _DROPPING or "".join(said[-3:-1]) in _DROPPING  # `dish_washer_door`


def is_drop_down(name: str) -> bool:
    """Whether a name is that of an oven or a dishwasher, whose doors drop, or of such a door; no microwave oven."""
    found = appliances(name)
    return is_dropping_door(name) or (bool(found & _DROPPING) and "microwave" not in found)


def is_drop_down_body(name: str) -> bool:
    """Whether a name is that of an oven, a dishwasher or its body, whose door drops; no microwave oven."""
    said = {singular(word) for word in spoken(name)}
    return is_appliance(name) and bool(said & _DROPPING) and "microwave" not in said


def is_refrigerator(name: str) -> bool:
    """Whether a name is that of a refrigerator, its body or its door; chests that freeze have lids."""
    said = [singular(word) for word in spoken(name)]
    is_door = len(said) > 1 and said[-1] == "door"
    return bool(_REFRIGERATORS & set(said)) and (is_door or is_appliance(name))
