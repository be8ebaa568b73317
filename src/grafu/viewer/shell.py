"""The frame of every page: one file with its styles and scripts inside, which no browser lets reach the network.

The content security policy names the scripts by their hash: nothing else runs, whatever a part is called.
"""

from base64 import b64encode
from functools import cache
from hashlib import sha256
from importlib.resources import files

from grafu.version import __version__
from grafu.viewer.markup import Html, joined, tag


def light_of(colour: str) -> Html:
    """Returns a coloured mark that names its colour: nobody must see it to read it."""
    return tag("span", colour, class_=f"light {colour}")


GENERATOR = f"grafu {__version__}"
HEAD_BYTES = 4096
"""What of a page says whose it is."""


def whole_page(title: str, body: Html, styles: tuple[str, ...], scripts: tuple[str, ...]) -> str:
    """Returns a page; `styles` and `scripts` are names of files beside the templates, used in this order."""
    style, script = _read(styles), '(() => {\n"use strict";\n' + _read(scripts) + "})();\n"
    policy = (
        f"default-src 'none'; img-src data:; style-src '{_hash(style)}'; script-src '{_hash(script)}'; "
        "base-uri 'none'; form-action 'none'"
    )
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=policy),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("meta", name="generator", content=GENERATOR),
        tag("link", rel="icon", href="data:,"),
        tag("title", title),
        tag("style", Html(style)),
    )
    main = tag("body", body, tag("script", Html(script)))
    return f"<!DOCTYPE html>\n{tag('html', head, main, lang='en')}\n"


def is_page_of_ours(data: bytes) -> bool:
    """Whether a file, of which the first `HEAD_BYTES` do, is a page that this module made, of whatever version."""
    return b'<meta name="generator" content="grafu ' in data[:HEAD_BYTES]


def section(title: str, *content: str, lead: str = "", name: str = "") -> Html:
    """Returns a part of the page under its heading; `lead` says in a line what is in it."""
    said = tag("p", lead, class_="lead") if lead else Html("")
    return tag("section", tag("h2", title), said, joined(content), id=name or None)


@cache
def _read(names: tuple[str, ...]) -> str:
    folder = files("grafu.viewer") / "templates"
    return "".join((folder / name).read_text(encoding="utf-8") for name in names)


def _hash(text: str) -> str:
    return "sha256-" + b64encode(sha256(text.encode()).digest()).decode()
