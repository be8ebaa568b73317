"""The addresses of the project and its description on PyPI: README.md, with links that work there.

hatchling runs this when it builds the package. The repository is the remote `origin` of the clone that is built: links
are made absolute with its address. Where there is none on the web, pictures are left out and links become their text.
"""

import re
import subprocess
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

_LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!https?://|#)([^)]+)\)")
_REMOTE = re.compile(r"(?:https://|ssh://)?(?:[^@/]+@)?([\w-]+(?:\.[\w-]+)+)(?::\d+)?[:/]([\w./~-]+?)(?:\.git)?/?")
_PAPER = "https://mingrui-zhao.github.io/Functionalization/"


def repository_at(remote: str) -> str:
    """Returns the address on the web of a Git remote, by HTTPS or SSH; "" for a folder."""
    found = _REMOTE.fullmatch(remote.strip())
    return f"https://{found[1]}/{found[2]}" if found and not remote.startswith((".", "/")) else ""


def addresses(repository: str) -> dict[str, str]:
    """Returns the addresses that PyPI lists; of the repository only where it is known."""
    if not repository:
        return {"Paper": _PAPER}
    pages = {"Documentation": "blob/HEAD/docs/index.md", "Changelog": "blob/HEAD/CHANGELOG.md", "Issues": "issues"}
    return {"Repository": repository, **{name: f"{repository}/{path}" for name, path in pages.items()}, "Paper": _PAPER}


def for_pypi(readme: str, repository: str) -> str:
    """Returns the text with no relative link; `repository` is an address like https://example.org/owner/name."""

    def changed(link: re.Match[str]) -> str:
        mark, text, path = link.groups()
        if not repository:
            return "" if mark else text
        return f"{mark}[{text}]({repository.rstrip('/')}/{'raw' if mark else 'blob'}/HEAD/{path})"

    return re.sub(r"\n{3,}", "\n\n", _LINK.sub(changed, readme))


def _origin(root: Path) -> str:
    """Returns the remote `origin` of a clone; "" where there is no clone or no Git."""
    if not (root / ".git").exists():
        return ""
    command = ["git", "-C", str(root), "config", "--get", "remote.origin.url"]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
    except OSError:
        return ""


class ReadmeHook(MetadataHookInterface):
    """Gives hatchling the description and the addresses."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Adds `readme` and `urls` to the metadata of the project."""
        text = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        repository = repository_at(_origin(Path(self.root)))
        metadata["readme"] = {"content-type": "text/markdown", "text": for_pypi(text, repository)}
        metadata["urls"] = addresses(repository)
