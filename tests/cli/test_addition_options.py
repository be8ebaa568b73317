"""What may be added, as the command spells it: each refusal, each style, and contradictions in one line."""

import argparse
import json
from pathlib import Path

import pytest

from grafu.additions.config import NO_ADDITIONS, AdditionConfig
from grafu.additions.grip.config import GripKind
from grafu.additions.interior.request import AUTO, InteriorKind, InteriorRequest
from grafu.cli.main import main
from grafu.cli.part_options import GRIPS, TOP_SHAPES, add_addition_options, addition_config
from grafu.errors import OptionError
from grafu.templates.handles import HANDLES

CHEST = Path(__file__).parents[2] / "samples" / "chest.glb"
BUILT_IN = tuple(template.id for template in HANDLES)


def config(*arguments: str, handles: tuple[str, ...] = BUILT_IN) -> AdditionConfig:
    parser = argparse.ArgumentParser()
    add_addition_options(parser)
    return addition_config(parser.parse_args(arguments), handles)


def test_by_default_all_is_added_but_carcass_boards() -> None:
    assert config() == AdditionConfig()
    assert AdditionConfig().carcass is None


def test_only_dynamic_adds_nothing() -> None:
    assert config("--only", "dynamic") == NO_ADDITIONS


def test_each_addition_can_be_refused() -> None:
    assert config("--no-top").top is None
    assert config("--no-drawer-boxes").drawer_boxes is None
    refused = config("--no-handles")
    assert refused.handles is None
    assert refused.grips is None


def test_styles_reach_what_they_are_for() -> None:
    found = config("--top", "rounded", "--handle", "bar-slim", "--interior", "auto", "--complete", "carcass")
    assert found.top is not None
    assert found.top.shape == "rounded"
    assert found.handles is not None
    assert found.handles.style == "bar-slim"
    assert found.interior == AUTO
    assert found.carcass is not None


def test_numbers_of_panels() -> None:
    assert config("--interior", "shelves=2,dividers=1").interior == InteriorRequest(InteriorKind.COUNTED, 2, 1)


@pytest.mark.parametrize("style", GRIPS)
def test_grips_are_carved_instead_of_handles(style: str) -> None:
    found = config("--handle", style)
    assert found.handles is None
    assert found.grips is not None
    assert found.grips.kind == ("auto" if style == "grip" else GripKind(style))


def test_a_template_of_the_users_own() -> None:
    found = config("--handle", "wing", handles=("wing",))
    assert found.handles is not None
    assert found.handles.style == "wing"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--handle", "wing"), "`--handle` must be one of bar-round, "),
        (("--interior", "shelves=many"), "`--interior` must be `none`, `auto`, "),
        (("--only", "dynamic", "--top", "rounded"), "`--top` and `--only` exclude each other"),
        (("--only", "dynamic", "--interior", "auto"), "`--interior` and `--only` exclude each other"),
        (("--no-top", "--top", "rounded"), "`--top` and `--no-top` exclude each other"),
        (("--no-handles", "--handle", "ring"), "`--handle` and `--no-handles` exclude each other"),
    ],
)
def test_what_cannot_be_is_said_in_one_line(arguments: tuple[str, ...], said: str) -> None:
    with pytest.raises(OptionError) as error:
        config(*arguments)
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_shapes_are_those_that_there_are() -> None:
    for shape in TOP_SHAPES:
        found = config("--top", shape).top
        assert found is not None
        assert found.shape == shape


@pytest.mark.parametrize(("more", "count"), [((), 2), (("--no-stays",), 0)])
def test_stays_can_be_refused(more: tuple[str, ...], count: int, tmp_path: Path) -> None:
    command = ["functionalize", str(CHEST), *more, "--formats", "urdf", "--no-page", "--out", str(tmp_path)]

    assert main(command) == 0
    report = json.loads((tmp_path / "chest" / "report.json").read_text())
    assert [joint["stays"] for joint in report["joints"]] == [count]


def test_catches_are_those_of_the_option_then_of_the_settings(tmp_path: Path) -> None:
    sample = str(CHEST.with_name("dresser.glb"))

    def made(name: str, *more: str) -> tuple[dict, str]:
        command = ["functionalize", sample, *more, "--formats", "mjcf,urdf", "--no-page", "--out", str(tmp_path / name)]
        assert main(command) == 0
        folder = tmp_path / name / "dresser"
        return json.loads((folder / "report.json").read_text()), (folder / "model.xml").read_text()

    report, text = made("closing", "--catch", "self-closing")
    settings = tmp_path / "closing" / "dresser" / "settings.json"
    again, same = made("again", "--settings", str(settings))
    plain, without = made("plain", "--settings", str(settings), "--catch", "none")

    assert [joint["kind"] for joint in report["caught"]["joints"]] == ["self-closing"] * len(report["joints"])
    assert (report["caught"]["files"], report["caught"]["files_without"]) == (["model.xml"], ["model.urdf"])
    assert text.count('<general class="catch"') == len(report["joints"])
    assert report["verdict"] == plain["verdict"]
    assert same == text
    assert again["caught"] == report["caught"]
    assert plain["caught"] is None
    assert "catch" not in without


def test_another_word_for_a_catch_is_refused_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["functionalize", str(CHEST), "--catch", "self-close", "--out", "nowhere"])

    assert end.value.code == 2
    assert "must be one of none, detent, self-closing: got 'self-close'; did you mean `self-closing`?" in (
        capsys.readouterr().err
    )


def test_where_no_file_has_the_catches_a_note_states_it_and_the_page_too(tmp_path: Path) -> None:
    sample = str(CHEST.with_name("dresser.glb"))

    assert main(["functionalize", sample, "--catch", "detent", "--formats", "urdf", "--out", str(tmp_path)]) == 0

    report = json.loads((tmp_path / "dresser" / "report.json").read_text())
    assert report["verdict"]["colour"] == "yellow"
    assert [note for note in report["notes"] if "add mjcf to --formats" in note]
    assert "Catches: 6 joints detent, in no file that was written; model.urdf cannot hold them." in (
        (tmp_path / "dresser" / "report.html").read_text()
    )
