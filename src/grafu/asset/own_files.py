"""Files that grafu wrote, read again with the care that anybody's need: folders of results are passed on.

A file is read where it lies in the folder that it is sought in, links followed.
"""

import os
from pathlib import Path
from typing import Any, Final

from grafu.asset.json_files import parse_json
from grafu.asset.regular_files import TooManyBytes, read_regular
from grafu.asset.resources import reason_of
from grafu.errors import AssetTooLarge, UnreadableAsset

MOST_BYTES: Final = 64 * 2**20
"""Of a report, settings or a manifest; those of a thousand parts have one or two million."""


def read_own(path: Path, expected: str, most: int = MOST_BYTES) -> bytes:
    """Returns the content of a file that grafu wrote; `expected` states in words what it should be.

    Raises:
        UnreadableAsset: if it is missing, cannot be read, is no regular file, or leads out of its folder.
        AssetTooLarge: if it has more than `most` bytes.
    """
    try:
        folder, target = Path(os.path.realpath(path.parent)), Path(os.path.realpath(path))
        if not target.is_relative_to(folder):
            raise UnreadableAsset(f"{path} is a link that leads out of its folder: expected {expected}")
        return read_regular(target, most, folder)
    except TooManyBytes:
        raise AssetTooLarge(f"{path} has more than {most / 2**20:g} MiB: expected {expected}") from None
    except (OSError, ValueError) as error:
        raise UnreadableAsset(f"{path} cannot be read ({reason_of(error)}): expected {expected}") from None


def read_own_json(path: Path, expected: str, most: int = MOST_BYTES) -> Any:
    """Returns the values in a JSON file that grafu wrote.

    Raises:
        UnreadableAsset: if it cannot be read, as by `read_own`, or is no JSON.
        AssetTooLarge: if it has more than `most` bytes, or more values than are read.
    """
    return parse_json(read_own(path, expected, most), path, expected)
