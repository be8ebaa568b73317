"""What a simulator made of a result, as a section of its page: put in, or in the place of an earlier one."""

import re
from base64 import b64encode
from collections.abc import Sequence
from typing import Final

from grafu.viewer.report_tables import plain_rows
from grafu.viewer.shell import Html, joined, section, tag

_BEGIN, _END = "<!-- check -->", "<!-- end of check -->"
_EARLIER: Final = re.compile(re.escape(_BEGIN) + ".*?" + re.escape(_END), re.DOTALL)
_BEFORE: Final = "</main>"


def with_check(
    page: str, columns: Sequence[str], rows: Sequence[Sequence[str]], lines: Sequence[str], clip: bytes
) -> str:
    """Returns a page with a section of these sentences, this table and this GIF, in the place of an earlier one.

    A page without a main part is returned as it is.
    """
    content: list[Html] = [tag("p", line) for line in lines]
    if rows:
        content.append(plain_rows(columns, rows, "Check"))
    if clip:
        source = f"data:image/gif;base64,{b64encode(clip).decode()}"
        content.append(tag("p", tag("img", src=source, alt="Each joint is pulled open and pushed shut")))
    block = f"{_BEGIN}{section('In the simulator', joined(content), name='check')}{_END}"
    if _EARLIER.search(page):
        return _EARLIER.sub(lambda _: block, page, count=1)
    before, found, after = page.rpartition(_BEFORE)
    return f"{before}{block}{found}{after}" if found else page
