"""A hook of mkdocs: links of a page to files outside of docs/, which the site does not hold, become their text."""

import re
from typing import Any

_OUTSIDE = re.compile(r"\[([^\]]+)\]\(\.\./[^)]+\)")


def without_outside_links(markdown: str) -> str:
    """Returns a page whose links out of its folder are text."""
    return _OUTSIDE.sub(r"\1", markdown)


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Called by mkdocs with each page."""
    return without_outside_links(markdown)
