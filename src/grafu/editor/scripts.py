"""The scripts and styles of the editor's pages: those of the report's page, and what makes it live."""

from collections.abc import Callable
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Final

from grafu.viewer.model_page import STYLES, VIEW_SCRIPTS
from grafu.viewer.shell import in_one_scope, template_text

EDITING: Final = (
    "server.js", "fields.js", "focus.js", "lasso.js", "dragging.js", "inspector.js", "toolbar.js", "keys.js", "edit.js",
)  # fmt: skip


WALL: Final = ("wall.js",)


def style() -> str:
    """Returns the style sheet of all pages."""
    return template_text(STYLES) + _own(("edit.css",))


def edit_script() -> str:
    """Returns the script of a model's page."""
    return in_one_scope(template_text(VIEW_SCRIPTS) + _own(EDITING))


def wall_script() -> str:
    """Returns the script of the page of several models."""
    return in_one_scope(template_text(("dom.js",)) + _own(WALL))


SCRIPTS: Final = MappingProxyType[str, Callable[[], str]]({"edit.js": edit_script, "wall.js": wall_script})


@cache
def _own(names: tuple[str, ...]) -> str:
    folder = files("grafu.editor") / "templates"
    return "".join((folder / name).read_text(encoding="utf-8") for name in names)
