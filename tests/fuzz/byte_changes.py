"""Changes of a file's bytes, whatever they mean: flipped, cut, doubled, overwritten, emptied, left out, swapped."""

from collections.abc import Callable
from random import Random

from fuzz.entries import Files, data_of, plain


def _of_one(change: Callable[[bytes, Random], bytes]) -> Callable[[Files, Random], Files | None]:
    def changed(files: Files, rng: Random) -> Files | None:
        names = [name for name in plain(files) if files[name]]
        if not names:
            return None
        name = rng.choice(names)
        return {**files, name: change(data_of(files, name), rng)}

    changed.__name__ = change.__name__
    return changed


def _range(data: bytes, rng: Random, longest: int = 4096) -> tuple[int, int]:
    start = rng.randrange(len(data))
    return start, min(len(data), start + rng.randint(1, longest))


@_of_one
def flip_bits(data: bytes, rng: Random) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 8, 64))):
        changed[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(changed)


@_of_one
def flip_early_bits(data: bytes, rng: Random) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.choice((1, 2, 4))):
        changed[rng.randrange(min(len(data), 128))] ^= 1 << rng.randrange(8)
    return bytes(changed)


@_of_one
def truncate(data: bytes, rng: Random) -> bytes:
    return data[: rng.choice((rng.randrange(len(data)), len(data) - 1, min(len(data), rng.randrange(64))))]


@_of_one
def overwrite_range(data: bytes, rng: Random) -> bytes:
    start, end = _range(data, rng, 64)
    junk = rng.choice((rng.randbytes(end - start), b"\0" * (end - start), b"\xff" * (end - start)))
    return data[:start] + junk + data[end:]


@_of_one
def delete_range(data: bytes, rng: Random) -> bytes:
    start, end = _range(data, rng)
    return data[:start] + data[end:]


@_of_one
def double_range(data: bytes, rng: Random) -> bytes:
    start, end = _range(data, rng)
    return data[:end] + data[start:end] * rng.choice((1, 2, 50)) + data[end:]


@_of_one
def insert_junk(data: bytes, rng: Random) -> bytes:
    start = rng.randrange(len(data) + 1)
    return data[:start] + rng.randbytes(rng.choice((1, 4, 300))) + data[start:]


@_of_one
def other_encoding(data: bytes, rng: Random) -> bytes:
    text = data.decode("utf-8", "replace")
    coding = rng.choice(("utf-16", "utf-32", "utf-8-sig", "utf-16-be", "utf-7"))
    return text.encode(coding, "surrogatepass" if coding != "utf-7" else "replace")


@_of_one
def other_line_ends(data: bytes, rng: Random) -> bytes:
    return data.replace(b"\n", rng.choice((b"\r", b"\r\n", b"\n\n", b"\\\n", b"\0", b"")))


@_of_one
def empty_file(data: bytes, rng: Random) -> bytes:
    return b""


@_of_one
def nothing_but_spaces(data: bytes, rng: Random) -> bytes:
    return rng.choice((b" ", b"\n", b"\0")) * min(len(data), 100_000)


def leave_out(files: Files, rng: Random) -> Files | None:
    gone = rng.choice(list(files))
    return {name: entry for name, entry in files.items() if name != gone}


def swap_files(files: Files, rng: Random) -> Files | None:
    names = plain(files)
    if len(names) < 2:
        return None
    a, b = rng.sample(names, 2)
    return {**files, a: files[b], b: files[a]}


CHANGES = (
    flip_bits,
    flip_early_bits,
    truncate,
    overwrite_range,
    delete_range,
    double_range,
    insert_junk,
    other_encoding,
    other_line_ends,
    empty_file,
    nothing_but_spaces,
    leave_out,
    swap_files,
)
