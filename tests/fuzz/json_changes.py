"""Changes of JSON that stays JSON, mostly: values of another type or size, keys gone or twice, references astray."""

import json
from collections.abc import Callable
from random import Random
from typing import Any

from fuzz.documents import (
    Path,
    Raw,
    document_of,
    json_files,
    places,
    removed,
    replaced,
    text_of,
    value_at,
    with_document,
    with_text,
)
from fuzz.entries import Files, data_of

JUNK: tuple[Any, ...] = (
    *(None, True, False, 0, 1, -1, 2, 7, 2**31 - 1, 2**31, 2**32, 2**53 + 1, 2**63, 2**64, 10**30, -(2**31)),
    *(0.0, 0.5, -0.0, 1e-300, 1e-9, 1e9, 1e30, 1e300, -1e300, "", " ", "0", "nan", "1e999", "door", "/", "\0"),
    *("none", "null", "true", "\u202e", "x" * 70_000, [], {}, [[]], [None], [0], [[0, 0, 0]], {"": {}}, {"a": [1]}),
    *([1] * 3, [0.0] * 16, ["a", "b", "c"], [1e400], [-1, -1, -1], list(range(1000))),
)
RAW = (
    *("NaN", "Infinity", "-Infinity", "1e400", "-1e400", "1e-400", "-0", "9" * 5000, "-" + "9" * 400),
    *(
        "1." + "0" * 5000,
        '"\\ud800"',
        '"\\u0000"',
        '"\\udfff\\ud800"',
        "[" * 100_000,
        '{"a":' * 100_000,
        "[" * 500 + "]" * 500,
    ),
    *("[" * 90_000 + "]" * 90_000, '{"a":' * 900 + "1" + "}" * 900, "tru", "'a'", "0x10", "01", "//", '"a\nb"'),
)


def _of_document(change: Callable[[Any, Random], Any]) -> Callable[[Files, Random], Files | None]:
    def changed(files: Files, rng: Random) -> Files | None:
        names = json_files(files)
        if not names:
            return None
        name = rng.choice(names)
        data = data_of(files, name)
        document = change(document_of(data), rng)
        return None if document is None else {**files, name: with_document(data, document)}

    changed.__name__ = change.__name__
    return changed


def a_place(document: Any, rng: Random, fits: Callable[[Any], bool] = lambda _: True) -> Path | None:
    """Returns the path to some value that fits: any, or one of a few that lie near the top, which matter most."""
    found = [path for path in places(document) if fits(value_at(document, path))]
    if not found:
        return None
    near = [path for path in found if len(path) <= 3]
    return rng.choice(near if near and rng.random() < 0.4 else found)


@_of_document
def other_value(document: Any, rng: Random) -> Any:
    path = a_place(document, rng)
    return None if path is None else replaced(document, path, rng.choice(JUNK))


@_of_document
def raw_value(document: Any, rng: Random) -> Any:
    path = a_place(document, rng)
    return None if path is None else replaced(document, path, Raw(rng.choice(RAW)))


@_of_document
def whole_of_another_type(document: Any, rng: Random) -> Any:
    return rng.choice((*JUNK[1:], [document], {"a": document}))


@_of_document
def no_such_key(document: Any, rng: Random) -> Any:
    path = a_place(document, rng)
    return None if path is None else removed(document, path)


@_of_document
def other_number(document: Any, rng: Random) -> Any:
    path = a_place(document, rng, lambda v: isinstance(v, int | float) and not isinstance(v, bool))
    if path is None:
        return None
    value = value_at(document, path)
    others = (-value, value + 1, value - 1, value * 1000, value / 1000, float(value), str(value), [value], value * 1e20)
    return replaced(document, path, rng.choice(others))


@_of_document
def other_text(document: Any, rng: Random) -> Any:
    path = a_place(document, rng, lambda v: isinstance(v, str))
    if path is None:
        return None
    value = value_at(document, path)
    texts = [v for p in places(document) if isinstance(v := value_at(document, p), str)]
    return replaced(document, path, rng.choice((value * 1000, value.upper(), f" {value} ", [value], *texts[:50])))


@_of_document
def swap_values(document: Any, rng: Random) -> Any:
    found = places(document)
    if len(found) < 2:
        return None
    a, b = rng.sample(found, 2)
    if a[: len(b)] == b or b[: len(a)] == a:
        return None
    value = value_at(document, a)
    return replaced(replaced(document, a, value_at(document, b)), b, value)


@_of_document
def longer_list(document: Any, rng: Random) -> Any:
    path = a_place(document, rng, lambda v: isinstance(v, list) and bool(v))
    if path is None:
        return None
    items = value_at(document, path)
    times = rng.choice((2, 3, 100, 100_000))
    size = len(json.dumps(items))
    return replaced(document, path, items * max(2, min(times, 4_000_000 // size)))


@_of_document
def shuffled_list(document: Any, rng: Random) -> Any:
    path = a_place(document, rng, lambda v: isinstance(v, list) and len(v) > 1)
    if path is None:
        return None
    items = list(value_at(document, path))
    rng.shuffle(items)
    return replaced(document, path, items[: rng.randint(0, len(items))])


@_of_document
def into_itself(document: Any, rng: Random) -> Any:
    """A value holds its own holder, some levels deep: children that are their parents."""
    path = a_place(document, rng, lambda v: isinstance(v, dict | list) and bool(v))
    if path is None:
        return None
    value = value_at(document, path)
    inner = a_place(value, rng)
    for _ in range(rng.choice((1, 2, 4))):
        value = replaced(value, inner, value) if inner else value
    return replaced(document, path, value) if len(str(value)) < 2_000_000 else None


def twice_the_key(files: Files, rng: Random) -> Files | None:
    """An object states a key twice, with values that differ."""
    names = json_files(files)
    if not names:
        return None
    name = rng.choice(names)
    data = data_of(files, name)
    text = text_of(data)
    at = [i for i, c in enumerate(text) if c == "{"]
    keys = [p[-1] for p in places(document_of(data)) if isinstance(p[-1], str)]
    if not at or not keys:
        return None
    start = rng.choice(at) + 1
    stated = f"{json.dumps(rng.choice(keys))}: {json.dumps(rng.choice(JUNK))}, "
    return {**files, name: with_text(data, text[:start] + stated + text[start:])}


CHANGES = (
    *(other_value, raw_value, no_such_key, other_number) * 2,
    *(other_value, whole_of_another_type, other_text, swap_values, longer_list, shuffled_list, into_itself),
    twice_the_key,
)
