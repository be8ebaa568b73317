"""What the command says when something goes wrong: one line on stderr. It decides no exit code."""

import sys
import tempfile
import traceback

INTERRUPTED = "interrupted; no half-written output is left"


def complain(message: str) -> None:
    """Prints one line on stderr, whatever line breaks the message holds."""
    print(f"grafu: {one_line(message)}", file=sys.stderr)


def one_line(message: str) -> str:
    """Returns the message with every run of white space, line breaks too, as one space."""
    return " ".join(message.split())


def internal_fault(error: BaseException, doing: str, debug: bool) -> str:
    """Returns the line for an error that is our fault; the traceback goes to stderr (`debug`) or into a kept log."""
    text = "".join(traceback.format_exception(error))
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
