"""The gallery that a call works with: the built-in one, and before it the user's own. It draws nothing."""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from grafu.templates.template import Gallery


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
