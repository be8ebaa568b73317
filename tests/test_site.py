"""The site of docs/: every page has one place in its navigation, and links out of docs/ do not break it."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parent.parent
SITE = (ROOT / "mkdocs.yml").read_text()


@pytest.fixture
def hook() -> ModuleType:
    spec = importlib.util.spec_from_file_location("site_links", ROOT / "scripts" / "site_links.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_navigation_names_every_page_once_with_the_title_of_the_index() -> None:
    named = re.findall(r"^      - (.+): ([a-z]+\.md)$", SITE, re.MULTILINE)
    assert sorted(page for _, page in named) == sorted(
        path.name for path in (ROOT / "docs").glob("*.md") if path.name != "index.md"
    )
    index = (ROOT / "docs" / "index.md").read_text()
    sections = re.findall(r"^## (.+)$", index, re.MULTILINE)
    assert sections == re.findall(r"^  - (\w[\w ]+):$", SITE.partition("\nnav:")[2], re.MULTILINE)
    assert all(f"- [{title}]({page})" in index for title, page in named)


def test_links_out_of_the_folder_become_text_and_others_stay(hook: ModuleType) -> None:
    page = "[a](../src/a.py), [b `c`](../examples/README.md#x) and [d](joints.md#e), ![f](images/f.png)"
    assert hook.on_page_markdown(page, page=None) == "a, b `c` and [d](joints.md#e), ![f](images/f.png)"


def test_nothing_is_loaded_from_the_internet_and_broken_links_are_errors() -> None:
    assert "font: false" in SITE
    assert re.search(r"links: \{not_found: warn, .*anchors: warn\}", SITE)
    makefile = (ROOT / "Makefile").read_text()
    assert "mkdocs build --strict" in makefile
    assert "make site" in (ROOT / ".ci" / "run").read_text()
