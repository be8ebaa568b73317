"""The built extension in a Blender without this checkout: installed, used, its files written.

It needs the zip that `make blender` builds, in dist/, and a `bpy`; it skips without either.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from grafu.errors import ExportError
from grafu.export.blend.exporter import find_interpreter

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from build_blender_addon import own_platform  # noqa: E402

ASK = """
import json, sys
from importlib.util import find_spec
print(json.dumps([sys._base_executable, find_spec("bpy").origin, find_spec("numpy").origin]))
"""


def bare_python(interpreter: str, folder: Path) -> tuple[str, str]:
    """Returns a Python and its path, on which are Blender and the numpy that every Blender brings, and nothing else."""
    asked = subprocess.run([interpreter, "-c", ASK], capture_output=True, text=True, timeout=300, check=True)
    base, blender, numpy = json.loads(asked.stdout.splitlines()[-1])
    for package in (Path(blender).parent, Path(numpy).parent, Path(numpy).parent.with_name("numpy.libs")):
        if package.exists():
            (folder / package.name).symlink_to(package)
    return base, str(folder)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    found = (ROOT / "dist").glob(f"grafu-blender-*-{own_platform()}*.zip")
    built = max(found, key=lambda path: path.stat().st_mtime, default=None)
    if built is None:
        pytest.skip("no extension is built: `make blender`")
    try:
        interpreter = find_interpreter()
    except ExportError as error:
        pytest.skip(str(error))
    made, only, profile = (tmp_path_factory.mktemp(name) for name in ("zip", "only", "profile"))
    python, path = bare_python(interpreter, only)
    command = [python, "-S", str(Path(__file__).with_name("zip_probe.py"))]
    done = subprocess.run(
        [*command, str(built), str(ROOT / "samples" / "sideboard.glb"), str(made)],
        env={**os.environ, "PYTHONPATH": path, "BLENDER_USER_RESOURCES": str(profile)},
        cwd=made,
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert done.returncode == 0, (done.stdout + done.stderr)[-3000:]
    (made / "profile").write_text(str(profile))
    (made / "built").write_text(built.stem)
    return made


@pytest.fixture(scope="module")
def facts(folder):
    return json.loads((folder / "facts.json").read_text())


def test_it_is_installed_with_its_own_wheels(facts, folder):
    assert facts["installed"] == ["FINISHED"]
    assert facts["enabled"]
    assert facts["package"].startswith((folder / "profile").read_text())
    assert not facts["torch"]


def test_it_makes_the_sample_work(facts):
    assert facts["ran"] == ["FINISHED"], facts["status"]
    assert len(facts["joints"]) == 5
    assert "error" not in facts["joints"]


def test_it_writes_every_file(facts, folder):
    assert facts["finalized"] == ["FINISHED"], facts["said"]
    written = {path.name for path in (folder / "final").iterdir()}
    assert written >= {"report.json", "settings.json", "source.glb", "graph.json"}
    assert written >= {f"model.{form}" for form in ("glb", "urdf", "xml", "blend")}


def test_usd_is_written_where_openusd_is_in_the_zip_and_refused_in_a_line_elsewhere(facts, folder):
    has_usd = (folder / "built").read_text().endswith("-usd")
    assert facts["with usd"] == ["FINISHED" if has_usd else "CANCELLED"]
    assert has_usd or "need OpenUSD's Python package" in facts["of usd"]
    assert "\n" not in facts["of usd"]
