"""The lines that the command states: errors go to stderr. It decides no exit code.

What steers a terminal is shown as an escape in all of them: names of files and parts are others' text.
"""

import sys
import tempfile
import traceback

from grafu.visible import visible

INTERRUPTED = "interrupted; no half-written output is left"


def complain(message: str) -> None:
    """Prints one line on stderr, whatever line breaks the message holds."""
    print(f"grafu: {visible(one_line(message))}", file=sys.stderr)


def say(line: str) -> None:
    """Prints one line on stdout, at once."""
    print(visible(line), flush=True)


def one_line(message: str) -> str:
    """Returns the message with every run of white space, line breaks too, as one space."""
    return " ".join(message.split())


def internal_fault(error: BaseException, doing: str, debug: bool) -> str:
    """Returns the line for an error that is our fault; the traceback goes to stderr (`debug`) or into a kept log."""
    lines = "".join(traceback.format_exception(error)).splitlines()
    text = "".join(f"{visible(line)}\n" for line in lines)
    said = one_line(f"{type(error).__name__}: {error}")[:200]
    if debug:
        print(text, file=sys.stderr)
        return f"internal error in {doing}, which is our fault, not yours ({said})"
    return f"internal error in {doing}, which is our fault, not yours ({said}); traceback kept in {_keep_log(text)}"


def _keep_log(text: str) -> str:
    try:
        with tempfile.NamedTemporaryFile("w", prefix="grafu-", suffix=".log", delete=False, encoding="utf-8") as log:
            log.write(text)
        return log.name
    except OSError:
        return "no file, for no temporary folder can be written: use --debug"
