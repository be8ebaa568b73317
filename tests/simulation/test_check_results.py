"""`grafu check`: what works passes, and each way of being broken is found; what is found lands in the folder."""

import json
import re
import shutil
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from grafu.cli.main import main
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.simulation.config import CheckConfig
from grafu.simulation.pulls import hollow_place
from grafu.simulation.record import CheckReport
from grafu.viewer.check_page import with_check

pytest.importorskip("mujoco")
DRESSER = Path(__file__).parents[2] / "samples" / "dresser.glb"


@pytest.fixture(scope="module")
def result(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("check")
    assert main(["functionalize", str(DRESSER), "--formats", "glb,mjcf", "--out", str(out)]) == 0
    return out / "dresser"


def copied(result: Path, tmp_path: Path, *changes: tuple[str, str]) -> Path:
    shutil.copytree(result, tmp_path / "broken")
    model = tmp_path / "broken" / "model.xml"
    text = model.read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    model.write_text(text)
    return tmp_path / "broken"


def checked(folder: Path) -> tuple[int, CheckReport]:
    code = main(["check", str(folder)])
    return code, CheckReport.read_json((folder / "check.json").read_bytes())


@pytest.mark.slow
def test_what_works_passes_and_all_is_written_and_listed(result, tmp_path, capsys):
    folder = copied(result, tmp_path)
    code, report = checked(folder)

    assert code == 0
    assert report.works
    assert [file.file for file in report.files] == ["model.xml"]
    assert len(report.files[0].joints) >= 3
    assert all(joint.carries for joint in report.files[0].joints)
    assert (folder / "check.gif").read_bytes().startswith(b"GIF89a")
    listed = json.loads((folder / ".grafu.json").read_text())["files"]
    assert {"check.json", "check.gif"} <= set(listed)
    page = (folder / "report.html").read_text()
    assert page.count("<!-- check -->") == 1
    assert all(joint.joint in page[page.index("<!-- check -->") :] for joint in report.files[0].joints)
    assert "stays at rest" in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["detent", "self-closing"])
def test_what_has_catches_opens_and_closes_all_the_same(tmp_path, kind):
    command = ["functionalize", str(DRESSER), "--catch", kind, "--formats", "mjcf", "--no-page", "--out", str(tmp_path)]
    assert main(command) == 0
    code, report = checked(tmp_path / "dresser")

    assert code == 0
    assert all(joint.works for joint in report.files[0].joints)
    assert "_catch" in (tmp_path / "dresser" / "model.xml").read_text()


def test_a_joint_that_needs_more_than_a_hand_does_not_open(result, tmp_path):
    from grafu.simulation.check import check_folder

    folder = copied(result, tmp_path)
    text = (folder / "model.xml").read_text()
    (folder / "model.xml").write_text(re.sub('frictionloss="[^"]*"', 'frictionloss="80"', text))

    found = check_folder(folder, replace(CheckConfig(), longest_pull=1.0, frames=2)).report

    assert not found.works
    assert all(not joint.works and joint.opened < 0.1 for joint in found.files[0].joints)


def test_a_page_that_is_not_ours_stays_as_it_is(result, tmp_path):
    folder = copied(result, tmp_path, ("</mujoco>", "<nonsense/></mujoco>"))
    marker = json.loads((folder / ".grafu.json").read_text())
    marker["files"].remove("report.html")
    (folder / ".grafu.json").write_text(json.dumps(marker))
    (folder / "report.html").write_text("<main></main>")
    checked(folder)
    assert (folder / "report.html").read_text() == "<main></main>"


def test_a_damaged_file_is_an_error_of_the_file_and_another_folder_is_refused(result, tmp_path, capsys):
    code, report = checked(copied(result, tmp_path, ("</mujoco>", "<nonsense/></mujoco>")))
    assert code == 1
    assert "MuJoCo does not load" in report.files[0].error

    (tmp_path / "other").mkdir()
    assert main(["check", str(tmp_path / "other")]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_of_the_folder_of_a_run_every_result_is_checked(result, tmp_path, capsys):
    copied(result, tmp_path, ("</mujoco>", "<nonsense/></mujoco>"))
    shutil.copytree(tmp_path / "broken", tmp_path / "second")
    assert main(["check", str(tmp_path)]) == 1
    assert [line.partition(":")[0] for line in capsys.readouterr().out.splitlines()] == ["broken", "second"]


def test_a_lid_that_is_too_heavy_in_urdf_is_explained(tmp_path):
    from grafu.simulation.check import NO_SPRINGS, check_folder
    from grafu.simulation.words import sentences

    chest = DRESSER.with_name("chest.glb")
    assert main(["functionalize", str(chest), "--formats", "urdf,mjcf", "--no-page", "--out", str(tmp_path)]) == 0
    found = check_folder(tmp_path / "chest", replace(CheckConfig(), frames=2)).report

    [mjcf], [urdf] = (file.joints for file in found.files)
    assert (mjcf.works, mjcf.hint) == (True, "")
    assert (urdf.works, urdf.hint) == (False, NO_SPRINGS)
    of_mjcf, of_urdf = sentences(found)
    assert "1 of 1 joint open and close when they are pulled;" in of_mjcf
    assert f"(lid_joint opens by {urdf.opened:.0%} under 20 N, for {NO_SPRINGS});".replace("%", " %") in of_urdf


def test_a_line_of_json_for_each_result_and_for_what_is_none(result, tmp_path, capsys):
    broken = copied(result, tmp_path, ("</mujoco>", "<nonsense/></mujoco>"))
    other = tmp_path / "other"
    other.mkdir()
    assert main(["check", "--json", str(broken), str(other)]) == 1
    first, second = map(json.loads, capsys.readouterr().out.splitlines())
    assert (first["check"], first["folder"], first["works"], first["error"]) == ("broken", str(broken), False, None)
    assert any("MuJoCo does not load" in finding for finding in first["findings"])
    assert (second["works"], second["findings"]) == (False, [])
    assert second["error"]
    assert set(first) == set(second)
    assert main(["check", "--json", str(other)]) == 2
    assert json.loads(capsys.readouterr().out) == second


def test_without_mujoco_there_is_one_line_before_any_work(result, tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    assert main(["check", str(result)]) == 2
    assert "pip install 'grafu[sim]'" in capsys.readouterr().err
    assert main(["functionalize", str(DRESSER), "--check", "--out", str(tmp_path / "new")]) == 2
    assert not (tmp_path / "new").exists()


def test_formats_that_mujoco_cannot_load_are_refused(tmp_path, capsys):
    assert main(["functionalize", str(DRESSER), "--check", "--formats", "glb", "--out", str(tmp_path / "new")]) == 2
    assert "urdf" in capsys.readouterr().err.lower()


def tray(depth: float) -> TriangleMesh:
    """Four walls around a floor of 0.4 x 0.3 m, 0.15 m high; `depth` is how deep it is."""
    boxes = [((0, 0, 0), (0.4, 0.3, 0.15 - depth))] if depth < 0.15 else []
    boxes += [((0, 0, 0), (0.01, 0.3, 0.15)), ((0.39, 0, 0), (0.4, 0.3, 0.15))]
    boxes += [((0, 0, 0), (0.4, 0.01, 0.15)), ((0, 0.29, 0), (0.4, 0.3, 0.15))]
    return merge_meshes([TriangleMesh.box_mesh(Box(np.array(a, float), np.array(b, float))) for a, b in boxes])


@pytest.mark.parametrize(
    ("depth", "is_hollow"), [(0.14, True), (0.05, True), (0.03, False), (0.0, False), (0.15, False)]
)
def test_a_drawer_is_hollow_where_a_cube_has_room_above_a_floor(depth, is_hollow):
    found = hollow_place([tray(depth)], vec3(0.0, -1.0, 0.0), CheckConfig())
    assert (found is not None) == is_hollow
    if found is not None:
        assert found[2] == pytest.approx(0.15 - depth, abs=1e-6)
        assert found[1] < 0.1  # in front
        assert found[0] == pytest.approx(0.2, abs=0.02)


def test_a_free_piece_is_checked_freely_and_one_on_a_wall_is_not_put_on_the_floor(result, tmp_path):
    from grafu.simulation.check import check_folder

    folder = copied(result, tmp_path)
    report = json.loads((folder / "report.json").read_text())
    for kind, stands in (("free", True), ("wall", None)):
        report["base"]["kind"] = kind
        (folder / "report.json").write_text(json.dumps(report))
        found = check_folder(folder, replace(CheckConfig(), longest_pull=0.05, frames=2)).report.files[0]
        assert found.stands is stands


def test_a_second_check_takes_the_place_of_the_first():
    page = "<body><main><p>text</p></main></body>"
    once = with_check(page, ("a",), [("1",)], ["first"], b"GIF")
    twice = with_check(once, ("a",), [("2 & <3>",)], ["second"], b"")
    assert "first" in once
    assert "first" not in twice
    assert "data:image/gif" in once
    assert "2 &amp; &lt;3&gt;" in twice
    assert twice.count("<!-- check -->") == 1
    assert twice.index("second") < twice.index("</main>")
    assert with_check("no main part", (), [], ["x"], b"") == "no main part"
