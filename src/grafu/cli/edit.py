"""The verb `edit`: a page in the browser on which joints, handles and categories are set right by hand."""

import argparse
from pathlib import Path

from grafu.cli.input_options import add_input_options, add_limit_option, load_options, with_limits
from grafu.cli.verb import EXIT_DONE, EXIT_TERMINATED, complain, say
from grafu.processes.lifetime import Terminated

_DESCRIPTION = """\
Opens the page of a result, or of a model, in the browser, where everything can be set right by hand: how a part moves,
how far, on which hinges, its handle, its category. Each choice is built at once and saved in settings.json beside the
results; Export writes every format. The server answers this machine alone, at an address with a random token.
"""
_EXAMPLES = """\
examples:
  grafu edit results/cabinet
  grafu edit cabinet.glb --out results
  grafu edit results --no-browser
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "edit", help="set joints and parts right by hand, in the browser", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument(
        "inputs", nargs="+", type=Path, metavar="INPUT", help="a folder of a result or of several, or a model"
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("results"),
        metavar="DIR",
        help="where the results of models go: DIR/<name>/ (default: results)",
    )
    parser.add_argument("--no-browser", action="store_true", help="print the address alone, and open no browser")
    parser.add_argument(
        "--port", type=_port, default=0, metavar="N", help="the port of this machine (default: a free one)"
    )
    add_input_options(parser)
    add_limit_option(parser)
    parser.set_defaults(run=run)
    return parser


def _port(text: str) -> int:
    if not (text.isascii() and text.isdigit() and 0 < int(text[:9]) < 65536):
        raise argparse.ArgumentTypeError(f"must be a number from 1 to 65535: got {text!r}")
    return int(text)


def run(options: argparse.Namespace) -> int:
    """Serves until it is ended with Ctrl-C; returns 0, or 143 where SIGTERM ended it.

    Raises:
        FunctionalizationError: if an input or an option is wrong.
    """
    from grafu.editor.workspace import open_all
    from grafu.errors import OptionError

    try:
        from grafu.editor.serving import serve
    except ImportError as error:
        if (error.name or "").split(".")[0] not in ("starlette", "uvicorn"):
            raise
        raise OptionError("`grafu edit` needs its extra: pip install 'grafu[edit]'") from None
    reading = with_limits(load_options(options), options)
    found = open_all(options.inputs, options.out, reading, lambda why: complain(f"left out: {why}"))
    try:
        serve(found, _tell, options.port, browser=not options.no_browser)
    except KeyboardInterrupt as end:  # Ctrl-C is the way to end it: what was chosen is saved already
        say("ended; every choice is saved")
        return EXIT_TERMINATED if isinstance(end, Terminated) else EXIT_DONE
    return EXIT_DONE


def _tell(address: str) -> None:
    say(f"grafu edit: {address}")
    say("Ctrl-C ends it; every choice is saved as it is made")
