"""What an import of the package, and the command as it starts, leave out; and what comes back where it is asked for."""

import gc
import os
import subprocess
import sys
from pathlib import Path

import pytest

from grafu.collecting import without_collecting

SAMPLE = Path(__file__).parents[1] / "samples" / "dresser.glb"
CHECKS_OF_SHAPES = {"jaxtyping", "jaxtyping._import_hook", "unittest.mock", "asyncio", "ssl"}
SCHEMAS = {"pydantic", "pydantic_core"}


def imported(*arguments: str) -> set[str]:
    """Returns the modules that Python imports with these arguments."""
    run = subprocess.run(
        [sys.executable, "-X", "importtime", *arguments],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    return {line.rpartition("|")[2].strip() for line in run.stderr.splitlines() if line.startswith("import time:")}


def printed(program: str) -> str:
    """Returns what a program prints, which must end well and without a word on stderr."""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    return run.stdout.strip()


def test_the_command_imports_no_checks_of_shapes(tmp_path: Path) -> None:
    found = imported(
        "-m", "grafu", *("functionalize", str(SAMPLE), "--formats", "glb", "--no-page"), "--out", str(tmp_path)
    )

    assert {"grafu.pipeline.functionalize", "grafu.geometry.arrays"} <= found
    assert found & CHECKS_OF_SHAPES == set()


def test_the_package_is_imported_without_checks_of_shapes_and_without_schemas() -> None:
    found = imported("-c", "import grafu; grafu.functionalize")

    assert {"grafu.pipeline.functionalize", "grafu.geometry.arrays"} <= found
    assert found & (CHECKS_OF_SHAPES | SCHEMAS) == set()


def test_a_program_that_has_imported_jaxtyping_has_its_shapes() -> None:
    program = "import jaxtyping, grafu.geometry.arrays as arrays; print(type(arrays.Vec3).__module__.split('.')[0])"

    assert printed(program) == "jaxtyping"


def test_elsewhere_a_shape_is_the_class_of_its_array() -> None:
    program = (
        "import numpy as np, grafu.shapes as shapes\n"
        "print({getattr(shapes, name)[np.ndarray, 'n 3'] is np.ndarray for name in dir(shapes) if name[0] in 'BFIU'})"
    )

    assert printed(program) == "{True}"


def test_jaxtyping_can_be_imported_after_the_package() -> None:
    assert printed("import grafu; grafu.functionalize; import jaxtyping; print(bool(jaxtyping.__file__))") == "True"


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
