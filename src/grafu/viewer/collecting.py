"""What a page from a disk collects: the motions that the user chooses, as one settings.json and one whole command.

It writes nothing: the browser saves the file where its downloads go.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

from grafu.errors import AssetError
from grafu.export.output_names import output_name
from grafu.joints.motion_choice import choice_in_words
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings
from grafu.viewer.shell import Html, joined, json_block, tag

LEAD: Final = (
    "One is wrong? Choose what is right, of as many parts as need it: the box at the end of the page then holds one "
    "settings.json and one command for all of them."
)
LINES: Final = "A click on an option chooses it; the box at the end of the page makes one command of all."


def collected(report: Report, settings: Settings, formats: Sequence[str] = ()) -> Html:
    """Returns the box that fills as options are chosen, and the data that its script needs.

    The command writes `formats` again, as names of export formats; without, those that are usual.
    """
    words = {option.rpartition("=")[2] for options in report.moves.values() for option in options}
    choices = {word: choice_in_words(word) for word in sorted(words)}
    data = {
        "settings": settings.to_json(),
        "input": report.input.path,
        "name": _stated_name(report, settings),
        "formats": list(formats),
        "words": {
            word: {"moves": str(choice.moves), "side": choice.side and str(choice.side), "inwards": choice.inwards}
            for word, choice in choices.items()
        },
    }
    save = tag("button", "Download settings.json", type="button", id="collected-save")
    copy = tag("button", "", type="button", class_="copy", id="collected-command", title="Copy", data_copy="")
    steps = tag("ol", tag("li", save), tag("li", "Run this, with the path of that file: ", copy))
    head = tag("h2", "Chosen")
    said = tag("p", "", id="collected-said", role="status", class_="lead")
    box = tag("section", head, said, steps, id="collected", class_="panel", hidden=True, aria_label="Chosen")
    return joined([box, json_block("collecting", data)])


def _stated_name(report: Report, settings: Settings) -> str:
    """Returns the name that the command must state, so that it writes to the place of these results; empty: none."""
    if settings.reading.pieces == "split":
        return ""  # pieces get their names from the input
    try:
        usual = output_name(Path(report.input.path))
    except AssetError:
        usual = ""
    return "" if report.input.name == usual else report.input.name
