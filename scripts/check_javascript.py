"""Checks the types of the pages' scripts, as JSDoc states them, with the compiler of TypeScript (`npm install`).

python scripts/check_javascript.py    exit 1 where a type is wrong; exit 0 with a line where there is no compiler
"""

import subprocess
import sys
from pathlib import Path

from grafu.editor.scripts import EDITING, WALL
from grafu.viewer.model_page import COLLECTING_SCRIPT, PAGE_SCRIPTS, VIEW_SCRIPTS
from grafu.viewer.run_page import RUN_SCRIPTS

ROOT = Path(__file__).parent.parent
COMPILER = ROOT / "node_modules" / ".bin" / "tsc"
OPTIONS = (
    "--allowJs", "--checkJs", "--noEmit", "--target", "es2022", "--lib", "es2022,dom,dom.iterable",
    "--strict", "false", "--strictNullChecks", "true", "--moduleDetection", "legacy",
)  # fmt: skip
_VIEWER, _EDITOR = (ROOT / "src" / "grafu" / layer / "templates" for layer in ("viewer", "editor"))


def programs() -> dict[str, list[Path]]:
    """Returns by page its scripts: those of one page share one scope, so that they are checked together."""
    return {
        "a model that is edited": [*(_VIEWER / one for one in VIEW_SCRIPTS), *(_EDITOR / one for one in EDITING)],
        "the wall": [_VIEWER / "dom.js", *(_EDITOR / one for one in WALL)],
        "a model": [_VIEWER / one for one in (*PAGE_SCRIPTS, COLLECTING_SCRIPT)],
        "a run": [_VIEWER / one for one in RUN_SCRIPTS],
    }


def main() -> int:
    """Checks one page after another; returns the exit code."""
    if not COMPILER.is_file():
        print("the types of the pages' scripts are not checked: there is no compiler; run npm install")
        return 0
    failed = [page for page, scripts in programs().items() if subprocess.run([COMPILER, *OPTIONS, *scripts]).returncode]
    print(f"wrong types in the scripts of {', '.join(failed)}" if failed else "types of the pages' scripts: right")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
