"""What is reported as missing."""

from dataclasses import replace

from grafu.asset.part import Asset
from grafu.graph.parse import parse_graph
from grafu.pipeline.deficiencies import DeficiencyKind, find_deficiencies
from grafu.synth.cabinet import Cabinet, make_cabinet
from grafu.synth.layout import Door, Drawer, Stack
from grafu.vocabulary import PartLabel

KIND = DeficiencyKind


def made(handle: str = "bar-round") -> Asset:
    return make_cabinet(Cabinet("made", layout=Stack((Drawer(handle=handle), Door(handle=handle)))))  # type: ignore[arg-type]


def kinds(asset: Asset) -> list[tuple[KIND, PartLabel]]:
    lacks = find_deficiencies(asset, parse_graph(asset))
    return [(lack.kind, asset.part(lack.part).label) for lack in lacks if lack.part]


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


def test_a_top_and_labels_are_missing_once_masked() -> None:
    asset = made()
    masked = asset.with_labels({part.id: PartLabel.UNKNOWN for part in asset.parts})
    lacks = find_deficiencies(masked, parse_graph(masked))

    assert [lack.part for lack in lacks if lack.kind is KIND.TOP] == [""]
    assert len([lack for lack in lacks if lack.kind is KIND.LABEL]) == len(asset.parts)
    assert KIND.TOP not in {lack.kind for lack in find_deficiencies(asset, parse_graph(asset))}
