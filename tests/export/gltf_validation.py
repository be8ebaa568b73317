"""Runs the official glTF validator over GLB bytes; it comes by `npm install --no-package-lock` in the repository."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

_ROOT = Path(__file__).parents[2]
_SCRIPT = """
const fs = require("fs"), validator = require(process.argv[1]);
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then(r => console.log(JSON.stringify(r)));
"""


def issues_of(data: bytes, folder: Path) -> dict:
    """Returns the validator's `issues`: numErrors, numWarnings, messages."""
    package = Path(os.environ.get("GRAFU_GLTF_VALIDATOR", _ROOT / "node_modules" / "gltf-validator"))
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed")
    if not package.exists():
        missing = "the glTF validator is missing: run `npm install --no-package-lock`, or set GRAFU_GLTF_VALIDATOR"
        assert not os.environ.get("CI"), missing  # the build server must not skip what it is there for
        pytest.skip(missing)
    path = folder / "model.glb"
    path.write_bytes(data)
    done = subprocess.run([node, "-e", _SCRIPT, str(package), str(path)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)["issues"]
