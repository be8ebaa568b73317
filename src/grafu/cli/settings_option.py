"""The settings of a run: those of `--settings FILE`, or the defaults, with what other options say instead.

It runs nothing.
"""

import argparse
from dataclasses import replace
from pathlib import Path

from grafu.asset.options import Limits
from grafu.asset.resources import read_bytes
from grafu.cli.addition_options import addition_config
from grafu.cli.input_options import load_options, with_limits
from grafu.errors import AssetError, OptionError
from grafu.pipeline.settings import Settings, settings_from_bytes
from grafu.templates.available import open_handles

_LIMITS = Limits(max_bytes=16 * 2**20)


def stated_settings(options: argparse.Namespace) -> Settings:
    """Returns the settings in the file `--settings`, or the defaults, with what the other options state in their place.

    A motion source that reads another system's file (`--motion particulate:FILE`) is no setting: it is passed over.

    Raises:
        FunctionalizationError: if the file cannot be read or is wrong, or an option is.
    """
    base = read_settings(options.settings) if options.settings else Settings()
    settings = replace(
        base,
        reading=with_limits(load_options(options, base.reading), options),
        additions=addition_config(options, open_handles(options.templates), base.additions),
        trim=base.trim and not options.no_trim,
        weights=options.weights or base.weights,
    )
    if options.motion is None or options.motion.source.is_foreign:
        return settings
    return replace(settings, motion=options.motion.source)


def read_settings(path: Path) -> Settings:
    """Returns the settings in a file.

    Raises:
        OptionError: if the file cannot be read or is wrong.
    """
    try:
        data = read_bytes(path, _LIMITS)
    except AssetError as error:
        raise OptionError(f"`--settings` must be a JSON file: {error}") from None
    return settings_from_bytes(data, path)
