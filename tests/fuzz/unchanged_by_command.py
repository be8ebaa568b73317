"""Cases whose files are as they were made, read by the whole command where there is one for them."""

from fuzz.case import Case
from fuzz.cases import NAMES, unchanged_case
from fuzz.readers import READERS as READERS


def make_case(seed: int, index: int) -> Case:
    """Returns the case of the kind of starting files with this index."""
    return unchanged_case(NAMES[index], index, by_command=READERS[NAMES[index]].arguments is not None)
