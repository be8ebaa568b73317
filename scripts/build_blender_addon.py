"""Builds the Blender extension: one zip with the add-on, this package and the wheels of its dependencies.

    python scripts/build_blender_addon.py [--python 3.11] [--platform PLATFORM ...] [--out dist]

Wheels are fetched with pip, for Blender's Python (3.11 in 4.2 to 5.0), and are not kept. numpy is Blender's own: the
others are chosen to go with the oldest, that of 4.2, and go with the later ones too. Without --platform the wheels are
for the machine that builds.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "blender_addon"
LEFT_OUT = (
    "numpy",  # every Blender brings it
    "cython",  # python-fcl names it, and needs it only where it is compiled
    *("rich", "pygments", "markdown_it_py", "mdurl", "shtab"),  # the command's tables; the add-on calls no command
)
OLDEST = ("numpy==1.24.3", "scipy<1.16", "shapely<2.1")
"""numpy of Blender 4.2 and 4.3 (4.4 to 5.0 have 1.26.4), and the last of those that go with it: pip need not search."""
_PLATFORMS = {"linux": "linux-x64", "manylinux": "linux-x64", "win": "windows-x64", "macosx": "macos-arm64"}


def main() -> None:
    """Builds the zip and prints where it is."""
    options = _options()
    out = Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        addon = Path(folder) / "grafu"
        shutil.copytree(SOURCE, addon, ignore=shutil.ignore_patterns("__pycache__"))
        wheels = _wheels(addon / "wheels", options.python, options.platform)
        version = next(w for w in wheels if w.startswith("grafu-")).split("-")[1]
        manifest = addon / "blender_manifest.toml"
        manifest.write_text(stated(manifest.read_text(), version, wheels, _platforms(options.platform)))
        name = f"grafu-blender-{version}-{_platforms(options.platform)[0]}"
        made = pack(addon, out / f"{name}.zip")
    print(f"{made}: {len(wheels)} wheels, {made.stat().st_size / 2**20:.0f} MB")


def pack(folder: Path, made: Path) -> Path:
    """Writes a folder to a zip and returns its path. Wheels are packed already: they are stored."""
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in sorted(folder.rglob("*")):
            kind = zipfile.ZIP_STORED if path.suffix == ".whl" else zipfile.ZIP_DEFLATED
            packed.write(path, path.relative_to(folder), kind)
    return made


def stated(manifest: str, version: str, wheels: list[str], platforms: list[str]) -> str:
    """Returns the manifest with version, wheels and platforms."""
    lines = "".join(f'  "./wheels/{wheel}",\n' for wheel in wheels)
    text = re.sub(r"^version = .*$", f'version = "{version}"', manifest, flags=re.MULTILINE)
    named = ", ".join(f'"{platform}"' for platform in platforms)
    return re.sub(r"^wheels = .*$", f"wheels = [\n{lines}]\nplatforms = [{named}]", text, flags=re.MULTILINE)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--python", default="3.11", help="Blender's Python (default: 3.11)")
    parser.add_argument(
        "--platform", nargs="*", default=[], help="pip's names of one platform, say manylinux_2_28_x86_64"
    )
    parser.add_argument("--out", default=str(ROOT / "dist"), help="where the zip goes (default: dist)")
    return parser.parse_args()


def _platforms(platforms: list[str]) -> list[str]:
    """Returns Blender's name of the platform that the wheels are for."""
    first = platforms[0] if platforms else sys.platform.replace("darwin", "macosx")
    return [next(name for start, name in _PLATFORMS.items() if first.startswith(start))]


def _wheels(folder: Path, python: str, platforms: list[str]) -> list[str]:
    """Fetches all wheels into a folder and returns their names, without what is left out."""
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    subprocess.run([*pip, "wheel", "--quiet", "--no-deps", "--wheel-dir", str(folder), str(ROOT)], check=True)
    (own,) = folder.glob("grafu-*.whl")
    wanted = ["--only-binary", ":all:", "--python-version", python, "--implementation", "cp"]
    wanted += [word for platform in platforms for word in ("--platform", platform)]
    subprocess.run([*pip, "download", "--quiet", *wanted, "--dest", str(folder), f"{own}[usd]", *OLDEST], check=True)
    for wheel in folder.glob("*.whl"):
        if wheel.name.lower().split("-")[0] in LEFT_OUT:
            wheel.unlink()
    return sorted(wheel.name for wheel in folder.glob("*.whl"))


if __name__ == "__main__":
    main()
