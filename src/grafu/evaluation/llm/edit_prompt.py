"""What a language model is asked for a list of edits: the edits that there are, and a description of the model."""

from typing import Final

from grafu.evaluation.llm.chat import Message
from grafu.evaluation.llm.graph_text import graph_text
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel

_LABELS: Final = ", ".join(f"`{label.value}`" for label in PartLabel)
EDIT_INSTRUCTIONS: Final = f"""\
You make 3D models of furniture work. Given are the parts of a model with their axis-aligned boxes and the pairs of \
parts that touch. Reply with a list of edits. Each is carried out on the model: hinges and rails are built where you \
state them, and what you do not mention does not move.

Frame: metres, Z is up, the front of the piece looks along -Y. Left and right are those of a person who stands before \
it: left is -X. The sides of the piece are left, right, front (-Y), back (+Y), top (+Z) and bottom (-Z).

The edits, each a JSON object:
- {{"do": "hinge", "part": id, "edge": side}}: the part turns about its edge at this side, on hinges. Optional: \
"opens": "outwards" (the usual) or "inwards"; "degrees": how far it opens.
- {{"do": "slide", "part": id, "direction": side}}: the part slides out to this side, on rails. Optional: "distance": \
how far, in metres.
- {{"do": "fold", "part": id, "to": "left", "right" or "top"}}: the part is one of two leaves that fold to this side.
- {{"do": "fix", "part": id}}: the part does not move.
- {{"do": "label", "part": id, "label": label}}: what the part is, one of {_LABELS}.
- {{"do": "attach", "part": id, "to": id}}: the part moves as one with another part, such as a board of a drawer with \
the drawer's front. Handles that touch a door or drawer move with it in any case.
- {{"do": "add", "what": "top", "handles" or "interior"}}: a top where none is; handles where a door or drawer cannot \
be pulled; shelves and dividers.

Every door, flap, lid and drawer is to open as in reality, without cutting into other parts. A part has at most one of \
hinge, slide, fold, fix and attach.

Reply with one JSON object and nothing else: {{"edits": [edits in any order]}}
"""


def edit_messages(graph: FunctionalGraph, picture: bytes = b"") -> tuple[Message, ...]:
    """Returns the conversation's beginning for a model's graph of contacts; `picture` is a PNG of it, or empty."""
    shown = " A picture of it is attached." if picture else ""
    asked = f"Make this piece work.{shown}\n\n{graph_text(graph)}"
    return Message("system", EDIT_INSTRUCTIONS), Message("user", asked, picture)
