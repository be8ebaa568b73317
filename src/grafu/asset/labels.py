"""Part labels from names, by a table of keywords. It looks at words only, never at geometry.

The words cover PartNet's and PartNet-Mobility's part names (storage furniture, tables, desks), the authors'
`<category>_<n>`, plain English, Blender's `.001` and camelCase. The first row of the table that matches decides.
"""

from functools import lru_cache
from typing import Final

from grafu.asset.names import words
from grafu.vocabulary import PartLabel

# Each row: a label and the phrases that give it. A phrase is words that adjoin (`drawer rail` also matches plurals);
# `=top` matches only where it is the whole name. Order matters: hardware and handles outweigh the part that they sit
# on (`door_hinge`, `drawer_handle`), pieces of a drawer outweigh the panels that they resemble (`drawer_back`), and
# nouns outweigh adjectives (`back_leg`, `top_shelf`).
TABLE: Final[tuple[tuple[PartLabel, str], ...]] = (
    (PartLabel.DRAWER, "pull out, pullout, slide out tray"),
    (PartLabel.HANDLE, "handle, doorhandle, knob, nob, doorknob, grip, handgrip, pull, grasp"),
    (PartLabel.MISC, "tabletop connector, drawer rail, drawer slider, drawer slide, drawer runner, hinge, lock"),
    (PartLabel.MISC, "keyhole, screw, nail, bolt, wheel, caster, castor, button, switch, lever, dial, faucet, tap"),
    (PartLabel.DRAWER, "drawer, keyboard tray, tray surface, =tray, sliding tray"),
    (PartLabel.FACE_FRAME, "face frame, faceframe, front frame, stile, mullion, top rail, bottom rail, mid rail"),
    (PartLabel.DOOR, "door, cabinetdoor, flap, lid, shutter, hatch, tambour"),
    (PartLabel.LEG, "leg, foot, feet, pedestal"),
    (PartLabel.SHELF, "shelf, shelve, shelves, bookshelf, plank, rack"),
    (PartLabel.DIVIDER, "divider, partition, separator, middle panel, mid panel, centre panel, center panel"),
    (PartLabel.BAR, "bar, stretcher, rod, crossbar, beam, rung, slat, apron, strut, brace, batten, crosspiece"),
    (PartLabel.BACK_PANEL, "back panel, backpanel, backboard, back board, back plate, rear panel, back side"),
    (PartLabel.TOP_PANEL, "top panel, toppanel, tabletop, table top, countertop, counter top, counter, worktop"),
    (PartLabel.TOP_PANEL, "desktop, desk top, top board, top plate, top surface, board top, bench top, =board"),
    (PartLabel.BOTTOM_PANEL, "bottom panel, bottompanel, bottom board, bottom plate, base panel, floor panel"),
    (PartLabel.BOTTOM_PANEL, "base plate, cabinet bottom, carcass bottom, =bottom"),
    (PartLabel.SIDE_PANEL, "side panel, sidepanel, side board, side plate, side wall, gable, toe kick, plinth"),
    (PartLabel.SIDE_PANEL, "kickboard, baseboard, skirting, end panel, left panel, right panel"),
    (PartLabel.SIDE_PANEL, "left side, right side, cabinet side, carcass side, =side, =left, =right"),
    (PartLabel.FACE_FRAME, "front panel, fixed front, false front, cabinet frame, =frame, =front"),
    (PartLabel.BACK_PANEL, "cabinet back, carcass back, =back, =rear"),
    (PartLabel.TOP_PANEL, "cabinet top, carcass top, =top"),
    (PartLabel.MISC, "misc, connector, glass, mirror, lamp, light, led, sink, basin, cushion, pillow, book, clock"),
    (PartLabel.MISC, "decoration, cord, cable, hook, key, vase, rail, runner, slider, cloth"),
)

# Things that furniture annotations give joints to although no hinge or rail carries them.
_CONTROLS = frozenset({"wheel", "caster", "castor", "knob", "nob", "button", "switch", "lever", "dial", "lock", "key"})
# Words that make a name a piece of a door or drawer rather than the whole.
_PIECES = frozenset({"front", "back", "side", "bottom", "base", "face", "panel", "surface", "frame", "glass", "board"})
_PLURALS = frozenset({"doors", "drawers"})
_CONTAINERS = frozenset({"unit", "set", "group", "stack", "chest", "cabinet", "collection", "compartment", "section"})


@lru_cache(maxsize=20_000)
def label_of(name: str) -> PartLabel:
    """Returns the label that a name gives, `unknown` where it gives none."""
    spoken = tuple(_singular(w) for w in words(name))
    for label, phrases in _PHRASES:
        if any(_matches(spoken, phrase, whole) for phrase, whole in phrases):
            return label
    return PartLabel.UNKNOWN


def is_control(name: str) -> bool:
    """Whether the name is that of a wheel, caster, knob, button or the like: it may turn, but on no hinge or rail."""
    spoken = {_singular(w) for w in words(name)}
    return bool(spoken & _CONTROLS) and not spoken & {"door", "drawer"}


def is_piece(name: str) -> bool:
    """Whether a door's or drawer's name is that of one of its pieces (`drawer_front`, `cabinet_door_surface`)."""
    return any(_singular(w) in _PIECES for w in words(name))


def is_whole_mover(name: str) -> bool:
    """Whether the name is that of one whole door or drawer: no piece, no plural, no container (`drawer_unit`)."""
    spoken = words(name)
    label = label_of(name)
    return label.is_movable and not is_piece(name) and not set(spoken) & (_PLURALS | (_CONTAINERS - {"cabinet"}))


def _singular(word: str) -> str:
    return word[:-1] if len(word) > 3 and word.endswith("s") and not word.endswith(("ss", "us")) else word


def _matches(spoken: tuple[str, ...], phrase: tuple[str, ...], whole: bool) -> bool:
    if whole:
        return spoken == phrase
    n = len(phrase)
    return any(spoken[i : i + n] == phrase for i in range(len(spoken) - n + 1))


def _parse(row: str) -> tuple[tuple[tuple[str, ...], bool], ...]:
    phrases = (p.strip() for p in row.split(","))
    return tuple((tuple(_singular(w) for w in p.lstrip("=").split()), p.startswith("=")) for p in phrases)


_PHRASES: Final = tuple((label, _parse(row)) for label, row in TABLE)
