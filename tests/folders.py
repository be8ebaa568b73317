"""What lies in a folder, for tests that compare what was written."""

from pathlib import Path


def contents(folder: Path) -> dict[str, bytes]:
    """Returns every file's bytes by its path within the folder."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
