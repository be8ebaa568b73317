"""The description of the package on PyPI: README.md, with links that work there.

hatchling runs this when it builds the package. Links are made absolute with the address `Repository` in
`[project.urls]`; while none is stated, pictures are left out and links become their text.
"""

import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

_LINK = re.compile(r"(!?)\[([^\]]*)\]\((?!https?://|#)([^)]+)\)")


def for_pypi(readme: str, repository: str) -> str:
    """Returns the text with no relative link; `repository` is an address like https://example.org/owner/name."""

    def changed(link: re.Match[str]) -> str:
        mark, text, path = link.groups()
        if not repository:
            return "" if mark else text
        return f"{mark}[{text}]({repository.rstrip('/')}/{'raw' if mark else 'blob'}/HEAD/{path})"

    return re.sub(r"\n{3,}", "\n\n", _LINK.sub(changed, readme))


class ReadmeHook(MetadataHookInterface):
    """Gives hatchling the description."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Adds `readme` to the metadata of the project."""
        text = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        repository = metadata.get("urls", {}).get("Repository", "")
        metadata["readme"] = {"content-type": "text/markdown", "text": for_pypi(text, repository)}
