"""A URL of a model, or of a folder of results: `s3://bucket/models/cab.glb`. It opens nothing."""

import re
from pathlib import Path
from typing import TypeAlias, final
from urllib.parse import unquote

from grafu.dataclass import dataclass
from grafu.errors import OptionError

_URL = re.compile(r"(?P<scheme>[A-Za-z][A-Za-z0-9+.-]+)://(?P<rest>.*)", re.S)
_MAGIC = re.compile(r"[*?\[]")


@final
@dataclass(frozen=True, order=True)
class Url:
    """An address with a scheme, without a slash at its end.

    Raises:
        OptionError: if it has no scheme or no name, or holds a password: it would be in logs and reports.
    """

    text: str

    def __post_init__(self) -> None:
        found = _URL.fullmatch(self.text)
        if found is None or not found["rest"].strip("/"):
            raise OptionError(f"a URL must be as `s3://bucket/folder`: got `{self.text}`")
        if "@" in found["rest"].split("/")[0]:
            scheme = found["scheme"]
            raise OptionError(
                f"a `{scheme}://` URL must not hold a name or a password before `@`, for reports and logs state it: "
                "give credentials in the environment"
            )
        if found["scheme"].lower() in ("http", "https"):
            raise OptionError("`http://` cannot be listed or written: give s3://, gs://, hf:// or a file")
        object.__setattr__(self, "text", f"{found['scheme'].lower()}://{found['rest'].rstrip('/')}")

    def __str__(self) -> str:
        return self.text

    def __truediv__(self, name: str) -> "Url":
        return Url(f"{self.text}/{name}")

    @property
    def scheme(self) -> str:
        """What stands before `://`."""
        return self.text.partition("://")[0]

    @property
    def name(self) -> str:
        """The last part."""
        return self.text.rpartition("/")[2]

    @property
    def parent(self) -> "Url":
        """The folder that holds it; itself for a bucket."""
        above = self.text.rpartition("/")[0]
        return self if above.endswith("/") else Url(above)

    @property
    def as_path(self) -> Path:
        """A path of the same parts, for what compares names."""
        return Path("/" + self.text.partition("://")[2])

    @property
    def has_pattern(self) -> bool:
        """Whether it stands for all that match it."""
        return _MAGIC.search(self.text) is not None

    def holds(self, other: "Url") -> bool:
        """Whether another one is this or lies in it."""
        return other == self or other.text.startswith(f"{self.text}/")


Place: TypeAlias = Path | Url


def place_of(text: str) -> Place:
    """Returns what an argument names: a URL, or a path (also of `file://`).

    Raises:
        OptionError: if it is no URL that can be used.
    """
    if text.lower().startswith("file://"):
        return Path(unquote(text[len("file://") :]))
    return Url(text) if _URL.fullmatch(text) else Path(text)
