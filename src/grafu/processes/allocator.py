"""How glibc's malloc treats what is freed: kept for what comes next, or given back to the system each time."""

import ctypes
from typing import Final

_TRIM_THRESHOLD: Final = -1  # M_TRIM_THRESHOLD of mallopt(3)
_MMAP_MAX: Final = -4  # M_MMAP_MAX
_ARENA_MAX: Final = -8  # M_ARENA_MAX
_NEVER: Final = -1


def keep_freed_memory() -> bool:
    """Has glibc keep the memory that is freed, from now on and until the process ends; whether it will do so.

    By default each block above some size, up to 32 MB, is a mapping of its own: it is given back when it is freed, and
    the next one is filled with zeros page by page. A step of training on a processor allocates a gigabyte in such
    blocks, and so takes half as long again. The process never becomes smaller then. Other allocators (musl, macOS,
    Windows, what is preloaded) are left as they are.
    """
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (AttributeError, OSError, TypeError):  # no such function, or no such library
        return False
    return all([mallopt(_ARENA_MAX, 1), mallopt(_MMAP_MAX, 0), mallopt(_TRIM_THRESHOLD, _NEVER)])
