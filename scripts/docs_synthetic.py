"""What docs/ repeats of the generator's tables: families, traditions, styles, strategies. `docs.py` writes it.

Reasons for single numbers stand beside the tables in the code; what is said here is what holds for a whole table.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields

from grafu.data.corruption.config import OFFICIAL, PAPER, STRATEGY_NAMES
from grafu.data.corruption.strategies import STRATEGIES, probabilities
from grafu.synth.families.table import FAMILIES
from grafu.synth.noise import cutting, distortion, housing, modelling_styles, naming, part_names
from grafu.synth.noise.modelling_styles import STYLES
from grafu.synth.sampling import carpentry, style
from grafu.synth.sampling.traditions import TRADITIONS, Tradition

SYNTH = "../src/grafu/synth"
HEAD = """\
# Distributions

<!-- drawn by scripts/docs.py from the tables in src/grafu/synth -->

What the generator of [synthetic furniture](synthetic.md) samples, and how often. That page lists the families. Numbers
are per cent unless stated otherwise; an empty cell means never. The reason for each number is beside it in the code.
What each family decides for itself (sizes, layouts) is in its own module.
"""
TRADITIONS_HEAD = f"""\
## Traditions

One piece is built in one tradition, so that what goes together in real furniture is sampled together: a shaker leaf on
a hairpin leg is rare. Each family names the traditions that it comes in ([families]({SYNTH}/families/table.py)), and
may narrow a table. Thicknesses are those of boards as they are sold, and the round numbers of simple models on
modelling sites; fractions follow what is sold and what the real development models show
([traditions]({SYNTH}/sampling/traditions.py)). Thicknesses are given as least · median · most.
"""
STYLE_HEAD = f"""\
## Doors and handles

The side of the hinge is sampled first and the handle follows it, so that a handle indicates the side of the
hinge as often as in real furniture ([style]({SYNTH}/sampling/style.py),
[carpentry]({SYNTH}/sampling/carpentry.py)). The position is sampled once
for each piece. Reach: on the free edge, as near to the hand as the door allows; middle and corner: of the free edge;
top line: horizontal in the middle of the upper or lower edge, which does not depend on the hinge; middle line: in the
middle of the door.
"""
MODELLING_HEAD = f"""\
## Modelling styles

A person who models one panel as a sheet does so in the whole model. So a style is sampled first; it makes the rest
likely or not ([modelling styles]({SYNTH}/noise/modelling_styles.py)). The fractions come from the seventeen development
models, which are few, and are widened to what other sources are known to have. Chances are per model. The
chance of sheets is per group of panels, that of loose objects per kind of object; both are multiplied by the factors
below.
"""
MISSING_HEAD = """\
## Missing parts

These parts of the whole piece are left out of the model. What carries a door, a drawer or a
handle stays, and so does a top that something stands on. Cases under a common worktop never have a top
of their own, push-to-open fronts never a handle; the repaired version holds what a completion would add.
"""
WORDING_HEAD = f"""\
## Labels, names, faces, cuts

A divider in one data set is a side panel in another ([naming]({SYNTH}/noise/naming.py)); such labels are those of the
model and of its ground truth. What is joined and cut is in [cutting]({SYNTH}/noise/cutting.py), how finely faces are
drawn in [modelling styles]({SYNTH}/noise/modelling_styles.py). A part has the label that is read from its name
([names of parts]({SYNTH}/noise/part_names.py)).
"""

# A tradition's tables of weights, in the order of the page, and what each decides.
CHOICES = {
    "mount": "fronts lie",
    "leaf": "doors",
    "handle": "handles",
    "box": "drawer boxes",
    "between": "between fronts",
    "base": "stands on",
    "leg": "legs, where it has any",
    "top": "tops",
}
LENGTHS = {"panel": "panels, mm", "front": "fronts, mm", "back": "backs, mm"}
SPANS = {"gap": ("gaps, mm", 1e3), "overhang": ("overhang of tops, mm", 1e3), "opening": ("doors open, degrees", 1.0)}
RATIOS = {
    "bare": "modelled with the fewest parts",
    "plain_drawers": "plain drawers beside the doors' leaf",
    "framed": "face frame",
    "moulded": "moulding",
    "muntin": "upright between a pair",
}
MASKINGS = ("keeps all labels", "lacks a few", "lacks many", "lacks all")


def distributions_page() -> str:
    """Returns docs/distributions.md."""
    parts = [HEAD, TRADITIONS_HEAD, traditions_tables(), STYLE_HEAD, style_tables(), MODELLING_HEAD, modelling_tables()]
    return "\n".join([*parts, MISSING_HEAD, missing_table(), WORDING_HEAD, wording_tables()])


def families_table() -> str:
    """Returns the table of families for docs/synthetic.md."""
    whole = sum(weight for weight, _ in FAMILIES.values())
    rows = [(name, number(weight / whole), said(draw.__doc__)) for name, (weight, draw) in FAMILIES.items()]
    return f"{len(rows)} families.\n\n{table(('family', '%', 'what it is'), rows)}"


def strategies_table() -> str:
    """Returns the table of corruption strategies for docs/dataset.md."""
    paper, official = (dict(zip(STRATEGY_NAMES, probabilities(c), strict=True)) for c in (PAPER, OFFICIAL))
    rows = [
        (
            f"`{name}`",
            STRATEGIES[name].family,
            f"{STRATEGIES[name].weight:g}",
            number(paper[name]),
            number(official[name]),
        )
        for name in STRATEGY_NAMES
    ]
    return table(("strategy", "family", "weight (paper)", "`PAPER`, %", "`OFFICIAL`, %"), rows)


def traditions_tables() -> str:
    """Returns a row for each thing that may be drawn, a column for each tradition."""
    head = ("", *TRADITIONS)
    texts = [table(("of pieces", *TRADITIONS), [*length_rows(), *span_rows(), *share_rows()])]
    for field, title in CHOICES.items():
        tables = [getattr(tradition, field) for tradition in TRADITIONS.values()]
        texts.append(f"**{title.capitalize()}**\n\n{weight_table(head, tables)}")
    assert {*CHOICES, *LENGTHS, *SPANS, *RATIOS} == {field.name for field in fields(Tradition)}, "a field has no row"
    return "\n".join(texts)


def length_rows() -> Iterable[tuple[str, ...]]:
    """Yields least, median and most of each thickness."""
    for field, title in LENGTHS.items():
        yield (title, *(spread_of(getattr(tradition, field)) for tradition in TRADITIONS.values()))


def span_rows() -> Iterable[tuple[str, ...]]:
    """Yields the ends of each span, drawn evenly between."""
    for field, (title, factor) in SPANS.items():
        spans = (getattr(tradition, field) for tradition in TRADITIONS.values())
        yield (title, *(f"{low * factor:g} to {high * factor:g}" for low, high in spans))


def share_rows() -> Iterable[tuple[str, ...]]:
    """Yields each fraction, per cent."""
    for field, title in RATIOS.items():
        yield (f"{title}, %", *(number(getattr(tradition, field)) for tradition in TRADITIONS.values()))


def style_tables() -> str:
    """Returns where handles sit, which grips stand in for them, and which side doors hang on."""
    carries = (style.CARRIES, style.KITCHEN_CARRIES, style.KNOB_CARRIES)
    sides = {
        "a door above another hangs on its side": carpentry.LIKE_BELOW,
        "beside a wall or a tall unit a door hangs there": carpentry.WALL_SIDE,
        "in a row, doors hang on the outer sides": carpentry.ROW_HABITS["outer"],
        "in a row, all hang left": carpentry.ROW_HABITS["left"],
        "in a row, all hang right": carpentry.ROW_HABITS["right"],
        "both doors of a pair hang on one side": carpentry.SAME_SIDE_PAIR,
    }
    texts = [
        "**Side-hung doors carry their handle**\n",
        weight_table(("", "bars and others", "the same, frameless and face frame", "knobs and rings"), carries),
        "**Fronts without a handle have a grip**\n",
        weight_table(("", "%"), [style.GRIPS]),
        "**Which side**\n",
        ratio_table(sides),
    ]
    return "\n".join(texts)


def modelling_tables() -> str:
    """Returns a row for each style, and the factors of loose objects."""
    columns = [f.name for f in fields(next(iter(STYLES.values()))) if f.name != "masking"]
    rows = [
        (name, *(number(getattr(style, column)) for column in columns), *map(number, style.masking))
        for name, style in STYLES.items()
    ]
    head = ("style", *(column.replace("_", " ") for column in columns), *MASKINGS)
    factors = [(kind, f"{factor:g}") for kind, factor in modelling_styles.LOOSE_WEIGHT.items()]
    sheets = [(label.value, f"{factor:g}") for label, factor in modelling_styles.SHEETS.items()]
    found = [table(("loose objects", "factor"), factors), table(("modelled as sheets", "factor"), sheets)]
    return "\n".join([table(head, rows), *found])


def missing_table() -> str:
    """Returns how often each part is missing."""
    tops = {f"the top: {family}": ratio for family, ratio in modelling_styles.NO_TOP.items()}
    others = {
        "the top: other cases": modelling_styles.NO_CASE_TOP,
        "the top: other tables": modelling_styles.NO_TABLE_TOP,
        "backs": modelling_styles.NO_BACK,
        "bottoms": modelling_styles.NO_BOTTOM,
        "all shelves": modelling_styles.NO_SHELVES,
        "one shelf": modelling_styles.A_SHELF_LOST,
        "all handles": modelling_styles.NO_HANDLES,
        "one handle": modelling_styles.ONE_HANDLE_LOST,
    }
    return ratio_table(tops | others)


def wording_tables() -> str:
    """Returns wording, what is joined, faces, density, and the rates of whole models."""
    models = {
        "every face double-sided": modelling_styles.BOTH_SIDES,
        "the same, where edges are finely rounded": modelling_styles.FINE_BOTH_SIDES,
        "parts in random order": modelling_styles.SHUFFLED,
        "boards let into one another": housing.HOUSED,
        "stretched by up to a tenth": distortion.STRETCHED * (1 - distortion.WIDELY),
        "stretched by up to a quarter": distortion.STRETCHED * distortion.WIDELY,
        "scaled wrongly": distortion.MIS_SCALED,
        "rotated by quarter turns": distortion.TURNED,
        "rotated by up to four degrees": distortion.YAWED,
        "one front ajar": modelling_styles.AJAR,
        "the whole case in one part": cutting.BODY,
        "of these: drawers are fronts alone": cutting.FRONTS_ALONE,
        "of these: handles are in one part with their fronts": cutting.BODY_HANDLES,
        "handles in pieces, bars and posts": cutting.HANDLES_IN_PIECES,
        "one label wrong": modelling_styles.MISLABELLED,
        "some parts named as others": part_names.MISNAMED,
        "of the parts of such a model": part_names.WRONG,
        "of face frames: modelled as bars": cutting.FRAME_IN_BARS,
    }
    texts = [
        ratio_table({name: ratio for name, (_, ratio) in naming.STYLES.items()}),
        "**How the parts of a model are named**\n",
        weight_table(("", "models", "parts without a label"), [part_names.SCHEMES, part_names.LOST_WORDS]),
        "**What is joined, where panels are joined**\n",
        weight_table(("", "%"), [{name: weight for name, (weight, _) in cutting.GROUPS.items()}]),
        "**Faces, where they have faults**\n",
        weight_table(("", "%"), [modelling_styles.FACES]),
        "**How finely models are drawn**\n",
        weight_table(("", "%"), [modelling_styles.DENSITY]),
        "**Whole models**\n",
        ratio_table(models),
    ]
    return "\n".join(texts)


def weight_table(head: Sequence[str], tables: Sequence[Mapping[str, float]]) -> str:
    """Returns a row for each word that any of the tables holds, and its fraction in each."""
    words = dict.fromkeys(word for weights in tables for word in weights)
    sums = [sum(weights.values()) for weights in tables]
    cells = {w: [number(weights.get(w, 0.0) / s) for weights, s in zip(tables, sums, strict=True)] for w in words}
    return table(head, [(word, *row) for word, row in cells.items() if any(row)])


def ratio_table(ratios: Mapping[str, float]) -> str:
    """Returns a row for each fraction, per cent."""
    return table(("", "%"), [(name, number(ratio)) for name, ratio in ratios.items()])


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Returns a table in Markdown."""
    lines = [f"| {' | '.join(cells)} |" for cells in rows]
    return "\n".join([f"| {' | '.join(head)} |", "|---" * len(head) + "|", *lines, ""])


def number(ratio: float) -> str:
    """Returns a fraction as per cent, one decimal below ten, nothing for nothing."""
    return "" if ratio == 0 else f"{100 * ratio:.0f}" if ratio >= 0.095 else f"{100 * ratio:.1f}".removesuffix(".0")


def spread_of(weights: Mapping[float, float]) -> str:
    """Returns least, median and most, metres in and millimetres out."""
    reached, half = 0.0, sum(weights.values()) / 2
    for middle in sorted(weights):
        reached += weights[middle]
        if reached >= half:
            break
    return " · ".join(f"{1e3 * length:g}" for length in (min(weights), middle, max(weights)))


def said(doc: str | None) -> str:
    """Returns what a drawing function states that it returns."""
    first = (doc or "").splitlines()[0].removeprefix("Returns ").removesuffix(".")
    return first[:1].upper() + first[1:]
