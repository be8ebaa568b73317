"""A cache by content, so that a run that changes little builds little again.

A cached value is what the function would return again: the functions are pure, and the key is the content of everything
that they are given. It knows nothing of what it holds.
"""

from collections import OrderedDict
from collections.abc import Callable
from typing import Any, TypeVar, final

from grafu.geometry.content import content_key

T = TypeVar("T")


@final
class Cache:
    """The last `most` values that were asked for; not a value. With `most` 0 nothing is cached, and no key is made.

    `made` counts how often something was made rather than found, by name.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._values: OrderedDict[bytes, tuple[Any, tuple[object, ...]]] = OrderedDict()
        self.made: dict[str, int] = {}

    def value(self, name: str, make: Callable[..., T], *given: object) -> T:
        """Returns `make(*given)`: the one that was cached under this name for the same content, else a new one."""
        if not self._most:
            return make(*given)
        key = content_key((name, given))
        if key not in self._values:
            self.made[name] = self.made.get(name, 0) + 1
            self._values[key] = make(*given), given
            while len(self._values) > self._most:
                self._values.popitem(last=False)
        self._values.move_to_end(key)
        found: T = self._values[key][0]
        return found


NO_CACHE = Cache(0)
"""Makes everything anew."""
