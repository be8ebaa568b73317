"""The settings that the options of a call state, over those of a settings file. It runs nothing."""

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.cli.input_options import load_options, with_limits
from grafu.errors import AssetError, OptionError

if TYPE_CHECKING:
    from grafu.pipeline.settings import Settings

MOST_SETTINGS = 16 * 2**20  # bytes of a settings file


def stated_settings(options: argparse.Namespace) -> "Settings":
    """Returns the settings in the file `--settings`, or the defaults, with what the other options state in their place.

    A motion source that reads another system's file (`--motion particulate:FILE`) is no setting: it is passed over.

    Raises:
        FunctionalizationError: if the file cannot be read or is wrong, or an option is.
    """
    from grafu.cli.part_options import addition_config
    from grafu.pipeline.settings import Settings
    from grafu.templates.gallery import open_handles

    base = read_settings(options.settings) if options.settings else Settings()
    settings = replace(
        base,
        reading=with_limits(load_options(options, base.reading), options),
        additions=addition_config(options, open_handles(options.templates), base.additions),
        trim=base.trim and not options.no_trim,
        small_parts=base.small_parts if options.small_parts is None else options.small_parts,
        weights=options.weights or base.weights,
        hinge=options.hinge or base.hinge,
        stays=base.stays and not options.no_stays,
        base=options.base or base.base,
        catch=options.catch or base.catch,
    )
    if options.motion is None or options.motion.source.is_foreign:
        return settings
    return replace(settings, motion=options.motion.source)


def read_settings(path: Path) -> "Settings":
    """Returns the settings in a file.

    Raises:
        OptionError: if the file cannot be read or is wrong.
    """
    from grafu.asset.options import Limits
    from grafu.asset.resources import read_bytes
    from grafu.pipeline.settings import settings_from_bytes

    try:
        data = read_bytes(path, Limits(max_bytes=MOST_SETTINGS))
    except AssetError as error:
        raise OptionError(f"`--settings` must be a JSON file: {error}") from None
    return settings_from_bytes(data, path)
