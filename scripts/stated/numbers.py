"""Which numbers of a page look like measurements, and are bound to nothing."""

import re
from collections.abc import Iterable
from pathlib import Path

LOOKS_MEASURED = re.compile(
    r"\d\S* ?±|\b\d[\d.,]* ?%|\bper cent\b|\b\d[\d,]* of (?:the |all |these |their )?\d"
    r"|(?<!Python )(?<!Python is )(?<!Blender )\b\d+\.\d{2,}\b"
    r"|\b\d[\d,.]* (?:s|seconds?|ms|minutes?|hours?)\b|\b\d[\d,.]* (?:MB|GB|KB|kB|MiB|GiB)\b"
    r"|\b\d[\d,.]* (?:million|times|steps|models|objects|doors|drawers|motions)\b"
)
BOUND = re.compile(
    r"<!-- figure: .*?<!-- end -->"  # a figure
    r"|<!-- ([^\n:]+): drawn by [^\n]*-->.*?<!-- end of \1 -->"  # a table
    r"|^(```|~~~).*?^\2"  # code
    r"|^    \S[^\n]*"
    r"|`[^`\n]*`|\]\([^)\n]*\)"
    r"|<!--.*?-->",
    re.DOTALL | re.MULTILINE,
)
NO_FIGURE = re.compile(r"<!-- no figure: \S[^\n]*-->")
DRAWN_PAGE = "<!-- drawn by scripts/"


def unbound(page: str, text: str, stated: Iterable[str]) -> list[str]:
    """Returns a line for each number that looks measured and is bound to nothing.

    `stated` are the sentences of the page whose numbers were compared with the code.
    """
    if DRAWN_PAGE in text[:400]:
        return []
    hidden = without_unmarked(text)
    for sentence in stated:
        hidden = re.sub(spaced(sentence), blank, hidden)
    hidden = BOUND.sub(blank, hidden)
    return [
        f"docs/{page}:{number}: `{found[0].strip()}` looks measured: bind it to the command that prints it or the "
        "constant that it is, or mark the paragraph `<!-- no figure: why -->` (docs/figures.md states how)"
        for number, line in enumerate(hidden.splitlines(), 1)
        if (found := LOOKS_MEASURED.search(line))
    ]


def spaced(sentence: str) -> str:
    """Returns a pattern for a sentence that may be broken over lines anywhere."""
    return r"\s+".join(map(re.escape, sentence.split()))


def without_unmarked(text: str) -> str:
    """Returns a text in which paragraphs that are marked as no figure are blank."""
    blocks = re.split(r"(\n[ \t]*\n)", text)
    return "".join(blank_text(block) if NO_FIGURE.search(block) else block for block in blocks)


def blank(found: re.Match[str]) -> str:
    """Returns spaces in place of what was found, lines kept."""
    return blank_text(found[0])


def blank_text(text: str) -> str:
    """Returns as many lines, empty."""
    return re.sub(r"[^\n]", " ", text)


def pages_in(docs: Path) -> dict[str, Path]:
    """Returns the pages that are checked by name: all of docs/, and README."""
    found = {path.name: path for path in sorted(docs.glob("*.md"))}
    return found | {"../README.md": docs.parent / "README.md"}
