"""Numbers of every config of realization check themselves when they are made."""

from dataclasses import fields
from math import nan

import pytest

from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.compartment.config import SolidBodyConfig
from grafu.additions.door_frame.config import DoorFrameConfig
from grafu.additions.drawer_box.config import BoxProbeConfig, DrawerBoxConfig
from grafu.additions.grip.config import GripConfig, GripSize, GripSizes, GripTrials, GroundConfig
from grafu.additions.handle.config import HandleConfig, HandleTrials
from grafu.additions.handle.grasp_config import FingerRoomConfig, GraspConfig, GripConfidences, ReliefConfig
from grafu.additions.interior.config import CarouselConfig, InteriorConfig, RoomConfig
from grafu.additions.top.config import (
    CutoutConfig,
    EvidenceConfig,
    OpeningConfig,
    OutlineConfig,
    SupportConfig,
    TopConfig,
)
from grafu.additions.top.lids_below import LidBelowConfig
from grafu.additions.top.slope_config import SlopeConfig
from grafu.additions.top.tap_config import TapConfig
from grafu.joints.clearance_config import ClearanceConfig
from grafu.joints.config import RealizationConfig
from grafu.joints.hinge_config import FootingConfig, HingeConfig, PinConfig, PivotConfig, SurveyConfig
from grafu.joints.rack_guide_config import RackGuideConfig
from grafu.joints.rail_config import BehindConfig, BodyConfig, FlankConfig, RailConfig
from grafu.joints.rail_footing_config import RailFootingConfig

CONFIGS = (
    BehindConfig, BodyConfig, BoxProbeConfig, CarcassConfig, CarouselConfig, ClearanceConfig, CutoutConfig,
    DoorFrameConfig,
    DrawerBoxConfig,
    EvidenceConfig, FingerRoomConfig, FlankConfig, FootingConfig, GraspConfig, GripConfidences, GripConfig,
    GripSizes, GroundConfig, HandleConfig, HandleTrials, HingeConfig, InteriorConfig, OpeningConfig, OutlineConfig,
    PinConfig, PivotConfig, RackGuideConfig, RailConfig, RailFootingConfig, RealizationConfig, ReliefConfig, RoomConfig,
    SlopeConfig, SolidBodyConfig, SupportConfig, SurveyConfig, TopConfig,
)  # fmt: skip
NUMBERS = [(made, field.name) for made in CONFIGS for field in fields(made) if field.type is float]
COUNTS = [(made, field.name) for made in CONFIGS for field in fields(made) if field.type is int]
POSITIVE = [
    (BoxProbeConfig, "touch"),
    (CarcassConfig, "back"),
    (ClearanceConfig, "play"),
    (SolidBodyConfig, "wall"),
    (DoorFrameConfig, "gap"),
    (CutoutConfig, "opening"),
    (DrawerBoxConfig, "wall"),
    (EvidenceConfig, "flange"),
    (FingerRoomConfig, "level"),
    (GraspConfig, "gap"),
    (GripConfig, "margin"),
    (GripSize, "length"),
    (GripConfig, "finger_width"),
    (GroundConfig, "seam"),
    (HandleConfig, "inset"),
    (HandleConfig, "from_top"),
    (HandleConfig, "least"),
    (BehindConfig, "air"),
    (BodyConfig, "even"),
    (FlankConfig, "taller"),
    (FootingConfig, "thinnest"),
    (HingeConfig, "tongue"),
    (PinConfig, "widest_seam"),
    (PinConfig, "widest_strip"),
    (PivotConfig, "plate"),
    (SurveyConfig, "even"),
    (InteriorConfig, "touch"),
    (OpeningConfig, "crack"),
    (OutlineConfig, "line"),
    (RailConfig, "divider"),
    (RealizationConfig, "depth"),
    (ReliefConfig, "cell"),
    (RoomConfig, "drawer_cells"),
    (SupportConfig, "divider"),
    (TapConfig, "rises"),
    (TopConfig, "thickness"),
]
RATIOS = [
    (ClearanceConfig, "touching"),
    (CutoutConfig, "left"),
    (EvidenceConfig, "plate"),
    (GraspConfig, "inside"),
    (GraspConfig, "labelled"),
    (GraspConfig, "lever"),
    (GraspConfig, "small"),
    (GripConfidences, "hooked"),
    (GripConfidences, "notch"),
    (GripConfig, "depth_ratio"),
    (GripConfig, "shown"),
    (GripSizes, "rim_radius"),
    (HandleConfig, "both"),
    (HandleConfig, "central"),
    (HandleConfig, "from_top_ratio"),
    (BehindConfig, "span"),
    (BodyConfig, "long"),
    (FlankConfig, "margin"),
    (FootingConfig, "snap"),
    (HingeConfig, "slim"),
    (PinConfig, "edge_leaf"),
    (PivotConfig, "met"),
    (SurveyConfig, "ends"),
    (InteriorConfig, "carried"),
    (OpeningConfig, "least"),
    (OutlineConfig, "carries"),
    (RailConfig, "most_inset"),
    (RackGuideConfig, "kept"),
    (RailFootingConfig, "wall"),
    (RealizationConfig, "least_opening"),
    (RealizationConfig, "max_carve"),
    (RealizationConfig, "max_carve_last"),
    (RealizationConfig, "max_carve_hidden"),
    (ReliefConfig, "plane"),
    (RoomConfig, "walled"),
    (SupportConfig, "full"),
    (TapConfig, "bottom"),
    (LidBelowConfig, "closes"),
    (TopConfig, "coverage"),
    (TopConfig, "metal"),
]


@pytest.mark.parametrize(("made", "name"), NUMBERS)
@pytest.mark.parametrize("wrong", [-1.0, nan])
def test_no_number_is_negative_or_none_at_all(made: type, name: str, wrong: float) -> None:
    with pytest.raises(ValueError, match=f"`{made.__name__}.{name}` must .*: got {wrong}"):
        made(**{name: wrong})


@pytest.mark.parametrize(("made", "name"), POSITIVE)
def test_what_is_there_has_a_size(made: type, name: str) -> None:
    sizes = {"length": 0.1, "width": 0.1} if made is GripSize else {}
    with pytest.raises(ValueError, match=rf"`{made.__name__}.{name}` must be .*: got 0\.0"):
        made(**{**sizes, name: 0.0})


@pytest.mark.parametrize(("made", "name"), COUNTS)
def test_no_count_is_negative(made: type, name: str) -> None:
    with pytest.raises(ValueError, match=r"must .*: got .*-1"):
        made(**{name: -1})


@pytest.mark.parametrize(("made", "name"), RATIOS)
def test_a_fraction_is_less_than_the_whole(made: type, name: str) -> None:
    with pytest.raises(ValueError, match=f"`{made.__name__}.{name}` must be"):
        made(**{name: 1.5})


@pytest.mark.parametrize("wrong", [{"size": (0.0, 0.1)}, {"depth": 0.0}, {"depth": nan}, {"size": (0.1, nan)}], ids=str)
def test_a_grips_own_size_is_above_0(wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match="own size and depth must be above 0: got"):
        GripConfig(**wrong)


@pytest.mark.parametrize(
    ("made", "wrong"),
    [
        (GripTrials, {"sizes": (1.0, 0.0)}),
        (GripTrials, {"margins": (-1.0,)}),
        (HandleTrials, {"lengths": (0.0,)}),
        (HandleTrials, {"protrusions": (1.0, nan)}),
        (HandleTrials, {"insets": (-0.5,)}),
        (HandleTrials, {"levels": (0.5, 0.0)}),
        (HandleTrials, {"spare": (("knob-round", 1.0, 0.0),)}),
    ],
)
def test_a_size_that_is_tried_is_above_0(made: type, wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match="must be above 0: got"):
        made(**wrong)
