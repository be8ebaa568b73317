"""Changes of NumPy files: other types, shapes and values, headers that lie, objects to unpickle, archives within."""

import io
import pickle
import struct
import zipfile
import zlib
from collections.abc import Callable
from random import Random

import numpy as np

from fuzz.entries import Files, data_of, plain

Members = dict[str, bytes]


def _of_archive(change: Callable[[Members, Random], Members]) -> Callable[[Files, Random], Files | None]:
    def changed(files: Files, rng: Random) -> Files | None:
        names = plain(files, ".npz")
        if not names:
            return None
        name = rng.choice(names)
        try:
            with zipfile.ZipFile(io.BytesIO(data_of(files, name))) as archive:
                members = {info.filename: archive.read(info) for info in archive.infolist()}
        except (zipfile.BadZipFile, OSError, EOFError, ValueError, struct.error, zlib.error, RuntimeError):
            return None
        return {**files, name: _zipped(change(members, rng), rng)} if members else None

    changed.__name__ = change.__name__
    return changed


def _zipped(members: Members, rng: Random) -> bytes:
    stored = io.BytesIO()
    packed = zipfile.ZIP_DEFLATED if rng.random() < 0.2 else zipfile.ZIP_STORED
    with zipfile.ZipFile(stored, "w", packed) as archive:
        for name, data in members.items():
            archive.writestr(zipfile.ZipInfo(name), data, packed)
    return stored.getvalue()


def _array(members: Members, rng: Random) -> tuple[str, np.ndarray]:
    names = [name for name in members if name.endswith(".npy")]
    if not names:
        return next(iter(members)), np.zeros(3)
    name = rng.choice(names)
    try:
        return name, np.load(io.BytesIO(members[name]), allow_pickle=False)
    except (ValueError, EOFError, OSError):
        return name, np.zeros(3)


def saved(array: np.ndarray) -> bytes:
    """Returns an array as the bytes of a .npy file."""
    stream = io.BytesIO()
    np.lib.format.write_array(stream, array, version=(1, 0))
    return stream.getvalue()


def _lying(shape: str, descr: str = "<f8", fortran: str = "False") -> bytes:
    head = f"{{'descr': {descr!r}, 'fortran_order': {fortran}, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + bytes(64)


class _Bad:
    def __reduce__(self) -> tuple[object, tuple[str]]:
        return (print, ("unpickled",))


def _pickled() -> bytes:
    head = b"{'descr': '|O', 'fortran_order': False, 'shape': (1,), }\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + pickle.dumps([_Bad()])


@_of_archive
def other_type(members: Members, rng: Random) -> Members:
    name, array = _array(members, rng)
    kinds = ("f2", "f8", "i1", "u8", "?", "c16", "U4", "S4", ">i4", "M8[s]", "f4", "i8")
    try:
        with np.errstate(all="ignore"):
            return {**members, name: saved(array.astype(rng.choice(kinds)))}
    except (ValueError, TypeError):
        return {**members, name: saved(np.zeros((), np.dtype([("a", "f4")])))}


@_of_archive
def other_shape(members: Members, rng: Random) -> Members:
    name, array = _array(members, rng)
    shapes: list[np.ndarray] = [array[..., None], array.reshape(-1), np.zeros((0, *array.shape)), np.array(1.0)]
    if array.ndim:
        shapes += [array[:1], array[:-1], np.concatenate([array, array]), array[::-1], np.zeros((3, 0), array.dtype)]
    return {**members, name: saved(rng.choice(shapes))}


@_of_archive
def other_numbers(members: Members, rng: Random) -> Members:
    name, array = _array(members, rng)
    if not array.size or array.dtype.kind not in "biuf":
        return members
    array = array.copy()
    ends = (0, -1, np.nan, np.inf, 1e300) if array.dtype.kind == "f" else (0, 1, array.max(), -1, 2**31, 2**62)
    with np.errstate(all="ignore"):
        value = np.array([rng.choice(ends)]).astype(array.dtype)[0]
    for _ in range(rng.choice((1, 1, 10))):
        array.flat[rng.randrange(array.size)] = value
    if rng.random() < 0.2:
        array[...] = value
    return {**members, name: saved(array)}


@_of_archive
def lying_header(members: Members, rng: Random) -> Members:
    name, _ = _array(members, rng)
    shapes = ("(9999999999,)", "(-1,)", "(2**40,)", "()", "(1000000, 1000000)", "(3, 3)", "[3]", "'x'", "(0,) * 99")
    descr = rng.choice(("<f8", "<u4", "|O", "<U99999999", "x", "<f4"))
    return {**members, name: _lying(rng.choice(shapes), descr, rng.choice(("True", "False", "3")))}


@_of_archive
def pickled_object(members: Members, rng: Random) -> Members:
    return {**members, _array(members, rng)[0]: _pickled()}


@_of_archive
def other_members(members: Members, rng: Random) -> Members:
    name = rng.choice(list(members))
    rest = {key: data for key, data in members.items() if key != name}
    renamed = rng.choice(("../outside/secret.npy", "/etc/passwd", "x.npy", name.upper(), "\x1b[31m.npy", "a" * 9000))
    more = {**members, "x.npy": _pickled()}
    return rng.choice((rest, {**rest, renamed: members[name]}, {**members, name: b""}, more))


@_of_archive
def swap_members(members: Members, rng: Random) -> Members:
    if len(members) < 2:
        return members
    a, b = rng.sample(list(members), 2)
    return {**members, a: members[b], b: members[a]}


@_of_archive
def json_member(members: Members, rng: Random) -> Members:
    names = [name for name in members if name.endswith(".json")]
    junk = (b"{}", b"[]", b"null", b"[" * 90_000, b'{"schema": 1}', b"\xff", b'["a"]', b"[1, null]")
    return {**members, rng.choice(names): rng.choice(junk)} if names else members


def lying_archive(files: Files, rng: Random) -> Files | None:
    """A member states that it is encrypted, packed in another way, or of another size."""
    names = plain(files, ".npz")
    if not names:
        return None
    name = rng.choice(names)
    data = bytearray(data_of(files, name))
    at = data.rfind(b"PK\x01\x02")
    if at < 0 or at + 46 > len(data):
        return None
    field, value = rng.choice(((8, 1), (10, 99), (10, 12), (20, 2**32 - 1), (24, 2**32 - 1), (42, 2**31), (28, 65535)))
    width = "<I" if field >= 20 and field != 28 else "<H"
    struct.pack_into(width, data, at + field, value)
    return {**files, name: bytes(data)}


def other_npy(files: Files, rng: Random) -> Files | None:
    """A .npy file of another type, shape or header."""
    names = plain(files, ".npy")
    if not names:
        return None
    made = (saved(np.full((4, 3), np.nan)), saved(np.zeros((0, 3))), saved(np.zeros((4, 6), "i1")), saved(np.array(1)))
    lies = (_lying("(99999999999, 3)"), _lying("(3, 3)", "|O"), _lying("(1, 3)", "<U8"), _pickled(), b"\x93NUMPY")
    return {**files, rng.choice(names): rng.choice((*made, *lies))}


CHANGES = (
    *(other_type, other_shape, other_numbers, lying_header, other_members, swap_members, json_member, lying_archive),
    *(pickled_object, other_npy, other_numbers),
)
