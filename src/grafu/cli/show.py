"""The verb `show`: opens the page of a result, or of a whole run, in the browser."""

import argparse
import webbrowser
from pathlib import Path

from grafu.cli.job import MODEL_PAGE
from grafu.cli.run_page import RUN_PAGE, write_index_of
from grafu.errors import UnreadableAsset

_DESCRIPTION = """\
Opens the page of a result (report.html), or of the run that a folder holds (index.html), in the default browser, and
prints its address. Of a folder with several results that were made one by one it writes index.html first. Nothing is
sent anywhere: the page is one file.
"""
_EXAMPLES = """\
examples:
  grafu show results
  grafu show results/cabinet
"""
_PAGES = (MODEL_PAGE, RUN_PAGE)


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "show", help="open the page of a result in the browser", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument("result", type=Path, metavar="RESULT", help="the folder of a result or of a run")
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Opens the page and returns 0; where there is no browser the address is printed all the same.

    Raises:
        UnreadableAsset: if there is no page.
    """
    from grafu.cli.verb import say

    address = page_of(options.result).resolve().as_uri()
    say(address)
    webbrowser.open(address)
    return 0


def page_of(result: Path) -> Path:
    """Returns the page of a result or of a run; of several results without one it is written.

    Raises:
        UnreadableAsset: if there is none.
        ExportError: if it cannot be written.
    """
    if not result.exists():
        raise UnreadableAsset(f"there is no {result}: give the folder of a result or of a run")
    if result.is_file() and result.suffix == ".html":
        return result
    pages = [result / name for name in _PAGES if (result / name).is_file()]
    if pages:
        return pages[0]
    inside = sorted(found.parent for found in result.glob("*/report.html")) if result.is_dir() else []
    if len(inside) == 1:
        return inside[0] / "report.html"
    if len(inside) > 1 and _holds_results(result):
        write_index_of(result)
        return result / RUN_PAGE
    hint = f"choose one of its {len(inside)} results" if inside else "run `grafu functionalize` without --no-page"
    raise UnreadableAsset(f"`{result}` must hold the page of a result (report.html or index.html): {hint}")


def _holds_results(folder: Path) -> bool:
    from grafu.cli.earlier import finished_in

    return any(finished_in(folder, but=set()))
