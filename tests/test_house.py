"""What the house promises: names, sizes, docs, a light and fast start, nothing of one machine in the files."""

import ast
import os
import re
import subprocess
import sys
import tomllib
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

import grafu
from grafu.version import __version__

ROOT = Path(__file__).parent.parent
SOURCES = sorted((ROOT / "src").rglob("*.py"))
LEARNING = ("network", "training")  # the folders that the product does without
# What extras bring: COLLADA, Draco, MJCF, the .blend export in a process of its own, USD, the editor, Parquet,
# baselines that ask a language model, storage at URLs, clusters.
OPTIONAL = {"collada", "DracoPy", "mujoco", "bpy", "pxr", "zstandard", "starlette", "uvicorn", "openai", "pyarrow"}
OPTIONAL |= {"fsspec", "ray"}
SAYS_NOTHING = re.compile(r"(^|_)(utils?|helpers?|misc|common)$")
# Spelled in pieces, so that this file does not hold what it forbids.
ONE_MACHINE = re.compile(r"(?<![\w.])/(" + "|".join(["wo" + "rk", "t" + "mp", "ho" + "me", "ro" + "ot"]) + r")/\w")


def tracked_texts() -> list[tuple[str, str]]:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False)
    if listed.returncode:
        pytest.skip("not a git checkout")
    names = [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]
    contents = [(name, (ROOT / name).read_bytes()) for name in names]
    return [(name, data.decode()) for name, data in contents if b"\0" not in data]


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text())


def python(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


def test_the_tree_of_the_readme_names_each_folder_in_the_order_of_its_layer() -> None:
    shown = re.findall(r"^ {6}(\w+)(?:/|\.py) +\S", (ROOT / "README.md").read_text(), re.MULTILINE)
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
    (layers,) = [contract["layers"] for contract in contracts if contract.get("containers") == ["grafu"]]
    layer = {name: k for k, names in enumerate(layers) for name in names.split(" | ")}

    assert sorted(shown) == sorted(layer)
    assert [layer[name] for name in shown] == sorted(layer.values())


def test_no_module_has_a_name_that_says_nothing() -> None:
    assert [p for p in SOURCES if SAYS_NOTHING.search(p.stem) or SAYS_NOTHING.search(p.parent.name)] == []


def test_files_stay_under_300_lines() -> None:
    files = [*SOURCES, *(ROOT / "scripts").rglob("*.py"), *(ROOT / "blender_addon").rglob("*.py")]
    lengths = {str(p.relative_to(ROOT)): len(p.read_text().splitlines()) for p in files}
    assert {name: lines for name, lines in lengths.items() if lines > 300} == {}


def test_values_and_shapes_are_those_that_are_quick_to_import() -> None:
    late = {("dataclasses", "dataclass"), *(("jaxtyping", name) for name in ("Bool", "Float", "Int", "Integer"))}
    own = ROOT / "src" / "grafu"
    found = [
        (path.name, node.module)
        for path in SOURCES
        if path not in (own / "dataclass.py", own / "shapes.py")
        for node in ast.walk(tree(path))
        if isinstance(node, ast.ImportFrom)
        if not late.isdisjoint((node.module, name.name) for name in node.names)
    ]
    assert found == []


def test_every_module_says_what_it_does() -> None:
    assert [p for p in SOURCES if not ast.get_docstring(tree(p))] == []


def test_slow_tests_start_first(request: pytest.FixtureRequest) -> None:
    slow = [item.get_closest_marker("slow") is not None for item in request.session.items]
    assert slow == sorted(slow, reverse=True)


def functions() -> list[tuple[Path, ast.FunctionDef]]:
    nodes = ((p, node) for p in SOURCES for node in ast.walk(tree(p)))
    return [(p, node) for p, node in nodes if isinstance(node, ast.FunctionDef)]


def test_functions_stay_short() -> None:
    def code_lines(node: ast.FunctionDef) -> int:
        doc = node.body[0] if ast.get_docstring(node) else None
        return (node.end_lineno or 0) - node.lineno + 1 - ((doc.end_lineno or 0) - doc.lineno + 1 if doc else 0)

    lengths = sorted(code_lines(node) for _, node in functions())
    assert lengths[-1] <= 60
    assert lengths[len(lengths) // 2] <= 10


def test_readme_names_only_targets_that_exist() -> None:
    targets = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    named = set(re.findall(r"\bmake ([a-z]+)", (ROOT / "README.md").read_text()))
    assert {"demo", "test"} <= named <= targets


def test_readme_links_lead_somewhere() -> None:
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").glob("*.md")]
    links = [(page, link) for page in pages for link in re.findall(r"\]\(([^)#:]+)\)", page.read_text())]
    assert [(page.name, link) for page, link in links if not (page.parent / link).exists()] == []


def test_the_index_links_every_page_once() -> None:
    linked = sorted(re.findall(r"\]\(([a-z]+\.md)\)", (ROOT / "docs" / "index.md").read_text()))
    assert linked == sorted(p.name for p in (ROOT / "docs").glob("*.md") if p.name != "index.md")


def test_the_changelog_knows_this_version() -> None:
    assert f"## [{__version__}]" in (ROOT / "CHANGELOG.md").read_text()
    assert grafu.__version__ == __version__


def test_ci_runs_what_the_readme_says() -> None:
    script = (ROOT / ".ci" / "run").read_text()
    assert all(f"make {target}" in script for target in ("demo", "check", "test"))


def test_no_file_names_a_place_on_one_machine() -> None:
    found = [(name, line) for name, text in tracked_texts() for line in text.splitlines() if ONE_MACHINE.search(line)]
    assert found == []


def imported_packages(*, to_train: bool) -> set[str]:
    """Returns what is imported to train, or by all else."""
    trees = [tree(p) for p in SOURCES if (p.relative_to(ROOT).parts[2] in LEARNING) == to_train]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module and not node.level}
    return {name.split(".")[0] for name in names} - set(sys.stdlib_module_names) - {"grafu"}


def test_the_base_install_is_what_is_imported() -> None:
    stated = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
    modules = {"python-fcl": "fcl", "pillow": "PIL", "mapbox-earcut": "mapbox_earcut"}
    names = {re.split(r"[<>=]", line)[0] for line in stated}

    assert {modules.get(name, name) for name in names} == imported_packages(to_train=False) - OPTIONAL
    assert not names & {"torch", "bpy", "usd-core"}


def test_what_training_imports_is_stated_too() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    stated = [*project["dependencies"], *project["optional-dependencies"]["train"]]
    assert imported_packages(to_train=True) <= {re.split(r"[<>=]", line)[0] for line in stated}


def test_the_pipeline_imports_neither_torch_nor_blender() -> None:
    code = "import sys, grafu.pipeline.functionalize; print(sorted({'torch', 'bpy'} & set(sys.modules)))"
    assert python(code).strip() == "[]"


def test_help_loads_nothing_heavy() -> None:
    code = (
        "import sys\nfrom grafu.cli.main import build_parser\nbuild_parser().format_help()\n"
        "print(sorted({'numpy', 'trimesh', 'scipy', 'pydantic', 'rich'} & set(sys.modules)))"
    )
    assert python(code).strip() == "[]"


def test_help_answers_at_once() -> None:
    command = [sys.executable, "-m", "grafu.cli.main", "--help"]

    def seconds() -> float:  # of the processor: other work on the machine does not count
        before = os.times()
        subprocess.run(command, check=True, capture_output=True)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system

    assert min(seconds() for _ in range(4)) <= 0.5


HEAVY = {"trimesh", "scipy", "networkx", "torch", "collada", "mujoco", "matplotlib"}
READERS_OF_OTHERS = {f"grafu.asset.{name}" for name in (
    "blend", "collada", "fbx", "foreign", "hssd", "mjcf", "partnet_mobility", "sdf", "threeds", "threemf", "urdf", "usd"
)}  # fmt: skip
NOT_ASKED_FOR = {"grafu.pipeline.foreign", "grafu.render", "grafu.templates.user", "grafu.viewer.run_page"}
NOT_ASKED_FOR |= {"lxml", "rich.progress"} | {f"grafu.cli.{verb}" for verb in ("ablate", "doctor", "evaluate", "synth")}


def imported_by_a_run(out: Path, *options: str) -> set[str]:
    sample = str(ROOT / "samples" / "kitchen_base.glb")
    arguments = ["functionalize", sample, "--out", str(out), *options]
    code = f"import sys\nfrom grafu.cli.main import main\nmain({arguments!r})\nprint(*sys.modules)"
    return set(python(code).splitlines()[-1].split())


def test_a_plain_run_imports_nothing_heavy_that_it_does_without(tmp_path: Path) -> None:
    imported = imported_by_a_run(tmp_path, "--formats", "glb", "--no-page")
    assert {"grafu.asset.gltf", "grafu.export.glb"} <= imported
    assert imported & (HEAVY | READERS_OF_OTHERS | NOT_ASKED_FOR) == set()


def test_a_page_and_a_urdf_need_hulls_but_no_trimesh(tmp_path: Path) -> None:
    imported = imported_by_a_run(tmp_path, "--formats", "glb,urdf")
    assert imported & ((HEAVY - {"scipy"}) | READERS_OF_OTHERS) == set()


def test_no_two_tests_or_tools_of_tests_share_a_name() -> None:
    # pytest imports them by their base names
    names = Counter(p.name for p in (ROOT / "tests").rglob("*.py") if p.name not in ("__init__.py", "conftest.py"))
    assert [name for name, count in names.items() if count > 1] == []


def test_each_name_of_a_public_class_stands_for_one_class() -> None:
    named: dict[str, list[str]] = {}
    for path in SOURCES:
        for node in ast.walk(tree(path)):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                named.setdefault(node.name, []).append(path.relative_to(ROOT).as_posix())
    assert {name: places for name, places in named.items() if len(places) > 1} == {}
