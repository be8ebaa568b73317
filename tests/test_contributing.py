"""CONTRIBUTING.md states which files to touch: they exist, and where a search can tell, none is missing."""

import re
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
FOLDERS = ("src", "blender_addon")
SOURCES = {path.relative_to(ROOT).as_posix(): path for name in FOLDERS for path in (ROOT / name).rglob("*.py")}


def row_of(what: str) -> str:
    """Returns the row of the table that states what to touch for this."""
    return next(line for line in PAGE.splitlines() if line.startswith(f"| {what} |"))


def paths_in(text: str) -> set[str]:
    return set(re.findall(r"`((?:src|tests|docs|blender_addon)/[\w/.]*)`", text))


def test_every_file_that_is_named_is_there() -> None:
    assert len(paths_in(PAGE)) > 20
    assert [path for path in sorted(paths_in(PAGE)) if not (ROOT / path).exists()] == []


def test_a_hinge_class_touches_the_files_that_name_one() -> None:
    # as a member, or as the letter in a literal of several: ("C", "F", "P") and ("C", "Contact", ...)
    named = re.compile(r"MechanismClass\.(?!NONE)[A-Z]|[(\[]\"C\", \"(?:F|Contact)\"")
    naming = {name for name, path in SOURCES.items() if named.search(path.read_text("utf-8"))}
    assert naming - paths_in(row_of("a hinge class")) == set()


def test_a_kind_of_motion_touches_the_files_that_name_one() -> None:
    moving = re.compile(r"JointType\.(?!FIXED)[A-Z]+|\"(revolute|prismatic)\"")
    pages = {p.relative_to(ROOT).as_posix(): p for p in (ROOT / "src/grafu/viewer/templates").iterdir()}
    every = {**SOURCES, **pages}
    named = paths_in(row_of("a kind of joint motion"))
    assert {name for name, path in every.items() if moving.search(path.read_text("utf-8"))} - named == set()
    assert len(named) <= 15


def test_a_format_with_words_for_motions_has_them_in_the_table() -> None:
    table = "src/grafu/articulation/motion_kind.py"
    assert "MotionFormat = Literal[" in SOURCES[table].read_text("utf-8")
    assert table in paths_in(row_of("an export format"))


def test_only_the_table_of_formats_names_an_exporter() -> None:
    exporter = re.compile(r"grafu\.export\.[\w.]+:export_\w+")
    assert {name for name, path in SOURCES.items() if exporter.search(path.read_text("utf-8"))} == {
        "src/grafu/export/formats.py"
    }
