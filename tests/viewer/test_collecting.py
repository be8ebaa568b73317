"""A page from a disk collects what is chosen: one settings.json that holds all of it, and one command that uses it."""

import json
import shlex
from pathlib import Path

import pytest

from grafu.cli.main import build_parser
from grafu.joints.motion_choice import choice_in_words
from grafu.pipeline.settings import Settings, settings_from_json
from grafu.viewer.model_page import model_page

SETTINGS = Settings(hinge="piano")


@pytest.fixture(scope="module")
def collecting(made) -> str:
    result = made.result
    return model_page(result.asset, result.object, result.completion, made.report, None, SETTINGS, ("glb", "mjcf"))


@pytest.fixture
def opened(browser, collecting, tmp_path):
    folder = tmp_path / "a folder's results" / "made"
    folder.mkdir(parents=True)
    (folder / "report.html").write_text(collecting)
    browser.open(folder / "report.html")
    return browser


def options_of(made) -> dict[str, str]:
    """Returns one option for each of two parts."""
    return {part: options[0] for part, options in list(made.report.moves.items())[:2]}


def press(browser, option: str) -> None:
    browser.run(f"[...document.querySelectorAll('[data-copy]')].find((one) => one.dataset.copy === {option!r}).click()")


def test_without_settings_nothing_is_collected(page, collecting):
    assert 'id="collected"' in collecting
    assert 'id="collected"' not in page


def test_choices_become_one_file_and_one_command(opened, made, tmp_path):
    assert opened.run("document.getElementById('collected').hidden")
    options = options_of(made)
    for option in options.values():
        press(opened, option)
    assert not opened.run("document.getElementById('collected').hidden")

    opened.run(
        "URL.createObjectURL = (blob) => {window.saved = blob.text(); return '#'};"
        "document.getElementById('collected-save').click()"
    )
    saved = settings_from_json(json.loads(opened.run("window.saved")))
    chosen = {part: choice_in_words(option.rpartition("=")[2]) for part, option in options.items()}
    assert saved.motions == chosen
    assert saved.hinge == "piano"

    words = shlex.split(opened.run("document.getElementById('collected-command').dataset.copy"))
    stated = build_parser().parse_args(words[1:])
    assert stated.inputs == [Path(made.report.input.path)]
    assert stated.out == tmp_path / "a folder's results"
    assert stated.overwrite
    assert stated.formats == "glb,mjcf"  # those of the results, which the command replaces
    assert stated.name == made.report.input.name
    assert opened.complaints() == []


def test_a_second_click_takes_a_choice_back(opened, made):
    option = next(iter(options_of(made).values()))
    press(opened, option)
    press(opened, option)
    assert opened.run("document.getElementById('collected').hidden")
