"""What is reported as missing."""

from dataclasses import replace

from grafu.additions.step import DeficiencyKind
from grafu.asset.part import Asset
from grafu.graph.parse import parse_graph
from grafu.joints.config import RealizationConfig
from grafu.joints.rail_config import DrawerConfig
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.records import find_deficiencies
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

KIND = DeficiencyKind


def made(handle: str = "bar-round") -> Asset:
    return make_cabinet(Cabinet("made", layout=Stack((Drawer(handle=handle), Door(handle=handle)))))  # type: ignore[arg-type]


def kinds(asset: Asset) -> list[tuple[KIND, PartLabel]]:
    missing = find_deficiencies(asset, parse_graph(asset))
    return [(one.kind, asset.part(one.part).label) for one in missing if one.part]


def test_hardware_is_missing_where_something_moves() -> None:
    assert set(kinds(made())) == {(KIND.HINGE, PartLabel.DOOR), (KIND.RAIL, PartLabel.DRAWER)}


def test_joints_are_missing_where_the_input_states_none() -> None:
    found = kinds(replace(made(), joints=()))
    assert (KIND.JOINT, PartLabel.DOOR) in found
    assert (KIND.JOINT, PartLabel.DRAWER) in found


def test_handles_are_missing_where_none_rides() -> None:
    found = kinds(made(handle="none"))
    assert (KIND.HANDLE, PartLabel.DOOR) in found
    assert (KIND.HANDLE, PartLabel.DRAWER) in found


def test_labels_are_missing_once_masked_and_the_top_is_there_all_the_same() -> None:
    asset = made()
    masked = asset.with_labels({part.id: PartLabel.UNKNOWN for part in asset.parts})
    missing = find_deficiencies(masked, parse_graph(masked))

    assert len([one for one in missing if one.kind is KIND.LABEL]) == len(asset.parts)
    assert KIND.TOP not in {one.kind for one in missing}


def test_a_top_is_missing_once_it_is_taken_away() -> None:
    asset = made()
    topless = replace(asset, parts=tuple(p for p in asset.parts if p.label is not PartLabel.TOP_PANEL))
    missing = find_deficiencies(topless, parse_graph(topless))

    assert [one.part for one in missing if one.kind is KIND.TOP] == [""]


def found_by_a_run(asset: Asset) -> dict[KIND, list[str]]:
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery())
    missing = find_deficiencies(asset, made.completion.completed, (made.body, made.fittings))
    return {kind: [one.part for one in missing if one.kind is kind] for kind in KIND}


def test_a_run_says_what_geometry_lacks() -> None:
    spec = Cabinet("made", layout=Stack((Drawer("front only", handle="none"), Door(handle="none"))))
    asset = make_cabinet(spec)
    panels = (PartLabel.TOP_PANEL, PartLabel.BACK_PANEL)
    found = found_by_a_run(replace(asset, parts=tuple(p for p in asset.parts if p.label not in panels)))
    drawer = next(p.id for p in asset.parts if p.label is PartLabel.DRAWER)
    door = next(p.id for p in asset.parts if p.label is PartLabel.DOOR)

    assert found[KIND.TOP] == [""]
    assert found[KIND.BACK]
    assert found[KIND.DRAWER_BOX] == [drawer]
    assert sorted(found[KIND.HANDLE]) == sorted([door, drawer])


def test_a_run_on_a_whole_cabinet_finds_nothing_of_it() -> None:
    found = found_by_a_run(made())
    missing = (KIND.TOP, KIND.BACK, KIND.BOTTOM, KIND.DRAWER_BOX, KIND.HANDLE)
    assert {kind: found[kind] for kind in missing} == {kind: [] for kind in missing}


def test_what_counts_as_a_drawer_is_the_same_to_joints_and_to_drawer_boxes() -> None:
    """Where all that is less deep than wide counts as a front, the boxes of a wide chest's drawers do not count."""
    chest = make_cabinet(Cabinet("made", Case(width=1.2, depth=0.4), Stack((Drawer(), Drawer()), between="nothing")))
    config = RealizationConfig(drawer=DrawerConfig(thickest_board=9.0, slat=0.99))

    assert without_box(chest, RealizationConfig()) == []
    assert without_box(chest, config) == [part.id for part in chest.parts if part.label is PartLabel.DRAWER]


def without_box(asset: Asset, config: RealizationConfig) -> list[str]:
    """The drawers that are reported as mere fronts."""
    settings = PipelineConfig(realization=config)
    made = functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), settings)
    return [one.part for one in made.body.deficiencies if one.kind is KIND.DRAWER_BOX]
