"""What a language model is asked for a completed graph: instructions, examples of synthetic furniture, the model.

The examples come from our generator, always the same, and from no model that is evaluated.
"""

from functools import lru_cache
from itertools import count, islice
from typing import Final

from grafu.evaluation.llm.chat import Message
from grafu.evaluation.llm.config import EXAMPLES_SEED, LlmConfig
from grafu.evaluation.llm.graph_text import completion_text, graph_text
from grafu.graph.functional_graph import FunctionalGraph
from grafu.synth.generate import make_specimen
from grafu.vocabulary import PartLabel

_LABELS: Final = ", ".join(f"`{label.value}`" for label in PartLabel)
GRAPH_INSTRUCTIONS: Final = f"""\
You complete functional graphs of furniture. A graph has a node for each part of a 3D model and edges between parts.
Given are the parts with their axis-aligned boxes and the pairs of parts that touch. Reply with what makes the piece \
work.

Frame: metres, Z is up, the front of the piece looks along -Y, the left of a person who stands before it is -X.

Parts: `id` is unique; `label` is one of {_LABELS}; `name` is the word of the model's author, where there is one; \
`low` and `high` are opposite corners of the box. A label may be `unknown` or wrong.

Edges, each with `kind`, `parent` and `child`:
- `hinge`: the child, a door, flap or lid, turns on the parent. `border` is the face of the child's box that carries \
the pin: one of -X, +X, -Y, +Y, -Z, +Z, but not one of its two broad faces. `axis` is the signed axis, along that \
border, about which the child opens: counter-clockwise where the axis points to you.
- `rail`: the child, a drawer, slides on the parent. `axis` is the signed axis along which it opens. A drawer that \
runs between two panels has a rail to each.
- `slide`: the same of a child that is no drawer, such as a sliding door.
- `turn`: the child turns about `axis` through the middle of its box, such as a knob.
- `attached`: the child moves as one with the parent, such as a handle with its door, or a board with its drawer.

The piece works if every door has a hinge or a slide and every drawer rails; the parent of each is a part that holds \
it: a side, a frame, a divider, a top or a bottom, or a door or drawer that moves itself; every handle is attached to \
what it opens; and no part is missing that it needs: a cabinet has a top, and every door and drawer can be pulled. \
What is drawn closed opens outwards. No part has two motions.

Reply with one JSON object and nothing else:
{{"labels": {{id: label, only where the given label is unknown or wrong}},
 "new_parts": [{{"id", "label", "low", "high"}}, only parts that are missing],
 "edges": [all edges of these five kinds; contacts are not repeated]}}
"""


def graph_messages(
    graph: FunctionalGraph, config: LlmConfig, seed: int | None = None, picture: bytes = b""
) -> tuple[Message, ...]:
    """Returns the conversation's beginning for a model's graph of contacts; `picture` is a PNG of it, or empty.

    `seed` is that of the model, where it is synthetic: the examples are of another one.
    """
    beginning = EXAMPLES_SEED + (seed == EXAMPLES_SEED)
    told = "".join(examples_text(beginning, config.examples, config.most_parts))
    shown = " A picture of it is attached." if picture else ""
    asked = f"Complete this graph.{shown}\n\n{graph_text(graph)}"
    return Message("system", GRAPH_INSTRUCTIONS + told), Message("user", asked, picture)


@lru_cache(maxsize=2)
def examples_text(seed: int, number: int, most_parts: int) -> tuple[str, ...]:
    """Returns so many examples: a given graph and its completion, of furniture with at most so many parts."""
    drawn = (make_specimen(seed, k, points=0) for k in count())
    kept = islice((one for one in drawn if len(one.whole.parts) <= most_parts), number)
    return tuple(
        f"\nExample {k}, given:\n{graph_text(one.given)}\nReply:\n{completion_text(one)}\n"
        for k, one in enumerate(kept, 1)
    )
