"""Thresholds of simulation shapes and of measures are fields of configurations; other numbers have a reason."""

from pathlib import Path

import pytest

from grafu.articulation.convex_pieces import ConvexPieceConfig, convex_pieces
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.judging.tops import TopMeasureConfig
from module_numbers import named_numbers

SOURCE = Path(__file__).parents[2] / "src" / "grafu"

SAMPLES = "how many rays, cells, poses or directions an algorithm takes"
TOLERANCE = "a tolerance of computing with rounded numbers, no size of furniture"
EFFORT = "after how many tries a search ends, or how much is done in a simpler way"
UNIT = "a unit, a constant of mathematics, or a row of a table"
MEASURE = "the definition of a measure, as the paper, docs/metrics.md or docs/evaluation.md state it"
PHYSICS = "a constant of physics, or the density of a material"
TEXT = "a bound of what is read, shown or sent as text, or a number of a protocol"
GRIPPER = "a size of the gripper whose grasp frames docs/conventions.md describes"

REASONS = {
    "articulation": {
        "articulated_object.py": {"_ALIKE": TOLERANCE},
        "board_holes.py": {
            "MOST_FACES": EFFORT,
            "MOST_HOLES": EFFORT,
            "SLIM": TOLERANCE,
            "SMALL": TOLERANCE,
            "FREE": TOLERANCE,
            "_FEW": EFFORT,
            "_NEAR": TOLERANCE,
        },
        "build_material.py": dict.fromkeys(("_BY_WORD", "_GLASS", "_STEEL", "_TEXTILE"), PHYSICS),
        "collision_shapes.py": {"_DENSE": EFFORT},
        "convex_pieces.py": {"_DIRECTIONS": SAMPLES, "_HULL_CORNERS": SAMPLES, "_GRID": SAMPLES, "_TRIES": EFFORT},
        "coupled_weight.py": {"_STEP": SAMPLES, "_EXACT": TOLERANCE, "_AT": SAMPLES},
        "finger_fit.py": dict.fromkeys(("_ACROSS", "_LEVELS", "_ON_FINGER", "_PLACES"), SAMPLES)
        | {"_LOOKED_AT": EFFORT, "_ROUNDING": TOLERANCE},
        "grasp_frame.py": dict.fromkeys(("FINGER_GAP", "FINGER_REACH", "FINGER_THICKNESS", "FINGER_WIDTH"), GRIPPER)
        | {"_RIGHT_ANGLE": TOLERANCE},
        "floor_clearance.py": {"_LEVEL": TOLERANCE, "_NOTHING": TOLERANCE},
        "grip_point.py": {"_EDGE": TOLERANCE},
        "kinematics.py": {"_ALIKE": TOLERANCE, "REST": UNIT},
        "level_feet.py": {"_UPRIGHT": TOLERANCE},
        "mass.py": {"NO_MOMENTS": UNIT},
        "motion_kind.py": {"_A_LITTLE": SAMPLES, "_DEGREES": UNIT, "_CENTIMETRES": UNIT, "_ROWS": UNIT},
        "open_together.py": {"_STEPS": SAMPLES},
        "counterbalance.py": {"GRAVITY": PHYSICS},
        "stability.py": {"_LEAST_ARM": TOLERANCE},
        "physics.py": {"(_MASSES, _PIECES, _CLEARANCE, _CONTACTS)": EFFORT},
    },
    "simulation": {
        "clip.py": dict.fromkeys(("_COLOURS", "_MILLISECONDS", "_SIZE"), UNIT),
        "pulls.py": dict.fromkeys(("_ABOVE", "_EDGE", "_FULL"), TOLERANCE)
        | dict.fromkeys(("_CONTROL", "_SLOT"), SAMPLES),
        "world.py": {"_AWAY": UNIT},
    },
    "metrics": {
        "collision.py": {"TOLERANT": MEASURE},
        "graph_accuracy.py": {"NEAR": MEASURE, "_DISTANCE_WEIGHT": MEASURE},
        "motion.py": {"ANGLE": MEASURE},
    },
    "judging": {
        "handles.py": {"POSES": SAMPLES},
        "outlined.py": {
            "ALIKE": TOLERANCE,
            "CARRIED": MEASURE,
            "SAMPLES": SAMPLES,
            "SPECK": TOLERANCE,
            "CORNERS": UNIT,
        },
        "panels.py": {"POSES": SAMPLES},
        "tops.py": {"_DIRECTIONS": SAMPLES, "_CELLS": SAMPLES, "_SIDES": SAMPLES},
    },
    "evaluation": {
        "bootstrap.py": dict.fromkeys(("LEVEL", "RESAMPLES", "SEED", "_BLOCK"), SAMPLES),
        "completeness.py": dict.fromkeys(("SKIN", "_PANELS"), MEASURE),
        "config_file.py": {"_MOST_BYTES": TEXT},
        "curves.py": dict.fromkeys(("_PANEL", "_ROOM", "_TICKS"), UNIT),
        "dataset.py": dict.fromkeys(("TEST_SEED", "_DEEPEST", "_MOST_MADE", "_TEST_COUNT"), SAMPLES),
        "dataset_release.py": {"DRAWER_RANGE": MEASURE, "DOOR_RANGE": MEASURE, "_FITS": TOLERANCE},
        "distribution.py": {"TRAINING_COUNT": SAMPLES, "TRAINING_SEED": SAMPLES},
        "llm/config.py": {"EXAMPLES_SEED": SAMPLES},
        "llm/conversation.py": {"_LONGEST": TEXT},
        "llm/endpoint.py": dict.fromkeys(("_BUSY", "_LEAST_SECRET", "_REFUSED", "_SERVER"), TEXT),
        "llm/graph_text.py": {"_DIGITS": TEXT},
        "llm/reply_json.py": {"_MOST_BYTES": TEXT, "_MOST_STARTS": EFFORT},
        "measures.py": {"OPENS": MEASURE},
        "methods.py": {"LEVELS": MEASURE},
        "motion_table.py": dict.fromkeys(
            (
                "(TOPLESS, WITH_ROOMS, WITHOUT_ROOMS)",
                "(TOPS, HANDLES_BEFORE, HANDLES, INTERIORS)",
                "MASKING",
                "MODELS",
                "MOTION",
                "OUTCOMES",
            ),
            UNIT,
        ),
        "moving_parts.py": dict.fromkeys(("DEPTH_RATIO", "IN_PLANE", "LARGEST", "WIDEST_TURN"), MEASURE),
        "output.py": {"TOP": UNIT},
        "pictures.py": dict.fromkeys(("MOST", "SIZE", "_FAULTY", "_LETTERS"), UNIT),
        "plausible.py": dict.fromkeys(("(_LINE_POINTS, _SAMPLES)", "_POSES"), SAMPLES)
        | dict.fromkeys(("HELD", "LEVER", "NEAR"), MEASURE),
        "programs/running.py": {"_SAID": TEXT},
        "records.py": {"_MOST_BYTES": EFFORT},
        "static_table.py": {"OPEN": MEASURE},
        "statistics.py": dict.fromkeys(
            ("(_LOW, _HIGH)", "_CHANCE", "_GROUP", "_GROUPS", "_INSIDE", "_ROUNDING"), SAMPLES
        ),
        "statistics_fronts.py": dict.fromkeys(("_BELOW", "_LEVEL", "_THIRDS"), MEASURE)
        | {"_GRID": SAMPLES, "_UP": UNIT},
        "statistics_measures.py": {"_FLAT": TOLERANCE},
        "still_picture.py": {"SIZE": UNIT},
        "welded.py": {"SAME": MEASURE, "_AS_IT_IS": UNIT, "_FLAT": TOLERANCE},
        "tasks.py": {"_SMALL": EFFORT},
        "twins.py": dict.fromkeys(("ALIKE", "ON", "SAME_BOX"), MEASURE) | {"_POINTS": SAMPLES},
        "usage_table.py": {"_MILLION": UNIT},
    },
}


@pytest.mark.parametrize("folder", REASONS)
def test_no_threshold_stands_in_a_module(folder: str) -> None:
    assert named_numbers(SOURCE / folder) == {name: set(why) for name, why in REASONS[folder].items()}


def test_specks_are_what_the_config_states() -> None:
    boxes = [((0.0, 0.0, 0.0), (0.6, 0.4, 0.02)), ((0.3, 0.2, 0.3), (0.31, 0.21, 0.31))]
    mesh = merge_meshes([TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high))) for low, high in boxes])
    diagonal = 0.01 * 3**0.5

    assert len(convex_pieces(mesh, ConvexPieceConfig(speck=0.9 * diagonal))) == 2
    assert len(convex_pieces(mesh, ConvexPieceConfig(speck=1.1 * diagonal))) == 1


@pytest.mark.parametrize(
    ("kind", "name", "value"),
    [(ConvexPieceConfig, "speck", 0.0), (ConvexPieceConfig, "tolerance", -1.0), (TopMeasureConfig, "near", 1.0)],
)
def test_a_number_that_makes_no_sense_is_refused(kind: type, name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"{kind.__name__}.{name}"):
        kind(**{name: value})
