"""What one asks of a result, what is changed of it, and how it is saved."""

from dataclasses import replace
from pathlib import Path

import pytest

import grafu
from grafu.additions.config import AdditionConfig
from grafu.additions.handle.config import HandleChoice
from grafu.errors import ExportError, OptionError
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.vocabulary import MechanismClass

SAMPLES = Path(__file__).parent.parent.parent / "samples"


@pytest.fixture(scope="module")
def chest() -> grafu.Result:
    return grafu.functionalize(SAMPLES / "chest.glb")


@pytest.fixture(scope="module")
def wardrobe() -> grafu.Result:
    return grafu.functionalize(SAMPLES / "wardrobe.glb", interior="none")


def doors(result: grafu.Result) -> list[str]:
    return [joint.part for joint in result.joints if joint.type == "revolute"]


def test_a_result_prints_in_one_short_line(chest: grafu.Result) -> None:
    assert repr(chest) == "<grafu.Result chest: 1 joint, 0 added, 0 skipped>"
    assert max(len(repr(each)) for each in (chest.made, chest.object, chest.graph, chest.made.completion)) < 200


def test_records_and_settings_print_in_a_few_lines(wardrobe: grafu.Result) -> None:
    changed = replace(AdditionConfig(), top=None, rejected=frozenset({"a"}), fronts={"door_1": HandleChoice("grip")})
    values = (wardrobe.report, *wardrobe.joints, wardrobe.settings, changed, PipelineConfig(wardrobe.settings))
    assert max(len(text) for value in values for text in (repr(value), str(value))) <= 350
    assert repr(AdditionConfig()) == "AdditionConfig()"
    assert "top=None" in repr(changed)


def test_joints_are_those_of_the_report_and_of_the_object(wardrobe: grafu.Result) -> None:
    assert wardrobe.joints == wardrobe.report.joints
    assert {joint.id for joint in wardrobe.joints} == {joint.id for joint in wardrobe.object.moving_joints}
    first = wardrobe.joints[0]
    assert wardrobe.joint(first.part) == wardrobe.joint(first.id) == first
    with pytest.raises(OptionError, match="there is no joint `nothing`: parts that move are"):
        wardrobe.joint("nothing")


def test_a_door_goes_to_the_other_side(wardrobe: grafu.Result) -> None:
    door = doors(wardrobe)[0]
    middle = wardrobe.asset.part(door).box.center[0]
    sides = {side: wardrobe.with_hinge(door, side=side).joint(door).origin[0] for side in ("left", "right")}
    assert sides["left"] < middle < sides["right"]


def test_hinges_are_as_they_are_chosen(wardrobe: grafu.Result) -> None:
    door = doors(wardrobe)[0]
    changed = wardrobe.with_hinge(door, count=3, opening=1.0)
    assert (changed.joint(door).count, round(changed.joint(door).upper, 6)) == (3, 1.0)
    assert wardrobe.joint(door).upper > 1.0  # the first result is as it was


def test_a_part_is_static(wardrobe: grafu.Result) -> None:
    door = doors(wardrobe)[0]
    stopped = wardrobe.with_motion(door, "fixed")
    assert door not in [joint.part for joint in stopped.joints]
    assert len(stopped.joints) == len(wardrobe.joints) - 1


def test_a_handle_is_chosen_and_left_out_again(chest: grafu.Result) -> None:
    lid = doors(chest)[0]
    knob = chest.with_handle(lid, "knob-round")
    assert [added.style for added in knob.added] == ["knob-round"]
    assert knob.without(knob.added[0].part).added == ()


def test_a_class_is_given_by_its_word_or_letter(wardrobe: grafu.Result) -> None:
    assert [MechanismClass(word) for word in ("contact", "flush", "perpendicular", "C")] == ["C", "F", "P", "C"]
    door = doors(wardrobe)[0]
    by_word, by_letter = (wardrobe.with_hinge(door, mechanism=name) for name in ("contact", "C"))
    assert by_word.settings == by_letter.settings != wardrobe.settings


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda r, d: r.with_hinge(d, side="upwards"), "`side` must be one of left, right, top, bottom"),
        (lambda r, d: r.with_hinge(d, mechanism="Z"), "`mechanism` must be one of contact, flush, perpendicular"),
        (lambda r, d: r.with_hinge(d, template="no-such"), "template of"),
        (lambda r, d: r.with_hinge(d, count=99), "`count` must be in 0..12: got 99"),
        (lambda r, d: r.with_hinge(d, opening=-1.0), "`opening` must be above 0"),
        (lambda r, d: r.with_hinge("nothing", count=2), "there is no joint `nothing`"),
        (lambda r, d: r.with_motion("nothing", "left"), "has no nothing"),
        (lambda r, d: r.with_rail("nothing", template="x"), "has no nothing"),
        (lambda r, d: r.with_label(d, "spoon"), "`label` must be one of"),
        (lambda r, d: r.without(d), "was not added: added parts are none"),
        (lambda r, d: r.with_handle(d, "no-such"), "`style` must be one of .* got 'no-such'"),
    ],
)
def test_what_cannot_be_is_one_line(chest: grafu.Result, change: object, message: str) -> None:
    with pytest.raises(OptionError, match=message) as raised:
        change(chest, doors(chest)[0])  # type: ignore[operator]
    assert "\n" not in str(raised.value)


def test_saving_gives_the_folder_and_refuses_to_replace_it(chest: grafu.Result, tmp_path: Path) -> None:
    folder = chest.save(str(tmp_path / "a" / "b"), formats=["glb", "mjcf"])
    assert {"model.glb", "model.xml", "report.html", "report.json"} <= {path.name for path in folder.iterdir()}
    with pytest.raises(ExportError, match="exists already"):
        chest.save(folder)
    chest.save(folder, "urdf", page=False, overwrite=True)
    assert not (folder / "model.xml").exists()
    assert (folder / "model.urdf").exists()


def test_wrong_formats_are_refused_before_anything_is_written(chest: grafu.Result, tmp_path: Path) -> None:
    with pytest.raises(ExportError, match="unknown format `fbx`"):
        chest.save(tmp_path / "out", formats=["glb", "fbx"])
    assert list(tmp_path.iterdir()) == []


def test_a_result_is_never_saved_over_its_input(chest: grafu.Result) -> None:
    with pytest.raises(ExportError, match="holds the input"):
        chest.save(SAMPLES, overwrite=True)
    assert (SAMPLES / "chest.glb").is_file()
