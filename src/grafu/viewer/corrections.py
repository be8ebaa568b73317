"""What sets a wrong motion right: the options of `grafu functionalize`, as buttons to copy. It corrects nothing."""

from grafu.viewer.markup import Html, joined, tag

LEAD = (
    "One is wrong? Copy its line, give it to the same command, with --overwrite. Instead of the last word: left, "
    "right, top or bottom (it turns about that side), slides, or not."
)


def correction_buttons(options: tuple[str, ...]) -> Html:
    """Returns a button for each option that copies it; its text can be selected, too."""
    buttons = (tag("button", o, type="button", class_="copy", title="Copy", data_copy=o) for o in options)
    return joined(buttons)
