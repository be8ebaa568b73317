"""Names of parts as the network reads them: hashed words and trigrams of letters. No torch, no table of words.

A name is evidence, not a label: `drwr`, `Schublade` and `drawer_2` share pieces, and `Cube.003` means nothing.
"""

import re
import unicodedata
from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import chain
from zlib import crc32

import numpy as np

from grafu.asset.names import CAMEL
from grafu.shapes import Int64

NAME_CODES = 32
"""How many pieces of a name are read, whole words first."""
NAME_BUCKETS = 2048
"""How many numbers pieces are hashed to, 1 to this; 0 is no piece."""
_WORDS = re.compile(r"[^\W\d_]+")
_GRAM = 3


def name_codes(names: Sequence[str]) -> Int64[np.ndarray, "n c"]:
    """Returns for each name the numbers of its words, then those of the trigrams of their letters, then zeros.

    Case, accents, digits and signs count nothing; camelCase parts words. A word stands between two signs, so that its
    first and last letters have trigrams of their own.
    """
    found = np.zeros((len(names), NAME_CODES), dtype=np.int64)
    for row, name in zip(found, names, strict=True):
        codes = _codes(name)
        row[: len(codes)] = codes
    return found


@lru_cache(maxsize=20_000)
def _codes(name: str) -> tuple[int, ...]:
    words = _WORDS.findall(CAMEL.sub(" ", _unaccented(name)).lower())
    grams = chain.from_iterable(_grams(f"<{word}>") for word in words)
    pieces = dict.fromkeys(chain(words, grams))
    return tuple(_bucket(piece) for piece in pieces)[:NAME_CODES]


def _unaccented(name: str) -> str:
    parts = unicodedata.normalize("NFKD", name)
    return unicodedata.normalize("NFC", "".join(letter for letter in parts if not unicodedata.combining(letter)))


def _grams(word: str) -> Iterable[str]:
    return (word[k : k + _GRAM] for k in range(len(word) - _GRAM + 1))


def _bucket(piece: str) -> int:
    return crc32(piece.encode("utf-8", "replace")) % NAME_BUCKETS + 1
