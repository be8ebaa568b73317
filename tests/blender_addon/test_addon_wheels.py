"""The wheels of the extension: made smaller without losing what the add-on imports, and what the zips hold."""

import ast
import csv
import hashlib
import io
import re
import subprocess
import sys
import tomllib
import zipfile
from base64 import urlsafe_b64encode
from collections.abc import Iterator
from fnmatch import fnmatch
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from blender_wheels import LEFT_OUT_OF, reduce_wheel, without_symbols  # noqa: E402
from build_blender_addon import LARGEST, PLATFORMS, own_platform, pack, stated  # noqa: E402

ENTRIES = ("grafu.pipeline.worker", "grafu.cli.finalize", "grafu.render.thumbnails")  # run in processes of their own
TAGS = {
    "linux-x64": r"manylinux.*_x86_64",
    "windows-x64": r"win_amd64",
    "macos-arm64": r"macosx_\d+_\d+_(arm64|universal2)",
    "macos-x64": r"macosx_\d+_\d+_(x86_64|universal2)",
}


def imports_in(path: Path) -> Iterator[str]:
    """Yields what a module imports anywhere, modules and names of modules alike."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def source_of(module: str) -> Path | None:
    place = ROOT / "src" / module.replace(".", "/")
    return next((path for path in (place.with_suffix(".py"), place / "__init__.py") if path.exists()), None)


def imported_by_the_addon() -> set[str]:
    """Returns all that the add-on and its processes import, of this package and of others, step by step."""
    addon = [name for path in (ROOT / "blender_addon").glob("*.py") for name in imports_in(path)]
    queue, found = [*ENTRIES, *addon], set()
    while queue:
        module = queue.pop()
        if module not in found:
            found.add(module)
            path = source_of(module)
            queue += imports_in(path) if path is not None else ()
    return found


def wheel_with(folder: Path, name: str, files: dict[str, bytes]) -> Path:
    """Writes a wheel of these files; its RECORD names them all."""
    made, record = folder / f"{name}-1.0-py3-none-any.whl", f"{name}-1.0.dist-info/RECORD"
    listed = "".join(f"{one},sha256=none,{len(content)}\n" for one, content in files.items())
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as packed:
        for one, content in {**files, record: f"{listed}{record},,\n".encode()}.items():
            packed.writestr(one, content)
    return made


def test_nothing_that_the_addon_imports_is_left_out():
    imported = imported_by_the_addon()
    files = {f"{name.replace('.', '/')}/__init__.py" for name in imported}
    patterns = [pattern for patterns in LEFT_OUT_OF.values() for pattern in patterns]
    assert {file for file in files if any(fnmatch(file, pattern) for pattern in patterns)} == set()
    assert {"grafu.joints.plan", "scipy.spatial", "onnxruntime"} <= imported


def test_a_smaller_wheel_lists_what_is_left(tmp_path):
    code = b"X = 1\n" * 500
    files = {"scipy/__init__.py": code, "scipy/stats/__init__.py": code, "scipy/spatial/tests/a.py": code}
    wheel = wheel_with(tmp_path, "scipy", {**files, "scipy/spatial/__init__.py": code})
    before = wheel.stat().st_size
    reduce_wheel(wheel)
    assert wheel.stat().st_size < before
    with zipfile.ZipFile(wheel) as packed:
        names = packed.namelist()
        rows = list(csv.reader(io.StringIO(packed.read("scipy-1.0.dist-info/RECORD").decode())))
        packed.extractall(tmp_path / "there")
    assert sorted(names) == ["scipy-1.0.dist-info/RECORD", "scipy/__init__.py", "scipy/spatial/__init__.py"]
    assert [row[0] for row in rows] == names
    digest = urlsafe_b64encode(hashlib.sha256(code).digest()).rstrip(b"=").decode()
    assert ["scipy/__init__.py", f"sha256={digest}", str(len(code))] in rows
    assert (tmp_path / "there" / "scipy" / "spatial" / "__init__.py").read_bytes() == code


def test_a_library_that_another_one_loads_is_not_left_out(tmp_path):
    files = {"onnxruntime/capi/libonnxruntime.so.1.2": b"c", "onnxruntime/capi/state.so": b"..libonnxruntime.so.1.."}
    wheel = wheel_with(tmp_path, "onnxruntime", files)
    with pytest.raises(ValueError, match=r"state\.so loads libonnxruntime\.so\.1\.2"):
        reduce_wheel(wheel)
    alone = wheel_with(tmp_path, "onnxruntime", {**files, "onnxruntime/capi/state.so": b"..libonnxruntime_other.so.."})
    reduce_wheel(alone)
    with zipfile.ZipFile(alone) as packed:
        assert "onnxruntime/capi/libonnxruntime.so.1.2" not in packed.namelist()


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has libraries of this form")
def test_a_library_without_its_symbols_still_works(tmp_path):
    spec = find_spec("fcl.fcl")
    library = Path(spec.origin)
    made = without_symbols(library.read_bytes())
    assert len(made) == library.stat().st_size
    assert made.count(0) > library.read_bytes().count(0)
    package = tmp_path / "fcl"
    package.mkdir()
    for path in library.parent.glob("*.py"):
        (package / path.name).write_bytes(path.read_bytes())
    (package / library.name).write_bytes(made)
    for beside in library.parent.parent.glob("python_fcl.libs"):
        (tmp_path / beside.name).symlink_to(beside)
    ask = "import fcl; print(fcl.__file__, fcl.Box(1, 2, 3).side[2])"
    done = subprocess.run([sys.executable, "-c", ask], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [str(package / "__init__.py"), "3.0"]


def test_what_is_no_library_stays_as_it_is():
    for data in (b"", b"MZ" + bytes(100), b"\x7fELF\x01\x01" + bytes(100)):
        assert without_symbols(data) == data


def test_the_manifest_names_wheels_and_platform(tmp_path):
    text = (ROOT / "blender_addon" / "blender_manifest.toml").read_text()
    manifest = tomllib.loads(stated(text, "1.2.3", ["a.whl", "b.whl"], ["windows-x64"]))
    assert manifest["version"] == "1.2.3"
    assert manifest["wheels"] == ["./wheels/a.whl", "./wheels/b.whl"]
    assert manifest["platforms"] == ["windows-x64"]
    (tmp_path / "addon").mkdir()
    (tmp_path / "addon" / "a.py").write_text("x")
    with zipfile.ZipFile(pack(tmp_path / "addon", tmp_path / "made.zip")) as packed:
        assert packed.namelist() == ["a.py"]


@pytest.mark.parametrize(
    ("system", "machine", "name"),
    [
        ("linux", "x86_64", "linux-x64"),
        ("win32", "AMD64", "windows-x64"),
        ("darwin", "arm64", "macos-arm64"),
        ("darwin", "x86_64", "macos-x64"),
    ],
)
def test_a_machine_builds_for_itself(system, machine, name):
    assert own_platform(system, machine) == name
    assert name in PLATFORMS


def built() -> list[Path]:
    return sorted((ROOT / "dist").glob("grafu-blender-*.zip"))


@pytest.mark.skipif(not built(), reason="no extension is built: `make blender`")
@pytest.mark.parametrize("path", built(), ids=lambda path: path.stem)
def test_a_zip_unpacks_to_what_its_manifest_names(path, tmp_path):
    with zipfile.ZipFile(path) as packed:
        packed.extractall(tmp_path)
    manifest = tomllib.loads((tmp_path / "blender_manifest.toml").read_text())
    (platform,) = manifest["platforms"]
    assert platform in path.stem
    there = {f"./wheels/{wheel.name}" for wheel in (tmp_path / "wheels").iterdir()}
    assert set(manifest["wheels"]) == there
    tags = [name.removesuffix(".whl").split("-")[-3:] for name in there]
    assert all(re.fullmatch(TAGS[platform], part) or part == "any" for tag in tags for part in tag[2].split("."))
    assert all(set(tag[0].split(".")) & {"cp311", "py3"} or tag[1] == "abi3" for tag in tags)
    names = {wheel.name.split("-")[0] for wheel in (tmp_path / "wheels").iterdir()}
    assert {"grafu", "scipy", "onnxruntime", "embreex", "manifold3d"} <= names
    assert ("usd_core" in names) == path.stem.endswith("-usd")
    assert ("psutil" in names) == (platform != "linux-x64")
    assert "numpy" not in names
    assert path.stat().st_size <= LARGEST or path.stem.endswith("-usd")
    for wheel in (tmp_path / "wheels").iterdir():
        with zipfile.ZipFile(wheel) as packed:
            record = next(name for name in packed.namelist() if name.endswith(".dist-info/RECORD"))
            listed = {row[0] for row in csv.reader(io.StringIO(packed.read(record).decode()))}
            assert set(packed.namelist()) <= listed | {record}, wheel.name
