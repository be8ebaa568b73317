"""Thresholds are fields of configurations: the numbers that stay in modules and functions are listed with a reason.

`tests/additions` and `tests/joints` list those of their folders.
"""

import inspect
import sys
from dataclasses import fields, is_dataclass
from pathlib import Path

import pytest

from grafu.articulation.build_material import MassConfig
from grafu.articulation.catch import CatchConfig
from grafu.articulation.finger_fit import FingerFitConfig
from grafu.articulation.finger_room import FingerRoomCutConfig
from grafu.articulation.joint_dynamics import DynamicsConfig
from grafu.asset.animated_bodies import AnimatedMotionConfig
from grafu.asset.appliance_fronts import ApplianceFrontConfig
from grafu.asset.boarded_drawers import BoardedDrawerConfig
from grafu.asset.bodies_of_faces import BodiesOfFacesConfig
from grafu.asset.body_kinds import BodyKindConfig
from grafu.asset.body_link import BodyLinkConfig
from grafu.asset.cad_names import CadNamesConfig
from grafu.asset.closed_side import ClosedSideConfig
from grafu.asset.cutting import CutConfig
from grafu.asset.door_frames import FramedDoorsConfig
from grafu.asset.drafts import GroupConfig
from grafu.asset.drawn_cuts import DrawnCutConfig
from grafu.asset.facing_groups import FacingConfig
from grafu.asset.foreign.agreement import AgreementConfig
from grafu.asset.foreign.matching import MatchConfig
from grafu.asset.framed_leaves import FramedLeafConfig
from grafu.asset.fronts_above import FrontsAboveConfig
from grafu.asset.grips import DrawnGripConfig
from grafu.asset.handle_stands import HandleStandConfig
from grafu.asset.handles_in_doors import HandlesInDoorsConfig
from grafu.asset.inner_pieces import InnerPieceConfig
from grafu.asset.lasso_cut import LassoConfig
from grafu.asset.leaf_pieces import LeafPieceConfig
from grafu.asset.link_groups import LinkGroupConfig
from grafu.asset.loose import LooseConfig
from grafu.asset.lying_handles import LyingHandleConfig
from grafu.asset.lying_windows import LyingWindowConfig
from grafu.asset.named_fittings import NamedFittingConfig
from grafu.asset.one_front import HeldTogetherConfig
from grafu.asset.open_side import OpenSideConfig
from grafu.asset.parted_surface import PartedSurfaceConfig
from grafu.asset.partnet_mobility import StandingConfig
from grafu.asset.pieces import PieceConfig
from grafu.asset.place_names import PlaceNamesConfig
from grafu.asset.plausibility import PlausibilityConfig
from grafu.asset.polygons import PolygonConfig
from grafu.asset.resting import RestConfig
from grafu.asset.ring_seats import RingSeatConfig
from grafu.asset.scale import ScaleConfig
from grafu.asset.seen_side import SeenSideConfig
from grafu.asset.shown_lids import ShownLidConfig
from grafu.asset.split_fronts import SplitFrontConfig
from grafu.asset.standing import FrontEvidenceConfig, HeadingConfig, UpEvidenceConfig
from grafu.asset.standing_handles import StandingHandleConfig
from grafu.asset.standing_out import StandingOutConfig
from grafu.asset.straight_borders import StraightBordersConfig
from grafu.completion.alike import AlikeConfig
from grafu.completion.appliance_bodies import ApplianceBodyConfig
from grafu.completion.boards_behind import BoardBehindConfig
from grafu.completion.config import DoorRuleConfig, DrawerRuleConfig, GuessConfig, MisnamedConfig, RowConfig, RuleConfig
from grafu.completion.control_panels import ControlPanelConfig
from grafu.completion.copied_bars import CopiedBarsConfig
from grafu.completion.cushions import CushionConfig
from grafu.completion.decode_config import FactConfig, HeldFrontsConfig, HeldPlateConfig
from grafu.completion.drawer_case import CaseConfig
from grafu.completion.drawers_above_doors import DrawerAboveConfig
from grafu.completion.dropping_doors import DroppingDoorConfig
from grafu.completion.fixed_shelves import FixedShelfConfig
from grafu.completion.guessed_shapes import GuessedShapeConfig
from grafu.completion.handle_sides import HandleSideConfig
from grafu.completion.held_borders import HeldBorderConfig
from grafu.completion.level_bars import LevelBarConfig
from grafu.completion.lids_above import LidAboveConfig
from grafu.completion.lone_fronts import LoneFrontConfig
from grafu.completion.moving_links import MovingLinkConfig
from grafu.completion.oven_doors import OvenDoorConfig
from grafu.completion.rehang import RehangConfig
from grafu.completion.round_doors import RoundDoorConfig
from grafu.completion.static_guesses import StaticGuessConfig
from grafu.completion.tall_doors import TallDoorConfig
from grafu.completion.thick_doors import ThickDoorConfig
from grafu.completion.wall_panels import WallPanelConfig
from grafu.completion.ways_out import WayOutConfig
from grafu.completion.window_doors import WindowDoorConfig
from grafu.dataset.config import DescriptorConfig
from grafu.export.gltf_packing import DracoConfig
from grafu.geometry.leaning import LeaningConfig
from grafu.judging.coverage import CoverageTestConfig
from grafu.judging.panels import RoomSearchConfig
from grafu.pipeline.verdict import VerdictConfig
from grafu.segmentation.boxes_in_case import BoxInCaseConfig
from grafu.segmentation.config import (
    CandidateConfig,
    DivisionConfig,
    FrameConfig,
    MemberConfig,
    SegmentationConfig,
)
from grafu.segmentation.drawer_boxes import TubConfig
from grafu.segmentation.furniture_pieces import FurnitureConfig
from grafu.segmentation.standing_apart import ApartConfig
from grafu.segmentation.surface_config import CreaseConfig, JoiningConfig
from module_numbers import explanations, factors_in_functions, floats_in_functions, modules_of, named_numbers

SOURCES = Path(__file__).parents[1] / "src" / "grafu"

SAMPLES = "how many rays an algorithm takes, or where they lie"
TOLERANCE = "a tolerance of computing with rounded numbers"
NUMBERING = "numbers of directions or of groups, or a direction"
VOTES = "the weight of a vote: weights were set together, against each other, and one alone means nothing"
FRAME = "it settles the frame of a front or of a border, which joints and additions share: each must see the same"
SHARED = "one answer for all: joints, additions and pages must not differ in it"
SOLD = "a table of sizes of furniture as sold, or of units of length"
WORDS = "how many names a sentence has, or letters a name"
FORMULA = "a number of geometry or mechanics"
MATERIALS = "a table of what materials weigh, the default of a field"
ELSEWHERE = "a tolerance that tells other coordinates from rounding, no size of furniture"
EFFORT = "after how much work a reader ends, or works in a simpler way"
KEPT = "how much of what was worked out is kept: less costs time and changes no result"
FORMAT = "what a format or a data set states: its axes, its codes, how large its numbers are"

FINGER = "the fingertip of a gripper: frames, shapes and pages must not differ in it"

READERS = (
    "blend", "collada", "fbx", "fbx_document", "folder", "gltf", "gltf_buffers", "gltf_draco", "gltf_meshes",
    "gltf_animations", "gltf_meshopt", "hssd_annotation", "json_files", "load", "mesh_files", "mjcf", "mjcf_text",
    "obj_lines",
    "obj_parser", "plain_png", "regular_files", "resources", "robot_document", "scan_files", "sdf", "threeds",
    "threemf", "urdf", "urdf_shapes", "usd", "usd_materials", "usd_physics",
)  # fmt: skip
"""Modules that read bytes and text: their numbers are those of formats, of colours and of how much is read."""

OF_MODULES = {
    "articulation": {
        "finger_fit.py": {
            "_ACROSS": SAMPLES,
            "_LEVELS": SAMPLES,
            "_PLACES": SAMPLES,
            "_ON_FINGER": SAMPLES,
            "_ROUNDING": TOLERANCE,
            "_LOOKED_AT": SAMPLES,
        },
        "finger_room.py": {},
        "grasp_frame.py": {
            "FINGER_WIDTH": FINGER,
            "FINGER_THICKNESS": FINGER,
            "FINGER_REACH": FINGER,
            "FINGER_GAP": FINGER,
            "_RIGHT_ANGLE": TOLERANCE,
        },
        "grasp_search.py": {},
        "coupled_weight.py": {"_STEP": TOLERANCE, "_EXACT": TOLERANCE, "_AT": SAMPLES},
        "build_material.py": {"_BY_WORD": MATERIALS, "_GLASS": MATERIALS, "_STEEL": MATERIALS, "_TEXTILE": MATERIALS},
        "mass.py": {"NO_MOMENTS": FORMULA},
    },
    "asset": {
        "bodies.py": {},
        "closed_side.py": {"_STEPS": SAMPLES},
        "open_side.py": {},
        "cutting.py": {},
        "door_frames.py": {"_RAYS": SAMPLES},
        "drafts.py": {},
        "lasso_cut.py": {"MOST_CORNERS": FORMAT, "_NO_AREA": TOLERANCE},
        "foreign/agreement.py": {"_FEW": EFFORT},
        "foreign/frames.py": {
            "_ROUNDS": EFFORT,
            "_Y_UP_Z_FRONT": FORMAT,
            "_Z_UP_X_BACK": FORMAT,
            "_Z_UP_X_FRONT": FORMAT,
        },
        "foreign/matching.py": {"_SMALLEST_SCALE": TOLERANCE, "_SOUND": TOLERANCE},
        "foreign/motions.py": {"AS_PARTS": FORMAT},
        "foreign/particulate.py": {"UP_ROTATIONS": FORMAT, "_SHAPES": FORMAT},
        "foreign/singapo.py": {"_ALIKE": ELSEWHERE, "_LARGEST": FORMAT},
        "frame.py": {},
        "furniture_pieces.py": {"_NAMED": WORDS},
        "hssd.py": {"_AGREES": ELSEWHERE},
        "loose.py": {},
        "names.py": {"_LEAST_PREFIX": WORDS, "_LONGEST": WORDS, "_RANKS": WORDS, "_TILES": WORDS},
        "part.py": {"IDENTITY_FRAME": FORMAT},
        "partnet_mobility.py": {},
        "pieces.py": {},
        "plausibility.py": {},
        "reading.py": {"_FLATNESS": TOLERANCE},
        "scale.py": {"DOOR": SOLD, "STORAGE": SOLD, "TABLE": SOLD, "WINDOW": SOLD, "UNITS": SOLD},
        "lying_windows.py": {"_RAYS": SAMPLES},
        "shown_lids.py": {"_UP": NUMBERING, "_RAYS": SAMPLES},
        "standing.py": {"_PLACES": NUMBERING},
    },
    "judging": {"handles.py": {"POSES": SAMPLES}, "panels.py": {"POSES": SAMPLES}},
    "scene": {
        "border.py": {"SNAP": FRAME, "_THIN_BOARD": FRAME, "_FRONT_RAYS": SAMPLES},
        "front.py": {"_TILTED": FRAME, "_SLIDES": FRAME, "_PANEL": FRAME, "_LYING": FRAME},
        "reads.py": {"_PLAY": TOLERANCE},
        "scale.py": {"_COMMON": SHARED},
        "shapes.py": {"MOST_SHAPES": KEPT, "MOST_USES": KEPT},
    },
    "segmentation": {
        "boxes_in_case.py": {"_TURNS": NUMBERING},
        "creased_surface.py": {"_SAME_UV": TOLERANCE},
        "mesh_shells.py": {"_Z": NUMBERING},
        "fronts.py": {"SHEET": TOLERANCE},
        "furniture_pieces.py": {"FLOOR_OR_WALL": NUMBERING, "ALONE": NUMBERING},
        "surroundings.py": {"NO_AREA": TOLERANCE, "RING_CELLS": SAMPLES},
        "view.py": {
            "_RAYS": SAMPLES,
            "_FAR": SAMPLES,
            "_MANY": SAMPLES,
            "_TOGETHER": SAMPLES,
            "_SPARE": TOLERANCE,
            "_ROOM": SAMPLES,
            "_FEW": SAMPLES,
        },
    },
    "completion": {
        "doors.py": {},
        "drawers.py": {"_DIRECTIONS": NUMBERING},
        "handles.py": {"_FLUSH": TOLERANCE, "_UP": NUMBERING},
        "rows.py": {},
        "selection.py": {},
        "slots.py": {},
        "rule.py": {"_FRONTS": NUMBERING},
        "rule_scene.py": {"CARRIES": VOTES, "_FLAT": TOLERANCE},
        "votes.py": {"_PRIOR": VOTES},
    },
    "pipeline": {"verdict.py": {"_NAMED": WORDS}, "triage.py": {}},
}
IN_FUNCTIONS = {
    "articulation": {"mass.py": dict.fromkeys((3.0, 4.0, 6.0, 9, 12.0, 20.0), FORMULA)},
    "asset": {
        "bodies.py": {},
        "cutting.py": {},
        "drafts.py": {},
        "foreign/agreement.py": {},
        "foreign/frames.py": {},
        "foreign/matching.py": {},
        "foreign/motions.py": {},
        "foreign/particulate.py": {},
        "foreign/singapo.py": {0.01: ELSEWHERE},
        "frame.py": {},
        "furniture_pieces.py": {},
        "hssd.py": {},
        "labels.py": {20_000: EFFORT},
        "loose.py": {10_000: WORDS},
        "names.py": {3: WORDS, 20_000: EFFORT},
        "part.py": {},
        "partnet_mobility.py": {3: FORMAT, 100: WORDS},
        "pieces.py": {4: WORDS, 200_000: EFFORT},
        "plausibility.py": {},
        "reading.py": {},
        "scale.py": {},
        "standing.py": {},
    },
    "judging": {
        "coverage.py": {},
        "handles.py": {},
        "panels.py": {0.01: TOLERANCE, 0.1: TOLERANCE, 0.99: TOLERANCE, 3: NUMBERING, 5: NUMBERING, 6: NUMBERING},
    },
    "scene": {"border.py": {}, "front.py": {}, "scene.py": {}},
    "segmentation": {
        "candidates.py": {},
        "division.py": {},
        "fronts.py": {6: TOLERANCE},
        "furniture_pieces.py": {},
        "mesh_shells.py": {},
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
    AgreementConfig, AnimatedMotionConfig, BoardBehindConfig, BodiesOfFacesConfig, CadNamesConfig, PartedSurfaceConfig,
    BodyKindConfig, BoxInCaseConfig, CandidateConfig, CaseConfig, CatchConfig, CutConfig, DivisionConfig,
    ClosedSideConfig, HandlesInDoorsConfig, SplitFrontConfig, StandingHandleConfig, StraightBordersConfig,
    DoorRuleConfig,
    DracoConfig, DrawerRuleConfig,
    AlikeConfig, CopiedBarsConfig, CoverageTestConfig, CushionConfig, DrawnGripConfig,
    DescriptorConfig, DynamicsConfig, FactConfig, FingerFitConfig, FingerRoomCutConfig, FixedShelfConfig,
    ApartConfig, FacingConfig, FrontsAboveConfig,
    FrameConfig, FrontEvidenceConfig, FurnitureConfig, GroupConfig, GuessConfig, GuessedShapeConfig, HeadingConfig,
    LassoConfig,
    LeaningConfig,
    FramedDoorsConfig, HandleSideConfig, HeldBorderConfig, HeldFrontsConfig, HeldPlateConfig, HeldTogetherConfig,
    LeafPieceConfig,
    BoardedDrawerConfig, FramedLeafConfig, HandleStandConfig, LinkGroupConfig,
    BodyLinkConfig, ControlPanelConfig, LidAboveConfig, RingSeatConfig, InnerPieceConfig, ApplianceBodyConfig,
    LevelBarConfig, LoneFrontConfig, MovingLinkConfig, LyingHandleConfig, LyingWindowConfig, OvenDoorConfig,
    LooseConfig,
    MassConfig, MatchConfig, NamedFittingConfig,
    MemberConfig, MisnamedConfig, PieceConfig, PlaceNamesConfig, PlausibilityConfig,
    RehangConfig, RestConfig, RoomSearchConfig, RoundDoorConfig, RowConfig, RuleConfig,
    OpenSideConfig, PolygonConfig, ScaleConfig, SeenSideConfig, SegmentationConfig, ShownLidConfig,
    StandingConfig, StandingOutConfig, StaticGuessConfig,
    ApplianceFrontConfig, CreaseConfig, DrawnCutConfig, DrawerAboveConfig, DroppingDoorConfig, JoiningConfig,
    TallDoorConfig, ThickDoorConfig, TubConfig, UpEvidenceConfig, VerdictConfig,
    WallPanelConfig, WayOutConfig, WindowDoorConfig,
)  # fmt: skip
NUMBERS = [
    (kind, f.name)
    for kind in CONFIGS
    for f in fields(kind)
    if not is_dataclass(f.default) and f.name not in ("build_by_word", "counterbalance", "catch")
]


@pytest.mark.parametrize("folder", OF_MODULES)
def test_no_threshold_stands_in_a_module(folder: str) -> None:
    found = named_numbers(SOURCES / folder)

    assert {name: found.get(name, set()) for name in OF_MODULES[folder]} == {
        name: set(reasons) for name, reasons in OF_MODULES[folder].items()
    }


@pytest.mark.parametrize("folder", ["scene", "segmentation"])
def test_all_modules_of_a_folder_are_looked_at(folder: str) -> None:
    assert named_numbers(SOURCES / folder).keys() == OF_MODULES[folder].keys()


def test_all_modules_with_numbers_of_the_input_are_looked_at_or_read_formats() -> None:
    found = named_numbers(SOURCES / "asset").keys()

    assert found <= {*OF_MODULES["asset"], *(f"{name}.py" for name in READERS)}
    assert all((SOURCES / "asset" / f"{name}.py").is_file() for name in READERS)
    assert not {f"{name}.py" for name in READERS} & OF_MODULES["asset"].keys()


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

    assert set(explanations(source, kind.__name__)) == {field.name for field in fields(kind)}


@pytest.mark.parametrize(("kind", "name"), NUMBERS)
def test_a_number_that_is_not_above_0_is_refused(kind: type, name: str) -> None:
    default = getattr(kind(), name)
    wrong = (*default[:-1], 0.0) if isinstance(default, tuple) else type(default)(0)

    with pytest.raises(ValueError, match=f"`{kind.__name__}.{name}` must be"):
        kind(**{name: wrong})
