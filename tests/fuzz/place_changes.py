"""Changes of where things lie and what they are called: names that lead out, links, FIFOs, folders, names to fear."""

import json
import re
from collections.abc import Callable
from pathlib import PurePosixPath
from random import Random
from xml.sax.saxutils import escape

from fuzz.documents import Raw, document_of, json_files, places, replaced, value_at, with_document
from fuzz.entries import Files, Odd, data_of, plain
from fuzz.hostile_words import NAMED, hostile_name, hostile_place

_IN_XML = re.compile(rb'((?:filename|file|meshdir)=")([^"]*)(")')
_IN_COLLADA = re.compile(rb"(<(?:init_from|uri)>)([^<]*)(<)")
_IN_TEXT = re.compile(rb"(?m)^(\s*(?:mtllib|map_\w+|bump|refl)\s+)([^\r\n]*)()")
_GROUP = re.compile(rb"(?m)^([og] |newmtl |usemtl )([^\r\n]*)()")
_IN_ROBOT = re.compile(rb'( (?:name|link)=")([^"]*)(")')


def _fits_in(name: str, pattern: re.Pattern[bytes]) -> bytes:
    text = escape(name, {'"': "&quot;"}) if pattern in (_IN_XML, _IN_ROBOT, _IN_COLLADA) else name
    return text.encode("utf-8", "surrogatepass")


def _replaced_match(data: bytes, pattern: re.Pattern[bytes], rng: Random, other: Callable[[str], str]) -> bytes | None:
    found = list(pattern.finditer(data))
    if not found:
        return None
    match = rng.choice(found)
    meant = other(match[2].decode("utf-8", "replace"))
    return data[: match.start(2)] + _fits_in(meant, pattern) + data[match.end(2) :]


def _text(value: str) -> str | Raw:
    return value if max(value, default="") < "\ud800" else Raw(json.dumps(value))


def place_astray(files: Files, rng: Random) -> Files | None:
    """A name of a file in a document leads elsewhere."""

    def other(named: str) -> str:
        return hostile_place(PurePosixPath(named.replace("\0", "")).suffix, named, rng)

    names = [*plain(files, ".urdf", ".sdf", ".xml", ".dae", ".obj", ".mtl"), *json_files(files)]
    rng.shuffle(names)
    for name in names:
        data = data_of(files, name)
        pattern = (
            _IN_COLLADA
            if name.endswith((".dae", ".sdf"))
            else _IN_XML
            if name.endswith((".urdf", ".xml"))
            else _IN_TEXT
        )
        changed = _json_place(data, files, rng, other) if name in json_files({name: data}) else None
        changed = changed or _replaced_match(data, pattern, rng, other)
        if changed is not None:
            return {**files, name: changed}
    return None


def _json_place(data: bytes, files: Files, rng: Random, other: Callable[[str], str]) -> bytes | None:
    document = document_of(data)
    stems = {PurePosixPath(name).stem for name in files}

    def names_file(value: object) -> bool:
        return isinstance(value, str) and (value.lower().endswith(NAMED) or value in stems or value in files)

    found = [path for path in places(document) if names_file(value_at(document, path))]
    if not found:
        return None
    path = rng.choice(found)
    return with_document(data, replaced(document, path, _text(other(value_at(document, path)))))


def library_astray(files: Files, rng: Random) -> Files | None:
    """An OBJ asks for a material library that lies elsewhere, and a library for a picture that does."""
    names = plain(files, ".obj", ".mtl")
    if not names:
        return None
    name = rng.choice(names)
    suffix, word = (".mtl", "mtllib") if name.endswith(".obj") else (".png", rng.choice(("map_Kd", "map_Bump", "norm")))
    line = f"{word} {hostile_place(suffix, name, rng)}\n".encode("utf-8", "surrogatepass")
    data = data_of(files, name)
    return {**files, name: line + data if suffix == ".mtl" else data + b"\n" + line}


def name_to_fear(files: Files, rng: Random) -> Files | None:
    """A part, link, group or material has such a name."""
    names = [*plain(files, ".urdf", ".obj", ".mtl"), *json_files(files)]
    rng.shuffle(names)
    feared = hostile_name(rng)
    for name in names:
        data = data_of(files, name)
        pattern = _IN_ROBOT if name.endswith(".urdf") else _GROUP
        changed = _json_name(data, feared, rng) if name in json_files({name: data}) else None
        changed = changed or _replaced_match(data, pattern, rng, lambda _: feared)
        if changed is not None:
            return {**files, name: changed}
    return None


def _json_name(data: bytes, feared: str, rng: Random) -> bytes | None:
    document = document_of(data)
    found = [p for p in places(document) if isinstance(value_at(document, p), str)]
    if not found:
        return None
    named = [p for p in found if p[-1] in ("name", "id", "label", "src", "dst", "title", "modelId", "model_id")]
    return with_document(data, replaced(document, rng.choice(named or found), _text(feared)))


def every_name_to_fear(files: Files, rng: Random) -> Files | None:
    """One name, wherever it stands in a document, becomes such a name: references still fit."""
    names = [
        n
        for n in plain(files, ".urdf", ".sdf", ".xml", ".dae", ".obj", ".json", ".glb", ".gltf")
        if b"\0\0" not in data_of(files, n)
    ]
    if not names:
        return None
    name = rng.choice(names)
    data = data_of(files, name)
    words = sorted(set(re.findall(rb"[A-Za-z][A-Za-z0-9_]*[-_][A-Za-z0-9_-]+", data)))
    if not words:
        return None
    feared = hostile_name(rng)
    text = json.dumps(feared)[1:-1] if name.endswith((".json", ".gltf")) else escape(feared, {'"': "&quot;"})
    return {**files, name: data.replace(rng.choice(words), text.encode("utf-8", "surrogatepass"))}


def file_to_fear(files: Files, rng: Random) -> Files | None:
    """A file is called so."""
    name = rng.choice(list(files))
    path = PurePosixPath(name)
    feared = hostile_name(rng).replace("/", "_").replace("\0", "_")
    return {str(path.with_name(f"x{feared}{path.suffix}"[-200:])) if n == name else n: e for n, e in files.items()}


def odd_entry(files: Files, rng: Random) -> Files | None:
    """A file is a link that leads out, round and round or to a device, a FIFO, a folder, or far too large."""
    name = rng.choice(list(files))
    up = "../" * (name.count("/") + 1)
    suffix = PurePosixPath(name).suffix
    own = PurePosixPath(name).name
    targets = (f"{up}outside/secret{suffix}", "/dev/zero", "/etc/passwd", own, ".", "..", "nowhere")
    links = [Odd("link", target) for target in targets]
    return {**files, name: rng.choice((*links, Odd("fifo"), Odd("folder"), Odd("sparse", size=700 * 2**20)))}


def one_more_entry(files: Files, rng: Random) -> Files | None:
    """Beside the files lies one more, which is no plain file or has a name to fear."""
    there = PurePosixPath(rng.choice(list(files)))
    feared = hostile_name(rng).replace("/", "_").replace("\0", "_")
    beside = str(there.with_name(f"x{feared}{there.suffix}"[-200:]))
    up = "../" * (str(there).count("/") + 1)
    link = Odd("link", f"{up}outside/secret{there.suffix}")
    return {**files, beside: rng.choice((link, Odd("fifo"), Odd("folder"), Odd("link", "."), files[str(there)]))}


def folder_leads_out(files: Files, rng: Random) -> Files | None:
    """A folder is a link that leads out."""
    folders = sorted({name.rpartition("/")[0] for name in files} - {""})
    if not folders:
        return None
    folder = rng.choice(folders)
    kept = {name: entry for name, entry in files.items() if not name.startswith(f"{folder}/")}
    up = "../" * (folder.count("/") + 1)
    return {**kept, folder: Odd("link", rng.choice((f"{up}outside", "/", ".", folder)))}


CHANGES = (
    *(place_astray, name_to_fear, odd_entry) * 2,
    *(library_astray, every_name_to_fear, file_to_fear, one_more_entry, folder_leads_out),
)
