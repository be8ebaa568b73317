"""The verb `check`: results are loaded into MuJoCo and pulled; what is found goes into their folders."""

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.cli.telling import add_telling_options, print_json
from grafu.cli.verb import EXIT_DONE, EXIT_FAILED, complain, one_line, say
from grafu.errors import FunctionalizationError, OptionError

if TYPE_CHECKING:
    from grafu.simulation.record import CheckReport

_DESCRIPTION = """\
Loads model.xml and model.urdf of results into MuJoCo (pip install 'grafu[sim]'): pulls every joint at its grip with at
most 20 N (30 N at a drawer), pushes it shut, drops a cube into drawers, and watches the piece stand, closed and with
everything open. Writes check.json and check.gif into each folder, and a table into its report.html.
"""
_EXAMPLES = """\
examples:
  grafu check results/kitchen_base
  grafu check results
"""
CHECK_FILE, CLIP_FILE, PAGE = "check.json", "check.gif", "report.html"


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "check", help="load results into MuJoCo, and pull every joint", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument("results", nargs="+", type=Path, metavar="RESULT", help="the folder of a result or of a run")
    add_telling_options(parser, "each result")
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Checks every result and prints a line on each file; returns 0 where all works, 1 where something does not.

    Raises:
        OptionError: if MuJoCo is not installed.
        FunctionalizationError: if the only result cannot be checked.
    """
    from grafu.simulation.world import require_mujoco

    require_mujoco()
    folders = _results_of(options.results)
    if len(folders) == 1:
        return EXIT_DONE if check_result(folders[0], options.json_lines).works else EXIT_FAILED
    return EXIT_DONE if check_results(folders, options.json_lines) else EXIT_FAILED


def _results_of(given: Sequence[Path]) -> list[Path]:
    """Returns the results that are given, and those of each run that is; what is neither stays, to be refused."""
    from grafu.dataset.results import results_in

    found = ([one for one in results_in([path]) if isinstance(one, Path)] or [path] for path in given)
    return [folder for folders in found for folder in folders]


def check_result(folder: Path, as_json: bool = False) -> "CheckReport":
    """Checks one result, writes what is found into its folder, and prints it, `as_json` in one line; returns it.

    Raises:
        FunctionalizationError: if it cannot be checked, or its folder cannot be written.
    """
    from grafu.simulation.check import check_folder
    from grafu.simulation.words import sentences

    try:
        checked = check_folder(folder)
    except FunctionalizationError as error:
        if as_json:
            print_json({**_named(folder), "works": False, "findings": [], "error": one_line(str(error))})
        raise
    _write(folder, checked.report, checked.clip)
    found = sentences(checked.report)
    for line in found:
        say(f"{folder.name}: {line}")
    if as_json:
        print_json({**_named(folder), "works": checked.report.works, "findings": list(found), "error": None})
    return checked.report


def _named(folder: Path) -> dict[str, str]:
    return {"check": folder.name, "folder": str(folder)}


def check_results(folders: Sequence[Path], as_json: bool = False) -> bool:
    """Checks results one after another, and complains of those that cannot be; returns whether all works."""
    works = True
    for folder in folders:
        try:
            works &= check_result(folder, as_json).works
        except FunctionalizationError as error:
            complain(f"{folder}: {error}")
            works = False
    return works


def require_simulator(formats: str) -> None:
    """Makes sure, before any work is done, that results of these formats (with commas between) can be checked.

    Raises:
        OptionError: if MuJoCo is not installed, or no format can be loaded into it.
    """
    from grafu.simulation.world import require_mujoco

    if not {"urdf", "mjcf"} & {name.strip().lower() for name in formats.split(",")}:
        raise OptionError(f"`--check` loads URDF or MJCF: add one to --formats, got {formats}")
    require_mujoco()


def _write(folder: Path, report: "CheckReport", clip: bytes) -> None:
    from tempfile import TemporaryDirectory

    from grafu.export.files import add_files
    from grafu.export.marker import read_marker
    from grafu.graph.serialize import dump_json
    from grafu.simulation.words import COLUMNS, sentences, table_rows
    from grafu.viewer.check_page import with_check

    contents = {CHECK_FILE: dump_json(report.to_json()).encode()}
    if clip:
        contents[CLIP_FILE] = clip
    marker = read_marker(folder)
    if marker is not None and PAGE in marker.files and (folder / PAGE).is_file():  # another's page stays as it is
        page = (folder / PAGE).read_text(encoding="utf-8")
        contents[PAGE] = with_check(page, COLUMNS, table_rows(report), sentences(report), clip).encode()
    with TemporaryDirectory() as place:
        added = {name: Path(place) / name for name in contents}
        for name, data in contents.items():
            added[name].write_bytes(data)
        add_files(folder, added)
