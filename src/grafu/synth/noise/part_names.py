"""What the parts of a model are called: by its maker, by a data set, in other languages, in short, or by a program.

A name is drawn for the label that a part has, and the label that is read from it is given with it. Some are of another
part by mistake. Where a label is lost, the name is mostly one that a program makes, now and then a word that no reader
knows but that shares letters with one.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Final, Literal

import numpy as np

from grafu.asset.label_phrases import TABLE
from grafu.asset.labels import label_of
from grafu.asset.languages import CHINESE, FRENCH, GERMAN, ITALIAN, JAPANESE, PORTUGUESE, SPANISH, table
from grafu.asset.part import Asset, Part
from grafu.synth.sampling.chance import chance, pick
from grafu.vocabulary import PartLabel

NameScheme = Literal["ids", "data set", "English", "foreign", "short", "program"]

# How the makers of models name their parts, over all that was looked at: data sets have a word for each kind, artists
# write English in any style, a tenth another language; a quarter of all files has the names of its program.
SCHEMES: Final[Mapping[NameScheme, float]] = {
    "ids": 0.15, "data set": 0.2, "English": 0.25, "foreign": 0.1, "short": 0.08, "program": 0.22
}  # fmt: skip
MISNAMED = 0.3  # of models: some of their names are of other parts
WRONG = 0.1  # of the parts of such a model
LOST_WORDS: Final[Mapping[NameScheme, float]] = {"program": 0.72, "short": 0.2, "foreign": 0.08}
"""Of parts whose label is lost."""
LOST_WRONG = 0.05  # of the words that they keep: another part's
PLACED = 0.3  # of names in English: with a word for the place
OF_PIECE = 0.15  # of models named in English: with a word for the piece in front

DATA_SET: Final[Mapping[PartLabel, tuple[str, ...]]] = {
    PartLabel.DOOR: ("cabinet_door", "door", "door_board", "cabinet_door_surface"),
    PartLabel.DRAWER: ("drawer", "drawer_box", "cabinet_drawer"),
    PartLabel.HANDLE: ("handle", "knob"),
    PartLabel.TOP_PANEL: ("top_panel", "tabletop", "board", "tabletop_surface"),
    PartLabel.SIDE_PANEL: ("vertical_side_panel", "side_panel", "base_side_panel"),
    PartLabel.BACK_PANEL: ("back_panel",),
    PartLabel.BOTTOM_PANEL: ("bottom_panel",),
    PartLabel.FACE_FRAME: ("vertical_front_panel", "frame", "front_frame"),
    PartLabel.SHELF: ("shelf",),
    PartLabel.DIVIDER: ("vertical_divider_panel", "divider"),
    PartLabel.BAR: ("bar", "bar_stretcher", "frame_vertical_bar", "frame_horizontal_bar", "stretcher"),
    PartLabel.LEG: ("leg", "foot", "caster"),
    PartLabel.MISC: ("other", "tabletop_connector", "fixed_part", "misc", "connector"),
}
PIECES: Final = ("cabinet", "Schrank", "dresser", "kitchen", "wardrobe", "table", "desk", "commode", "SM", "furniture")
PLACES: Final = ("left", "right", "upper", "lower", "front", "rear", "inner", "L", "R", "big", "small", "01", "B")
PROGRAMS: Final = (
    "Cube.{n:03d}", "Cube_{n}", "Mesh_{n}", "mesh{n}", "Object{n:03d}", "Object_{n}", "g{n}", "group_{n}",
    "node{n}", "polySurface{n}", "pCube{n}", "Plane.{n:03d}", "Cylinder.{n:03d}", "Box{n:03d}",
    "ChamferBox{n:03d}", "Line{n:03d}", "Body{n}", "Solid{n}", "Component#{n}", "part_{n}", "link_{n}",
    "obj_{n}", "wood_{n}", "Material.{n:03d}", "{n}", "",
    "Geometry_{n}", "default_{n}", "visual_{n}",
    "Oak_{n}", "metal", "Mesh.{n:03d}", "primitive_{n}", "joined_{n}",
)  # fmt: skip
# What a part is named for by mistake
MISTAKEN: Final[Mapping[PartLabel, tuple[PartLabel, ...]]] = {
    PartLabel.DOOR: (PartLabel.SIDE_PANEL, PartLabel.FACE_FRAME, PartLabel.MISC, PartLabel.DRAWER),
    PartLabel.DRAWER: (PartLabel.FACE_FRAME, PartLabel.SHELF, PartLabel.MISC, PartLabel.DOOR),
    PartLabel.SIDE_PANEL: (PartLabel.BACK_PANEL, PartLabel.DOOR, PartLabel.LEG),
    PartLabel.FACE_FRAME: (PartLabel.DOOR, PartLabel.DRAWER, PartLabel.BAR),
    PartLabel.SHELF: (PartLabel.BOTTOM_PANEL, PartLabel.TOP_PANEL, PartLabel.DRAWER),
    PartLabel.HANDLE: (PartLabel.MISC, PartLabel.BAR),
    PartLabel.BAR: (PartLabel.HANDLE, PartLabel.LEG),
    PartLabel.MISC: (PartLabel.HANDLE, PartLabel.BAR, PartLabel.DOOR),
}
Writer = Callable[[Sequence[str]], str]
WRITERS: Final[tuple[Writer, ...]] = (
    "_".join,
    " ".join,
    "-".join,
    lambda said: "".join(word.capitalize() for word in said),
    lambda said: "_".join(word.upper() for word in said),
    lambda said: " ".join(word.capitalize() for word in said),
)
NUMBERS: Final = ("", "_{n}", ".{n:03d}", " {n}", "{n}", "_{n:02d}")


def named(
    given: Asset, true: Mapping[str, PartLabel], scheme: NameScheme, misnamed: bool, rng: np.random.Generator
) -> tuple[Asset, tuple[str, ...]]:
    """Returns what is given of a model, its parts named by a scheme, and the ids of parts that are named for others.

    A part has the label that is read from its name: none where no reader knows the word. Parts whose label is lost get
    names that give none; `true` are the labels of all parts.
    """
    write, number = WRITERS[int(rng.integers(len(WRITERS)))], NUMBERS[int(rng.integers(len(NUMBERS)))]
    piece = PIECES[int(rng.integers(len(PIECES)))] if chance(rng, OF_PIECE) else ""
    program = PROGRAMS[int(rng.integers(len(PROGRAMS)))]

    wrong: list[str] = []

    def one(k: int, part: Part) -> Part:
        n = k + 1
        if part.label is PartLabel.UNKNOWN:
            return _nameless(part, n, true[part.id], program, rng)
        if scheme == "program":
            return _called(part, program.format(n=n))
        label = _mistaken(part.label, rng) if misnamed and chance(rng, WRONG) else part.label
        if label is not part.label:
            wrong.append(part.id)
        if scheme == "ids" and label is part.label:
            return part
        said = _words(label, "English" if scheme == "ids" else scheme, rng)
        if scheme == "English":
            said = ((piece,) if piece else ()) + ((_any(PLACES, rng), *said) if chance(rng, PLACED) else said)
        name = said[0] if scheme == "data set" else write(said)
        name = f"{name}_{n}" if scheme == "data set" else name + number.format(n=n)
        return _read(part, label, name)

    parts = tuple(one(k, part) for k, part in enumerate(given.parts))
    return replace(given, parts=parts), tuple(wrong)


def _read(part: Part, label: PartLabel, name: str) -> Part:
    """Returns a part with a name, and with the label that the name is for if any reader knows it."""
    if label_of(name) is PartLabel.UNKNOWN:
        return replace(_called(part, name), label=PartLabel.UNKNOWN, labelled_by="none")
    return replace(_called(part, name), label=label)


def _nameless(part: Part, n: int, true: PartLabel, program: str, rng: np.random.Generator) -> Part:
    """Returns a part without a label, with a name that gives none."""
    scheme = pick(rng, LOST_WORDS)
    if scheme == "program" or true is PartLabel.UNKNOWN:
        return _called(part, program.format(n=n))
    label = _mistaken(true, rng) if chance(rng, LOST_WRONG) else true
    name = "_".join(_words(label, scheme, rng)) + f"_{n}"
    return _called(part, name if label_of(name) is PartLabel.UNKNOWN else program.format(n=n))


def _called(part: Part, name: str) -> Part:
    return replace(part, source=replace(part.source, name=name))


def _mistaken(label: PartLabel, rng: np.random.Generator) -> PartLabel:
    others = MISTAKEN.get(label, ())
    return others[int(rng.integers(len(others)))] if others else label


def _words(label: PartLabel, scheme: NameScheme, rng: np.random.Generator) -> tuple[str, ...]:
    if scheme == "data set":
        return (_any(DATA_SET[label], rng),)
    if scheme == "foreign":
        return (_any(foreign_words()[label] or english_phrases()[label], rng),)
    said = tuple(_any(english_phrases()[label], rng).split())
    return tuple(_shortened(word, rng) for word in said) if scheme == "short" else said


def _shortened(word: str, rng: np.random.Generator) -> str:
    """Returns a word as people shorten or misspell it."""
    match int(rng.integers(4)):
        case 0:
            return word[0] + "".join(letter for letter in word[1:] if letter not in "aeiou")
        case 1:
            return word[: int(rng.integers(3, 5))]
        case 2:
            k = int(rng.integers(1, len(word)))
            return word[:k] + word[k + 1 :]
        case _:
            k = int(rng.integers(1, len(word)))
            return word[: k - 1] + word[k] + word[k - 1] + word[k + 1 :]


def _any(choices: Sequence[str], rng: np.random.Generator) -> str:
    return choices[int(rng.integers(len(choices)))]


@cache
def english_phrases() -> Mapping[PartLabel, tuple[str, ...]]:
    """Returns the English phrases that give each label."""
    found: dict[PartLabel, list[str]] = {label: [] for label in PartLabel}
    for label, row in TABLE:
        found[label] += [phrase.strip().lstrip("=") for phrase in row.split(",")]
    return {label: tuple(p for p in phrases if label_of(p) is label) for label, phrases in found.items()}


@cache
def foreign_words() -> Mapping[PartLabel, tuple[str, ...]]:
    """Returns the words of other languages that give each label."""
    found: dict[PartLabel, list[str]] = {label: [] for label in PartLabel}
    for word in table(GERMAN, FRENCH, SPANISH, ITALIAN, PORTUGUESE, CHINESE, JAPANESE):
        found[label_of(word)].append(word)
    return {label: tuple(words) for label, words in found.items()}
