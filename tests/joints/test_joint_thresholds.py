"""Thresholds of joints are fields of configurations: the numbers that stand in modules are listed with a reason."""

import inspect
import sys
from dataclasses import fields, replace
from pathlib import Path

import pytest

from grafu.joints.box_flaps import BoxFlapConfig
from grafu.joints.boxes_behind import BoxBehindConfig
from grafu.joints.building_doors import BuildingDoorConfig
from grafu.joints.clearance_config import ClearanceConfig
from grafu.joints.concealed_config import ConcealedConfig
from grafu.joints.config import BlockConfig, RealizationConfig, TimeConfig
from grafu.joints.door_grips import DoorGripConfig
from grafu.joints.drawn_across import DrawnAcrossConfig
from grafu.joints.drawn_arm_config import DrawnArmConfig
from grafu.joints.drawn_config import DrawnConfig
from grafu.joints.drop_leaves import DropLeafConfig
from grafu.joints.drop_support_config import DropSupportConfig
from grafu.joints.extension_leaves import ExtensionConfig
from grafu.joints.fold_config import FoldConfig
from grafu.joints.hinge.candidates import hinge_count
from grafu.joints.hinge_config import FootingConfig, HingeConfig, PinConfig, PivotConfig, SurveyConfig
from grafu.joints.hung_parts import HungPartsConfig
from grafu.joints.lever_config import LeverConfig
from grafu.joints.lift_arm_config import LiftArmConfig
from grafu.joints.on_lids import OnLidConfig
from grafu.joints.plan import PlanConfig
from grafu.joints.portholes import PortholeConfig
from grafu.joints.pull_outs import PullOutConfig
from grafu.joints.rack_guide_config import RackGuideConfig
from grafu.joints.racks import RackConfig
from grafu.joints.rail.in_case import InCaseConfig
from grafu.joints.rail_config import (
    BehindConfig,
    BodyConfig,
    ClosingConfig,
    DrawerConfig,
    FlankConfig,
    RailConfig,
)
from grafu.joints.rail_footing_config import RailFootingConfig
from grafu.joints.raised_leaves import RaisedLeafConfig
from grafu.joints.ring_seats import SeatPairConfig
from grafu.joints.screens import ScreenConfig
from grafu.joints.sliding_panes import SlidingPaneConfig
from grafu.joints.stay_config import StayConfig
from grafu.joints.swivel_mirrors import MirrorConfig
from grafu.joints.swivels import SwivelConfig
from grafu.joints.tilting_fronts import TiltConfig
from grafu.joints.trays import TrayConfig
from grafu.joints.waste_bins import WasteBinConfig
from grafu.joints.wide_bars import WideBarConfig
from grafu.joints.wide_door_config import WideDoorConfig
from grafu.joints.window_config import WindowConfig
from module_numbers import explanations, factors_in_functions, floats_in_functions, modules_of, named_numbers

JOINTS = Path(__file__).parents[2] / "src" / "grafu" / "joints"

SAMPLES = "how many rays, poses, heights or pieces an algorithm takes, or where they lie"
TOLERANCE = "a tolerance of computing with rounded numbers, no size of furniture"
EFFORT = "after how many tries, or beyond how many pieces, a search ends or is done in a simpler way"
NUMBERING = "the rank of a row in a table, or a direction"
OUTLINE = "what tells a board from a box where a user states how it moves"
LOOK = "the colour of hardware"
GEOMETRY = "a number of geometry: what folds ends in the plane of the opening"
KEPT = "how much of what was worked out is kept: less costs time and changes no result"
CHOICE = "the range of what a user may choose"

REASONS = {
    "framed_leaves.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING},
    "gaps.py": {"_POSES": SAMPLES, "_TOUCHING": TOLERANCE},
    "known.py": {"MOST_KNOWN": KEPT},
    "no_hardware.py": {"_DEPTHS": SAMPLES, "_TRAVELS": SAMPLES, "_POSES": SAMPLES, "_RAYS": SAMPLES},
    "clearance/carve.py": {
        "_TURN_STEP": SAMPLES,
        "_MOST_PLANES": EFFORT,
        "MOST_SOLIDS": EFFORT,
        "_FEW_SOLIDS": EFFORT,
        "_SURE": TOLERANCE,
        "_SAMPLES": SAMPLES,
    },
    "clearance/behind.py": {"_KEPT": EFFORT, "_STEPS": EFFORT},
    "clearance/sunk.py": {"_SAMPLES": SAMPLES, "_STEPS": EFFORT},
    "clearance/in_frame.py": {"GAPS": EFFORT, "WIDE_GAPS": EFFORT},
    "clearance/seam.py": {"_POSES": SAMPLES},
    "clearance/make.py": {"_FINELY": EFFORT, "_STEPS": EFFORT},
    "beside_leaf.py": {"_UP": NUMBERING, "_RAYS": SAMPLES, "_UPRIGHT": NUMBERING},
    "boxes_behind.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING, "_OUT": NUMBERING, "_RAYS": SAMPLES},
    "building_doors.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING, "_RAYS": SAMPLES},
    "clearance/loss.py": {
        "_MOST_EXACT": EFFORT,
        "_FEW_EXACT": EFFORT,
        "_POINTS": SAMPLES,
        "_FEW_POINTS": SAMPLES,
        "_FAR": TOLERANCE,
        "_PLASTIC": GEOMETRY,
    },
    "clearance/separate.py": {"_SAMPLES": SAMPLES},
    "clearance/trim.py": {"_FIRST_STEP": SAMPLES, "_ON_BACK": TOLERANCE},
    "closing.py": {"_ALONG": SAMPLES, "_SIDES": NUMBERING},
    "drawn_across.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING},
    "drawn_arms.py": {"_UP": NUMBERING},
    "barrels.py": {"_ALONG": EFFORT, "_POINT": TOLERANCE, "_CORNERS": NUMBERING},
    "drop_leaves.py": {"_UP": NUMBERING},
    "drop_supports.py": {"_UP": NUMBERING, "_QUARTER": GEOMETRY},
    "door_grips.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING},
    "door_levers.py": {"(_ACROSS, _DEPTH, _UP)": NUMBERING, "_UPRIGHT": NUMBERING},
    "extension_leaves.py": {"_UP": NUMBERING},
    "lifts.py": {"_LEVEL": NUMBERING},
    "raised_leaves.py": {"_UP": NUMBERING, "_SIDES": NUMBERING},
    "swivel_mirrors.py": {"_UP": NUMBERING},
    "wide_bars.py": {"_UP": NUMBERING},
    "closing_doors.py": {"_ALONG": SAMPLES},
    "coupled.py": {"_ALIKE": TOLERANCE},
    "folding.py": {"_TWICE": GEOMETRY},
    "fold_track.py": {"_POSES": SAMPLES, "_RAYS": SAMPLES, "_ACROSS": SAMPLES},
    "corner_leaves.py": {"_OF_SECOND": SAMPLES},
    "leaves.py": {"UP": NUMBERING, "_UP": NUMBERING},
    "shown_folds.py": {"_PAIRS": NUMBERING},
    "hinge/candidates.py": {"(PIVOTS, MAKESHIFT)": NUMBERING, "_HEIGHT_SHIFTS": SAMPLES},
    "hinge/hardware.py": {"_POSES": SAMPLES},
    "hinge/neighbours.py": {"_POSES_OF_OTHERS": SAMPLES},
    "hinge/place.py": {"_FEWEST": EFFORT, "_ENOUGH": EFFORT, "_STRUCK": EFFORT},
    "lift_arms.py": {"_SIDES": NUMBERING, "_ROUND": SAMPLES, "_QUARTER": SAMPLES},
    "parallel_lifts.py": {"_NEAR": TOLERANCE},
    "limits.py": {
        "_REST_DENSITY": SAMPLES,
        "_DIP": TOLERANCE,
        "_BOX_POSES": SAMPLES,
        "_BETWEEN": SAMPLES,
        "_HALVINGS": SAMPLES,
    },
    "box_flaps.py": {"_UP": NUMBERING, "_RAYS": SAMPLES},
    "plate_edges.py": {"_UP": NUMBERING},
    "ring_seats.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING, "_RAYS": SAMPLES},
    "lone_leaves.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING},
    "measuring.py": {"_MEASURED_POSES": SAMPLES},
    "motion_choice.py": {"_BOARD": OUTLINE, "_LEVEL": TOLERANCE, "DIRECTIONS": NUMBERING},
    "order.py": {"_RATIOS": SAMPLES},
    "plan.py": {"SCALES": CHOICE, "MOST_HINGES": CHOICE},
    "portholes.py": {"_DEPTH": NUMBERING, "_ACROSS": NUMBERING},
    "hung_parts.py": {"_DEPTH": NUMBERING, "_ACROSS": NUMBERING},
    "pull_outs.py": {"(_UP, _DEPTH)": NUMBERING, "_OUT": NUMBERING},
    "racks.py": {"(_UP, _DEPTH)": NUMBERING, "_RAYS": SAMPLES},
    "rail/body_region.py": {"(_SLIDE, _HEIGHT)": SAMPLES, "_FINER": SAMPLES},
    "sliding_doors.py": {"_UP": NUMBERING},
    "sliding_panes.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING},
    "screens.py": {"_WIDTH": NUMBERING, "_DEPTH": NUMBERING, "_UP": NUMBERING},
    "on_lids.py": {"_UP": NUMBERING},
    "swivels.py": {"_UP": NUMBERING},
    "trays.py": {"(_ACROSS, _DEPTH, _UP)": NUMBERING},
    "stays.py": {"_SIDES": NUMBERING},
    "small_parts.py": {"_UP": NUMBERING},
    "windows.py": {"(_WIDTH, _DEPTH, _UP)": NUMBERING, "_RAYS": SAMPLES},
    "tilting_fronts.py": {"(_UP, _DEPTH)": NUMBERING, "_RAYS": SAMPLES},
    "behind_fronts.py": {"_DEPTH": NUMBERING, "_ACROSS": NUMBERING, "_AS_DEEP": "as deep as another"},
    "waste_bins.py": {"(_UP, _DEPTH)": NUMBERING, "_OUT": NUMBERING, "_RAYS": SAMPLES},
    "support_block.py": {"WOOD": LOOK, "METAL": LOOK, "_GRID": SAMPLES, "_STEPS": SAMPLES, "_ON_LEAF": SAMPLES},
}
CONFIGS = (
    BehindConfig, BlockConfig, BodyConfig, BoxBehindConfig, BuildingDoorConfig, ClearanceConfig, ClosingConfig,
    ConcealedConfig,
    DoorGripConfig, DrawerConfig, DrawnAcrossConfig, DrawnConfig, DropLeafConfig, DropSupportConfig, ExtensionConfig,
    FlankConfig, FoldConfig,
    DrawnArmConfig, FootingConfig, HingeConfig, HungPartsConfig, InCaseConfig,
    LeverConfig, LiftArmConfig, MirrorConfig, PinConfig, PivotConfig,
    BoxFlapConfig, OnLidConfig, ScreenConfig, SeatPairConfig, SlidingPaneConfig, SwivelConfig,
    PlanConfig, PortholeConfig, PullOutConfig, RackConfig, RackGuideConfig, RailConfig, RailFootingConfig,
    RaisedLeafConfig,
    RealizationConfig,
    StayConfig, SurveyConfig, TiltConfig, TimeConfig, TrayConfig, WasteBinConfig, WideBarConfig, WideDoorConfig,
    WindowConfig,
)  # fmt: skip


def test_no_threshold_stands_in_a_module() -> None:
    assert named_numbers(JOINTS) == {name: set(reasons) for name, reasons in REASONS.items()}


@pytest.mark.parametrize("name", modules_of(JOINTS))
def test_no_threshold_stands_in_a_function(name: str) -> None:
    source = modules_of(JOINTS)[name]

    assert [*floats_in_functions(source), *factors_in_functions(source)] == []


@pytest.mark.parametrize("kind", CONFIGS, ids=lambda kind: kind.__name__)
def test_every_field_has_a_line_that_explains_it(kind: type) -> None:
    source = inspect.getsource(sys.modules[kind.__module__])

    assert set(explanations(source, kind.__name__)) == {field.name for field in fields(kind)}


@pytest.mark.parametrize(
    ("kind", "name"),
    [(kind, field.name) for kind in CONFIGS for field in fields(kind) if field.type in (float, int)],
    ids=lambda value: value if isinstance(value, str) else value.__name__,
)
def test_a_number_below_0_is_refused(kind: type, name: str) -> None:
    with pytest.raises(ValueError, match=name if not name.endswith("poses") else "poses"):
        replace(kind(), **{name: type(getattr(kind(), name))(-1)})


@pytest.mark.parametrize(("length", "count"), [(0.3, 2), (0.9, 2), (0.91, 3), (1.5, 3), (2.1, 4)])
def test_the_number_of_hinges_follows_the_length(length: float, count: int) -> None:
    assert hinge_count(length, HingeConfig()) == count
    assert hinge_count(2 * length, HingeConfig(two_up_to=1.8, one_more_per=1.2)) == count


@pytest.mark.parametrize("kind", CONFIGS, ids=lambda kind: kind.__name__)
def test_what_a_models_scale_multiplies_is_what_is_explained_as_metres(kind: type) -> None:
    source = inspect.getsource(sys.modules[kind.__module__])
    lines = explanations(source, kind.__name__)

    assert set(getattr(kind, "LENGTHS", ())) == {name for name, line in lines.items() if "(metres" in line}
