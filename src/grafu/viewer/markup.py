"""HTML that is safe by its type: text is escaped unless it is `Html` already. It knows no page.

Names of parts come from users; a `<script>` in one of them is shown, never run.
"""

import json
from collections.abc import Iterable
from html import escape
from typing import Any, final

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
