"""By which words the authors' weights are told apart that have one shape. It reads nothing.

The released files hold names that are documented nowhere. Most weights are known by their shape and layer; of the
others the words of their names decide, as the paper and the files of graphs use them.
"""

import re
from typing import Final

LAYER: Final = re.compile(r"(?:layers?|blocks?)[._](\d+)")
"""Where a name states the number of its layer."""

UNUSED: Final = re.compile(r"handle\w*border")
"""What no score depends on: a head that the authors train with weight 0."""

_ENDS: Final = (r"(?:^|[._])", r"(?:[._]|$)")


def _whole(words: str) -> str:
    return rf"{_ENDS[0]}(?:{words}){_ENDS[1]}"


WORDS: Final[tuple[tuple[str, tuple[str, ...]], ...]] = (
    (r"^encoder\.nodes\.points", (r"point|pc|geom|cloud|sa\d",)),
    (r"^encoder\.nodes\.box", (r"box|geo|cent",)),
    (r"^encoder\.edges", (r"edge",)),
    (r"^encoder\.(layers|updates|norm)", (r"enc|graph",)),
    (r"^encoder\.updates", (r"edge|upd",)),
    (r"^decoder\.(layers|norm)", (r"dec|slot",)),
    (r"^decoder\.(summary|free)", (r"pool|summ|glob|context|free|query|queries",)),
    (r"\.to_slots", (r"self",)),
    (r"\.to_nodes", (r"cross|memory|multihead",)),
    (r"\.query$", (_whole(r"w_?q|q|query|queries|to_q|q_proj|lin_q|q_lin|lin_query"),)),
    (r"\.key$", (_whole(r"w_?k|k|key|keys|to_k|k_proj|lin_k|k_lin|lin_key"),)),
    (r"\.value$", (_whole(r"w_?v|v|value|values|to_v|v_proj|lin_v|v_lin|lin_value"),)),
    (r"\.out$", (_whole(r"w_?o|o|out|output|to_out|out_proj|o_proj|lin_o|o_lin|lin_out|proj"),)),
    (r"\.before_slots$", (r"norm",)),
    (r"heads\.exists", (r"exist|valid",)),
    (r"heads\.category", (r"mat|cat|class|label",)),
    (r"heads\.shift", (r"cent|pos|delta",)),
    (r"heads\.size", (r"half|box|size|ext",)),
    (r"heads\.edge", (r"edge",)),
    (r"heads\.parent", (r"parent",)),
    (r"heads\.hinge_(target|abstain)", (r"target|hinge|abst|null",)),
    (r"heads\.(parent|hinge)_abstain", (r"abst|null|none",)),
    (r"heads\.border", (r"border",)),
    (r"heads\.sign", (r"sign(?!ed)",)),
    (r"heads\.slide", (r"rail",)),
)
"""For a pattern of our names, the patterns that the authors' names have: all of them, where they have any."""


def words_of(ours: str) -> tuple[re.Pattern[str], ...]:
    """Returns what a name of the authors' must have, where several weights have the shape of this one of ours."""
    return tuple(re.compile(word) for pattern, words in WORDS if re.search(pattern, ours) for word in words)
