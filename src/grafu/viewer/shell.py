"""The frame of every page: one file with its styles and scripts inside, which no browser lets reach the network.

The content security policy names the scripts by their hash: nothing else runs, whatever a part is called. HTML is safe
by its type: text is escaped unless it is `Html` already. Names of parts come from users; a `<script>` in one of them is
shown, never run.
"""

import json
from base64 import b64encode
from collections.abc import Iterable
from functools import cache
from hashlib import sha256
from html import escape
from importlib.resources import files
from typing import Any, final

from grafu.version import __version__

Attribute = str | int | float | bool | None
_EMPTY = frozenset({"br", "col", "img", "input", "link", "meta"})


@final
class Html(str):
    """Text that is markup already; only this module and fixed templates make it."""

    __slots__ = ()


def tag(name: str, /, *children: str, **attributes: Attribute) -> Html:
    """Returns an element. A child that is not `Html` is escaped.

    In attribute names `_` stands for `-`, and one at the end is dropped (`class_`); True writes the bare name, False
    and None leave the attribute out.
    """
    words = "".join(_attribute(key, value) for key, value in attributes.items())
    if name in _EMPTY:
        return Html(f"<{name}{words}>")
    return Html(f"<{name}{words}>{joined(children)}</{name}>")


def joined(parts: Iterable[str], between: str = "") -> Html:
    """Returns the parts one after another, each escaped unless it is `Html`."""
    return Html(_escaped(between).join(_escaped(part) for part in parts))


def json_block(block_id: str, data: object) -> Html:
    """Returns data for scripts as an element that browsers never run, whatever strings it holds."""
    text = json.dumps(data, separators=(",", ":"), ensure_ascii=False, allow_nan=False, default=_plain)
    for sign in "<>&\u2028\u2029":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return Html(f'<script type="application/json" id="{escape(block_id)}">{text}</script>')


def _escaped(part: str) -> str:
    return part if isinstance(part, Html) else escape(part)


def _attribute(key: str, value: Attribute) -> str:
    if value is None or value is False:
        return ""
    name = key.rstrip("_").replace("_", "-")
    return f" {name}" if value is True else f' {name}="{escape(str(value))}"'


def _plain(value: Any) -> Any:
    return value.tolist()  # numpy's numbers and arrays


def light_of(colour: str) -> Html:
    """Returns a coloured mark that also names its colour, for readers who cannot see it."""
    return tag("span", colour, class_=f"light {colour}")


GENERATOR = f"grafu {__version__}"
HEAD_BYTES = 4096
"""What of a page states whose it is."""


def whole_page(title: str, body: Html, styles: tuple[str, ...], scripts: tuple[str, ...]) -> str:
    """Returns a page; `styles` and `scripts` are names of files beside the templates, used in this order."""
    style, script = template_text(styles), in_one_scope(template_text(scripts))
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
    """Returns a part of the page under its heading; `lead` states in a line what is in it."""
    lead_text = tag("p", lead, class_="lead") if lead else Html("")
    return tag("section", tag("h2", title), lead_text, joined(content), id=name or None)


def in_one_scope(scripts: str) -> str:
    """Returns scripts as one that leaves no names behind."""
    return '(() => {\n"use strict";\n' + scripts + "})();\n"


@cache
def template_text(names: tuple[str, ...]) -> str:
    """Returns the files of these names beside the templates, one after another."""
    folder = files("grafu.viewer") / "templates"
    return "".join((folder / name).read_text(encoding="utf-8") for name in names)


def _hash(text: str) -> str:
    return "sha256-" + b64encode(sha256(text.encode()).digest()).decode()
