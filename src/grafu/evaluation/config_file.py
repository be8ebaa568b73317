"""A frozen configuration from the TOML file that the user wrote for it. It decides no value."""

import tomllib
from pathlib import Path
from typing import Any, Final, TypeVar

from pydantic import TypeAdapter, ValidationError

from grafu.asset.json_files import read_own
from grafu.errors import AssetError, OptionError

Config = TypeVar("Config")
_MOST_BYTES: Final = 2**20


def read_config(path: Path, kind: type[Config]) -> Config:
    """Returns the configuration of this class that a file states; what it leaves out is as by default.

    Raises:
        OptionError: if it cannot be read, is no TOML, or names or states what there is not.
    """
    expected = f"a TOML file with the fields of {kind.__name__}"
    try:
        stated = tomllib.loads(read_own(path, expected, _MOST_BYTES).decode())
    except AssetError as error:
        raise OptionError(str(error)) from None
    except ValueError as error:
        raise OptionError(f"{path} is no TOML ({' '.join(str(error).split())}): expected {expected}") from None
    adapter: Any = TypeAdapter(kind)
    try:
        return adapter.validate_python(stated)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(step) for step in first["loc"])
        raise OptionError(f"{path}: {f'`{where}`: ' if where else ''}{first['msg']}; expected {expected}") from None
