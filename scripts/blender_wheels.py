"""Wheels made smaller for the Blender extension: without what the add-on never imports, packed by LZMA.

A wheel keeps its name and its tags, and its RECORD lists what is left: it is installed like any other. Of Linux'
libraries the tables of symbols are blanked that no loader reads; their code stays where it is.
"""

import csv
import hashlib
import io
import re
import struct
import zipfile
from base64 import urlsafe_b64encode
from collections.abc import Iterable, Mapping
from fnmatch import fnmatch
from pathlib import Path

ANYWHERE = ("*/tests/*", "*/test/*")
_OF_SCIPY = (
    *("stats", "io", "interpolate", "integrate", "signal", "fft", "fftpack", "cluster", "odr", "misc", "datasets"),
    *("differentiate", "optimize"),
)
_OF_GRAFU = ("training", "network", "synth", "data", "evaluation", "metrics", "editor", "dataset", "cluster")
LEFT_OUT_OF = {
    "grafu": tuple(f"grafu/{name}/*" for name in _OF_GRAFU),  # what learns and measures
    "scipy": (
        *(f"scipy/{name}/*" for name in _OF_SCIPY),
        *("scipy/special/cython_special.*", "scipy/linalg/_decomp_interpolative.*"),  # for what is left out above
    ),
    "onnxruntime": (
        *("onnxruntime/capi/libonnxruntime.*", "onnxruntime/capi/onnxruntime.dll"),  # for C: Python's has all of it
        *(f"onnxruntime/{name}/*" for name in ("quantization", "transformers", "tools", "datasets", "backend")),
    ),
    "pillow": ("PIL/_avif.*", "*/libavif*", "PIL/_imagingcms.*", "*/liblcms2*"),  # glTF has no such textures
    "lxml": ("lxml/objectify.*", "lxml/html/*", "lxml/isoschematron/*", "lxml/includes/*"),
    "python_fcl": ("fcl/*.cpp",),
    "trimesh": ("trimesh/resources/templates/*",),  # its own pages
}
"""By the name of a wheel, the files that are left out of it."""
_LIBRARY = re.compile(r"\.(so|dll|dylib|pyd)(\.[\d.]+)?$")
_LOADED = 2  # flag of an ELF section that is in memory when a library is used
_BLANKED = (1, 2, 3)  # kinds of ELF sections: what debuggers read, symbols and their names


def reduce_wheel(wheel: Path) -> None:
    """Writes a wheel anew without what is left out of it.

    Raises:
        ValueError: if a binary that is kept names a library that is left out.
    """
    patterns = (*ANYWHERE, *LEFT_OUT_OF.get(wheel.name.split("-")[0].lower(), ()))
    with zipfile.ZipFile(wheel) as packed:
        files = [one for one in packed.infolist() if not one.is_dir()]
        contents = {one.filename: packed.read(one) for one in files if not _matches(one.filename, patterns)}
        modes = {one.filename: one.external_attr for one in files}
    _require_unnamed(wheel.name, modes.keys() - contents.keys(), contents)
    contents = {name: without_symbols(content) for name, content in contents.items()}
    record = next(name for name in contents if name.endswith(".dist-info/RECORD"))
    contents[record] = _record_of(contents, record)
    with zipfile.ZipFile(wheel, "w") as made:
        for name, content in contents.items():
            about = zipfile.ZipInfo(name)
            about.compress_type, about.external_attr = zipfile.ZIP_LZMA, modes[name]
            made.writestr(about, content)


def without_symbols(library: bytes) -> bytes:
    """Returns an ELF library of 64 bits with blanks where it has symbols that no loader reads; all else as it is."""
    if library[:6] != b"\x7fELF\x02\x01":
        return library
    made = bytearray(library)
    (table,) = struct.unpack_from("<Q", made, 0x28)
    size, count, names = struct.unpack_from("<HHH", made, 0x3A)
    for number in set(range(count)) - {names}:
        kind, flags, _, start, length = struct.unpack_from("<IQQQQ", made, table + number * size + 4)
        if kind in _BLANKED and not flags & _LOADED:
            made[start : start + length] = bytes(length)
    return bytes(made)


def _matches(name: str, patterns: Iterable[str]) -> bool:
    return any(fnmatch(name, pattern) for pattern in patterns)


def _record_of(contents: Mapping[str, bytes], record: str) -> bytes:
    """Returns the RECORD of a wheel's files: name, hash and size of each."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    for name, content in contents.items():
        digest = urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        rows.writerow((name, "", "") if name == record else (name, f"sha256={digest}", len(content)))
    return text.getvalue().encode()


def _require_unnamed(wheel: str, left_out: Iterable[str], contents: Mapping[str, bytes]) -> None:
    """Refuses to leave out a library that a binary which is kept would load: it names what it loads."""
    libraries = {name.rsplit("/", 1)[-1] for name in left_out if _LIBRARY.search(name)}
    words = {library: re.sub(r"(\.so)\.[\d.]+$", r"\1.", library).encode() for library in libraries}
    for name, content in contents.items():
        if _LIBRARY.search(name):
            named = [library for library, word in words.items() if word in content]
            if named:
                raise ValueError(f"{wheel}: {name} loads {', '.join(named)}, which must not be left out")
