"""What takes long to prepare of arrays is prepared once: found again by content, as long as there is room.

The same mesh comes again as another value: a rail that is tried in one place is then tested in it, a part is asked for
its rays by one stage after another.
"""

from collections import OrderedDict
from collections.abc import Callable
from hashlib import blake2b
from typing import Generic, TypeVar, final

import numpy as np

Made = TypeVar("Made")


@final
class RememberedByContent(Generic[Made]):
    """What was made of arrays, the last used as far as they fit in `room`; not a value."""

    def __init__(self, room: int) -> None:
        self._left = room
        self._made: OrderedDict[bytes, tuple[Made, int]] = OrderedDict()

    def of(self, make: Callable[[], Made], size: int, *arrays: np.ndarray) -> Made:
        """Returns what `make` makes of contiguous arrays, or made of equal ones; it takes `size` of the room."""
        digest = blake2b(digest_size=16)
        for array in arrays:
            digest.update(array.data)
            digest.update(b"%d" % len(array))
        key = digest.digest()
        if (known := self._made.get(key)) is not None:
            self._made.move_to_end(key)
            return known[0]
        made = make()
        self._made[key] = made, size
        self._left -= size
        while self._left < 0:
            self._left += self._made.popitem(last=False)[1][1]
        return made
