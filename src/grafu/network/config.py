"""The sizes and choices of the network: the paper's numbers by default, each departure named with its reason."""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any, Literal, final

from grafu.dataclass import dataclass
from grafu.graph.arrays import EDGE_CODES, LABELS, KindSet

LABEL_COUNT = len(LABELS)  # 13 categories and `unknown`

PointsFrame = Literal["object", "part"]
PairFeatures = Literal["faces", "signed", "unsigned"]
PairBoxes = Literal["input", "predicted"]
FreeBoxes = Literal["pointed", "absolute"]
Vocabulary = Literal["grafu", "official"]


@final
@dataclass(frozen=True)
class GraFuConfig:
    """What the network is built of; the defaults have the sizes of the paper (supplement, GraFu Architecture).

    `hidden` is the width of nodes and slots, `edge` that of pairs; `category`, `points` and `geometry` are the widths
    of the three parts of a node's latent. `free_slots` (K) recover what is missing; padding exists in batches only.

    Departures:
        points_frame: the authors encode points where they stand in the object. "part" takes each part about its own
            middle, in the object's scale: the same leaf is the same shape wherever it hangs, the box states where.
        pair_features: "signed" gives the pair heads the direction from one part to the other, "unsigned" only how far
            apart they are; both are switches of the authors' code, and a pin's side needs the direction. "faces" adds,
            to pair heads and to the edge encoder, how the faces of two boxes lie to each other, down to millimetres.
        margins: nodes also see how far their boxes are from the object's faces, on the same scale: what is a few
            millimetres below the top is no shelf.
        pair_boxes: pair heads see, for slots of input nodes, the box that was given ("input") or the one predicted
            again: a given box is exact, and gaps of a millimetre decide about contact. No gradient runs through them.
        pair_edges: pair heads also see the encoder's last feature of the edge between two input nodes. The paper gives
            them slots and boxes only, so that the kinds of edges in the input reach them through nodes alone.
        second_grouping: the paper's second stage groups the groups of points once more, each with up to
            `second_neighbours` within `second_radius` (of the object's size; both are the authors'). Without, it takes
            all groups at once: of 32 there is little left to group, and a step is shorter by a tenth or two.
        slots: the paper has a budget of 55 slots (M), most of them padding that must be predicted not to exist. None:
            as many slots as nodes, and K more; the budget never cuts a graph, larger ones get more slots.
        symmetric_edges: the kind of an edge is one, whichever end is asked: its logits are the mean of both ways. The
            paper classifies each pair by itself; where it does, the mean is taken in use alone.
        vocabulary: "official" has the 17 categories of the authors' code, as their weights do.
        free_boxes: the paper has free slots say their boxes in the object's frame ("absolute"). "pointed" ones point at
            nodes and say theirs in units of those: a handle sits so far along its door, a top as wide as its case.
        visibility: nodes also see how much of their part is visible from each side, and what lies behind it
            (`grafu.completion.visibility`): a front and a shelf may have one shape.
        kinds: the paper has four kinds of edges. "all" has ours, too: a door that slides, what turns about no border of
            its box, and motions on what moves itself.
        names: nodes also see pieces of the input's own words for their parts (`grafu.completion.name_codes`), as
            evidence beside the label that was read from them: a name may be wrong, or foreign.
        facts: the network also predicts which parts move as one body, which are drawn ajar, and what the whole is.
        materials: nodes also see how much of their part's surface is transparent: doors, shelves and tops are of glass.
        name_dropout: in training, the fraction of graphs whose names are hidden: many files have none that mean
            anything.
        material_dropout: in training, the fraction of graphs whose materials are hidden: many files have none.
        geometry_dropout: in training, the fraction of graphs whose parts' points are hidden (authors: .3, of whole
            batches): real surfaces differ more from synthetic ones than boxes and contacts do.

    Raises:
        ValueError: if a size is below 1, a fraction is not in [0, 1), the heads do not divide `hidden`, or there are
            fewer slots than free ones.
    """

    hidden: int = 256
    heads: int = 8
    encoder_layers: int = 4
    decoder_layers: int = 4
    edge: int = 128
    category: int = 128
    points: int = 64
    geometry: int = 32
    free_slots: int = 4
    dropout: float = 0.1  # authors' code
    geometry_dropout: float = 0.3
    points_frame: PointsFrame = "part"
    pair_features: PairFeatures = "faces"
    margins: bool = True
    pair_boxes: PairBoxes = "input"
    pair_edges: bool = True
    free_boxes: FreeBoxes = "pointed"
    visibility: bool = True
    kinds: KindSet = "all"
    names: bool = True
    facts: bool = True
    materials: bool = True
    name_dropout: float = 0.3
    material_dropout: float = 0.5
    second_grouping: bool = False
    second_radius: float = 0.4
    second_neighbours: int = 32
    slots: int | None = None
    symmetric_edges: bool = True
    vocabulary: Vocabulary = "grafu"

    @property
    def edge_codes(self) -> int:
        """How many codes of edges are predicted, that of no edge among them."""
        return EDGE_CODES[self.kinds]

    def __post_init__(self) -> None:
        sizes = ("hidden", "heads", "encoder_layers", "decoder_layers", "edge", "category", "points", "geometry")
        for name in sizes:
            if getattr(self, name) < 1:
                raise ValueError(f"`{name}` must be at least 1: got {getattr(self, name)}")
        if self.hidden % self.heads:
            raise ValueError(f"`hidden` must be a multiple of `heads`: got {self.hidden} and {self.heads}")
        if self.free_slots < 0:
            raise ValueError(f"`free_slots` must not be negative: got {self.free_slots}")
        if self.slots is not None and self.slots < max(1, self.free_slots):
            raise ValueError(f"`slots` must be at least `free_slots`: got {self.slots} and {self.free_slots}")
        if self.second_neighbours < 1 or self.second_radius <= 0:
            said = f"{self.second_neighbours}, {self.second_radius}"
            raise ValueError(f"`second_neighbours` and `second_radius` must be above 0: got {said}")
        for name in ("dropout", "geometry_dropout", "name_dropout", "material_dropout"):
            if not 0.0 <= getattr(self, name) < 1.0:
                raise ValueError(f"`{name}` must be at least 0 and below 1: got {getattr(self, name)}")


PAPER = GraFuConfig(
    geometry_dropout=0.0,
    points_frame="object",
    pair_features="signed",
    margins=False,
    pair_boxes="predicted",
    pair_edges=False,
    free_boxes="absolute",
    visibility=False,
    kinds="paper",
    names=False,
    facts=False,
    materials=False,
    name_dropout=0.0,
    material_dropout=0.0,
    second_grouping=True,
    slots=55,
    symmetric_edges=False,
)
"""The paper's network, without our departures."""

OFFICIAL = replace(PAPER, geometry_dropout=0.3, vocabulary="official")
"""The network of the authors' code, into which their weights are read."""

OLDER: Mapping[str, Any] = MappingProxyType(
    {"kinds": "paper", "visibility": False, "names": False, "facts": False, "materials": False}
)
"""The fields that files of earlier networks do not state, and what they had."""
