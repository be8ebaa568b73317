"""The types of the pages' scripts are checked: all scripts, each with the others of its page."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

import check_javascript  # noqa: E402  a script, found by the line above


def test_every_script_is_of_a_page_that_is_checked():
    checked = {path for scripts in check_javascript.programs().values() for path in scripts}
    assert checked == set((ROOT / "src").rglob("*.js"))
    assert all(path.read_text().startswith("// @ts-check\n") for path in checked)


@pytest.mark.skipif(not check_javascript.COMPILER.is_file(), reason="the compiler comes by npm install")
def test_a_wrong_type_is_told(monkeypatch, tmp_path, capfd):
    assert check_javascript.main() == 0
    wrong = tmp_path / "wrong.js"
    wrong.write_text("document.getElementById('a').value = 1;\n")
    monkeypatch.setattr(check_javascript, "programs", lambda: {"a page": [wrong]})
    assert check_javascript.main() == 1
    said = capfd.readouterr().out
    assert "Property 'value' does not exist" in said
    assert "possibly 'null'" in said
