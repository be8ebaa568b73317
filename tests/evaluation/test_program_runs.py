"""Installed systems as stubs: one that writes its format, ones that fail, hang, write nothing, or are not there."""

import json
import os
import re
import sys
import time
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.errors import NotRun, OptionError, UnreadableAsset
from grafu.evaluation.config_file import read_config
from grafu.evaluation.llm.config import LlmConfig
from grafu.evaluation.methods import Method, MethodOptions, made_by, parse_method
from grafu.evaluation.perform import method_facts
from grafu.evaluation.programs.config import ProgramConfig
from grafu.evaluation.programs.running import program_hash
from grafu.export.files import write_files
from grafu.export.particulate import export_particulate
from grafu.export.singapo import export_singapo
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.truth.clashes import articulated_of
from small_assets import load_annotated, write_pnm

# Copies what was prepared for the model to the folder that it is given, as the named system would write it there.
STUB = """\
import os, pathlib, shutil, sys
mesh, picture, out, model, prepared = sys.argv[1:6]
assert pathlib.Path(mesh).read_text().startswith("v ")
assert pathlib.Path(picture).read_bytes().startswith(b"\\x89PNG")
assert "PYTHONPATH" not in os.environ
assert os.environ["STUB"] == "own"
with open(os.path.join(prepared, "runs"), "a") as runs:
    runs.write(model + "\\n")
shutil.copytree(os.path.join(prepared, model), os.path.join(out, "made", "0"))
print("done")
"""


@pytest.fixture(scope="module")
def cabinet() -> Asset:
    return make_cabinet(Cabinet())


def config_file(place: Path, command: list[str], **more: object) -> Path:
    lines = [f"command = {json.dumps(command)}", *(f"{name} = {json.dumps(value)}" for name, value in more.items())]
    file = place / "run.toml"
    file.write_text("\n".join(lines) + '\n[environment]\nSTUB = "own"\n')
    return file


def stub(folder: Path, code: str, system: str = "singapo", **more: object) -> Method:
    (folder / "stub.py").write_text(code)
    words = ["{mesh}", "{picture}", "{out}", "{id}", str(folder / "prepared")]
    file = config_file(folder, [sys.executable, "stub.py", *words], folder=str(folder), **more)
    return parse_method(f"{system}-run:{file}", MethodOptions(outputs=folder / "outputs"))


def prepare(folder: Path, cabinet: Asset, system: str) -> None:
    write = export_singapo if system == "singapo" else export_particulate
    write_files(write(articulated_of(cabinet)), folder / "prepared" / cabinet.name)


@pytest.mark.parametrize("system", ["particulate", "singapo"])
def test_what_a_program_writes_is_read_and_built(
    system: str, tmp_path: Path, cabinet: Asset, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PYTHONPATH", "of our own Python")
    prepare(tmp_path, cabinet, system)
    method = stub(tmp_path, STUB, system, result="made/*")
    for _ in range(2):
        parts = method_facts(cabinet, made_by(method, cabinet, cabinet.name)).parts
        assert len(parts) == len(cabinet.joints)
        assert all(part.raw and part.raw.aligned for part in parts)
    assert (tmp_path / "prepared" / "runs").read_text().split() == [cabinet.name]  # the second time it was read


def test_a_prediction_on_the_mesh_that_was_written_fits_a_model_in_any_frame(tmp_path: Path) -> None:
    turned = np.array([[0.0, -50.0, 0.0], [50.0, 0.0, 0.0], [0.0, 0.0, 50.0]])
    asset = load_annotated(write_pnm(tmp_path / "data", turned))
    prepare(tmp_path, asset, "particulate")
    made = made_by(stub(tmp_path, STUB, "particulate", result="made/*"), asset, asset.name)
    parts = method_facts(asset, made).parts
    assert len(parts) == 2
    assert all(part.raw and part.raw.aligned for part in parts)


def test_another_command_runs_again_and_another_model_too(tmp_path: Path, cabinet: Asset) -> None:
    prepare(tmp_path, cabinet, "singapo")
    made_by(stub(tmp_path, STUB, result="made/*"), cabinet, cabinet.name)
    made_by(stub(tmp_path, STUB, result="made/0"), cabinet, cabinet.name)
    (tmp_path / "prepared" / cabinet.name).rename(tmp_path / "prepared" / "other")
    made_by(stub(tmp_path, STUB, result="made/0"), cabinet, "other")
    runs = (tmp_path / "prepared" / "runs").read_text().split()
    assert runs == [cabinet.name, cabinet.name, "other"]


@pytest.mark.parametrize(
    ("code", "states"),
    [
        ("import sys; print('no GPU is there'); sys.exit(3)", "exit code 3: no GPU is there"),
        ("pass", "wrote no `.`"),
        ("import sys, pathlib; (pathlib.Path(sys.argv[3]) / 'object.json').write_text('{')", "damaged"),
        ("import sys, pathlib; (pathlib.Path(sys.argv[3]) / 'notes.txt').write_text('')", "is no prediction"),
    ],
)
def test_a_program_that_fails_is_said_and_run_again(code: str, states: str, tmp_path: Path, cabinet: Asset) -> None:
    method = stub(tmp_path, code)
    with pytest.raises(UnreadableAsset, match=states) as error:
        made_by(method, cabinet, cabinet.name)
    assert "\n" not in str(error.value)
    prepare(tmp_path, cabinet, "singapo")
    (tmp_path / "stub.py").write_text(STUB.replace('os.path.join(out, "made", "0"))', "out, dirs_exist_ok=True)"))
    assert made_by(method, cabinet, cabinet.name).object.joints  # nothing of the failed run is in the way


def test_a_program_that_writes_no_file_of_the_pattern_is_said(tmp_path: Path, cabinet: Asset) -> None:
    prepare(tmp_path, cabinet, "singapo")
    with pytest.raises(UnreadableAsset, match=r"wrote no `elsewhere/\*`"):
        made_by(stub(tmp_path, STUB, result="elsewhere/*"), cabinet, cabinet.name)


@pytest.mark.skipif(os.name != "posix", reason="groups of processes are POSIX's")
def test_a_program_that_hangs_is_ended_with_what_it_started(tmp_path: Path, cabinet: Asset) -> None:
    code = (
        "import subprocess, sys, time, pathlib\n"
        "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)'])\n"
        "pathlib.Path(sys.argv[5] + '.id').write_text(str(child.pid))\n"
        "time.sleep(60)"
    )
    begun = time.perf_counter()
    with pytest.raises(UnreadableAsset, match=r"took more than 1 s"):
        made_by(stub(tmp_path, code, timeout=1), cabinet, cabinet.name)
    assert time.perf_counter() - begun < 30
    child = int((tmp_path / "prepared.id").read_text())
    for _ in range(200):
        state = Path(f"/proc/{child}/stat")
        if not state.exists() or ") Z " in state.read_text():
            break
        time.sleep(0.02)
    else:
        pytest.fail("what the program had started still runs")


@pytest.mark.parametrize(
    ("program", "folder", "named"),
    [("no-such-program", ".", "no-such-program"), (sys.executable, "nowhere", "nowhere")],
)
def test_what_is_not_installed_is_not_run(
    program: str, folder: str, named: str, tmp_path: Path, cabinet: Asset
) -> None:
    file = config_file(tmp_path, [program, "{out}"], folder=str(tmp_path / folder))
    method = parse_method(f"particulate-run:{file}", MethodOptions(outputs=tmp_path / "outputs"))
    with pytest.raises(NotRun, match=f"particulate is not installed: .*{named}"):
        made_by(method, cabinet, cabinet.name)
    assert not (tmp_path / "outputs").exists()


@pytest.mark.parametrize(
    ("text", "states"),
    [
        ("", "command"),
        ("command = []", "must name a program"),
        ('command = ["a"]', "must name {out}"),
        ('command = ["a", "{out}", "{model}"]', "got {model}"),
        ('command = ["a", "{out"]', "command|expected"),
        ('command = "a {out}"', "command"),
        ('command = ["a", "{out}"]\nresult = "../x"', "within {out}"),
        ('command = ["a", "{out}"]\ntimeout = 0', "timeout"),
        ('command = ["a", "{out}"]\nspeed = 1', "speed"),
        ("command = [", "is no TOML"),
    ],
)
def test_a_config_that_is_wrong_is_refused_before_any_work(text: str, states: str, tmp_path: Path) -> None:
    (tmp_path / "run.toml").write_text(text)
    with pytest.raises(OptionError, match=states) as error:
        parse_method(f"singapo-run:{tmp_path / 'run.toml'}")
    assert "\n" not in str(error.value)
    assert "run.toml" in str(error.value)


def test_a_config_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="cannot be read"):
        parse_method(f"singapo-run:{tmp_path / 'run.toml'}")
    with pytest.raises(OptionError, match="`singapo-run:FILE`"):
        parse_method("singapo-run")


def test_a_whole_number_of_seconds_is_a_time(tmp_path: Path) -> None:
    (tmp_path / "run.toml").write_text('command = ["a", "{out}"]\ntimeout = 20')
    assert read_config(tmp_path / "run.toml", ProgramConfig).timeout == 20.0


def test_what_determines_an_output_determines_its_folder(tmp_path: Path) -> None:
    methods = [stub(tmp_path, ""), stub(tmp_path, "", "particulate"), stub(tmp_path, "", result="x")]
    hashes = [program_hash(method.program) for method in methods if method.program]
    assert len(set(hashes)) == 3
    longer = stub(tmp_path, "", timeout=5).program
    assert longer
    assert program_hash(longer) == hashes[0]


def test_the_files_in_the_page_are_configs(tmp_path: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "evaluation.md").read_text()
    llm, *runs = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    (tmp_path / "llm.toml").write_text(llm)
    stated = read_config(tmp_path / "llm.toml", LlmConfig)
    assert set(re.findall(r"^(\w+) =", llm, re.MULTILINE)) == {field.name for field in fields(LlmConfig)}
    assert stated.price_in
    for number, text in enumerate(runs):
        (tmp_path / f"{number}.toml").write_text(text)
        assert read_config(tmp_path / f"{number}.toml", ProgramConfig).command[0].startswith("/opt/")
    assert len(runs) == 2
