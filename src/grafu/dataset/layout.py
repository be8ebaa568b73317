"""The names in a set of results, which its writer and its reader share. It needs the standard library alone."""

import json
from collections.abc import Mapping
from typing import Any, Final

INDEX: Final = "index.jsonl"
PARQUET: Final = "index.parquet"
CARD: Final = "README.md"
METADATA: Final = "metadata.jsonl"
"""In the folder of a split: the rows of its models, where each model is a folder."""
FIGURES: Final = "json"
"""The ending of the member of a shard that holds a model's row."""
BUNDLE: Final = "folder.tar"
"""The ending of the member that holds the files of formats that consist of several, as they lie in the result."""
SPLITS: Final = ("train", "validation", "test")


def json_line(row: Mapping[str, Any]) -> bytes:
    """Returns a row as one line of JSON in ASCII."""
    return (json.dumps(row) + "\n").encode()
