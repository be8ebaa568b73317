"""The option `--settings`: a file of settings instead of the options that say the same. It runs nothing."""

import argparse
from typing import TYPE_CHECKING

from grafu.asset.options import Limits
from grafu.cli.addition_options import add_addition_options
from grafu.cli.input_options import add_input_options
from grafu.errors import AssetError, OptionError
from grafu.pipeline.motion_source import SourceOption

if TYPE_CHECKING:
    from grafu.pipeline.settings import Settings

_LIMITS = Limits(max_bytes=16 * 2**20)


def read_settings(options: argparse.Namespace) -> "Settings":
    """Returns the settings in the file `options.settings`.

    Raises:
        OptionError: if the file cannot be read or is wrong, or another option says what it says.
    """
    from grafu.asset.resources import read_bytes
    from grafu.pipeline.settings import settings_from_bytes

    _require_alone(options)
    try:
        data = read_bytes(options.settings, _LIMITS)
    except AssetError as error:
        raise OptionError(f"`--settings` must be a JSON file: {error}") from None
    return settings_from_bytes(data, options.settings)


def _require_alone(options: argparse.Namespace) -> None:
    """Raises OptionError if an option is given that the settings hold."""
    parser = argparse.ArgumentParser()
    add_addition_options(parser)
    add_input_options(parser)
    usual = {**vars(parser.parse_args([])), "motion": SourceOption(), "no_trim": False, "weights": None}
    for name, value in usual.items():
        if getattr(options, name) != value:
            spelled = "--" + name.replace("_", "-")
            raise OptionError(f"`--settings` and `{spelled}` exclude each other: leave one of them out")
