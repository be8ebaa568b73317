"""`--pieces split` through the real command: each piece of furniture of a file is a result of its own."""

import json
import shutil
from pathlib import Path

import pytest

import grafu
from folders import contents
from furniture_rooms import cabinet, furnished_room, numbered, room, write_scene
from grafu.cli.main import main
from grafu.errors import OptionError


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("row")
    row = {**cabinet("wardrobe", (-0.6, 0, 0)), **numbered(cabinet("", (0.6, 0, 0)))}
    assert main(command(write_scene(folder / "row.glb", row), folder / "out")) == 0
    return folder


def command(scene: Path, out: Path, *more: str) -> list[str]:
    return ["functionalize", str(scene), "--pieces", "split", "--formats", "urdf", "--out", str(out), *more]


def values(out: Path, name: str, file: str) -> dict:
    return json.loads((out / name / file).read_text())


def test_each_piece_has_a_folder_and_all_are_on_one_page(done: Path) -> None:
    out = done / "out"
    assert sorted(path.name for path in out.iterdir()) == ["index.html", "row_piece_2", "row_wardrobe"]
    for k, name in enumerate(("row_wardrobe", "row_piece_2"), 1):
        assert len(values(out, name, "report.json")["joints"]) == 2
        assert values(out, name, "report.json")["input"]["name"] == name
        reading = values(out, name, "settings.json")["reading"]
        assert (reading["pieces"], reading["piece"]) == ("split", k)
        assert f'href="{name}/report.html"' in (out / "index.html").read_text()


def test_the_settings_of_a_piece_give_the_same_again(done: Path, tmp_path: Path) -> None:
    settings = done / "out" / "row_piece_2" / "settings.json"
    plain = ["functionalize", str(done / "row.glb"), "--formats", "urdf", "--out", str(tmp_path)]
    assert main([*plain, "--no-page", "--settings", str(settings)]) == 0
    first, again = (contents(out / "row_piece_2" / "meshes") for out in (done / "out", tmp_path))
    assert first == again


def test_resuming_makes_the_piece_that_is_lacking(done: Path, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    shutil.copytree(done / "out", tmp_path, dirs_exist_ok=True)
    shutil.rmtree(tmp_path / "row_piece_2")
    made = (tmp_path / "row_wardrobe" / "report.json").stat().st_mtime_ns
    assert main([*command(done / "row.glb", tmp_path), "--resume", "--no-page"]) == 0
    assert (tmp_path / "row_wardrobe" / "report.json").stat().st_mtime_ns == made
    assert (tmp_path / "row_piece_2" / "report.json").is_file()
    assert "1 of them done earlier" in capsys.readouterr().out


def test_one_piece_is_one_result_under_the_plain_name(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "one.glb", room(cabinet("")))
    assert main(command(scene, tmp_path / "out", "--no-page")) == 0
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["one"]


def test_no_piece_is_a_line_and_exit_code_2(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    scene = write_scene(tmp_path / "empty.glb", room({}))
    assert main(command(scene, tmp_path / "out")) == 2
    assert "holds no piece of furniture" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_results_that_would_go_to_one_place_are_refused(done: Path, capsys: pytest.CaptureFixture) -> None:
    other = done / "row_piece_2.glb"
    other.write_bytes((write_scene(done / "other.glb", cabinet(""))).read_bytes())
    verb, *rest = command(done / "row.glb", done / "both")
    assert main([verb, str(other), *rest]) == 2
    assert "must have different names" in capsys.readouterr().err


def test_parts_are_moved_of_one_piece_only(done: Path, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    move = ["--move", "wardrobe_cabinet_door_surface_7=right", "--no-page"]
    assert main(command(done / "row.glb", tmp_path, *move)) == 2
    assert "of split pieces one by --piece" in capsys.readouterr().err
    assert main(command(done / "row.glb", tmp_path, *move, "--piece", "1")) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["row_wardrobe"]


def test_inspect_shows_one_piece(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    scene = str(write_scene(tmp_path / "room.glb", furnished_room()))
    assert main(["inspect", scene, "--pieces", "split", "--piece", "2"]) == 0
    assert "room_desk: glb, 5 parts" in capsys.readouterr().out
    assert main(["inspect", scene, "--pieces", "split"]) == 2
    assert "choose one by --piece" in capsys.readouterr().err


def test_the_same_from_python(done: Path, tmp_path: Path) -> None:
    names = grafu.piece_names(done / "row.glb")
    assert names == ("row_wardrobe", "row_piece_2")
    result = grafu.functionalize(done / "row.glb", pieces="split", piece=2)
    result.save(tmp_path / names[1], formats=["urdf"], page=False)
    for file in ("model.urdf", "settings.json"):
        assert (tmp_path / names[1] / file).read_bytes() == (done / "out" / names[1] / file).read_bytes()
    with pytest.raises(OptionError, match="`pieces` must be together or split"):
        grafu.load(done / "row.glb", pieces="apart")
    with pytest.raises(TypeError, match=r"`grafu\.piece_names` has no argument piece"):
        grafu.piece_names(done / "row.glb", piece=1)
