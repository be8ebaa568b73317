"""Part labels from names, by a table of phrases and a little grammar. It looks at words only, never at geometry.

The words cover PartNet's and PartNet-Mobility's part names (storage furniture, tables, desks), the authors'
`<category>_<n>`, Blender's `.001`, camelCase, and ten languages (`grafu.asset.languages`, `languages_slavic`).

The head noun is what a part is: the last one of a name, or of what stands before a preposition. `drawer_0_left_rail` is
a rail, `door_handle` a handle, `opening_on_hinge_1_door` a door. Words that mean a piece of a door or drawer
(`drawer_left_side`) leave it what it is.
"""

import re
from functools import lru_cache
from itertools import pairwise
from typing import Final, final

from grafu.asset.label_phrases import TABLE
from grafu.asset.languages import word_set
from grafu.asset.names import OF, singular, spoken
from grafu.dataclass import dataclass
from grafu.vocabulary import PartLabel

# Things that furniture annotations give joints to although no hinge or rail carries them.
_CONTROLS = frozenset({"wheel", "caster", "castor", "knob", "nob", "button", "switch", "lever", "dial", "lock", "key"})
_LEAF_CONTROLS = word_set("knob nob lock key")
_PLACES = word_set(
    "left right upper lower top bottom middle center centre mid front back rear side inner outer lateral vertical "
    "horizontal first second third sliding fixed"
)
# Words that make a name a piece of a door or drawer rather than the whole.
_PIECES = word_set(
    "front back side bottom base face panel surface frame glass board box container body pane window floor wall skin "
    "mirror plate facade"
)
_LEAF_PIECES = word_set("stile rail mullion molding moulding trim bead slat")
_VOIDS = word_set("recess shadow gap cavity slot groove cutout hole pocket")
_VALVES = word_set("tap faucet hot cold heat water burner")  # whose handles are on no door or drawer
_FITTINGS = word_set("hinge lock rail slide slider runner screw knuckle bearing bracket wheel caster castor")
_HARDWARE = frozenset({"hinge", "lock", "latch", "knuckle"})
_LEADING = (  # `hinge_plate_left_door`: a fitting, and then which door or drawer it is on
    (PartLabel.DRAWER, word_set("rail runner bracket")),
    (PartLabel.DOOR, word_set("plate leaf bracket arm knuckle barrel strap pin cup")),
)
_PLURALS = frozenset({"doors", "drawers"})
_CONTAINERS = word_set(
    "unit set group stack chest cabinet collection compartment section case carcass body cupboard wardrobe "
    "dresser desk table bench bookcase sideboard kitchen fridge refrigerator freezer oven stove cooker microwave "
    "dishwasher washer "
    "bed stair nightstand shell housing"
)
# Sweet Home 3D writes before a name on what it opens: that is no word about what the part is.
_OPENING: Final = re.compile(r"^sweethome3d_opening_on_(?:hinge|rail)_\d+_?", re.IGNORECASE)
_AND = word_set("and or plus")
_CHESTS = word_set("chest trunk coffer")
_DOORWAYS = word_set("doorway doorframe jamb architrave")
_BEDS = word_set("bed cot crib cradle mattress pillow duvet")
APPLIANCES = word_set("fridge refrigerator freezer oven stove cooker microwave dishwasher washer")


@final
@dataclass(frozen=True, slots=True)
class Sense:
    """What a name states: the label, whether it is a piece of a door or drawer, and whether nothing blurs it.

    A name `is_blurred` where it goes on, after the noun, with words that are not known (`drawer_sprocket`).
    `is_container` states that it is the name of a whole piece of furniture or of its body, `is_fitting` that it is that
    of a hinge, a rail or the like, `mention` which door or drawer it names besides (`drawer_unit`, `drawer_lock`),
    `is_either` that it names doors and drawers alike.
    """

    label: PartLabel
    is_piece: bool = False
    is_blurred: bool = False
    is_container: bool = False
    is_fitting: bool = False
    is_either: bool = False
    mention: PartLabel | None = None


@lru_cache(maxsize=20_000)
def sense_of(name: str) -> Sense:
    """Returns what a name states; where it states nothing, the label is `unknown`."""
    for phrase in _phrases(spoken(_OPENING.sub("", name) or name)):
        found = _sense(tuple(singular(w) for w in phrase))
        if found.label is not PartLabel.UNKNOWN or found.is_container or found.is_either:
            return found
    return Sense(PartLabel.UNKNOWN)


def label_of(name: str) -> PartLabel:
    """Returns the label that a name gives, `unknown` where it gives none."""
    return sense_of(name).label


def is_control(name: str) -> bool:
    """Whether the name is that of a wheel, caster, knob, button or the like: it may turn, but on no hinge or rail.

    A `door_button` is a button: what a name ends in tells what it names; a `lock_door` is a door.
    """
    said = [singular(w) for w in spoken(name)]
    if {"door", "drawer"} & set(said):
        return bool(said) and said[-1] in _CONTROLS - _LEAF_CONTROLS
    return bool(_CONTROLS & set(said))


def is_chest(name: str) -> bool:
    """Whether the name is that of a chest, a trunk or a chest freezer, but of no chest of drawers."""
    said = {singular(w) for w in spoken(name)}
    return bool(said & _CHESTS) and "drawer" not in said


def is_washer(name: str) -> bool:
    """Whether the name is that of a washing machine."""
    said = {singular(w) for w in spoken(name)}
    return "washer" in said or {"washing", "machine"} <= said


def is_bed(name: str) -> bool:
    """Whether the name is that of a bed or of what lies on one: a cot, a mattress, a pillow."""
    return bool({singular(w) for w in spoken(name)} & _BEDS)


def is_doorway(name: str) -> bool:
    """Whether the name is that of the frame around a door, or of a piece of one."""
    said = [singular(w) for w in spoken(name)]
    return bool(_DOORWAYS & {*said}) or ("door", "frame") in pairwise(said)


def is_appliance(name: str) -> bool:
    """Whether the name is that of a kitchen appliance or its body: an oven, a refrigerator, a dishwasher."""
    return sense_of(name).is_container and bool({singular(w) for w in spoken(name)} & APPLIANCES)


def is_opening(name: str) -> bool:
    """Whether Sweet Home 3D states in the name that it opens."""
    return _OPENING.match(name) is not None


def is_piece(name: str) -> bool:
    """Whether the name is that of a door's or drawer's piece (`drawer_front`, `cabinet_door_surface`)."""
    return sense_of(name).is_piece


def is_whole_part(name: str) -> bool:
    """Whether the name is that of one whole door or drawer: no piece, no plural, no container (`drawer_unit`)."""
    sense = sense_of(name)
    whole = sense.label.is_movable and not sense.is_piece and not sense.is_blurred
    return whole and not set(spoken(name)) & (_PLURALS | {"unit", "set", "group", "stack", "collection"})


def _phrases(said: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Returns the name in the order in which its phrases count: what stands before a preposition, then what after."""
    found: list[list[str]] = [[]]
    for word in said:
        if word == OF:
            found.append([])
        else:
            found[-1].append(word)
    return [tuple(phrase) for phrase in found if phrase]


@lru_cache(maxsize=20_000)  # many names differ in their numbers alone
def _sense(said: tuple[str, ...]) -> Sense:
    handle, moving = _last(said, _OF_HANDLES), _last(said, _OF_MOVING)
    if handle is not None and not (set(said[handle[1] :]) & _VOIDS or _overlaps(handle, moving)):
        is_valve = moving is None and bool(set(said) & _VALVES)
        return Sense(PartLabel.MISC if is_valve else PartLabel.HANDLE)
    if _names_both(said):
        return Sense(PartLabel.UNKNOWN, is_either=True)
    if moving is not None:
        found = _as_moving(said, moving)
        if found is not None:
            return found
    head = _last(said, _OF_OTHERS)
    container = max((i for i, w in enumerate(said) if w in _CONTAINERS), default=-1)
    if head is None or container >= head[1]:
        mention = None if moving is None else moving[2]
        return Sense(PartLabel.UNKNOWN, is_container=container >= 0, mention=mention if container >= 0 else None)
    if said[head[0] : head[1]] == ("counter",) and set(said[head[1] :]) & (_PLACES | {"panel"}):
        return Sense(PartLabel.UNKNOWN)  # `counter_side_left`: a piece of furniture is called so, too
    is_fitting = bool(set(said[head[0] : head[1]]) & _FITTINGS)
    return Sense(head[2], is_fitting=is_fitting, mention=None if moving is None or not is_fitting else moving[2])


def _as_moving(said: tuple[str, ...], moving: tuple[int, int, PartLabel]) -> Sense | None:
    """Returns what a name with a door or drawer in it states, None where another noun is its head."""
    start, end, label = moving
    tail = tuple(word for word in said[end:] if len(word) > 1)  # `drawer_r0_c2`: the letters of a row and a column
    if (tail or end - start > 1) and set(said[:start]) & _HARDWARE:
        return None  # `hinge_door_leaf`: the leaf of the hinge that is on the door
    if _leads(said[:start], label):
        return None
    own = _PIECES | (_LEAF_PIECES if label is PartLabel.DOOR else frozenset())
    known = _without_strange_end(tail)
    if all(w in own or w in _PLACES for w in known):
        pieces = set(known) & own | ({"surface"} & set(said[start:end]))
        return Sense(label, is_piece=bool(pieces), is_blurred=len(known) < len(tail))
    after = _last(said, _OF_OTHERS)
    later = after is not None and after[1] > end
    if later or any(w in _CONTAINERS for w in tail):
        return None
    return Sense(label, is_piece=bool(set(tail) & own), is_blurred=True)


def _leads(before: tuple[str, ...], label: PartLabel) -> bool:
    """Whether the words before a door or drawer name a fitting that is on it: nothing is called a `rail drawer`."""
    for moving, fittings in _LEADING:
        if label is moving and set(before) & fittings:
            return label is PartLabel.DRAWER or bool(set(before) & _HARDWARE)
    return False


def _without_strange_end(tail: tuple[str, ...]) -> tuple[str, ...]:
    """Returns the words without those at the end that state nothing: a material, a file's ending."""
    return tail[: max((k + 1 for k, word in enumerate(tail) if word in _KNOWN), default=0)]


def _names_both(said: tuple[str, ...]) -> bool:
    """Whether a name is that of doors and drawers alike (`door_and_drawers`): which of them a part is, shape tells."""
    threes = zip(said, said[1:], said[2:], strict=False)
    return any(word in _AND and {before, after} == {"door", "drawer"} for before, word, after in threes)


def _overlaps(first: tuple[int, int, PartLabel], second: tuple[int, int, PartLabel] | None) -> bool:
    return second is not None and first[0] < second[1] and second[0] < first[1]


def _last(said: tuple[str, ...], rows: "_Rows") -> tuple[int, int, PartLabel] | None:
    """Returns where the phrase that ends last begins and ends, and its label; the longest of several."""
    found = [
        (i, i + len(phrase), label)
        for i, word in enumerate(said)
        for label, phrase, whole in rows.get(word, ())
        if (said == phrase if whole else said[i : i + len(phrase)] == phrase)
    ]
    return max(found, key=lambda f: (f[1], f[1] - f[0]), default=None)


_Rows = dict[str, list[tuple[PartLabel, tuple[str, ...], bool]]]


def _rows(labels: frozenset[PartLabel]) -> _Rows:
    """Returns the phrases of labels, and whether each is a whole name alone, by their first words."""
    found: _Rows = {}
    for label, p in ((label, p.strip()) for label, row in TABLE if label in labels for p in row.split(",")):
        phrase = tuple(singular(w) for w in p.lstrip("=").split())
        found.setdefault(phrase[0], []).append((label, phrase, p.startswith("=")))
    return found


_MOVING = frozenset({PartLabel.DOOR, PartLabel.DRAWER})
_OF_MOVING: Final = _rows(_MOVING)
_OF_HANDLES: Final = _rows(frozenset({PartLabel.HANDLE}))
_OF_OTHERS: Final = _rows(frozenset(PartLabel) - _MOVING - {PartLabel.HANDLE})
_KNOWN: Final = (
    frozenset(
        word
        for rows in (_OF_MOVING, _OF_HANDLES, _OF_OTHERS)
        for found in rows.values()
        for _, said, _ in found
        for word in said
    )
    | _PIECES
    | _LEAF_PIECES
    | _PLACES
    | _CONTAINERS
    | _VOIDS
    | _FITTINGS
)
