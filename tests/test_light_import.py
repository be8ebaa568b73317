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


def test_what_is_imported_counts_as_old_and_what_a_program_has_frozen_stays_so() -> None:
    program = (
        "import gc, grafu\n"
        "{before}\n"
        "grafu.functionalize\n"
        "import grafu.asset.part as part\n"
        "old = any(one is part.__dict__ for one in gc.get_objects(generation=2))\n"
        "print(old, gc.get_count()[0] < 10_000, gc.get_freeze_count() > 0)"
    )

    assert printed(program.format(before="")) == "True True False"
    assert printed(program.format(before="gc.freeze()")).split()[2] == "True"


THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_THREAD_TIMEOUT")
SHOWN = f"print([os.environ.get(name) for name in {THREADS}])"


@pytest.mark.parametrize("stated", [{}, {"OPENBLAS_THREAD_TIMEOUT": "4"}])
def test_an_import_leaves_the_environment_as_it_was(stated: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> None:
    for name in THREADS:
        monkeypatch.delenv(name, raising=False)
    for name, value in stated.items():
        monkeypatch.setenv(name, value)

    found = printed(f"import os, grafu; grafu.functionalize; {SHOWN}")

    assert found == str([None, None, stated.get("OPENBLAS_THREAD_TIMEOUT")])


@pytest.mark.skipif(sys.platform != "linux", reason="threads are counted in /proc")
def test_a_program_has_the_threads_that_numpy_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in THREADS:
        monkeypatch.delenv(name, raising=False)
    count = "; import os; print(len(os.listdir('/proc/self/task')))"

    assert printed(f"import grafu; grafu.functionalize{count}") == printed(f"import numpy{count}")


VERB = "['completion', 'bash']"


@pytest.mark.parametrize(
    ("stated", "given", "expected"),
    [
        ({}, "None", ["1", None, None]),
        ({"OMP_NUM_THREADS": "3"}, "None", [None, "3", None]),
        ({"OPENBLAS_NUM_THREADS": "2"}, "None", ["2", None, None]),
        ({}, VERB, [None, None, None]),
    ],
)
def test_the_command_computes_with_one_thread_unless_told_otherwise(
    stated: dict[str, str], given: str, expected: list[str | None], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in THREADS:
        monkeypatch.delenv(name, raising=False)
    for name, value in stated.items():
        monkeypatch.setenv(name, value)

    found = printed(f"import os, sys; sys.argv[1:] = {VERB}; from grafu.cli.main import main; main({given}); {SHOWN}")

    assert found.splitlines()[-1] == str(expected)


def test_the_command_ends_without_a_search_and_calls_what_is_to_be_called_at_its_end() -> None:
    ends = "atexit.register(lambda: print('at its end', gc.get_freeze_count() > 0))"
    program = f"import atexit, gc, sys; sys.argv[1:] = {VERB}; from grafu.cli.main import main; {ends}; "

    assert printed(program + "main(None)").splitlines()[-1] == "at its end True"
    assert printed(program + f"main({VERB})").splitlines()[-1] == "at its end False"
