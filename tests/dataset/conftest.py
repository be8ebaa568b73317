"""Small results, made once: a cabinet, its mirror image, a larger copy, and something else."""

import subprocess
import sys
from pathlib import Path
from shutil import copyfile

import numpy as np
import pytest

ROOT = Path(__file__).parent.parent.parent


@pytest.fixture(scope="session")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from small_assets import write_glb

    folder = tmp_path_factory.mktemp("made")
    write_glb(folder / "cabinet.glb")
    write_glb(folder / "mirrored.glb", np.diag([-1.0, 1.0, 1.0]))
    write_glb(folder / "larger.glb", 1.5 * np.eye(3))
    copyfile(ROOT / "samples" / "chest.glb", folder / "chest.glb")
    runs = [
        ["functionalize", str(path), "--motion", "rule", "--formats", "glb,urdf" if path.stem == "cabinet" else "glb"]
        for path in sorted(folder.glob("*.glb"))
    ]
    # In one process where shapes are not checked: it takes a quarter of the time
    more = ["--no-page", "--quiet", "--out", str(folder / "out")]
    code = f"from grafu.cli.main import main\nfor run in {runs!r}: assert main([*run, *{more!r}]) == 0"
    subprocess.run([sys.executable, "-c", code], check=True)
    return folder / "out"
