"""Names: from what people and exporters write to words, and to ids that URDF and USD accept.

A name as English words in English order, whatever its language and spelling.

`Schubladengriff`, `poignée de tiroir`, `抽屉把手` and `DrawerHandle.001` all become `drawer handle`. A compound is
taken apart where known words cover it. Words without meaning (`mesh`, `Cube`, materials) are dropped, unknown
ones kept.
"""

import re
import unicodedata
from collections.abc import Iterable
from functools import lru_cache
from typing import Final

from grafu.asset.languages import CHINESE, ENGLISH, GERMAN, JAPANESE, ROMANCE, table, word_set
from grafu.asset.languages_slavic import SLAVIC, latin

CAMEL: Final = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")
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
    return tuple(_LETTERS.findall(CAMEL.sub(" ", plain(name)).lower()))


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


OF: Final = "of"
"""Stands for each preposition: what comes before it is the thing that is named."""

_GENERIC = word_set(
    "mesh cube plane cylinder circle sphere torus curve object obj node group grp geom geo geometry model main part "
    "piece lod low high lp hp poly polysurface shape mat material default export link visual root null copy instance "
    "new old the a b c d e x y z fbx gltf wood wooden metal pine mdf oak steel chrome plastic white black grey gray "
    "brown sweethome opening mirrored"
)
_PREPOSITIONS = word_set("of for with in at from under above below behind beneath on to")
_SUFFIXES = ("drawers", "drawer", "doors", "door", "handle", "knob", "shelf", "hinge", "schublade", "griff")
_LEAST_PREFIX = 4
_LINKS = ("", "n", "en", "s", "es", "e")  # between the parts of a German compound
_HAN = re.compile(r"[\u3005-\u30ff\u3400-\u9fff]+")
# In Romance names the head comes first, or the owner does (`puerta_tirador`): what is decided by rank is not decided by
# order.
_RANKS: Final[dict[str, int]] = {
    **dict.fromkeys(("cabinet", "carcass", "table", "desk", "bed", "kitchen", "bookcase", "sink"), 0),
    **dict.fromkeys(("door", "doors", "drawer", "drawers", "flap", "lid"), 2),
    **dict.fromkeys(("panel", "board", "wall", "plate", "kick"), 4),
    **dict.fromkeys(("rail", "hinge", "screw", "wheel", "lock"), 5),
    **dict.fromkeys(("handle", "knob"), 6),
    **dict.fromkeys(("shelf", "divider", "leg", "tabletop", "stile", "mirror", "front", "side", "back", "base"), 3),
}
_HEAD_LAST = table(GERMAN)
_ROMANCE = table(*ROMANCE, *SLAVIC)  # Slavic names, too, begin with the head
_HAN_WORDS = table(CHINESE, JAPANESE)
_LONGEST_HAN = max(map(len, _HAN_WORDS))
_ENGLISH = frozenset(ENGLISH.split())
_TILES: Final = {w: (w,) for w in _ENGLISH} | {w: m for w, m in _HEAD_LAST.items() if len(w) >= 4 or w == "tur"}


@lru_cache(maxsize=20_000)
def spoken(name: str) -> tuple[str, ...]:
    """Returns the words of a name, lower-case, English and in English order; `OF` parts a thing from its owner."""
    found: list[str] = []
    is_romance = False
    for word in _parted(latin(unicodedata.normalize("NFKC", name))):
        meaning, romance = _meaning(word)
        is_romance |= romance
        found += meaning
    kept = [w for w in found if w not in _GENERIC]
    return _ranked(kept) if is_romance else tuple(kept)


def singular(word: str) -> str:
    """Returns the word without an English plural's `s`."""
    return word[:-1] if len(word) > 3 and word.endswith("s") and not word.endswith(("ss", "us")) else word


def _parted(name: str) -> list[str]:
    """Returns the words as written, Latin ones without accents; signs written without spaces are one word."""
    found: list[str] = []
    start = 0
    for match in _HAN.finditer(name):
        found += [*words(name[start : match.start()]), match[0]]
        start = match.end()
    return [*found, *words(name[start:])]


@lru_cache(maxsize=20_000)
def _meaning(word: str) -> tuple[tuple[str, ...], bool]:
    """Returns what a word means in English, and whether it is a Romance noun or adjective."""
    if _HAN.match(word):
        return _han(word), False
    if word in _PREPOSITIONS:
        return (OF,), False
    if word in _ENGLISH or singular(word) in _ENGLISH:
        return (word,), False
    if word in _HEAD_LAST:
        return _HEAD_LAST[word], False
    if word in _ROMANCE:
        return _ROMANCE[word], _ROMANCE[word] != (OF,)
    return _compound(word), False


def _ranked(found: list[str]) -> tuple[str, ...]:
    return tuple(sorted((w for w in found if w != OF), key=lambda w: _RANKS.get(w, 1)))


def _han(text: str) -> tuple[str, ...]:
    """Returns the English words of signs written without spaces, the longest known word first; `OF` states nothing."""
    found: list[str] = []
    i = 0
    while i < len(text):
        size = next((n for n in range(_LONGEST_HAN, 0, -1) if text[i : i + n] in _HAN_WORDS), 0)
        found += _HAN_WORDS[text[i : i + size]] if size else ("?",)
        i += max(size, 1)
    return tuple(w for w in found if w != OF)


def _compound(word: str) -> tuple[str, ...]:
    """Returns the parts of a word that known words cover, its known end, or the word itself."""
    tiles = _tiles(word)
    if tiles is not None and len(tiles) > 1:
        return tuple(w for tile in tiles for w in _TILES[tile])
    end = next((s for s in _SUFFIXES if word.endswith(s) and len(word) - len(s) >= _LEAST_PREFIX), None)
    return (word,) if end is None else (word[: -len(end)], *_TILES[end])


def _tiles(word: str) -> list[str] | None:
    best: list[list[str] | None] = [[]] + [None] * len(word)
    for i in range(len(word)):
        before = best[i]
        if before is None:
            continue
        for tile in (t for t in _TILES if word.startswith(t, i)):
            for link in _LINKS if tile in _HEAD_LAST else ("",):
                end = i + len(tile)
                if end < len(word) and word.startswith(link, end):
                    end += len(link)
                known = best[end] if end <= len(word) else []
                if known is None or (known and len(known) > len(before) + 1):
                    best[end] = [*before, tile]
    return best[len(word)]
