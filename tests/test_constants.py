"""Thresholds are fields of configurations: the numbers that stay in modules and functions are listed with a reason.

`tests/additions` and `tests/joints` list those of their folders.
"""

import inspect
import sys
from dataclasses import fields, is_dataclass
from pathlib import Path

import pytest

from grafu.asset.frame import FrontEvidenceConfig
from grafu.asset.scale import ScaleConfig
from grafu.completion.config import DoorRuleConfig, DrawerRuleConfig, GuessConfig, RowConfig, RuleConfig
from grafu.pipeline.verdict import VerdictConfig
from grafu.segmentation.config import (
    CandidateConfig,
    DivisionConfig,
    FrameConfig,
    FurnitureConfig,
    MemberConfig,
    SegmentationConfig,
)
from module_numbers import explained_fields, factors_in_functions, floats_in_functions, modules_of, named_numbers

SOURCES = Path(__file__).parents[1] / "src" / "grafu"

SAMPLES = "how many rays an algorithm takes, or where they lie"
TOLERANCE = "a tolerance of computing with rounded numbers"
NUMBERING = "numbers of directions or of groups, or a direction"
VOTES = "the weight of a vote: weights were set together, against each other, and one alone means nothing"
FRAME = "it settles the frame of a front or of a border, which joints and additions share: each must see the same"
SHARED = "one answer for all: joints, additions and pages must not differ in it"
SOLD = "a table of sizes of furniture as sold, or of units of length"
WORDS = "how many names a sentence has"

OF_MODULES = {
    "asset": {"frame.py": {}, "scale.py": {"STORAGE": SOLD, "TABLE": SOLD, "UNITS": SOLD}},
    "scene": {
        "border.py": {"SNAP": FRAME, "_THIN_BOARD": FRAME},
        "front.py": {"_TILTED": FRAME, "_SLIDES": FRAME, "_PANEL": FRAME, "_LYING": FRAME},
        "scale.py": {"_COMMON": SHARED},
    },
    "segmentation": {
        "candidates.py": {"_NO_AREA": TOLERANCE},
        "division.py": {"_Z": NUMBERING},
        "fronts.py": {"_RING_CELLS": SAMPLES},
        "furniture_pieces.py": {"FLOOR_OR_WALL": NUMBERING, "ALONE": NUMBERING},
        "view.py": {"_RAYS": SAMPLES, "_FAR": SAMPLES, "_MANY": SAMPLES, "_SPARE": TOLERANCE},
    },
    "completion": {
        "doors.py": {},
        "drawers.py": {"_DIRECTIONS": NUMBERING},
        "handles.py": {},
        "rows.py": {},
        "rule.py": {"_FRONTS": NUMBERING},
        "rule_scene.py": {"CARRIES": VOTES, "_FLAT": TOLERANCE},
        "votes.py": {"_PRIOR": VOTES},
    },
    "pipeline": {"verdict.py": {"_NAMED": WORDS}, "triage.py": {}},
}
IN_FUNCTIONS = {
    "asset": {"frame.py": {}, "scale.py": {}},
    "scene": {"border.py": {}, "front.py": {}, "scale.py": {}},
    "segmentation": {
        "candidates.py": {},
        "division.py": {},
        "fronts.py": {6: TOLERANCE},
        "furniture_pieces.py": {},
        "view.py": {0.4871: SAMPLES, 0.5113: SAMPLES},
    },
    "completion": {
        "doors.py": {
            **dict.fromkeys((0.1, 0.2, 0.7, 0.8, 0.9, 1.5, 2.5, 3.0, 4.0, 6.0), VOTES),
            5: NUMBERING,  # upwards; also a weight
        },
        "drawers.py": dict.fromkeys((0.3, 0.6, 1.5, 3.0, 4.0, 5.0), VOTES),
        "handles.py": dict.fromkeys((0.002, 0.01), VOTES),
        "rows.py": {},
        "rule.py": {},
        "rule_scene.py": {},
        "votes.py": {},
    },
    "pipeline": {"verdict.py": {1000: "millimetres of a metre"}, "triage.py": {}},
}
CONFIGS = (
    CandidateConfig, DivisionConfig, DoorRuleConfig, DrawerRuleConfig, FrameConfig, FrontEvidenceConfig,
    FurnitureConfig, GuessConfig, MemberConfig, RowConfig, RuleConfig, ScaleConfig, SegmentationConfig, VerdictConfig,
)  # fmt: skip
NUMBERS = [(kind, f.name) for kind in CONFIGS for f in fields(kind) if not is_dataclass(f.default)]


@pytest.mark.parametrize("folder", OF_MODULES)
def test_no_threshold_stands_in_a_module(folder: str) -> None:
    found = named_numbers(SOURCES / folder)

    assert {name: found.get(name, set()) for name in OF_MODULES[folder]} == {
        name: set(reasons) for name, reasons in OF_MODULES[folder].items()
    }


@pytest.mark.parametrize("folder", ["scene", "segmentation"])
def test_all_modules_of_a_folder_are_looked_at(folder: str) -> None:
    assert named_numbers(SOURCES / folder).keys() == OF_MODULES[folder].keys()


@pytest.mark.parametrize("folder", IN_FUNCTIONS)
def test_no_threshold_stands_in_a_function(folder: str) -> None:
    sources = modules_of(SOURCES / folder)
    found = {
        name: {*floats_in_functions(sources[name]), *factors_in_functions(sources[name])}
        for name in IN_FUNCTIONS[folder]
    }

    assert found == {name: set(reasons) for name, reasons in IN_FUNCTIONS[folder].items()}


@pytest.mark.parametrize("kind", CONFIGS, ids=lambda kind: kind.__name__)
def test_every_field_has_a_line_that_explains_it(kind: type) -> None:
    source = inspect.getsource(sys.modules[kind.__module__])

    assert explained_fields(source, kind.__name__) == {field.name for field in fields(kind)}


@pytest.mark.parametrize(("kind", "name"), NUMBERS)
def test_a_number_that_is_not_above_0_is_refused(kind: type, name: str) -> None:
    default = getattr(kind(), name)
    wrong = (*default[:-1], 0.0) if isinstance(default, tuple) else type(default)(0)

    with pytest.raises(ValueError, match=f"`{kind.__name__}.{name}` must be"):
        kind(**{name: wrong})
