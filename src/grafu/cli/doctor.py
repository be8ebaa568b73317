"""The verb `doctor`: what is installed, which formats can be written, and whether a small cabinet comes out right."""

import argparse
import platform
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, requires, version
from importlib.util import find_spec
from time import perf_counter
from typing import final

from grafu.dataclass import dataclass
from grafu.version import __version__

_DESCRIPTION = """\
Lists versions, the formats that can be written here and what the others need, opens the network, and makes a small
cabinet work in memory. It writes nothing. Exit code 1 if something that grafu always needs is missing or fails.
"""
_EXAMPLES = """\
examples:
  grafu doctor
"""
_PIECE = "overlay pair"  # of `grafu.synth.samples.TIDY`


@final
@dataclass(frozen=True, slots=True)
class Finding:
    """One line: what was looked at, whether it is there and works, and what it is or how to get it.

    `needed` states that nothing works without it.
    """

    what: str
    works: bool
    said: str
    needed: bool = True


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "doctor", help="show what is installed and whether it works", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.set_defaults(run=run)
    return parser


def run(_: argparse.Namespace) -> int:
    """Prints all findings; returns 1 if something needed is missing or fails, else 0."""
    from rich.markup import escape

    from grafu.cli.terminal import plain_table, wide_console

    found = [*_packages(), *_formats(), *_verbs(), _network(), _self_test()]
    table = plain_table("", "what", "found")
    for one in found:
        table.add_row("ok" if one.works else "FAILS" if one.needed else "-", escape(one.what), escape(one.said))
    wide_console().print(table)
    return int(any(one.needed and not one.works for one in found))


def _packages() -> Iterator[Finding]:
    yield Finding("grafu", True, f"{__version__} on Python {platform.python_version()}, {sys.platform}")
    for stated in requires("grafu") or ():
        name, _, marker = (part.strip() for part in stated.partition(";"))
        if "extra ==" in marker or "sys_platform" in marker:
            continue
        name = name.split(">")[0].split("<")[0].split("=")[0].split("!")[0].split("[")[0].strip()
        yield _package(name)


def _package(name: str) -> Finding:
    try:
        return Finding(name, True, version(name))
    except PackageNotFoundError:
        return Finding(name, False, f"not installed: pip install {name}")


def _formats() -> Iterator[Finding]:
    from grafu.errors import ExportError
    from grafu.export.formats import FORMATS, exporter_for

    for one in FORMATS.values():
        try:
            exporter_for(one.name)
        except ExportError as error:
            yield Finding(f"--formats {one.name}", False, str(error), needed=False)
        else:
            yield Finding(f"--formats {one.name}", True, one.title)


_NEEDED = {"edit": ("edit", "starlette", "uvicorn"), "check": ("sim", "mujoco"), "train": ("train", "torch")}
"""What verbs need beside the base install: the extra that brings it, and its packages."""


def _verbs() -> Iterator[Finding]:
    for verb, (extra, *packages) in _NEEDED.items():
        missing = [name for name in packages if find_spec(name) is None]
        said = f"needs {', '.join(missing)}: pip install 'grafu[{extra}]'" if missing else ", ".join(packages)
        yield Finding(f"grafu {verb}", not missing, said, needed=False)


def _network() -> Finding:
    from grafu.completion.session import SHIPPED_WEIGHTS, open_network
    from grafu.errors import WeightsError

    try:
        open_network(SHIPPED_WEIGHTS)
    except WeightsError as error:
        return Finding("network", False, str(error))
    return Finding("network", True, f"{SHIPPED_WEIGHTS.stat().st_size / 1e6:.1f} MB of weights")


def _self_test() -> Finding:
    from grafu.errors import FunctionalizationError
    from grafu.pipeline.functionalize import functionalize
    from grafu.pipeline.motion_source import MotionSource
    from grafu.pipeline.report import report_of
    from grafu.pipeline.verdict import verdict_of
    from grafu.synth.samples import TIDY
    from grafu.templates.gallery import builtin_gallery

    began = perf_counter()
    try:
        made = functionalize(TIDY[_PIECE]().without_annotation(), MotionSource.NETWORK, builtin_gallery())
    except FunctionalizationError as error:
        return Finding("a cabinet with two doors", False, str(error))
    verdict = verdict_of(report_of(made))
    right = len(made.object.moving_joints) == 2  # its two doors
    return Finding("a cabinet with two doors", right, f"{verdict.sentence} ({perf_counter() - began:.1f} s)")
