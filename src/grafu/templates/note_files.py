"""The text of a template's annotation file, read with care. It knows no fields."""

from pathlib import Path

from grafu.asset.options import Limits
from grafu.asset.resources import ModelFiles
from grafu.errors import AssetError, TemplateError

_LIMITS = Limits(max_bytes=2**20)


def read_note(path: Path) -> str:
    """Returns the text of an annotation file.

    Raises:
        TemplateError: if it is missing, no regular file of its template's folder, too large, or not UTF-8.
    """
    try:
        return ModelFiles(path.parent, _LIMITS).read(path).decode("utf-8")
    except (AssetError, UnicodeDecodeError) as error:
        why = error if isinstance(error, AssetError) else f"{path} cannot be read as text (UnicodeDecodeError)"
        raise TemplateError(f"{why}: expected a JSON file") from None
