"""What no case may do, whatever was read: rules on exceptions, on what a command states, and on what is written."""

import json
import traceback
from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree

from grafu.errors import FunctionalizationError

_LONGEST = 10_000  # characters of a message: names of 5,000 characters may stand in it
_NONE_OF_OURS = "site-packages"


def of_exception(error: BaseException) -> list[str]:
    """Returns what is wrong with an exception: nothing, if it is one of our own with a message."""
    if isinstance(error, FunctionalizationError):
        return [] if str(error).strip() else ["an exception states nothing"]
    frames = traceback.extract_tb(error.__traceback__)
    ours = [f for f in frames if "grafu" in Path(f.filename).parts and _NONE_OF_OURS not in f.filename]
    where = f"{Path(ours[-1].filename).name}:{ours[-1].lineno} {ours[-1].name}" if ours else "?"
    return [f"raises {type(error).__name__} in {where}: {' '.join(str(error).split())[:200]}"]


def of_command(code: object, said: str, complained: str) -> list[str]:
    """Returns what is wrong with a command that ended: its exit code and what it said on stdout and stderr."""
    broken = []
    if code not in (0, 1, 2):
        broken.append(f"exit code {code!r}")
    for word in ("internal error", "Traceback", "out of memory", "Warning:"):
        if word in complained + said:
            line = next(line for line in (complained + said).splitlines() if word in line)
            broken.append(f"states {word!r}: {line[:400]}")
    lines = complained.splitlines()
    if code and (len(lines) != 1 or not lines[0].startswith("grafu: ")):
        broken.append(f"exit code {code} with {len(lines)} lines on stderr: {complained[:300]!r}")
    return broken + _length(complained) + _control(said + complained)


def of_results(folder: Path, before: Mapping[str, tuple[int, int]]) -> list[str]:
    """Returns what is wrong with files that were written: JSON that is not strict, XML that is not well formed."""
    broken = []
    written = (name for name, state in listing(folder).items() if before.get(name) != state)
    for path in (folder / name for name in written):
        try:
            if path.suffix == ".json":
                json.loads(path.read_bytes(), parse_constant=_no_number)
            elif path.suffix in (".urdf", ".xml"):
                ElementTree.fromstring(path.read_bytes())
        except (ValueError, ElementTree.ParseError) as error:
            broken.append(f"writes {path.name}, which is damaged: {str(error)[:200]}")
    return broken


def listing(folder: Path) -> dict[str, tuple[int, int]]:
    """Returns the size and time of all that lies below a folder, links not followed."""
    found = {}
    for path in sorted(folder.rglob("*")):
        state = path.lstat()
        found[str(path.relative_to(folder))] = (state.st_size, 0 if path.is_dir() else state.st_mtime_ns)
    return found


def of_change(what: str, before: dict[str, tuple[int, int]], after: dict[str, tuple[int, int]]) -> list[str]:
    """Returns what is wrong if something in a folder was added, changed or taken away."""
    names = sorted(name for name in {*before, *after} if before.get(name) != after.get(name))
    return [f"changes {what}: {', '.join(names[:3])[:300]}"] if names else []


def _no_number(word: str) -> float:
    raise ValueError(f"{word} is no JSON")


def _length(said: str) -> list[str]:
    return [f"states {len(said)} characters: {said[:100]!r}"] if len(said) > _LONGEST else []


def _control(said: str) -> list[str]:
    found = sorted(
        {c for c in said if (c < " " and c not in "\n\t") or "\x7f" <= c < "\xa0" or "\ud800" <= c < "\ue000"}
    )
    return [f"prints control characters: {found}"] if found else []
