"""Builds the Blender extension: one zip with the add-on, this package and the wheels of its dependencies.

    python scripts/build_blender_addon.py [--platform linux-x64 windows-x64 macos-arm64 macos-x64] [--usd] [--out dist]

One zip for each platform; without --platform, for the machine that builds. Wheels are fetched with pip, for Blender's
Python (3.11 in 4.2 to 5.0), made smaller, and are not kept. numpy is Blender's own: the others are chosen to go with
the oldest, that of 4.2, and go with the later ones too. --usd adds OpenUSD, without which USD is not written.
"""

import argparse
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path

from blender_wheels import reduce_wheel

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "blender_addon"
LEFT_OUT = (
    "numpy",  # every Blender brings it
    "cython",  # python-fcl names it, and needs it only where it is compiled
    *("rich", "pygments", "markdown_it_py", "mdurl", "shtab"),  # the command's tables; the add-on calls no command
    *(
        "sympy",
        "mpmath",
        "coloredlogs",
        "humanfriendly",
    ),  # ONNX Runtime names them, and needs them to make networks ...
    *("protobuf", "flatbuffers"),  # ... or reads them in Python
)
OLDEST = ("numpy==1.24.3", "scipy<1.16", "shapely<2.1")
"""numpy of Blender 4.2 and 4.3 (4.4 to 5.0 have 1.26.4), and the last of those that go with it: pip need not search."""
ELSEWHERE = ("psutil>=5.9",)
"""Wheels for systems other than Linux: pip asks the machine that builds, not the one that it builds for."""
PLATFORMS = {
    "linux-x64": tuple(f"manylinux{name}_x86_64" for name in ("_2_28", "_2_27", "_2_24", "2014", "_2_17")),
    "windows-x64": ("win_amd64",),
    "macos-arm64": ("macosx_13_0_arm64",),
    "macos-x64": ("macosx_13_0_x86_64",),
}
"""By Blender's name of a platform, pip's: Linux with glibc 2.28 or later, as Blender itself, macOS 13 or later."""
LARGEST = 60e6  # bytes of a zip without OpenUSD


def main() -> int:
    """Builds the zips, prints where they are, and returns the exit code."""
    options = _options()
    out = Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    too_large = False
    for name in dict.fromkeys(options.platform):
        made, count = build(name, options.python, options.usd, out)
        size = made.stat().st_size
        print(f"{made}: {count} wheels, {size / 1e6:.1f} MB", flush=True)
        if size > LARGEST and not options.usd:
            too_large = True
            print(f"{made.name} must be at most {LARGEST / 1e6:.0f} MB: leave more out of its wheels", file=sys.stderr)
    return int(too_large)


def build(name: str, python: str, usd: bool, out: Path) -> tuple[Path, int]:
    """Builds the zip for one platform; returns its path and how many wheels it holds."""
    with tempfile.TemporaryDirectory() as folder:
        addon = Path(folder) / "grafu"
        shutil.copytree(SOURCE, addon, ignore=shutil.ignore_patterns("__pycache__"))
        wheels = _wheels(addon / "wheels", python, name, usd)
        version = next(w for w in wheels if w.startswith("grafu-")).split("-")[1]
        manifest = addon / "blender_manifest.toml"
        manifest.write_text(stated(manifest.read_text(), version, wheels, [name]))
        made = pack(addon, out / f"grafu-blender-{version}-{name}{'-usd' * usd}.zip")
    return made, len(wheels)


def pack(folder: Path, made: Path) -> Path:
    """Writes a folder to a zip and returns its path. Wheels are packed already: they are stored."""
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in sorted(folder.rglob("*")):
            kind = zipfile.ZIP_STORED if path.suffix == ".whl" else zipfile.ZIP_DEFLATED
            packed.write(path, path.relative_to(folder), kind)
    return made


def stated(manifest: str, version: str, wheels: Sequence[str], platforms: Sequence[str]) -> str:
    """Returns the manifest with version, wheels and platforms."""
    lines = "".join(f'  "./wheels/{wheel}",\n' for wheel in wheels)
    text = re.sub(r"^version = .*$", f'version = "{version}"', manifest, flags=re.MULTILINE)
    named = ", ".join(f'"{platform}"' for platform in platforms)
    return re.sub(r"^wheels = .*$", f"wheels = [\n{lines}]\nplatforms = [{named}]", text, flags=re.MULTILINE)


def own_platform(system: str = sys.platform, machine: str = "") -> str:
    """Returns Blender's name of the platform of this machine."""
    kind = {"win32": "windows", "darwin": "macos"}.get(system, "linux")
    return f"{kind}-arm64" if (machine or platform.machine()).lower() in ("arm64", "aarch64") else f"{kind}-x64"


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--python", default="3.11", help="Blender's Python (default: 3.11)")
    parser.add_argument(
        "--platform", nargs="+", choices=PLATFORMS, default=[own_platform()], help="what Blender runs on; several"
    )
    parser.add_argument("--usd", action="store_true", help="add OpenUSD, to write USD: about 28 MB more")
    parser.add_argument("--out", default=str(ROOT / "dist"), help="where the zips go (default: dist)")
    options = parser.parse_args()
    if unknown := set(options.platform) - PLATFORMS.keys():
        parser.error(f"there are no wheels for {', '.join(unknown)}: --platform takes {', '.join(PLATFORMS)}")
    return options


def _wheels(folder: Path, python: str, name: str, usd: bool) -> list[str]:
    """Fetches all wheels into a folder, made smaller, and returns their names, without what is left out."""
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    subprocess.run([*pip, "wheel", "--quiet", "--no-deps", "--wheel-dir", str(folder), str(ROOT)], check=True)
    (own,) = folder.glob("grafu-*.whl")
    wanted = ["--only-binary", ":all:", "--python-version", python, "--implementation", "cp"]
    wanted += [word for tag in PLATFORMS[name] for word in ("--platform", tag)]
    needed = [f"{own}[usd]" if usd else str(own), *OLDEST, *(() if name.startswith("linux") else ELSEWHERE)]
    subprocess.run([*pip, "download", "--quiet", *wanted, "--dest", str(folder), *needed], check=True)
    for wheel in folder.glob("*.whl"):
        if wheel.name.lower().split("-")[0] in LEFT_OUT:
            wheel.unlink()
        else:
            reduce_wheel(wheel)
    return sorted(wheel.name for wheel in folder.glob("*.whl"))


if __name__ == "__main__":
    sys.exit(main())
