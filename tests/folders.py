"""What lies in a folder, for tests that compare what was written."""

from pathlib import Path


def contents(folder: Path) -> dict[str, bytes]:
    """Returns every file's bytes by its path within the folder, but for the marker by which grafu knows its folders."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != ".grafu.json"
    }
