"""The option `--formats`: a list of formats, or, without one, the table of all that there are. It writes nothing."""

import argparse
from collections.abc import Sequence
from typing import Any, final

from grafu.export.formats import DEFAULT_FORMATS, FORMATS, known_formats

_LIST = "list"


def add_formats_option(parser: argparse.ArgumentParser) -> None:
    """Adds --formats."""
    parser.add_argument(
        "--formats",
        action=_FormatsAction,
        nargs="?",
        const=_LIST,
        default=",".join(DEFAULT_FORMATS),
        metavar="LIST",
        help=f"what to write, separated by commas: {known_formats()} (default: {','.join(DEFAULT_FORMATS)}); without a "
        "list, or with `list`: print a table of them and end",
    )


@final
class _FormatsAction(argparse.Action):
    """Takes a list of formats; prints the table and ends where none is given."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        _: str | None = None,
    ) -> None:
        """Keeps the list, or prints the table and ends with exit code 0."""
        if values == _LIST:
            print_formats()
            parser.exit(0)
        setattr(namespace, self.dest, values)


def print_formats() -> None:
    """Prints each format with its files, what it is for, and whether it can be written here."""
    from rich.markup import escape

    from grafu.cli.terminal import plain_table, wide_console

    table = plain_table("format", "files", "what it is for", "here")
    for one in FORMATS.values():
        table.add_row(one.name, ", ".join(one.files), escape(one.about), escape(_here(one.name)))
    wide_console().print(table)


def _here(name: str) -> str:
    """Returns whether a format can be written, by default or not, else what it needs."""
    from grafu.errors import ExportError
    from grafu.export.formats import exporter_for

    try:
        exporter_for(name)
    except ExportError:
        return f"needs pip install 'grafu[{FORMATS[name].extra}]'"
    return "by default" if name in DEFAULT_FORMATS else "yes"
