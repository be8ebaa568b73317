"""What was decided by hand about a model, read from `decisions.jsonl`. It writes nothing.

A line is a JSON object; `chosen` null takes back what an earlier line of the same part and question states. So the last
line of each is what holds.
"""

import json
from pathlib import Path
from typing import Any, Final

from grafu.asset.json_files import read_own
from grafu.errors import AssetError

DECISIONS: Final = "decisions.jsonl"
Key = tuple[str, str]
"""A part and a question."""


def decided_before(path: Path, model: str) -> dict[Key, Any]:
    """Returns what the lines of a file decide about a model; a line that is damaged, say cut short, is passed over."""
    try:
        text = read_own(path, "decisions of grafu").decode(errors="replace")
    except AssetError:
        return {}
    found: dict[Key, Any] = {}
    for line in text.splitlines():
        record = _parsed(line)
        if record.get("model") == model and isinstance(record.get("part"), str):
            found[record["part"], str(record.get("question"))] = record.get("chosen")
    return {key: value for key, value in found.items() if value is not None}


def _parsed(line: str) -> dict[str, Any]:
    try:
        record = json.loads(line)
    except (ValueError, RecursionError):
        return {}
    return record if isinstance(record, dict) else {}
