"""Bad input through the real command: one clear line, exit code 2, nothing left behind."""

import json
import os
import struct
from collections.abc import Callable
from pathlib import Path

import pytest
from obj_inputs import CABINET, obj_text, write_cabinet

from grafu.cli.main import main

PANEL = obj_text([("panel", CABINET["door"])])
BAD_LINE = "o door\nv 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\no side\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 4 5 6\n"


def empty_folder(path: Path) -> Path:
    path.mkdir()
    return path


def text_file(name: str, text: str) -> Callable[[Path], Path]:
    def write(path: Path) -> Path:
        path.mkdir()
        (path / name).write_text(text)
        return path / name

    return write


def glb(tree: object, binary: bytes = b"") -> bytes:
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(binary), 0x004E4942) + binary if binary else b""
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def glb_file(data: bytes) -> Callable[[Path], Path]:
    def write(path: Path) -> Path:
        path.mkdir()
        (path / "model.glb").write_bytes(data)
        return path / "model.glb"

    return write


def huge_accessor() -> bytes:
    """Returns a GLB of a few bytes that claims billions of vertices."""
    accessor = {"bufferView": 0, "componentType": 5126, "count": 4_000_000_000, "type": "VEC3"}
    mesh = {"primitives": [{"attributes": {"POSITION": 0}}]}
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "name": "door"}, {"mesh": 0, "name": "side"}],
        "meshes": [mesh],
        "accessors": [accessor],
        "bufferViews": [{"buffer": 0, "byteLength": 12}],
        "buffers": [{"byteLength": 12}],
    }
    return glb(tree, bytes(12))


def many_parts(path: Path) -> Path:
    path.mkdir()
    lines = [f"o part_{i}\nv {i} 0 0\nv {i} 1 0\nv {i} 0 1\nf -3 -2 -1" for i in range(10_000)]
    (path / "crowd.obj").write_text("\n".join(lines))
    return path / "crowd.obj"


def urdf(body: str) -> Callable[[Path], Path]:
    return text_file("piece.urdf", f'<robot name="piece">{body}</robot>')


VISUAL = '<visual><geometry><box size="1 1 1"/></geometry></visual>'
ABSENT = '<visual><geometry><mesh filename="{}.obj"/></geometry></visual>'
CYCLE = f"""<link name="a">{VISUAL}</link><link name="b">{VISUAL}</link>
<joint name="x" type="revolute"><parent link="a"/><child link="b"/></joint>
<joint name="y" type="revolute"><parent link="b"/><child link="a"/></joint>"""
BOMB = """<?xml version="1.0"?><!DOCTYPE robot [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">
<!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;"><!ENTITY d "&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;">]>
<robot name="&d;"><link name="a"/></robot>"""

BAD: dict[str, Callable[[Path], Path]] = {
    "missing file": lambda path: path / "nowhere.glb",
    "empty folder": empty_folder,
    "not a mesh": text_file("model.obj", "Dear reader, this is a letter.\n"),
    "an unknown suffix": text_file("model.docx", "words"),
    "a truncated GLB": glb_file(glb({"asset": {"version": "2.0"}})[:17]),
    "a GLB whose JSON is broken": glb_file(glb({"a": 1}).replace(b"{", b"[")),
    "an accessor far larger than its buffer": glb_file(huge_accessor()),
    "an OBJ with NaN": text_file("model.obj", BAD_LINE),
    "an empty OBJ": text_file("model.obj", ""),
    "zero parts": glb_file(glb({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]})),
    "one part": text_file("model.obj", PANEL),
    "one part that has faces": text_file("model.obj", PANEL + "o ghost\nv 0 0 0\n"),
    "10,000 parts": many_parts,
    "a cyclic URDF": urdf(CYCLE),
    "a URDF whose meshes are absent": urdf(
        f'<link name="a">{ABSENT.format("a")}</link><link name="b">{ABSENT.format("b")}</link>'
    ),
    "an XML bomb": text_file("piece.urdf", BOMB),
    "broken XML": text_file("piece.urdf", "<robot><link name='a'>"),
}


@pytest.mark.parametrize("verb", ["functionalize", "inspect"])
@pytest.mark.parametrize("what", BAD)
def test_bad_input_ends_in_one_line(what: str, verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, out = BAD[what](tmp_path / "input"), tmp_path / "out"

    code = main([verb, str(source)] + (["--out", str(out)] if verb == "functionalize" else []))

    said = capsys.readouterr()
    assert code == 2, said.err
    assert said.err.startswith("grafu: ")
    assert said.err.count("\n") == 1
    assert "Traceback" not in said.err + said.out
    assert not out.exists()


def test_the_limit_on_parts_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["inspect", str(many_parts(tmp_path / "input"))])

    assert "5,000" in capsys.readouterr().err.replace("5000", "5,000")


ODD_NAMES: dict[str, Callable[[str], str]] = {
    "duplicated names": lambda name: {"top_panel": "panel", "divider": "panel"}.get(name, name),
    "spaces, slashes and Unicode": lambda name: f"{name} größe/№ 1 \U0001f6aa",
    "ways out of the folder": lambda name: f"../../{name}\\..\\<script>",
    "longer than a file's name may be": lambda name: f"{name} {'long' * 100}",
}


@pytest.mark.parametrize("what", ODD_NAMES)
def test_odd_names_are_mended(what: str, tmp_path: Path) -> None:
    source = tmp_path / "odd.obj"
    source.write_text(obj_text((ODD_NAMES[what](name), box) for name, box in CABINET.items()), encoding="utf-8")

    assert main(["functionalize", str(source), "--out", str(tmp_path / "out")]) == 0

    report = json.loads((tmp_path / "out" / "odd" / "report.json").read_text())
    ids = [part["id"] for part in report["parts"]]
    assert len(set(ids)) == len(ids)
    assert all(i.isascii() and i.replace("_", "a").isalnum() for i in ids)


def test_an_output_that_exists_is_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, kept = write_cabinet(tmp_path), tmp_path / "out" / "cabinet" / "notes.txt"
    kept.parent.mkdir(parents=True)
    kept.write_text("mine")

    assert main(["functionalize", str(source), "--out", str(tmp_path / "out")]) == 2
    assert "notes.txt" in capsys.readouterr().err
    assert [p.name for p in kept.parent.iterdir()] == ["notes.txt"]


def test_a_file_in_place_of_the_output_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, out = write_cabinet(tmp_path), tmp_path / "out"
    out.write_text("a file")

    assert main(["functionalize", str(source), "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert f"--out must be a folder: `{out}` is a file" in said
    assert said.count("\n") == 1
    assert out.read_text() == "a file"


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everywhere")
def test_a_read_only_output_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, out = write_cabinet(tmp_path), tmp_path / "out"
    out.mkdir()
    out.chmod(0o500)

    assert main(["functionalize", str(source), "--out", str(out)]) == 2
    assert "cannot write" in capsys.readouterr().err
    assert list(out.iterdir()) == []


def test_a_disk_that_refuses(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    source, out = write_cabinet(tmp_path), tmp_path / "out"

    def refuse(self: Path, data: bytes) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", refuse)

    assert main(["functionalize", str(source), "--out", str(out)]) == 2
    assert "No space left" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize("verb", ["functionalize", "inspect"])
def test_links_that_lead_round_and_round(verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, out = tmp_path / "round.glb", tmp_path / "out"
    source.symlink_to("round.glb")

    assert main([verb, str(source)] + (["--out", str(out)] if verb == "functionalize" else [])) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert str(source) in said
    assert not out.exists()
