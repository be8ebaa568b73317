"""Thresholds of additions are fields of configurations: the numbers that stand in modules are listed with a reason."""

from pathlib import Path

import pytest

from module_numbers import factors_in_functions, floats_in_functions, modules_of, named_numbers, numbers_in

ADDITIONS = Path(__file__).parents[2] / "src" / "grafu" / "additions"

SAMPLES = "how many rays, cells, poses or pieces an algorithm takes, or where in a face they lie"
TOLERANCE = "a tolerance of computing with rounded numbers, no size of furniture"
SHAPE = "how exactly an outline is drawn, and when it is taken as a simpler one; relative to the outline itself"
WORDS = "how many names a sentence has"
NUMBERING = "numbers of axes, of faces and of steps between cells"
LIMIT = "the most that an input may ask for, or that is computed in a reasonable time"
GLASS = "textures of unknown size: of materials, not of furniture, and the same for all steps"

REASONS = {
    "carcass/bays.py": {"FRONT_HEIGHTS": SAMPLES, "DEPTHS": SAMPLES, "FINE_DEPTHS": SAMPLES},
    "carcass/complete.py": {
        "RAY_SPREAD": SAMPLES,
        "PIECES": SAMPLES,
        "FINE_PIECES": SAMPLES,
        "WITHIN": TOLERANCE,
    },
    "carcass/missing_panels.py": {"RAY_GRID": SAMPLES, "NAMED": WORDS},
    "compartment/complete.py": {"_LINING": NUMBERING},
    "compartment/solid.py": {"RAYS": SAMPLES, "PLACES": SAMPLES, "_Y": NUMBERING},
    "door_frame/complete.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING},
    "drawer_box/boards.py": {
        "RAYS_PER_SIDE": SAMPLES,
        "SPREAD": SAMPLES,
        "WHOLE_SPREAD": SAMPLES,
        "WALL_HEIGHTS": SAMPLES,
    },
    "drawer_box/room.py": {
        "COLUMNS": SAMPLES,
        "SLICES": SAMPLES,
        "DEPTH_QUANTILES": SAMPLES,
        "SAME_DEPTH": TOLERANCE,
    },
    "drawer_box/verdict.py": {"COLUMNS": SAMPLES, "FACE_RAYS": SAMPLES, "LEVELS": SAMPLES, "RAY_START": TOLERANCE},
    "grip/carve.py": {"BOX_TOLERANCE": TOLERANCE},
    "grip/ground.py": {"ASIDE": TOLERANCE, "OUTERMOST_LINES": SAMPLES},
    "grip/place.py": {"LINES": SAMPLES},
    "grip/shape.py": {
        "QUARTER_EDGES": SAMPLES,
        "TURN_EDGES": SAMPLES,
        "RIM_TRACE": TOLERANCE,
        "DIGITS": TOLERANCE,
        "BOTTOM_LEVELS": SAMPLES,
        "RIM_SLICES": SAMPLES,
        "LEVEL_TOLERANCE": TOLERANCE,
    },
    "handle/config.py": {"MOST_HANDLES": LIMIT},
    "handle/grasp.py": {"_UP": NUMBERING},
    "handle/finger_room.py": {"OPPOSITE_STEPS": NUMBERING, "STEPS": NUMBERING, "EDGE_CELLS": SAMPLES},
    "handle/fit.py": {"SAME_SURFACE": TOLERANCE, "MOST_FOOT_POINTS": SAMPLES},
    "handle/grips.py": {"CLUSTER_CELLS": SAMPLES},
    "handle/relief.py": {"MOST_CELLS": SAMPLES, "ALL_CELLS": SAMPLES, "UNSEEN": TOLERANCE},
    "handle/spots.py": {"TURNS": NUMBERING},
    "interior/arrangement.py": {"FLAT": TOLERANCE},
    "interior/carousel.py": {"QUARTER_EDGES": SAMPLES, "POST_EDGES": SAMPLES},
    "interior/faces.py": {
        "RIM_STEPS": SAMPLES,
        "RIM_LEVELS": SAMPLES,
        "RIM_REACH": SAMPLES,
        "RAYS_PER_SIDE": SAMPLES,
        "RAY_SPAN": SAMPLES,
        "FACE_CELLS": SAMPLES,
        "PART_CELLS": TOLERANCE,
    },
    "interior/occupied.py": {"POINT_SPACING": SAMPLES, "ASKEW_SPACING": SAMPLES, "ALONG": TOLERANCE},
    "interior/outline.py": {
        "REGION_CELLS": SAMPLES,
        "SECTION_LEVELS": SAMPLES,
        "LINE": TOLERANCE,
        "PLAIN": TOLERANCE,
        "AT_WALL": TOLERANCE,
        "OPEN": TOLERANCE,
        "CIRCLE": TOLERANCE,
    },
    "interior/panels.py": {
        "RAYS_ALONG_EDGE": SAMPLES,
        "EDGE_MARGIN": SAMPLES,
        "EDGE_LEVELS": SAMPLES,
        "ALIKE": SHAPE,
        "CORNERS": NUMBERING,
        "FLAT": TOLERANCE,
    },
    "interior/request.py": {"MOST_PANELS": LIMIT, "MOST_ANGLE": LIMIT, "MOST_TRAYS": LIMIT},
    "interior/rooms.py": {
        "FRONTS": NUMBERING,
        "LID": NUMBERING,
        "LEAST_WALLS": NUMBERING,
        "SIDE_AXES": NUMBERING,
        "FRONT_FACES": NUMBERING,
    },
    "interior/turned.py": {"LEAST_STRAIGHT": SHAPE},
    "likeness.py": {"DEFAULT_TEXTURE_DENSITY": GLASS},
    "top/complete.py": {"NARROWEST_GROOVE": SHAPE, "GROOVE_DETAIL": SHAPE, "RECTANGLE": SHAPE},
    "top/cutouts.py": {"SWEEP_POSES": SAMPLES, "ROUNDED_UP": TOLERANCE},
    "top/sloping.py": {"TOUCH": TOLERANCE},
    "top/height_map.py": {
        "(_ALL, _FIRST, _LAST)": NUMBERING,
        "LEAST_UPRIGHT_PART": TOLERANCE,
        "BORDER_TOLERANCE": TOLERANCE,
        "CELLS_AT_ONCE": LIMIT,
    },
    "top/outline.py": {"ALONG_AXES": SHAPE, "SPECK": SAMPLES},
    "top/section.py": {
        "LEAST_SPREAD": TOLERANCE,
        "SMALL": SHAPE,
        "MOST_CORNER": SHAPE,
        "SIDES": NUMBERING,
        "SHORTEST_LINE": TOLERANCE,
        "MOST_LINES": LIMIT,
        "MITRE_LIMIT": TOLERANCE,
        "ROUNDINGS": TOLERANCE,
        "SHORTEST_EDGE": TOLERANCE,
        "ARC_EDGES": SAMPLES,
        "ROUND_EDGES": SAMPLES,
    },
    "top/supports.py": {"ALONG_AXES": SHAPE, "CELL_INSET": SAMPLES},
    "top/views.py": {
        "VIEW_CELLS": SAMPLES,
        "PLAN_CELLS": SAMPLES,
        "VIEWING_DIRECTIONS": NUMBERING,
        "SEEN_POINTS": SAMPLES,
    },
}

IN_FUNCTIONS = {
    "carcass/complete.py": {3: NUMBERING},
    "handle/grips.py": {1.2: TOLERANCE},  # cells: what lies on a border
    "handle/spots.py": {0.25: SAMPLES, 0.75: SAMPLES},  # the middles of two halves
    "interior/compartments.py": {5: NUMBERING, 6: NUMBERING},
    "interior/faces.py": {6: NUMBERING},
    "interior/rooms.py": {3: NUMBERING, 5: NUMBERING, 6: NUMBERING},
}


@pytest.mark.parametrize(
    ("source", "names"),
    [
        ("NEAR = 0.3", ["NEAR"]),
        ("NEAR: float = -0.3", ["NEAR"]),
        ("A, B = 1, 2", ["(A, B)"]),
        ("HEIGHTS = np.linspace(0.1, x, n)", ["HEIGHTS"]),
        ("NAMES = ('a', 'b')\nOPEN = True\nCONFIG = Config()", []),
        ("def f():\n    near = 0.3", []),
    ],
)
def test_a_number_of_a_module_is_found(source: str, names: list[str]) -> None:
    assert list(numbers_in(source)) == names


def test_a_number_of_a_function_is_found() -> None:
    source = (
        "NEAR = 0.3\ndef f():\n    a = 0.5 * 0.25 + 1e-9\n    return max(a, 2)\nclass A:\n    def g(self): return 0.7"
    )
    assert list(floats_in_functions(source)) == [0.25, 0.7]


@pytest.mark.parametrize(
    ("line", "numbers"),
    [
        ("return 4 * gap", [4]),
        ("return gap > 3", [3]),
        ("return radians(3)", [3]),
        ("return is_free(body, 12)", [12]),
        ("return 2 * gap / 2 + T[:3, 3] @ np.eye(4)", []),
    ],
)
def test_a_whole_number_of_a_function_is_found(line: str, numbers: list[int]) -> None:
    assert list(factors_in_functions(f"POSES = 12\ndef f(gap):\n    {line}")) == numbers


def test_no_threshold_stands_in_a_module() -> None:
    assert named_numbers(ADDITIONS) == {name: set(reasons) for name, reasons in REASONS.items()}


@pytest.mark.parametrize("name", modules_of(ADDITIONS))
def test_no_threshold_stands_in_a_function(name: str) -> None:
    source = modules_of(ADDITIONS)[name]
    found = {*floats_in_functions(source), *factors_in_functions(source)}

    assert found == set(IN_FUNCTIONS.get(name, {}))
