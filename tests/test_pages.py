"""The code in the pages runs as it stands there."""

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parent.parent / "docs"


def code_below(page: str, heading: str) -> list[str]:
    sections = re.split(r"^#+ ", (DOCS / page).read_text(), flags=re.MULTILINE)
    (section,) = [text for text in sections if text.startswith(f"{heading}\n")]
    return re.findall(r"```python\n(.*?)```", section, re.DOTALL)


@pytest.mark.parametrize(
    ("page", "heading", "prints"),
    [
        ("synthetic.md", "Synthetic furniture", ""),
        ("additions.md", "From Python", "top_panel rectangle\nhandle_door knob-round\nshelf panel shelf\n"),
        ("dataset.md", "Pairs", ""),
        ("predictions.md", "From Python", "singapo True singapo\n"),
        ("dataset.md", "FurFun folders", "()\n"),  # what is written is read without a word
    ],
)
def test_the_code_below_a_heading_runs(
    page: str,
    heading: str,
    prints: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    (code,) = code_below(page, heading)
    exec(compile(code, f"{page}: {heading}", "exec"), {})
    assert capsys.readouterr().out == prints
