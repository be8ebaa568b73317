"""CONTRIBUTING.md says which files to touch: they exist, and where a search can tell, none is missing."""

import re
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
SOURCES = {path.relative_to(ROOT).as_posix(): path for path in (ROOT / "src").rglob("*.py")}


def row_of(what: str) -> str:
    """Returns the row of the table that says what to touch for this."""
    return next(line for line in PAGE.splitlines() if line.startswith(f"| {what} |"))


def paths_in(text: str) -> set[str]:
    return set(re.findall(r"`((?:src|tests|docs)/[\w/.]*)`", text))


def test_every_file_that_is_named_is_there() -> None:
    assert len(paths_in(PAGE)) > 20
    assert [path for path in sorted(paths_in(PAGE)) if not (ROOT / path).exists()] == []


def test_a_hinge_class_touches_the_files_that_name_one() -> None:
    naming = {
        name for name, path in SOURCES.items() if re.search(r"MechanismClass\.(?!NONE)[A-Z]", path.read_text("utf-8"))
    }
    assert naming - paths_in(row_of("a hinge class")) == set()


def test_a_kind_of_motion_touches_the_files_that_name_one() -> None:
    moving = re.compile(r"JointType\.(?!FIXED)[A-Z]+|\"(revolute|prismatic)\"")
    addon = {path.relative_to(ROOT).as_posix(): path for path in (ROOT / "blender_addon").rglob("*.py")}
    pages = {p.relative_to(ROOT).as_posix(): p for p in (ROOT / "src/grafu/viewer/templates").iterdir()}
    every = {**SOURCES, **addon, **pages}
    named = paths_in(row_of("a kind of joint motion"))
    assert {name for name, path in every.items() if moving.search(path.read_text("utf-8"))} - named == set()
    assert len(named) <= 15


def test_only_the_table_of_formats_names_an_exporter() -> None:
    exporter = re.compile(r"grafu\.export\.[\w.]+:export_\w+")
    assert {name for name, path in SOURCES.items() if exporter.search(path.read_text("utf-8"))} == {
        "src/grafu/export/formats.py"
    }
