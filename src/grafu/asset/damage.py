"""One guard around calls of other people's readers: whatever they raise, the file is damaged.

It stands around the library's call alone. Around our own code it would hide our own faults.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from grafu.errors import UnreadableAsset


@contextmanager
def library_call(where: object, expected: str) -> Iterator[None]:
    """Turns any exception of a library inside the block into one clear line; NumPy warns of no number in it.

    Args:
        where: the file, for the message.
        expected: what it should have been, in words.

    Raises:
        UnreadableAsset: where the library raised anything but an interruption or want of memory.
    """
    try:
        with np.errstate(all="ignore"):  # numbers that damage made huge, or none
            yield
    except MemoryError:
        raise
    except Exception:
        raise UnreadableAsset(f"{where} is damaged or of another kind: expected {expected}") from None
