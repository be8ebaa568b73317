"""The command starts without jaxtyping; programs that call it keep what they have."""

import gc
import os
import subprocess
import sys
from pathlib import Path

import pytest

from grafu.cli.light_start import without_collecting

SAMPLE = Path(__file__).parents[2] / "samples" / "dresser.glb"
NOT_NEEDED = {"jaxtyping", "jaxtyping._import_hook", "unittest.mock", "asyncio", "ssl"}


def test_the_command_imports_no_checks_of_shapes(tmp_path: Path) -> None:
    arguments = ["functionalize", str(SAMPLE), "--formats", "glb", "--no-page", "--out", str(tmp_path)]
    run = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "grafu", *arguments],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    imported = {line.rpartition("|")[2].strip() for line in run.stderr.splitlines() if line.startswith("import time:")}

    assert {"grafu.pipeline.functionalize", "grafu.geometry.arrays"} <= imported
    assert imported & NOT_NEEDED == set()


def test_a_program_that_calls_the_command_keeps_jaxtyping() -> None:
    program = (
        "import sys\nfrom grafu.cli.main import main\n"
        "try:\n    main(['--version'])\nexcept SystemExit:\n    pass\n"
        "import jaxtyping\nassert jaxtyping.__file__, jaxtyping\n"
        "import grafu.geometry.arrays as arrays\nassert 'jaxtyping' in type(arrays.Vec3).__module__, arrays.Vec3\n"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)

    assert (run.returncode, run.stderr) == (0, "")


@pytest.mark.parametrize("kind", ["Float", "Bool", "Int64", "Shaped", "UInt8"])
def test_a_shape_without_its_checks_is_the_class_of_the_array(kind: str) -> None:
    program = (
        "from grafu.cli.light_start import without_shape_checks\nwithout_shape_checks()\n"
        f"from jaxtyping import {kind}\nimport numpy as np\nassert {kind}[np.ndarray, 'n 3'] is np.ndarray\n"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)

    assert (run.returncode, run.stderr) == (0, "")


@pytest.mark.parametrize("is_on", [True, False])
def test_garbage_is_looked_for_again_after_an_import_that_failed(is_on: bool) -> None:
    was_on = gc.isenabled()
    try:
        (gc.enable if is_on else gc.disable)()
        with pytest.raises(ImportError, match="did not"), without_collecting():
            raise ImportError("searched for garbage" if gc.isenabled() else "did not")
        assert gc.isenabled() is is_on
    finally:
        (gc.enable if was_on else gc.disable)()
