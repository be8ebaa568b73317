"""What the README and the pages for users tell a reader to type runs as it stands, on samples as small as can be."""

import json
import re
import shlex
from pathlib import Path
from shutil import copyfile

import pytest

from grafu.cli.input_options import join_directions
from grafu.cli.main import build_parser, main

ROOT = Path(__file__).parent.parent.parent
README = (ROOT / "README.md").read_text()
USERS = ("docs/artist.md", "docs/simulation.md", "docs/research.md", "docs/faq.md")  # every command of them is run
PAGES = {
    page: re.findall(r"^    (?:\.venv/bin/)?(grafu [^#\n]+)", (ROOT / page).read_text(), re.MULTILINE)
    for page in ("README.md", "docs/prepare.md", *USERS)
}
LINES = [line for lines in PAGES.values() for line in lines]


def arguments_of(line: str) -> list[str]:
    words = shlex.split(line)[1:]
    found = (sorted(str(p.relative_to(ROOT)) for p in ROOT.glob(word)) if "*" in word else [word] for word in words)
    return [word for each in found for word in each]


def test_every_line_is_a_command_on_what_the_checkout_holds() -> None:
    assert len(LINES) >= 14
    for line in LINES:
        words = arguments_of(line)
        if words[-1] != "--formats":  # it prints a table and ends
            build_parser().parse_args(words)
        assert all((ROOT / word).exists() for word in words if word.startswith("samples/"))


EVERY_PAGE = (*ROOT.glob("docs/*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "examples" / "README.md")


@pytest.mark.parametrize("page", EVERY_PAGE, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_command_of_every_page_is_read_as_it_stands(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = re.sub(r"\s*\\?\n +(?=--)", " ", page.read_text()).replace("\\\n", " ")  # lines that go on
    fenced = "\n".join(re.findall(r"^ *```\w*\n(.*?)^ *```", text, re.MULTILINE | re.DOTALL))
    lines = re.findall(r"^ {4,6}(?:\.venv/bin/)?grafu ([^\n]+)", text, re.MULTILINE)
    for line in lines + re.findall(r"^(?:\.venv/bin/)?grafu ([^\n]+)", fenced, re.MULTILINE):
        words = shlex.split(re.sub(r" (\||&&|> \S+)( .*)?$", "", line), comments=True)
        assert not code_of(words), (line, capsys.readouterr().err)


def code_of(words: list[str]) -> str | int | None:
    """Returns 0 where the words are read; a help, or the table of formats, ends with it, too."""
    try:
        build_parser(words).parse_args(join_directions(words))
    except SystemExit as end:
        return end.code
    return 0


def copy_samples(folder: Path, lines: list[str]) -> None:
    """Copies the samples into a folder; where no line names a part of one, or checks it, it is the smallest."""
    (folder / "samples").mkdir()
    themselves = {name for line in lines if "--move" in line for name in re.findall(r"samples/(\w+\.glb)", line)}
    themselves |= {f"{Path(line.strip()).name}.glb" for line in lines if line.startswith("grafu check ")}
    for path in (ROOT / "samples").iterdir():
        source = path if path.name in themselves else ROOT / "samples" / "chest.glb"
        copyfile(source, folder / "samples" / path.name)


def is_short(line: str) -> bool:
    return re.match(r"grafu (inspect|functionalize samples/\w+\.glb )", line) is not None


def outputs_of(line: str) -> list[Path]:
    """Returns the folders that a line writes, one for each input; the editor writes into the result that it opens."""
    if line.endswith("--formats") or line.startswith("grafu edit "):
        return []
    options = build_parser().parse_args(arguments_of(line))
    return (
        [options.out / Path(found).stem for found in getattr(options, "inputs", [])] if hasattr(options, "out") else []
    )


@pytest.mark.parametrize("page", PAGES)
def test_no_line_writes_where_an_earlier_one_of_the_page_did(page: str) -> None:
    written = [folder for line in PAGES[page] for folder in outputs_of(line)]
    assert len(written) >= (1 if page in USERS else 4)
    assert len(set(written)) == len(written)


@pytest.mark.slow
@pytest.mark.parametrize("page", USERS)
def test_every_command_of_a_page_for_users_runs_in_order(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("webbrowser.open", lambda _: True)
    for name in ("OPENAI_API_KEY", "OPENAI_BASE_URL"):  # no test asks a language model
        monkeypatch.delenv(name, raising=False)
    copy_samples(tmp_path, PAGES[page])
    for line in PAGES[page]:
        try:
            code = main(arguments_of(line))
        except SystemExit as end:
            code = end.code
        assert code == 0, (line, capsys.readouterr().err)


def test_the_line_of_json_in_the_page_has_fields_that_are_printed() -> None:
    text = (ROOT / "docs" / "simulation.md").read_text()
    (shown,) = re.findall(r"```json\n(.*?)```", text, re.DOTALL)
    fields = set(re.findall(r"`(\w+)`", (ROOT / "docs" / "outputs.md").read_text()))
    assert set(json.loads(shown)) <= fields


def test_the_commands_of_a_page_run_one_after_another_in_one_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A command that stands twice, but for the folder that it writes, runs once."""
    done = set()
    for page in (page for page in PAGES if page not in USERS):
        lines = PAGES[page]
        folder = tmp_path / Path(page).stem
        folder.mkdir()
        monkeypatch.chdir(folder)
        copy_samples(folder, lines)
        for line in filter(is_short, lines):
            if (what := re.sub(r" --out \S+", "", line).strip()) not in done:
                assert main([*arguments_of(line), *(["--no-page"] if "functionalize" in line else [])]) == 0, line
            done.add(what)
    assert len(done) >= 10


def test_the_python_runs_as_it_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "samples").symlink_to(ROOT / "samples")
    (code,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    exec(compile(code, "README.md", "exec"), {})
    assert (tmp_path / "results" / "changed" / "model.urdf").is_file()
