"""Names: from what people and exporters write to words, and to ids that URDF and USD accept. It knows no labels."""

import re
import unicodedata
from collections.abc import Iterable

_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")
_LETTERS = re.compile(r"[a-z]+")
_UNSAFE = re.compile(r"[^A-Za-z0-9]+")

# The output contract keeps these beginnings for hardware; `handle` begins the names of handles alone.
_LONGEST = 120  # letters of an id: what is made for a part puts its own words before and behind it
_HARDWARE = ("hinge_", "rail_", "support_")


def plain(name: str) -> str:
    """Returns the name in ASCII, accents dropped (`Tür` becomes `Tur`)."""
    return unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()


def words(name: str) -> tuple[str, ...]:
    """Returns the lower-case words of a name; digits and signs part words, and so does camelCase."""
    return tuple(_LETTERS.findall(_CAMEL.sub(" ", plain(name)).lower()))


def safe_id(name: str, is_handle: bool = False) -> str:
    """Returns an id of the form `[A-Za-z_][A-Za-z0-9_]*` that does not pass for hardware or, wrongly, for a handle.

    Long names are cut: files are called by ids, and no file system takes more than 255 letters.
    """
    base = _UNSAFE.sub("_", plain(name)).strip("_")[:_LONGEST].rstrip("_")
    if is_handle and not base.startswith("handle"):
        return f"handle_{base}".rstrip("_")
    reserved = not is_handle and (base.startswith("handle") or f"{base}_".startswith(_HARDWARE))
    if not base or base[0].isdigit() or reserved:
        return f"part_{base}".rstrip("_")
    return base


def unique_ids(names: Iterable[tuple[str, bool]]) -> list[str]:
    """Returns one safe id per (name, is_handle); repeated ones get `_2`, `_3`, ... in order."""
    wanted = [safe_id(name, is_handle) for name, is_handle in names]
    taken: set[str] = set()
    counts: dict[str, int] = {}
    reserved = set(wanted)
    ids = []
    for base in wanted:
        chosen = base
        while chosen in taken or (chosen != base and chosen in reserved):
            counts[base] = counts.get(base, 1) + 1
            chosen = f"{base}_{counts[base]}"
        taken.add(chosen)
        ids.append(chosen)
    return ids
