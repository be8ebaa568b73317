"""Every example runs, from the root of a checkout, and is listed in the table of examples."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
WITH_MUJOCO = [path for path in EXAMPLES if "import mujoco" in path.read_text()]
TWO = ("chest.glb", "sideboard.glb")  # for an example that takes all there are
OTHERS = [path for path in EXAMPLES if path not in WITH_MUJOCO]

# In one process the package is imported once; each example has a folder and a namespace of its own
RUN = """
import contextlib, os, runpy, sys
for path in sys.argv[1:]:
    os.chdir(os.path.join(START, os.path.splitext(os.path.basename(path))[0]))
    with open("output.txt", "w") as said, contextlib.redirect_stdout(said):
        runpy.run_path(path, run_name="__main__")
"""


def test_the_table_lists_each_example_once() -> None:
    page = (ROOT / "examples" / "README.md").read_text()
    assert [path.name for path in EXAMPLES if page.count(f"({path.name})") != 1] == []
    assert len(EXAMPLES) == 6


@pytest.mark.parametrize("paths", [OTHERS, WITH_MUJOCO], ids=["package alone", "with MuJoCo"])
def test_examples_run_as_they_stand(paths: list[Path], tmp_path: Path) -> None:
    assert paths
    if paths == WITH_MUJOCO:
        pytest.importorskip("mujoco")
    for path in paths:
        samples = tmp_path / path.stem / "samples"
        samples.mkdir(parents=True)
        for name in re.findall(r"samples/(\w+\.glb)", path.read_text()) or TWO:
            (samples / name).symlink_to(ROOT / "samples" / name)
    environment = {**os.environ, "PYTHONWARNINGS": "error"}
    command = [sys.executable, "-c", f"START = {str(tmp_path)!r}\n{RUN}", *map(str, paths)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for path in paths:
        assert (tmp_path / path.stem / "output.txt").read_text().strip(), path.name
        assert (tmp_path / path.stem / "results").exists() is (".save(" in path.read_text()), path.name
