"""The templates that a run can use: the built-in ones and, before them, the user's own. It draws nothing."""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from grafu.templates.template import Gallery, HandleTemplate


def open_gallery(folder: Path | None) -> "Gallery":
    """Returns the built-in gallery; the templates in `folder` come first where one is given.

    Raises:
        TemplateError: if a template in the folder is at fault.
    """
    from grafu.templates.gallery import builtin_gallery

    if folder is None:
        return builtin_gallery()
    from grafu.templates.user import load_gallery

    return builtin_gallery().extended(load_gallery(folder))


def open_handles(folder: Path | None) -> "dict[str, HandleTemplate]":
    """Returns all handles by id, the user's own in `folder` first; one of theirs replaces a built-in one of its name.

    Raises:
        TemplateError: if a handle in the folder is at fault.
    """
    from grafu.templates.handles import HANDLES
    from grafu.templates.user import load_handles

    own = load_handles(folder) if folder is not None else {}
    return {**own, **{template.id: template for template in HANDLES if template.id not in own}}
